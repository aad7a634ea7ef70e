//! What can go wrong in a generation.

/// Why no map came out.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// The application asked to stop.
    #[error("generation was cancelled")]
    Cancelled,
    /// The preset holds something that no map can be made from.
    #[error("{at}: {problem}")]
    Preset {
        /// Place in the preset, as a dotted key.
        at: String,
        /// What is wrong there.
        problem: String,
    },
}
