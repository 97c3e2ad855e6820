use nalgebra::Matrix3;

use super::layout::{CapShape, Layout, Role};
use super::shape_function::Particles;
use crate::linear::dense::DenseSystem;
use crate::linear::gmres::Gmres;

/// The solution of either form for a contact, in units of h and of Young's modulus: the
/// coefficients for the three unit displacements of the tool, and the force that each takes.
#[derive(Debug, Clone)]
pub(super) struct Solution {
    pub(super) particles: Particles,
    /// Per particle the matrix whose column k is U_J for a unit displacement along k [-].
    pub(super) coefficients: Vec<Matrix3<f64>>,
    /// Force on the tissue along i for a unit displacement along k [E h].
    pub(super) stiffness: Matrix3<f64>,
}

impl Solution {
    pub(super) fn new(count: usize) -> Self {
        Self {
            particles: Particles::with_capacity(count),
            coefficients: vec![Matrix3::zeros(); count],
            stiffness: Matrix3::zeros(),
        }
    }

    /// Puts the particles under a surface of shape `cap`.
    pub(super) fn place(&mut self, layout: &Layout, cap: CapShape, support: f64) {
        self.particles.positions.clear();
        self.particles
            .positions
            .extend(layout.places.iter().map(|place| cap.position(place)));
        self.particles.size_spheres(support);
    }
}

/// How the equations of a contact were solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Solved {
    /// By factors.
    Directly,
    /// By so many iterations.
    Iteratively(usize),
    /// By factors, since the iterations ended with this relative residual [-].
    InPlaceOfIterations(f64),
}

impl Solved {
    /// Replaces the right sides of `system` by the solutions: to a tolerance [-] if iterations reach it,
    /// else by factors.
    pub(super) fn of(system: &mut DenseSystem, gmres: Option<(&mut Gmres, f64)>) -> Self {
        let solved = match gmres {
            None => Self::Directly,
            Some((gmres, tolerance)) => match gmres.solve(system, tolerance) {
                Ok(iterations) => return Self::Iteratively(iterations),
                Err(failed) => Self::InPlaceOfIterations(failed.residual),
            },
        };
        system.solve();
        solved
    }
}

/// Which particles the tool and the periphery prescribe, and which are found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Partition {
    /// The tool's particle first, then the fixed ones.
    pub(super) prescribed: Vec<usize>,
    pub(super) free: Vec<usize>,
}

impl Partition {
    pub(super) fn new(layout: &Layout) -> Self {
        let (prescribed, free) = (0..layout.roles.len())
            .partition(|&i| matches!(layout.roles[i], Role::Tool | Role::Fixed));
        Self { prescribed, free }
    }
}
