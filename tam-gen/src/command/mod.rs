//! What commands on top of this library share: arguments, printing, failures, files, interruption and progress.
//!
//! `tam-gen` and `tam-viewer` are made of it, so that both speak alike: one readable report with a way out, one JSON
//! object on standard output with `--json`, files written whole or not at all.

mod common;
mod failure;
pub mod files;
pub mod interrupt;
mod output;
mod progress;
pub mod schema;
pub mod shell;
pub mod source;
pub mod words;

pub use common::{Common, STYLES, in_pool, start_log};
pub use failure::Failure;
pub use output::{Output, colours, print_bytes, refused_arguments};
pub use progress::Progress;
