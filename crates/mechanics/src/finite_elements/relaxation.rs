//! Relaxation inside the body, by internal variables at the points of integration.
//!
//! With S = F⁻¹ P the second Piola-Kirchhoff stress, which a rotation leaves alone,
//!   S(t) = Sₑ(t) − Σ gᵢ hᵢ(t),  τᵢ ḣᵢ = Sₑ − hᵢ   [Simo 1987],
//! and the same for the pressure, so that the body relaxes as one. Over a step, in which Sₑ goes
//! linearly, S = γ Sₑ¹ − Sₕ with a share γ = 1 − Σ gᵢ φᵢ that still follows and a part Sₕ that is history
//! (see `material::prony`).
//!
//! *How we know*: `relaxation::a_held_stretch_relaxes_as_the_series` and the comparison of an indentation
//! with the convolution of its curve.
//!
//! *Limits*: one relaxation function for the whole body; at finite strain the deformation during a ramp
//! is then not exactly the elastic one.

use nalgebra::Matrix3;

use super::assembly;
use super::model::{FiniteElementModel, FiniteElementState};
use crate::material::law::Tangent;
use crate::{PronySeries, Strain};

/// Internal (history) variables of the stress of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct RelaxationHistory {
    terms: usize,
    /// Elastic stress of distortion [Pa] at the last time; element by element, point by point.
    stress: Vec<Matrix3<f64>>,
    /// Branches of it [Pa]; points × terms.
    branches: Vec<Matrix3<f64>>,
    /// Elastic pressures [Pa] at the last time.
    pressure: Vec<f64>,
    /// Branches of them [Pa]; pressures × terms.
    pressure_branches: Vec<f64>,
}

/// The next step of a body that relaxes.
#[derive(Debug, Clone, PartialEq)]
pub struct RelaxationStep {
    /// Share γ of the elastic stress that acts at the step's end [-].
    pub(super) follows: f64,
    /// History Sₕ [Pa] at the points.
    pub(super) stress: Vec<Matrix3<f64>>,
    /// History of the pressures [Pa].
    pub(super) pressure: Vec<f64>,
}

/// The history at one point of integration.
#[derive(Debug, Clone, Copy)]
pub(super) struct PointHistory<'a> {
    pub(super) step: &'a RelaxationStep,
    stress: &'a Matrix3<f64>,
    /// Number of the first pressure, and the numbers of the element's.
    first: usize,
    pressures: &'a [u32],
}

impl RelaxationStep {
    /// Points and pressures whose history it has.
    pub(super) fn lengths(&self) -> [usize; 2] {
        [self.stress.len(), self.pressure.len()]
    }

    /// At the point `place`, whose element has these `pressures` among its unknowns.
    pub(super) fn at<'a>(
        &'a self,
        model: &FiniteElementModel,
        place: usize,
        pressures: &'a [u32],
    ) -> PointHistory<'a> {
        PointHistory {
            step: self,
            stress: &self.stress[place],
            first: model.displacements(),
            pressures,
        }
    }
}

impl PointHistory<'_> {
    /// P ← γ Pₑ − F Sₕ, and its tangent.
    pub(super) fn relax(
        &self,
        strain: Strain,
        f: &Matrix3<f64>,
        stress: &mut Matrix3<f64>,
        tangent: &mut Tangent,
    ) {
        *stress *= self.step.follows;
        *tangent *= self.step.follows;
        match strain {
            Strain::Small => *stress -= self.stress,
            Strain::Finite => {
                *stress -= f * self.stress;
                for (j, l) in (0..3).flat_map(|j| (0..3).map(move |l| (j, l))) {
                    for i in 0..3 {
                        tangent[(3 * j + i, 3 * l + i)] -= self.stress[(l, j)];
                    }
                }
            }
        }
    }

    /// History of the pressure at a point with these functions [Pa].
    pub(super) fn pressure(&self, functions: &[f64]) -> f64 {
        let history = |m: u32| self.step.pressure[m as usize - self.first];
        let each = functions.iter().zip(self.pressures);
        each.map(|(q, &m)| q * history(m)).sum()
    }
}

impl RelaxationHistory {
    /// A body that was at rest for long.
    pub fn at_rest(model: &FiniteElementModel, series: &PronySeries) -> Self {
        let (points, pressures) = (model.mapping.weights.len(), model.pressures());
        let terms = series.terms().len();
        Self {
            terms,
            stress: vec![Matrix3::zeros(); points],
            branches: vec![Matrix3::zeros(); points * terms],
            pressure: vec![0.0; pressures],
            pressure_branches: vec![0.0; pressures * terms],
        }
    }

    /// The step of `duration` [s] from here; zero is a jump.
    pub fn step(&self, series: &PronySeries, duration: f64) -> RelaxationStep {
        let terms = self.terms;
        let mut follows = 1.0;
        let mut stress = vec![Matrix3::zeros(); self.stress.len()];
        let mut pressure = vec![0.0; self.pressure.len()];
        for (i, share) in series.shares(duration).enumerate() {
            follows -= share.g * share.new;
            for (point, history) in stress.iter_mut().enumerate() {
                *history += share.g
                    * (share.decay * self.branches[point * terms + i]
                        + share.old * self.stress[point]);
            }
            for (m, history) in pressure.iter_mut().enumerate() {
                *history += share.g
                    * (share.decay * self.pressure_branches[m * terms + i]
                        + share.old * self.pressure[m]);
            }
        }
        RelaxationStep {
            follows,
            stress,
            pressure,
        }
    }

    /// Goes `duration` [s] on, to the equilibrium `state` that `step` led to.
    pub fn advance(
        &mut self,
        model: &FiniteElementModel,
        series: &PronySeries,
        duration: f64,
        state: &FiniteElementState,
    ) {
        let step = self.step(series, duration);
        let stress = assembly::elastic_stresses(model, &state.unknowns);
        let relaxed = &state.unknowns[model.displacements()..];
        let pressure: Vec<f64> = relaxed
            .iter()
            .zip(&step.pressure)
            .map(|(p, history)| (p + history) / step.follows)
            .collect();
        for (i, share) in series.shares(duration).enumerate() {
            for (point, new) in stress.iter().enumerate() {
                let branch = &mut self.branches[point * self.terms + i];
                *branch = share.decay * *branch + share.old * self.stress[point] + share.new * new;
            }
            for (m, new) in pressure.iter().enumerate() {
                let branch = &mut self.pressure_branches[m * self.terms + i];
                *branch = share.decay * *branch + share.old * self.pressure[m] + share.new * new;
            }
        }
        self.stress = stress;
        self.pressure = pressure;
    }
}
