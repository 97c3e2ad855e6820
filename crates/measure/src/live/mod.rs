//! A rig that is operated by a person, on a thread of its own.
//!
//! ```text
//!            ──ring(RigCommand)──────────▶ rig, 1 kHz ──ring(RigEvent)──▶ clerk ──ring(RigSample)──▶ window
//!  Console   ──stop, emergency stop,▶                             │   ──channel(ConsoleEvent)─────▶
//!              arm (atomic)                                       └──▶ *.csv
//! ```
//!
//! Nobody keeps the rig waiting: what finds no room in a ring is counted. Recordings are written by the clerk,
//! so that they are whole however slow the window is. An order that was given before somebody pressed stop, or
//! before a motion failed, is stale: it is dropped and said to be.
//!
//! *How we know*: `live::…` on a virtual clock, with [`Operated`] in the thread of the test.
//!
//! *Limits*: the thread is as punctual as the operating system lets it be. Over tissue that is not there the rig's
//! time waits with it.

mod console;
mod live_rig;
mod log_writer;
mod operated;

pub use console::{Console, RigCommand};
pub use live_rig::LiveRig;
pub use log_writer::{Commission, ConsoleEvent, Unwritten};
pub use operated::{Operated, RigEvent};
