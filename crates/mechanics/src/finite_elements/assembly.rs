//! Forces and tangent of a deformed body.
//!
//! With the pressure p as a field of its own, equilibrium makes stationary
//!   Π = ∫ W(F) + p θ(F) − p²/(2 κ) dV,
//! so that the residuals are ∫ (∂W/∂F + p ∂θ/∂F) : δF and ∫ δp (θ − p/κ). The matrix is symmetric; its
//! pressure block carries a further −ε/μ, which is missing from the residual: it makes the matrix
//! quasi-definite for κ = ∞ as well, and costs Newton's method a factor of about ε per step.
//!
//! *How we know*: `derivatives::tangent_is_the_derivative_of_the_residual`, patch tests.
//!
//! *Limits*: pressures are continuous where laws meet.

use std::sync::Arc;

use nalgebra::Matrix3;

use super::model::{ElementSums, FiniteElementModel, FiniteElementWorkspace};
use super::relaxation::{PointHistory, RelaxationStep};
use crate::Strain;
use crate::material::law::{Distortion, Law, Tangent};

/// ε of the pressure block [-].
pub(super) const PRESSURE_REGULARIZATION: f64 = 1e-7;

/// Places of F_ij in a column of nine that an axisymmetric motion (r, z, hoop) moves, and a solid's.
const AXISYMMETRIC: [usize; 5] = [0, 1, 3, 4, 8];

/// An element is turned inside out at some point of integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Inverted;

/// Puts residual, tangent and energy of `unknowns` into `workspace`.
pub(super) fn assemble(
    model: &FiniteElementModel,
    unknowns: &[f64],
    relaxing: Option<&RelaxationStep>,
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Inverted> {
    workspace.residual.fill(0.0);
    workspace.tangent.fill(0.0);
    workspace.energy = 0.0;
    let local = model.local_unknowns();
    let triangle = local * (local + 1) / 2;
    for element in 0..model.mesh.len() {
        let numbers = &model.unknowns[element * local..(element + 1) * local];
        let scratch = &mut workspace.element;
        for (value, &number) in scratch.values.iter_mut().zip(numbers) {
            *value = unknowns[number as usize];
        }
        scratch.sums.force.fill(0.0);
        scratch.sums.matrix.fill(0.0);
        for point in 0..model.mapping.points {
            let past = relaxing.map(|step| {
                let place = element * model.mapping.points + point;
                step.at(
                    model,
                    place,
                    &numbers[local - model.mapping.pressures_per_element..],
                )
            });
            let point = Point::new(model, element, point);
            workspace.energy += if model.dimension() == 2 {
                point.integrate::<2>(model, past, &scratch.values, &mut scratch.sums)
            } else {
                point.integrate::<3>(model, past, &scratch.values, &mut scratch.sums)
            }?;
        }
        for (&number, force) in numbers.iter().zip(&scratch.sums.force) {
            workspace.residual[number as usize] += force;
        }
        let mut places = model.scatter[element * triangle..].iter();
        for column in 0..local {
            for row in column..local {
                let place = places.next().expect("the triangle has this size");
                workspace.tangent[*place as usize] += scratch.sums.matrix[column * local + row];
            }
        }
    }
    Ok(())
}

/// Adds what a unit of the `parameter` of `law` adds to the residual of an elastic body, where it is of that law.
pub(super) fn add_sensitivity(
    model: &FiniteElementModel,
    unknowns: &[f64],
    law: &Arc<dyn Law>,
    parameter: usize,
    residual: &mut [f64],
) {
    let local = model.local_unknowns();
    let (mut values, mut force) = (vec![0.0; local], vec![0.0; local]);
    for (element, numbers) in model.unknowns.chunks_exact(local).enumerate() {
        if !Arc::ptr_eq(model.shared_law(element * model.mapping.points), law) {
            continue;
        }
        for (value, &number) in values.iter_mut().zip(numbers) {
            *value = unknowns[number as usize];
        }
        force.fill(0.0);
        for point in 0..model.mapping.points {
            let point = Point::new(model, element, point);
            let solid = model.dimension() == 3;
            let f = if solid {
                point.gradient::<3>(&values)
            } else {
                point.gradient::<2>(&values)
            };
            let (stress, compressibility) = point.law.sensitivities(parameter, &f);
            if solid {
                point.add_stress::<3>(&stress, &mut force);
            } else {
                point.add_stress::<2>(&stress, &mut force);
            }
            let count = point.gradients.len();
            let pressure = point.pressure(&values[count..]);
            for (force, q) in force[count..].iter_mut().zip(point.pressures) {
                *force -= point.weight * q * pressure * compressibility;
            }
        }
        for (&number, force) in numbers.iter().zip(&force) {
            residual[number as usize] += force;
        }
    }
}

/// Elastic stresses [Pa] at the points of integration, as relaxation takes them: second
/// Piola-Kirchhoff at finite strain.
pub(super) fn elastic_stresses(model: &FiniteElementModel, unknowns: &[f64]) -> Vec<Matrix3<f64>> {
    let local = model.local_unknowns();
    let mut stresses = Vec::with_capacity(model.mapping.weights.len());
    let mut values = vec![0.0; local];
    for (element, numbers) in model.unknowns.chunks_exact(local).enumerate() {
        for (value, &number) in values.iter_mut().zip(numbers) {
            *value = unknowns[number as usize];
        }
        for point in 0..model.mapping.points {
            let point = Point::new(model, element, point);
            let law = point.law;
            let f = if model.dimension() == 2 {
                point.gradient::<2>(&values)
            } else {
                point.gradient::<3>(&values)
            };
            let stress = if point.pressures.is_empty() {
                law.stress(&f)
            } else {
                law.distortion_stress(&f)
            };
            stresses.push(match law.volume().strain {
                Strain::Small => stress,
                Strain::Finite => f.try_inverse().unwrap_or_default() * stress,
            });
        }
    }
    stresses
}

/// θ − p/κ at a point, and what its change and its block of the matrix need.
struct Constraint {
    /// ∂θ/∂F [-].
    gradient: Matrix3<f64>,
    /// θ − p/κ [-].
    excess: f64,
    /// 1/κ and ε/μ [1/Pa].
    compressibility: f64,
}

/// One point of integration, with the slices of the mapping that belong to it.
struct Point<'a> {
    law: &'a dyn Law,
    weight: f64,
    gradients: &'a [f64],
    hoop_terms: &'a [f64],
    pressures: &'a [f64],
}

