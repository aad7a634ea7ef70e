//! Placements other than prefixes of sequences.

pub(crate) mod praun;
