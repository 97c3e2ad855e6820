//! A rig that is operated by a person, on a thread of its own.
//!
//! ```text
//!            ──ring(RigCommand)──▶ rig, 1 kHz ──ring(RigEvent)──▶ log writer ──ring(RigSample)─────▶ window
//!  Console   ──stop, emergency stop,▶                                │        ──channel(ConsoleEvent)▶
//!              arm (atomic)                                          └──▶ *.csv
//! ```
//!
//! Nothing blocks the rig: values that find a ring full are counted as lost. The log writer writes the recordings, so
//! that a slow window loses no row. A command from before a stop or a failed motion is stale: the rig drops it and
//! reports that.
//!
//! *How we know*: `live::…` on a virtual clock, with [`CommandedRig`] in the thread of the test.
//!
//! *Limits*: the operating system decides how punctual the thread is. Over virtual tissue the rig's time waits with the
//! thread.

mod commanded_rig;
mod console;
mod live_rig;
mod log_writer;

pub use commanded_rig::{CommandedRig, RigEvent};
pub use console::{Console, RigCommand};
pub use live_rig::LiveRig;
pub use log_writer::{ConsoleEvent, RecordingRequest, WriteFailed};
