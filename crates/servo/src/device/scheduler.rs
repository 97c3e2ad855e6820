use std::time::Duration;

use crate::{Disabled, Fault};

/// Whether a scheduler shall call again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// At its next period.
    Again,
    /// Never again.
    End,
}

/// One tick of a loop. It never panics, and does nothing after it answered [`Next::End`].
pub type Tick = Box<dyn FnMut() -> Next + Send>;

/// The scheduler of a device that is called from a thread of its own library.
pub trait Scheduler: Send {
    /// Has `tick` called once per period from now on, never twice at the same time.
    ///
    /// # Errors
    /// When the library refuses.
    fn start(&mut self, tick: Tick) -> Result<(), Fault>;

    /// Switches the motors off from another thread than that of the calls, for a tick that does not come to its end.
    fn disable(&mut self) -> Disabled;

    /// Ends the calls and drops the tick, with its device, after `tick` answered [`Next::End`].
    ///
    /// # Errors
    /// When `tick` did not answer that within `timeout`, or the library does not end: the tick is never dropped then,
    /// for a call may still come.
    fn stop(&mut self, timeout: Duration) -> Result<(), Fault>;
}
