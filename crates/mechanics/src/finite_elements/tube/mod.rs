//! A tube under pressure: its widening, its limit pressure, and the force of a punch on its side.
//!
//! The pressure follows the inner wall ([`super::Cavity`]); both end faces are fixed, or guided:
//! then they may widen but not move along the tube, which is a piece of an endless one. Beyond its
//! limit pressure a tube of a law that does not stiffen enough has no equilibrium; the limit is a
//! point of its [`super::Path`], where the pressure has its first maximum.
//!
//! *How we know*: `tube::…`: Lamé's cylinder, the closed form for incompressible tubes in plane strain
//! up to and beyond its maximum, refined runs; for the punch the half-space, the axisymmetric tube and
//! F = d(E − p V)/dd (`punching::tests`).
//!
//! *Limits*: inflation is axisymmetric and symmetric about the middle; a tube that is sucked in, or so
//! long that it bends or bulges off its middle, does otherwise.

mod indent;
mod inflate;
mod mesh;
mod punching;
mod solid;

use std::sync::Arc;

use crate::Error;
use crate::material::law::Law;

pub use indent::{Indented, TubePunch, indent};
pub use inflate::{Inflated, WIDEST, inflate};

/// A tube at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tube {
    /// Length between its end faces [m].
    pub length: f64,
    /// Inner radius [m].
    pub inner_radius: f64,
    /// Outer radius [m].
    pub outer_radius: f64,
}

/// Boundary condition of the end faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Nothing.
    Fixed,
    /// Widen or narrow.
    Guided,
}

/// A tube of tissue and its supports.
#[derive(Debug, Clone)]
pub struct TubeProblem {
    /// Its shape.
    pub tube: Tube,
    /// Its law; with [`crate::Strain::Small`] all is linear and there is no limit. Fibres lie in the wall, at their angle to
    /// the circumference.
    pub law: Arc<dyn Law>,
    /// Its ends.
    pub ends: Ends,
}

impl Tube {
    fn wall(&self) -> f64 {
        self.outer_radius - self.inner_radius
    }

    fn check(&self) -> Result<(), Error> {
        let Self {
            length,
            inner_radius,
            outer_radius,
        } = *self;
        let good = length > 0.0 && inner_radius > 0.0 && outer_radius > inner_radius;
        if good && length.is_finite() && outer_radius.is_finite() {
            return Ok(());
        }
        Err(Error::TubeOutOfRange {
            length,
            inner_radius,
            outer_radius,
        })
    }
}

fn check_pressure(pressure: f64) -> Result<(), Error> {
    if pressure >= 0.0 && pressure.is_finite() {
        Ok(())
    } else {
        Err(Error::PressureOutOfRange { pressure })
    }
}
