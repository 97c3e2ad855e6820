/// Receives the progress of a job and can ask it to stop.
///
/// A job calls these methods from any of its threads, but never from a time-critical one. To cancel a job at once,
/// unwind out of [`say`](Self::say) or [`at`](Self::at): no file is half written at that point.
pub trait Watch: Sync {
    /// Reports the current step.
    fn say(&self, doing: &str);

    /// A warning before a long step; the answer repeats it.
    fn warn(&self, _warning: &str) {}

    /// Sets the completed fraction of the job, from 0 to 1 [-].
    fn at(&self, part: f64);

    /// Whether the job should stop cleanly and return its results so far.
    fn is_asked_to_stop(&self) -> bool {
        false
    }

    /// Calls `write`, which writes a file and must not be cancelled.
    fn unbroken(&self, write: &mut dyn FnMut()) {
        write();
    }
}

/// Ignores all progress.
#[derive(Debug, Clone, Copy)]
pub struct Nobody;

impl Watch for Nobody {
    fn say(&self, _doing: &str) {}

    fn at(&self, _part: f64) {}
}
