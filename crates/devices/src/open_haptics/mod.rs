//! Devices of OpenHaptics (Touch, PHANTOM), by `libHD`.
//!
//! The library has a scheduler of its own that calls back a thousand times a second, and only its thread may call the
//! device. So the servo loop ticks inside that callback: one frame per tick, which sends the force of the tick before
//! and reads the handle's state. The last frame has zero force, and the motors are off before the scheduler stops; the
//! same holds after a panic.
//!
//! No hand holds a stylus in its inkwell. A device that the inkwell calibrates is calibrated when its stylus is put
//! there.
//!
//! The axes are ours: x right, y up, z toward the user; millimetres become metres.
//!
//! *How we know*: `libraries::…`, `library_faults::…`, `campaign::…` in the tests, against a stand-in library; `tests`
//! here, under Miri.
//!
//! *Limits*: the default device alone. The documents that could be read do not state that the stylus points along −z of
//! its own frame; nor do they state what the switch of the inkwell reads, which follows two public drivers. If the
//! scheduler no longer calls, no frame can send zero: the thread that ends the loop switches the motors off. Not tried
//! on hardware.

mod device;
mod errors;
mod functions;
mod scheduler;
#[cfg(test)]
mod tests;

pub use device::{OpenHapticsDevice, list};
