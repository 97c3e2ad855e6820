//! Devices of Force Dimension (omega, delta, sigma, lambda), by `libdhd`.
//!
//! Its functions are called on the thread of the loop, one after another: zero time is spent on waiting for another
//! thread of ordinary priority. A call that does not return holds up that thread; then the device's own watchdog, which
//! is set where there is one, takes its forces off after 20 ms. The library is told the largest force that it may ever
//! display. Arming enables forces again, after whatever took them off.
//!
//! The axes of the library are x toward the user, y right, z up; ours are (y, z, x) of it.
//!
//! *How we know*: `libraries::…`, `library_faults::…`, `campaign::…` in the tests, against a library that stands for it;
//! `tests` here, under Miri.
//!
//! *Limits*: a gripper is shut by its button, not by its angle, whose range is not known. Which way its handle points
//! was not seen. Not tried on hardware.

mod device;
mod functions;
#[cfg(test)]
mod tests;

pub use device::{ForceDimensionDevice, list};
