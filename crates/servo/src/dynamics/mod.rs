//! Compensation of a device's own weight, spring and mass: [`Compensation`], and the [`Linkage`] whose weight it
//! balances.
//!
//! *How we know*: `compensation::…` of the crate `measure`, whose virtual PHANTOM has such a weight, spring and mass.

mod compensation;
mod linkage;

pub(crate) use compensation::Compensator;
pub use compensation::{Compensation, largest_mass};
pub use linkage::Linkage;
