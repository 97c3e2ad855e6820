use nalgebra::DMatrix;
use palpate_mechanics::PronySeries;

use super::curves::{Curves, UnitCurve};
use super::forces::{self, Bounds, EARLIER, Indentation};
use super::law::CandidateLaw;
use crate::Error;
use crate::fit::{
    Differences, Fit, Parameter, Settings, another_minimum, least_squares_with_jacobian,
    multi_start,
};
use crate::viscoelastic::QUASI_LINEAR;

/// A law that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct LawFit {
    /// The law that was sought.
    pub law: CandidateLaw,
    /// The modulus [Pa] and the shapes [-], and after them the relaxation that was given, as ratios and
    /// logarithms of times: free, so that its uncertainty is part of theirs.
    pub fit: Fit,
    /// Forces of the law in each recording [N].
    pub forces: Vec<Vec<f64>>,
    /// How many runs of finite elements it took.
    pub solves: usize,
    /// Elastic force per unit of the modulus at the shapes that were found.
    pub curve: UnitCurve,
    /// Relative error of the force by the elements [-].
    pub discretisation: f64,
    /// Relative error of the force as an elastic force times G(t), at any depth [-].
    pub product_error: f64,
    /// Systematic influences on the residuals [N], each column for one standard deviation: the zeros of the
    /// recordings, the motion of the tissue, the elements, and that force is taken for an elastic one times G(t), at any depth
    /// and at finite strain.
    pub systematic: Vec<Vec<f64>>,
    /// The other minima that were found, the best first.
    pub others: Vec<OtherMinimum>,
}

/// A local minimum other than the least one.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherMinimum {
    /// [N²]
    pub sum_of_squares: f64,
    /// [Pa]
    pub modulus: f64,
    /// [-]
    pub shape: Vec<f64>,
}

impl LawFit {
    /// The modulus [Pa].
    pub fn modulus(&self) -> f64 {
        self.fit.parameters[0].value
    }

    /// The shapes [-].
    pub fn shape(&self) -> &[f64] {
        &self.curve.shape
    }

    /// Part of the force, and so of the modulus, that the model may be off [-]: by its elements, and because
    /// force is taken for an elastic one times G(t).
    pub fn model_error(&self) -> f64 {
        self.discretisation + self.product_error
    }
}

impl LawFit {
    /// The sentence on other minima that are about as good; none where there is one alone.
    pub(super) fn other_minima_warning(&self) -> Option<String> {
        let other = self.others.first()?;
        let times = other.sum_of_squares / self.fit.sum_of_squares();
        let each = self.law.parameters(other.modulus, &other.shape);
        let of_shapes = each.iter().skip(1).map(|own| (own.name, own.value));
        another_minimum(self.law.name().word(), times, of_shapes)
    }
}

/// Indentations of a tissue whose relaxation is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LawData<'a> {
    /// Its indentations, with their forces.
    pub(crate) indentations: &'a [Indentation<'a>],
    /// Its relaxation.
    pub(crate) series: &'a PronySeries,
}

/// Relative change of the parameters below which a fit has arrived [-]: less than the elements are off.
pub(super) const SETTINGS: Settings = Settings {
    tolerance: 1e-4,
    iterations: 500,
    differences: Differences::Forward,
    precision: f64::EPSILON,
};
/// Largest error of the predicted curve at which a fit ends [-]: far less than the elements are off.
const PREDICTION_TOLERANCE: f64 = 3e-4;
/// Rounds in which the modulus under pressure is found, and the change at which they end [-].
const ROUNDS: usize = 6;
const SETTLED: f64 = 1e-3;

