//! The finite spheres without calibration: particles, weights, integration, and the fixed boundary of
//! the organ.
//!
//! The tip's radius a is the unit of length. Particles lie in half a ball, which [`region`] maps to the organ
//! out to its fixed boundary, to infinity on a half-space. Displacement is u = b Σ φ_J(y) U_J + h Σ φ_J(y)
//! c_J u_p(x): moving least squares times b = 1 − σ², and in each sphere the field u_p of a flat punch
//! ([`punch`]), whose strain is infinite at the tip's edge, times h, which vanishes on the fixed boundary.
//! Galerkin's condition gives K.
//!
//! A flat tip that slips presses with p = (p₀ + p₁ r²/a²)/√(1 − r²/a²). The two unknown p make the mean of
//! u over either part of the load equal to the depth; the force is their sum. Nothing is fitted.
//!
//! *How we know*: `uncalibrated::…` against closed forms, slabs, finite elements; `patch::…`.
//!
//! *Limits*: tips that slip; small strain. On a half-space the basis holds the answer, so only the other
//! shapes, and [`super::Calibration::ParticlesAlone`], test the particles.

#[cfg(test)]
mod patch;
mod punch;
mod region;
mod template;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};

use self::punch::punch;
use self::region::{Mapped, Region, TemplatePlace, in_half_ball};
use self::template::{Template, TipPoint};
use super::layout::Layout;
use super::model::LocalContact;
use super::settings::Integration;
use super::shape_function::ShapeFunctions;
use crate::linear::dense::DenseSystem;
use crate::{LinearElastic, Vec3};

/// Integration points whose strains are multiplied at once.
const BLOCK: usize = 64;

/// Part of the diagonal that is added to it, since the two kinds of functions are nearly dependent; it
/// moves forces in the ninth digit.
const RIDGE: f64 = 1e-11;

#[derive(Debug, Clone)]
pub(super) struct Uncalibrated {
    template: Template,
    law: LinearElastic,
    /// Whether spheres carry the punch's field.
    enriched: bool,
}

/// Scratch of [`Uncalibrated`].
pub(super) struct UncalibratedWorkspace {
    system: DenseSystem,
    strains: Mat<f64>,
    loads: Mat<f64>,
    functions: ShapeFunctions,
    /// Coefficients for a unit depth [-].
    coefficients: Vec<f64>,
    region: Region,
}

impl Uncalibrated {
    pub(super) fn new(
        layout: &Layout,
        integration: Integration,
        law: &LinearElastic,
        enriched: bool,
    ) -> Self {
        Self {
            template: Template::new(layout, integration),
            law: *law,
            enriched,
        }
    }

    fn particles(&self) -> usize {
        self.template.particles.positions.len()
    }

    fn unknowns(&self) -> usize {
        self.particles() * if self.enriched { 4 } else { 3 }
    }

    pub(super) fn integration_points(&self) -> usize {
        self.template.points.len()
    }

    pub(super) fn workspace(&self) -> UncalibratedWorkspace {
        let unknowns = self.unknowns();
        UncalibratedWorkspace {
            system: DenseSystem::new(unknowns, 2),
            strains: Mat::zeros(6 * BLOCK, unknowns),
            loads: Mat::zeros(unknowns, 2),
            functions: ShapeFunctions::with_capacity(self.particles()),
            coefficients: vec![0.0; unknowns],
            region: Region {
                curvature: Vec3::zeros(),
                thickness: f64::INFINITY,
            },
        }
    }

    /// Makes the equations of `contact`.
    pub(super) fn assemble(&self, contact: &LocalContact, workspace: &mut UncalibratedWorkspace) {
        workspace.region = Region {
            curvature: contact.curvature * contact.radius,
            thickness: contact.thickness / contact.radius,
        };
        workspace.system.clear();
        for first in (0..self.template.points.len()).step_by(BLOCK) {
            let last = (first + BLOCK).min(self.template.points.len());
            workspace.strains.fill(0.0);
            for at in first..last {
                self.write_strains(at, 6 * (at - first), workspace);
            }
            let strains = workspace.strains.as_ref();
            let sum = workspace.system.matrix.as_mut();
            matmul(sum, Accum::Add, strains.transpose(), strains, 1.0, Par::Seq);
        }
        for k in 0..self.unknowns() {
            workspace.system.matrix[(k, k)] *= 1.0 + RIDGE;
        }
        self.write_loads(workspace);
    }

