/// Receives the progress of a job and can ask it to stop.
///
/// A job calls these methods from any of its threads, but never from a time-critical one. To cancel a job at once,
/// unwind out of [`report_step`](Self::report_step) or [`report_fraction`](Self::report_fraction): no file is half written at that point.
pub trait ProgressCallback: Sync {
    /// Reports the current step.
    fn report_step(&self, doing: &str);

    /// A warning before a long step; the answer repeats it.
    fn warn(&self, _warning: &str) {}

    /// Sets the completed fraction of the job, from 0 to 1 [-].
    fn report_fraction(&self, part: f64);

    /// Whether the job should stop cleanly and return its results so far.
    fn should_stop(&self) -> bool {
        false
    }

    /// Calls `write`, which writes a file and must not be cancelled.
    fn without_cancellation(&self, write: &mut dyn FnMut()) {
        write();
    }
}

/// Ignores all progress.
#[derive(Debug, Clone, Copy)]
pub struct NoProgress;

impl ProgressCallback for NoProgress {
    fn report_step(&self, _doing: &str) {}

    fn report_fraction(&self, _part: f64) {}
}