/// The law of `curves` that comes nearest to `indentations` of a tissue that relaxes by `series`.
///
/// # Errors
/// When the body cannot be indented like that, or there is no force.
pub fn law_fit(
    curves: &mut Curves,
    indentations: &[Indentation<'_>],
    series: &PronySeries,
) -> Result<LawFit, Error> {
    let data = LawData {
        indentations,
        series,
    };
    let mut modulus = start(curves, data)?;
    let mut found = from(curves, data, modulus)?;
    // Under pressure the curve is that of one modulus.
    for _ in 0..ROUNDS {
        let change = (found.modulus() / modulus - 1.0).abs();
        if !curves.depend_on_modulus() || change < SETTLED {
            break;
        }
        modulus = found.modulus();
        found = from(curves, data, modulus)?;
    }
    Ok(found)
}

/// The modulus [Pa] with which the force of the first shapes is nearest: force is linear in it.
fn start(curves: &mut Curves, data: LawData<'_>) -> Result<f64, Error> {
    let curve = curves.of(f64::INFINITY, &curves.law().start())?;
    let (mut products, mut squares) = (0.0, 0.0);
    for each in data.indentations {
        let (unit, _) = forces::forces(each.time, each.depth, &curve, 1.0, data.series);
        for (unit, force) in unit.iter().zip(each.force) {
            products += unit * force;
            squares += unit * unit;
        }
    }
    let modulus = products / squares;
    if modulus > 0.0 && modulus.is_finite() {
        Ok(modulus)
    } else {
        Err(Error::NoContactForce)
    }
}

/// Rounds in which each shape is found, and halvings of the way to those that have no equilibrium, at most.
const ROUNDS_OF_SHAPE: usize = 12;
const HALVINGS: usize = 4;

/// Fits with interpolated curves, until the curve solved at the shape of the fit agrees with its prediction.
fn from(curves: &mut Curves, data: LawData<'_>, modulus: f64) -> Result<LawFit, Error> {
    let count = curves.law().count();
    let rounds = ROUNDS_OF_SHAPE * count.max(2).saturating_sub(1);
    let mut start = parameters(curves.law(), data.series, modulus);
    let mut iterations = Vec::new();
    curves.of(modulus, &curves.law().start())?;
    for _ in 0..rounds {
        let (mut fit, others) = least_minimum(curves, modulus, &start, data)?;
        // A later round begins where the one before it ended.
        let again = usize::from(!iterations.is_empty());
        iterations.extend(fit.iterations.drain(again..));
        let shape = shapes(&fit.parameters[..count]);
        let modulus = match curves.depend_on_modulus() {
            true => modulus,
            false => fit.parameters[0].value,
        };
        let predicted = curves.predicted(modulus, &shape);
        let solved = solved_toward(curves, modulus, &shape)?;
        let is_like = |own: UnitCurve| own.force.approximates(&solved.force, PREDICTION_TOLERANCE);
        if solved.shape == shape && predicted.is_some_and(is_like) {
            curves.check_base(modulus)?;
            fit.iterations = iterations;
            return Ok(LawFit {
                others,
                ..found(fit, curves, &solved, data)
            });
        }
        start = fit.parameters;
    }
    curves.check_base(start[0].value)?;
    Err(Error::NoShape { tried: rounds })
}

/// The shapes [-] among the parameters of a law.
fn shapes(of_law: &[Parameter]) -> Vec<f64> {
    of_law[1..]
        .iter()
        .map(|parameter| parameter.value)
        .collect()
}

/// Other places from which a shape is sought, and the seed that draws them.
const STARTS: usize = 6;
const SEED: u64 = 1;

/// The least minimum by curves that are known, from `start` and from shapes all over their range, and the others.
fn least_minimum(
    curves: &Curves,
    modulus: f64,
    start: &[Parameter],
    data: LawData<'_>,
) -> Result<(Fit, Vec<OtherMinimum>), Error> {
    let count = curves.law().count();
    let is_of_one = curves.depend_on_modulus();
    let one = |start: &[Parameter]| {
        fitted(start, count, data, |own, shape| {
            curves.predicted(if is_of_one { modulus } else { own }, shape)
        })
    };
    if count == 1 {
        return Ok((one(start)?, Vec::new()));
    }
    let mut minima = multi_start(start, STARTS, SEED, one)?.into_iter();
    let least = minima.next().ok_or(Error::NoContactForce)?;
    let others = minima.map(|other| OtherMinimum {
        sum_of_squares: other.fit.sum_of_squares(),
        modulus: other.fit.parameters[0].value,
        shape: shapes(&other.fit.parameters[..count]),
    });
    Ok((least.fit, others.collect()))
}

/// A fit with the forces of the curve that was solved at its shape.
pub(super) fn found(mut fit: Fit, curves: &Curves, curve: &UnitCurve, data: LawData<'_>) -> LawFit {
    let modulus = fit.parameters[0].value;
    let forces = write(curve, data, modulus, &mut fit.residuals, &mut fit.jacobian);
    // The columns of what was fixed were not asked for.
    for parameter in fit.parameters.iter_mut().skip(curves.law().count()) {
        parameter.fixed = false;
    }
    let left = 1.0 - data.series.terms().iter().map(|(g, _)| g).sum::<f64>();
    let product_error = curves.product_share() * QUASI_LINEAR * (1.0 - left);
    let bounds = Bounds {
        model: curve.discretisation + product_error,
        mesh: curve.discretisation,
        earlier: curves.product_share() * EARLIER / curves.body().radius(),
    };
    LawFit {
        law: curves.law(),
        systematic: forces::systematic(data.indentations, curve, modulus, data.series, bounds),
        product_error,
        fit,
        forces,
        solves: curves.solve_count(),
        discretisation: curve.discretisation,
        curve: curve.clone(),
        others: Vec::new(),
    }
}

/// The curve of these shapes [-], or of some on the way to them from where there is equilibrium.
fn solved_toward(curves: &mut Curves, modulus: f64, shape: &[f64]) -> Result<UnitCurve, Error> {
    let known = curves.nearest(modulus, shape);
    let known = known.unwrap_or_else(|| shape.to_vec());
    let mut shape = shape.to_vec();
    let mut found = curves.of(modulus, &shape);
    for _ in 0..HALVINGS {
        if found.is_ok() {
            break;
        }
        for (own, known) in shape.iter_mut().zip(&known) {
            *own = 0.5 * (*own + known);
        }
        found = curves.of(modulus, &shape);
    }
    found
}

/// The fit of the parameters of a law, so many as `count`, a modulus and shapes, whose curves `of` gives from both.
fn fitted(
    start: &[Parameter],
    count: usize,
    data: LawData<'_>,
    of: impl Fn(f64, &[f64]) -> Option<UnitCurve>,
) -> Result<Fit, Error> {
    let samples = data.indentations.iter().map(|each| each.time.len()).sum();
    let evaluate = |values: &[f64], residuals: &mut [f64], jacobian: &mut DMatrix<f64>| {
        let curve = of(values[0], &values[1..count])?;
        write(&curve, data, values[0], residuals, jacobian);
        residuals.iter().all(|r| r.is_finite()).then_some(())
    };
    least_squares_with_jacobian(start, samples, &SETTINGS, evaluate)
}

/// Forces [N] of a curve in each indentation; writes residuals and derivatives.
fn write(
    curve: &UnitCurve,
    data: LawData<'_>,
    modulus: f64,
    residuals: &mut [f64],
    jacobian: &mut DMatrix<f64>,
) -> Vec<Vec<f64>> {
    let mut start = 0;
    let each = data.indentations.iter().map(|each| {
        let (forces, columns) = forces::forces(each.time, each.depth, curve, modulus, data.series);
        forces::write(&columns, start, jacobian);
        for (row, force) in forces.iter().enumerate() {
            residuals[start + row] = force - each.force[row];
        }
        start += forces.len();
        forces
    });
    each.collect()
}

pub(super) fn parameters(law: CandidateLaw, series: &PronySeries, modulus: f64) -> Vec<Parameter> {
    let first = Parameter::new("modulus_pa", modulus).within(0.0, f64::INFINITY);
    let shapes = law.shapes().into_iter().enumerate().map(|(place, range)| {
        Parameter::new(format!("shape_{}", place + 1), range.start)
            .within(range.lower, range.upper)
            .scaled(1.0)
    });
    let left = 1.0 - series.terms().iter().map(|(g, _)| g).sum::<f64>();
    let relaxation = series
        .terms()
        .iter()
        .enumerate()
        .flat_map(|(place, (g, tau))| {
            let ratio = Parameter::new(format!("ratio_{}", place + 1), g / left);
            let time = Parameter::new(format!("log_tau_{}", place + 1), tau.ln()).scaled(1.0);
            [ratio.fixed(), time.fixed()]
        });
    [first]
        .into_iter()
        .chain(shapes)
        .chain(relaxation)
        .collect()
}
