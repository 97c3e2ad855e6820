//! Devices of OpenHaptics (Touch, PHANTOM), by `libHD`.
//!
//! The library has a scheduler of its own that calls back a thousand times a second. The callback takes the newest
//! force, hands it over, and tells where the handle is; a servo loop beside it finds the newest state waiting. So a
//! force is up to a tick later than on a device that is asked, and a loop that hangs is noticed on the other side: a
//! force that is older than 20 ms is not displayed.
//!
//! The axes are ours: x right, y up, z toward the user; millimetres become metres.
//!
//! *How we know*: `open_haptics::…` in the tests, against a library that stands for it (`stand_ins/hd.c`).
//!
//! *Limits*: the default device alone. That the stylus points along −z of its own frame is not in the documents that
//! could be read. Not tried on hardware.

mod device;
mod errors;
mod frames;
mod functions;

pub use device::{OpenHapticsDevice, list};
