//! Devices of OpenHaptics (Touch, PHANTOM), by `libHD`.
//!
//! The library has a scheduler of its own that calls back a thousand times a second, and its device may be called from
//! there alone. So the servo loop ticks inside that callback: one frame per tick, which takes the force of the tick
//! before and tells where the handle is. The last frame has zero force, and the motors are off before the scheduler
//! stops; so it is after a panic.
//!
//! A stylus in its inkwell is held by nobody. One that is calibrated by its inkwell is calibrated when it is put there.
//!
//! The axes are ours: x right, y up, z toward the user; millimetres become metres.
//!
//! *How we know*: `libraries::…`, `library_faults::…`, `campaign::…` in the tests, against a library that stands for it;
//! `tests` here, under Miri.
//!
//! *Limits*: the default device alone. That the stylus points along −z of its own frame is not in the documents that
//! could be read; nor is what the switch of the inkwell reads, which follows two public drivers. Should the scheduler
//! call no more, no frame can say zero: the motors are switched off by who ends the loop. Not tried on hardware.

mod device;
mod errors;
mod functions;
mod scheduler;
#[cfg(test)]
mod tests;

pub use device::{OpenHapticsDevice, list};
