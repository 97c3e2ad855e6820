//! Devices of Force Dimension (omega, delta, sigma, lambda), by `libdhd`.
//!
//! The thread of the loop calls its functions, one after another: it never waits for another thread of ordinary
//! priority. A call that does not return blocks that thread; then the device's own watchdog, which is set if it has
//! one, takes its forces off after 20 ms. The driver sets the library's limit of the force. Arming enables forces
//! again, whatever took them off.
//!
//! The axes of the library are x toward the user, y right, z up; ours are (y, z, x) of it.
//!
//! *How we know*: `libraries::…`, `library_faults::…`, `campaign::…` in the tests, against a stand-in library; `tests`
//! here, under Miri.
//!
//! *Limits*: the button of a gripper shuts it, not its angle, whose range is not known. The direction of its handle was
//! not verified. Not tried on hardware.

mod device;
mod functions;
#[cfg(test)]
mod tests;

pub use device::{ForceDimensionDevice, list};