    /// Rows whose squares sum to twice the energy of an integration point, in E.
    fn write_strains(&self, at: usize, row: usize, workspace: &mut UncalibratedWorkspace) {
        let point = &self.template.points[at];
        let mapped = workspace.region.map(&point.place);
        let rows = EnergyRows::new(&self.law, point.weight * mapped.volume);
        let count = self.particles();
        let values = &self.template.values[at * count..][..count];
        let slopes = &self.template.slopes[at * count..][..count];
        let y = in_half_ball(&point.place);
        let decay = 1.0 - y.norm_squared();
        let enriched = self.enriched.then(|| self.enrichment_at(&mapped));
        for (j, (&value, slope)) in values.iter().zip(slopes).enumerate() {
            let decaying = slope * decay - y * (2.0 * value);
            let gradient = mapped.template_by_place.tr_mul(&decaying);
            for k in 0..3 {
                let mut field = nalgebra::Matrix3::zeros();
                field.set_row(k, &gradient.transpose());
                rows.write(&field, row, 3 * j + k, &mut workspace.strains);
            }
            if let Some((displacement, by_place)) = &enriched {
                let slope = mapped.template_by_place.tr_mul(slope);
                let field = by_place * value + displacement * slope.transpose();
                rows.write(&field, row, 3 * count + j, &mut workspace.strains);
            }
        }
    }

    /// h u_p and its gradient.
    fn enrichment_at(&self, mapped: &Mapped) -> (Vec3, nalgebra::Matrix3<f64>) {
        let (displacement, by_flat) = punch(&mapped.flat, self.law.poissons_ratio());
        let factor = 1.0 - mapped.distance * mapped.inverse_fixed_distance;
        let by_place = by_flat * mapped.flat_by_place * factor
            + displacement * mapped.factor_gradient.transpose();
        (displacement * factor, by_place)
    }

    fn write_loads(&self, workspace: &mut UncalibratedWorkspace) {
        let UncalibratedWorkspace {
            system,
            loads,
            functions,
            region,
            ..
        } = workspace;
        loads.fill(0.0);
        let count = self.particles();
        for point in &self.template.tip {
            let Some(place) = tip_place(region, point) else {
                continue;
            };
            functions.evaluate_values(&self.template.particles, &in_half_ball(&place));
            let decay = 1.0 - place.distance.powi(2);
            let factor = region.vanishing_factor(point.radius, point.azimuth, 1.0);
            let parts = [point.weight, point.weight * point.radius.powi(2)];
            for (&j, &value) in functions.particles.iter().zip(&functions.values) {
                for (k, part) in parts.into_iter().enumerate() {
                    // Into the organ; the punch's own displacement is one.
                    loads[(3 * j as usize + 2, k)] -= part * decay * value;
                    if self.enriched {
                        loads[(3 * count + j as usize, k)] += part * factor * value;
                    }
                }
            }
        }
        system.right.copy_from(&*loads);
    }

