//! The force of a fitted law for any depth over time, with its standard error.
//!
//! F(t) = Fₑ(t) − Σ gᵢ hᵢ(t), τᵢ ḣᵢ = Fₑ − hᵢ, with the elastic force over depth of the fit. The variance of F is
//! j C jᵀ, C the covariance of the law's parameters, gᵢ and τᵢ, j the derivatives with these.
//!
//! *How we know*: `fitted::forces_of_a_found_law_and_their_errors_are_those_of_its_parameters`.
//!
//! *Limits*: the product of elastic force and G(t); beyond the deepest fitted depth, the curve continues along its
//! tangent.

use std::ops::Range;

use nalgebra::DMatrix;
use palpate_mechanics::{IndentationCurve, PronySeries, branch};

use super::correlations::Correlations;
use super::description::LawDescription;
use super::law::to_shape;

/// The elastic force of a law over depth, with its changes with the law's parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticForce {
    /// The force [N] over depth [m].
    pub force: IndentationCurve,
    /// The change of the force with each parameter [N over its unit], by its name.
    pub sensitivities: Vec<(String, IndentationCurve)>,
}

impl LawDescription {
    /// The instantaneous elastic force that the fit found.
    pub fn elastic(&self) -> ElasticForce {
        let law = &self.found;
        let (modulus, curve) = (law.modulus(), &law.curve);
        let depths: Vec<f64> = curve.force.points().map(|(depth, _)| depth).collect();
        let through = |of: &dyn Fn(f64) -> f64| {
            let forces: Vec<f64> = depths.iter().map(|depth| of(*depth)).collect();
            IndentationCurve::through(&depths, &forces)
        };
        let own = law.law.parameters(modulus, law.shape());
        let back = to_shape(&own);
        let by = |place: usize| {
            through(&|depth| {
                let shapes = curve.by_shape.iter().enumerate();
                let of_shapes =
                    shapes.map(|(shape, by)| by.force(depth) * back[(1 + shape, place)]);
                curve.by_modulus(depth) * back[(0, place)] + modulus * of_shapes.sum::<f64>()
            })
        };
        let named = own.iter().enumerate();
        ElasticForce {
            force: curve.force.scaled(1.0, modulus),
            sensitivities: named
                .map(|(place, parameter)| (parameter.name.to_owned(), by(place)))
                .collect(),
        }
    }
}

impl ElasticForce {
    /// Force [N] and its standard error [N] at `depth` [m]; with `time` [s], of tissue that relaxes by `series` over
    /// that course, and at once without it. `known` has the covariance of the parameters; those that it does not name
    /// are exact.
    pub fn evaluate(
        &self,
        time: Option<&[f64]>,
        depth: &[f64],
        series: &PronySeries,
        known: &Correlations,
    ) -> Vec<[f64; 2]> {
        let elastic: Vec<f64> = depth.iter().map(|d| self.force.force(*d)).collect();
        let terms = match time {
            Some(_) => series.terms(),
            None => &[],
        };
        let branches: Vec<(Vec<f64>, Vec<f64>)> = time.map_or_else(Vec::new, |time| {
            let each = terms.iter();
            each.map(|&(_, tau)| branch(tau, time, &elastic)).collect()
        });
        let relaxed = |values: &[f64]| {
            let mut force = values.to_vec();
            for (&(g, tau), time) in terms.iter().zip(std::iter::repeat(time).flatten()) {
                let lost = branch(tau, time, values).0;
                let each = force.iter_mut().zip(lost);
                each.for_each(|(force, lost)| *force -= g * lost);
            }
            force
        };
        let mut columns = DMatrix::zeros(depth.len(), known.names.len());
        let mut set = |name: &str, values: &mut dyn Iterator<Item = f64>| {
            if let Some(place) = known.names.iter().position(|own| own == name) {
                let into = columns.column_mut(place).data.into_slice_mut();
                into.iter_mut()
                    .zip(values)
                    .for_each(|(into, value)| *into = value);
            }
        };
        for (name, curve) in &self.sensitivities {
            let change: Vec<f64> = depth.iter().map(|d| curve.force(*d)).collect();
            set(name, &mut relaxed(&change).into_iter());
        }
        for ((place, (g, tau)), (lost, slopes)) in (1..).zip(terms).zip(&branches) {
            set(&format!("g_{place}"), &mut lost.iter().map(|lost| -lost));
            let by_time = slopes.iter().map(|slope| -g * slope / tau);
            set(&format!("tau_{place}_s"), &mut { by_time });
        }
        let force = relaxed(&elastic);
        let errors = standard_errors(&columns, &known.covariance);
        force
            .into_iter()
            .zip(errors)
            .map(<[f64; 2]>::from)
            .collect()
    }
}

/// √(j C jᵀ) of each row j of `derivatives`.
pub fn standard_errors(derivatives: &DMatrix<f64>, covariance: &DMatrix<f64>) -> Vec<f64> {
    let spread = derivatives * covariance;
    let rows: Range<usize> = 0..derivatives.nrows();
    rows.map(|row| spread.row(row).dot(&derivatives.row(row)).max(0.0).sqrt())
        .collect()
}
