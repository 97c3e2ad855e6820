/// Why something cannot be found from a recording.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// The samples are too few.
    #[error(
        "the recording has {samples} samples, and {task} takes at least {least}; record for longer or faster"
    )]
    TooShort {
        /// How many there are.
        samples: usize,
        /// How many are needed.
        least: usize,
        /// What for.
        task: &'static str,
    },
}
