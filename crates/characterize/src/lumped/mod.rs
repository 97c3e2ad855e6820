//! Laws without geometry, on plain columns of time, depth and force.
//!
//! *Mean modulus*: closed forms of the half-space for a flat punch (6.1), a sphere [Hertz 1881] and a cone
//! [Sneddon 1965]. *Kelvin*: two springs and a damper, (6.3) as it must read: a step of depth d gives
//! d (k₂ + (k₁ − k₂) exp(−t k₁/b)); the printed form rises with time (`docs/errata.md`).
//!
//! *How we know*: `lumped::…`: closed forms, recordings made from known parameters.
//!
//! *Limits*: small strain; the numbers belong to one indenter on one specimen.

mod kelvin;
mod mean_modulus;

pub use kelvin::{DepthHistory, KelvinFit, fit_kelvin};
pub use mean_modulus::{Contact, fit_modulus, mean_modulus};
