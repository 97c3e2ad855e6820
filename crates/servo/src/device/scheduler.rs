use std::time::Duration;

use crate::{Disabled, Fault};

/// Whether a scheduler calls again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// At its next period.
    Continue,
    /// Never again.
    End,
}

/// One tick of a loop. It never panics, and does nothing after it has returned [`Next::End`].
pub type Tick = Box<dyn FnMut() -> Next + Send>;

/// The scheduler of a device whose library calls from its own thread.
pub trait Scheduler: Send {
    /// Calls `tick` once per period from now on, never twice at the same time.
    ///
    /// # Errors
    /// When the library refuses.
    fn start(&mut self, tick: Tick) -> Result<(), Fault>;

    /// Switches the motors off from another thread, for a tick that does not return.
    fn disable(&mut self) -> Disabled;

    /// Ends the calls and drops the tick, with its device, after `tick` returned [`Next::End`].
    ///
    /// # Errors
    /// When `tick` did not return that within `timeout`, or the library does not end: the tick is then never dropped,
    /// since another call may still come.
    fn stop(&mut self, timeout: Duration) -> Result<(), Fault>;
}
