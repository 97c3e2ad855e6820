/// Who waits for a job: hears how far it is, and may ask it to stop.
///
/// A job calls these from any of its threads and from none that is in a hurry. One that must end at once may
/// unwind out of [`say`](Self::say) and [`at`](Self::at): no file is half written then.
pub trait Watch: Sync {
    /// What is being done now.
    fn say(&self, doing: &str);

    /// A warning about what takes long from now on; the answer has it too.
    fn warn(&self, _warning: &str) {}

    /// The part of the whole that is done, from 0 to 1 [-].
    fn at(&self, part: f64);

    /// Whether the job should end in good order, with what is done so far.
    fn is_asked_to_stop(&self) -> bool {
        false
    }

    /// Calls `write`, which writes a file and must not be cancelled.
    fn unbroken(&self, write: &mut dyn FnMut()) {
        write();
    }
}

/// Nobody waits.
#[derive(Debug, Clone, Copy)]
pub struct Nobody;

impl Watch for Nobody {
    fn say(&self, _doing: &str) {}

    fn at(&self, _part: f64) {}
}