impl<'a> Point<'a> {
    fn new(model: &'a FiniteElementModel, element: usize, point: usize) -> Self {
        let (mapping, nodes) = (&model.mapping, model.mesh.kind.nodes());
        let index = element * mapping.points + point;
        let part = |all: &'a [f64], width: usize| {
            all.get(index * width..(index + 1) * width).unwrap_or(&[])
        };
        Self {
            law: model.law_at(index),
            weight: mapping.weights[index],
            gradients: part(&mapping.gradients, nodes * model.dimension()),
            hoop_terms: part(&mapping.hoop_terms, nodes),
            pressures: part(&mapping.pressures, mapping.pressures_per_element),
        }
    }

    /// Deformation gradient of the element's displacements.
    fn gradient<const D: usize>(&self, values: &[f64]) -> Matrix3<f64> {
        let mut f = Matrix3::identity();
        for (u, g) in values.chunks_exact(D).zip(self.gradients.chunks_exact(D)) {
            for j in 0..D {
                for i in 0..D {
                    f[(i, j)] += u[i] * g[j];
                }
            }
        }
        for (u, hoop) in values.chunks_exact(D).zip(self.hoop_terms) {
            f[(2, 2)] += u[0] * hoop;
        }
        f
    }

    /// Adds this point to force and matrix (lower triangle, column by column); answers its energy.
    fn integrate<const D: usize>(
        &self,
        model: &FiniteElementModel,
        past: Option<PointHistory<'_>>,
        values: &[f64],
        sums: &mut ElementSums,
    ) -> Result<f64, Inverted> {
        let f = self.gradient::<D>(values);
        let (law, volume) = (self.law, self.law.volume());
        let stands = volume.strain == Strain::Small || f.determinant() > 0.0;
        if !stands {
            return Err(Inverted);
        }
        if self.pressures.is_empty() {
            let (mut stress, mut tangent) = (law.stress(&f), law.tangent(&f));
            if let Some(past) = past {
                past.relax(volume.strain, &f, &mut stress, &mut tangent);
            }
            self.add_stress::<D>(&stress, &mut sums.force);
            self.add_tangent::<D>(&tangent, &mut sums.matrix, values.len());
            return Ok(self.weight * law.energy(&f));
        }
        let Distortion {
            energy,
            mut stress,
            mut tangent,
        } = law.distortion(&f);
        let pressure = self.pressure(&values[self.gradients.len()..]);
        let (mut elastic_pressure, mut follows) = (pressure, 1.0);
        if let Some(past) = past {
            past.relax(volume.strain, &f, &mut stress, &mut tangent);
            follows = past.step.follows;
            elastic_pressure = (pressure + past.pressure(self.pressures)) / follows;
        }
        let dilation = volume.dilation_gradient(&f);
        stress += pressure * dilation;
        volume.add_dilation_curvature(pressure, &f, &mut tangent);
        self.add_stress::<D>(&stress, &mut sums.force);
        self.add_tangent::<D>(&tangent, &mut sums.matrix, values.len());
        let compressibility = 1.0 / volume.bulk_modulus;
        let constraint = Constraint {
            gradient: dilation,
            excess: volume.dilation(&f) - elastic_pressure * compressibility,
            compressibility: compressibility / follows
                + PRESSURE_REGULARIZATION / model.shear_modulus,
        };
        self.add_pressure::<D>(&constraint, sums);
        let energy = energy + 0.5 * compressibility * elastic_pressure.powi(2);
        Ok(self.weight * energy)
    }

    fn pressure(&self, values: &[f64]) -> f64 {
        self.pressures.iter().zip(values).map(|(q, p)| q * p).sum()
    }

    fn add_stress<const D: usize>(&self, stress: &Matrix3<f64>, force: &mut [f64]) {
        for (out, g) in force
            .chunks_exact_mut(D)
            .zip(self.gradients.chunks_exact(D))
        {
            for (i, out) in out.iter_mut().enumerate() {
                for (j, g) in g.iter().enumerate() {
                    *out += self.weight * stress[(i, j)] * g;
                }
            }
        }
        for (out, hoop) in force.chunks_exact_mut(D).zip(self.hoop_terms) {
            out[0] += self.weight * stress[(2, 2)] * hoop;
        }
    }

    fn add_tangent<const D: usize>(&self, tangent: &Tangent, matrix: &mut [f64], local: usize) {
        let nodes = self.gradients.len() / D;
        let entries = tangent.as_slice();
        for b in 0..nodes {
            let gb = &self.gradients[b * D..(b + 1) * D];
            for k in 0..D {
                // Change of stress with this displacement.
                let mut change = [0.0; 9];
                let mut add = |column: usize, factor: f64| {
                    let column = &entries[9 * column..9 * column + 9];
                    if D == 2 {
                        for row in AXISYMMETRIC {
                            change[row] += factor * column[row];
                        }
                    } else {
                        for (change, entry) in change.iter_mut().zip(column) {
                            *change += factor * entry;
                        }
                    }
                };
                for (l, g) in gb.iter().enumerate() {
                    add(3 * l + k, self.weight * g);
                }
                if D == 2 && k == 0 {
                    add(8, self.weight * self.hoop_terms[b]);
                }
                let column = &mut matrix[(b * D + k) * local..][..nodes * D];
                let (rows, _) = column[b * D..].as_chunks_mut::<D>();
                let (gradients, _) = self.gradients[b * D..].as_chunks::<D>();
                if D == 2 {
                    let each = rows.iter_mut().zip(gradients).zip(&self.hoop_terms[b..]);
                    for ((row, g), hoop) in each {
                        row[0] = row[0] + change[0] * g[0] + change[3] * g[1] + change[8] * hoop;
                        row[1] = row[1] + change[1] * g[0] + change[4] * g[1];
                    }
                } else {
                    for (row, g) in rows.iter_mut().zip(gradients) {
                        for i in 0..D {
                            for j in 0..D {
                                row[i] += change[3 * j + i] * g[j];
                            }
                        }
                    }
                }
            }
        }
    }

    /// The coupling of displacements to pressures, and the pressures' own block.
    fn add_pressure<const D: usize>(&self, constraint: &Constraint, sums: &mut ElementSums) {
        let ElementSums { force, matrix } = sums;
        let local = force.len();
        let count = self.gradients.len();
        for (a, g) in self.gradients.chunks_exact(D).enumerate() {
            for i in 0..D {
                let mut along = 0.0;
                for (j, g) in g.iter().enumerate() {
                    along += constraint.gradient[(i, j)] * g;
                }
                if D == 2 && i == 0 {
                    along += constraint.gradient[(2, 2)] * self.hoop_terms[a];
                }
                let column = &mut matrix[(a * D + i) * local..][..local];
                for (entry, q) in column[count..].iter_mut().zip(self.pressures) {
                    *entry += self.weight * along * q;
                }
            }
        }
        for (m, q) in self.pressures.iter().enumerate() {
            force[count + m] += self.weight * q * constraint.excess;
            let column = &mut matrix[(count + m) * local..][..local];
            for (entry, other) in column[count + m..].iter_mut().zip(&self.pressures[m..]) {
                *entry -= self.weight * constraint.compressibility * q * other;
            }
        }
    }
}