    /// Solves what [`Self::assemble`] made; the stiffness along the normal [N/m].
    pub(super) fn solve(&self, radius: f64, workspace: &mut UncalibratedWorkspace) -> f64 {
        let UncalibratedWorkspace {
            system,
            loads,
            coefficients,
            ..
        } = workspace;
        system.solve();
        let mut compliance = nalgebra::Matrix2::zeros();
        for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let terms = (0..loads.nrows()).map(|row| loads[(row, i)] * system.right[(row, k)]);
            compliance[(i, k)] = terms.sum();
        }
        let mut depth = nalgebra::Vector2::zeros();
        for point in &self.template.tip {
            depth += point.weight * nalgebra::Vector2::new(1.0, point.radius.powi(2));
        }
        let inverse = compliance.try_inverse();
        let inverse = inverse.unwrap_or_else(|| nalgebra::Matrix2::repeat(f64::NAN));
        let pressures = inverse * depth;
        for (row, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient =
                pressures[0] * system.right[(row, 0)] + pressures[1] * system.right[(row, 1)];
        }
        pressures.dot(&depth) * self.law.youngs_modulus() * radius
    }

    /// Displacement [-] at `x` [tip radii] for a unit depth of the last contact that was solved.
    pub(super) fn displacement(&self, workspace: &mut UncalibratedWorkspace, x: &Vec3) -> Vec3 {
        let region = workspace.region;
        let (radius, azimuth, fraction) = region.coordinates(x);
        // The tip's own point: the map has no azimuth there.
        let radius = radius.max(1e-9);
        let Some(distance) = region.template_distance(radius, azimuth, fraction) else {
            return Vec3::zeros();
        };
        let place = TemplatePlace {
            distance,
            azimuth,
            fraction,
        };
        let (count, y) = (self.particles(), in_half_ball(&place));
        let functions = &mut workspace.functions;
        functions.evaluate_values(&self.template.particles, &y);
        let decay = 1.0 - y.norm_squared();
        let carried = self.enriched.then(|| {
            let (displacement, _) = punch(&region.map(&place).flat, self.law.poissons_ratio());
            displacement * region.vanishing_factor(radius, azimuth, fraction)
        });
        let mut moved = Vec3::zeros();
        let coefficients = &workspace.coefficients;
        for (&j, &value) in functions.particles.iter().zip(&functions.values) {
            let j = j as usize;
            moved += decay * value * Vec3::from_row_slice(&coefficients[3 * j..][..3]);
            if let Some(carried) = carried {
                moved += carried * (value * coefficients[3 * count + j]);
            }
        }
        moved
    }
}

fn tip_place(region: &Region, point: &TipPoint) -> Option<TemplatePlace> {
    let distance = region.template_distance(point.radius, point.azimuth, 1.0)?;
    Some(TemplatePlace {
        distance,
        azimuth: point.azimuth,
        fraction: 1.0,
    })
}

/// Factors that make squares of strain into energy, in E.
struct EnergyRows {
    shear: f64,
    normal: [f64; 3],
}

impl EnergyRows {
    fn new(law: &LinearElastic, volume: f64) -> Self {
        let scale = volume / law.youngs_modulus();
        let (lame, shear) = (law.lame_modulus() * scale, law.shear_modulus() * scale);
        // λ (tr ε)² + 2 μ ε:ε of the diagonal: 2 μ |dev|² and (λ + 2 μ/3) tr².
        Self {
            shear: shear.sqrt(),
            normal: [
                shear.sqrt(),
                (shear / 3.0).sqrt(),
                (lame + 2.0 * shear / 3.0).sqrt(),
            ],
        }
    }

    /// Writes the six rows of a displacement gradient into a column.
    fn write(
        &self,
        gradient: &nalgebra::Matrix3<f64>,
        row: usize,
        column: usize,
        strains: &mut Mat<f64>,
    ) {
        let [x, y, z] = [gradient[(0, 0)], gradient[(1, 1)], gradient[(2, 2)]];
        let rows = [
            self.normal[0] * (x - y),
            self.normal[1] * (x + y - 2.0 * z),
            self.normal[2] * (x + y + z),
            self.shear * (gradient[(0, 1)] + gradient[(1, 0)]),
            self.shear * (gradient[(1, 2)] + gradient[(2, 1)]),
            self.shear * (gradient[(2, 0)] + gradient[(0, 2)]),
        ];
        for (k, value) in rows.into_iter().enumerate() {
            strains[(row + k, column)] = value;
        }
    }
}
