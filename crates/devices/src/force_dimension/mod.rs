//! Devices of Force Dimension (omega, delta, sigma, lambda), by `libdhd`.
//!
//! A call into the library may take as long as it likes, so a thread of its own makes them: it is given a force,
//! hands it over, reads the device and answers. A servo loop waits for the answer for 20 ms at most. Without a new force
//! for so long the thread takes the force off by itself, and the library is told the largest force that it may ever
//! display.
//!
//! The axes of the library are x toward the user, y right, z up; ours are (y, z, x) of it.
//!
//! *How we know*: `force_dimension::…` in the tests, against a library that stands for it (`stand_ins/dhd.c`).
//!
//! *Limits*: a gripper is shut by its button, not by its angle, whose range is not known. Which way its handle points
//! was not seen. The device's own watchdog is left as it is. Not tried on hardware.

mod calls;
mod device;
mod functions;

pub use device::{ForceDimensionDevice, list};
