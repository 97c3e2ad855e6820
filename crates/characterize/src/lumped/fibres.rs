//! The law with fibres, fitted to pieces that are cut at several angles to them.
//!
//! The stress of two families at ±γ is even in γ, so that its slope with γ is zero at 0 and at 90°; a fit in γ creeps towards
//! them and knows nothing there. In sin² γ it is smooth, and that is what is fitted; near the ends slopes are those at
//! [`MIN_ANGLE`].

use nalgebra::DMatrix;
use palpate_files::recording::RecordingHeader;
use palpate_files::tissue::LawName;
use palpate_mechanics::finite_elements::homogeneous::deformed;
use palpate_mechanics::{Fibres, HolzapfelGasserOgden};

use super::piece::{Measured, PieceTest};
use crate::Error;
use crate::fit::{
    Fit, Parameter, Settings, another_minimum, distinct_minima, least_squares_with_jacobian,
};
use crate::inverse::CandidateLaw;

/// What is known of fibres before a fit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct KnownFibres {
    dispersion: Option<f64>,
    angle_deg: Option<f64>,
}

impl KnownFibres {
    pub(super) fn of(header: &RecordingHeader) -> Self {
        Self {
            dispersion: header.dispersion,
            angle_deg: header.fibre_angle_deg,
        }
    }

    /// Keys of what is to be fitted.
    fn sought(self) -> Vec<&'static str> {
        let each = [
            ("dispersion", self.dispersion),
            ("fibre_angle_deg", self.angle_deg),
        ];
        let unknown = each.into_iter().filter(|(_, known)| known.is_none());
        unknown.map(|(key, _)| key).collect()
    }
}

/// A fit whose errors are those of all parameters together, also of what ended on a bound: k₁ and k₂ follow the dispersion and
/// the angle, and would look better known than they are.
pub(super) fn with_all_free(fit: &Fit) -> Fit {
    let mut free = fit.clone();
    let each = free.parameters.iter_mut();
    for own in each.filter(|own| !own.fixed) {
        (own.lower, own.upper) = (f64::NEG_INFINITY, f64::INFINITY);
    }
    free
}

/// A law with fibres that was found.
pub(super) struct FibreFit {
    pub(super) fit: Fit,
    /// Parameters that these tests do not determine.
    pub(super) undetermined: Vec<&'static str>,
    pub(super) warnings: Vec<String>,
}

/// Samples of each piece by which starts are chosen, and by which minima are sought.
const FEW: usize = 12;
const SOME: usize = 60;
/// Starts for each pair of dispersion and angle, and in all.
const OF_CELL: usize = 2;
const STARTS: usize = 12;
/// k₁ over C₁₀; k₂ times the square of the largest strain; dispersions and angles [degrees], from which fits may start.
const STIFFNESSES: [f64; 6] = [0.1, 1.0, 10.0, 100.0, 1e3, 1e4];
const EXPONENTS: [f64; 3] = [0.1, 1.0, 3.0];
const DISPERSIONS: [f64; 3] = [0.03, 0.15, 0.28];
const ANGLES: [f64; 4] = [10.0, 30.0, 50.0, 75.0];
/// From the ends of its range, an angle at which slopes are taken [degrees]: it changes the stress of fibres by its square, 3e-8,
/// and rounding leaves twelve digits of its slope.
const MIN_ANGLE: f64 = 0.01;
/// The least C₁₀ over the largest stress [-]: without a matrix the sides of a strip are not determined.
const LEAST: f64 = 1e-6;

/// The law of Holzapfel, Gasser and Ogden that comes nearest to all `pieces`, with what is `known` of its fibres.
///
/// # Errors
/// When a piece does not say how its fibres lie, samples are fewer than parameters, or stress does not grow with strain.
pub(super) fn fitted(pieces: &[Measured], known: KnownFibres) -> Result<FibreFit, Error> {
    pieces
        .iter()
        .try_for_each(|own| own.loading.frame().map(drop))?;
    let some = thinned(pieces, SOME);
    let starts = starts(&thinned(pieces, FEW), known);
    let minima = distinct_minima(starts.iter().map(|start| least(start, &some, known)))?;
    let (best, others) = minima.split_first().ok_or(Error::NoContactForce)?;
    let fit = in_degrees(least(&best.fit.parameters, pieces, known)?, known);
    let sought = known.sought();
    let (mut undetermined, mut warnings) = (Vec::new(), Vec::new());
    if directions(pieces) == 1 && !sought.is_empty() {
        undetermined = [&["k1_pa", "k2"], &sought[..]].concat();
        warnings.push(format!(
            "all pieces are loaded in one direction to their fibres, which does not determine {}, as these replace one another in \
             the shape of one curve; add a piece that is cut in another direction, or state `{}`",
            undetermined.join(", "),
            sought.join("` and `")
        ));
    }
    warnings.extend(others.first().and_then(|other| {
        let times = other.fit.sum_of_squares() / best.fit.sum_of_squares();
        let other = in_degrees(other.fit.clone(), known);
        let each = other.parameters.iter();
        let each = each.map(|own| (own.name.as_str(), own.value));
        another_minimum(LawName::HolzapfelGasserOgden.word(), times, each)
    }));
    Ok(FibreFit {
        fit,
        undetermined,
        warnings,
    })
}

/// How many directions pieces are loaded in, to their fibres; a stretch does as much on either side of them.
fn directions(pieces: &[Measured]) -> usize {
    let mut all: Vec<(bool, f64)> = Vec::new();
    for loading in pieces.iter().map(|own| own.loading) {
        let angle = loading
            .fibre_axis_angle_deg
            .unwrap_or(0.0)
            .rem_euclid(180.0);
        let own = match loading.test {
            PieceTest::SimpleShear => (true, angle),
            PieceTest::Uniaxial | PieceTest::PlanarTension => (false, angle.min(180.0 - angle)),
        };
        if !all.contains(&own) {
            all.push(own);
        }
    }
    all.len()
}

/// So many samples of each piece, evenly.
fn thinned(pieces: &[Measured], most: usize) -> Vec<Measured> {
    let each = pieces.iter().map(|own| {
        let last = own.stresses.len().saturating_sub(1);
        let count = most.min(own.stresses.len());
        let sampled = |values: &[f64]| {
            let places = (0..count).map(|place| (place * last) / count.saturating_sub(1).max(1));
            places.map(|place| values[place]).collect()
        };
        Measured {
            loading: own.loading,
            stretches: sampled(&own.stretches),
            stresses: sampled(&own.stresses),
        }
    });
    each.collect()
}

/// Where fits start: all stress grows with C₁₀, which is found for each set of shapes, and the best are taken.
fn starts(pieces: &[Measured], known: KnownFibres) -> Vec<Vec<Parameter>> {
    let law = CandidateLaw::HolzapfelGasserOgden;
    let samples = pieces.iter().flat_map(Measured::samples);
    let largest = samples.fold(0.0, |most: f64, (_, stress)| most.max(stress.abs()));
    // E of fibres along the load.
    let strain = pieces.iter().flat_map(|own| {
        let shear = own.loading.test == PieceTest::SimpleShear;
        own.stretches.iter().map(move |x| match shear {
            true => x * x + x.abs(),
            false => (x * x - 1.0).abs(),
        })
    });
    let strain = strain.fold(0.0, f64::max).max(1e-6);
    let or = |known: Option<f64>, usual: &[f64]| known.map_or(usual.to_vec(), |own| vec![own]);
    let mut all: Vec<(usize, f64, Vec<f64>)> = Vec::new();
    let mut cell = 0;
    for dispersion in or(known.dispersion, &DISPERSIONS) {
        for angle in or(known.angle_deg, &ANGLES) {
            for stiffness in STIFFNESSES {
                for exponent in EXPONENTS {
                    let shape = [stiffness, exponent / strain.powi(2), dispersion, angle];
                    let own = law.parameters(1.0, &shape);
                    let unit: Vec<f64> = own.iter().map(|own| own.value).collect();
                    let Some((modulus, gained)) = modulus(&unit, pieces, known) else {
                        continue;
                    };
                    let own = law.parameters(modulus, &shape);
                    all.push((cell, gained, own.iter().map(|own| own.value).collect()));
                }
            }
            cell += 1;
        }
    }
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut taken = vec![0; cell];
    let most = if cell == 1 { STARTS } else { OF_CELL };
    let best = all.into_iter().filter(|(cell, ..)| {
        taken[*cell] += 1;
        taken[*cell] <= most
    });
    best.take(STARTS)
        .map(|(_, _, values)| bounded(&values, LEAST * largest, known))
        .collect()
}

/// The C₁₀ [Pa] that comes nearest to what was measured with the shapes of these parameters, and the square of the stress
/// that it explains; none where that is none.
fn modulus(unit: &[f64], pieces: &[Measured], known: KnownFibres) -> Option<(f64, f64)> {
    let count = pieces.iter().map(|own| own.stresses.len()).sum();
    let (mut stresses, mut changes) = (vec![0.0; count], DMatrix::zeros(count, unit.len()));
    let mut values = unit.to_vec();
    values[ANGLE] = squared_sine(unit[ANGLE]);
    write(&values, pieces, known, &mut stresses, &mut changes)?;
    let (mut products, mut squares) = (0.0, 0.0);
    let known = pieces.iter().flat_map(|own| &own.stresses);
    for (residual, known) in stresses.iter().zip(known) {
        let own = residual + known;
        products += own * known;
        squares += own * own;
    }
    let modulus = products / squares;
    (modulus > 0.0 && modulus.is_finite()).then_some((modulus, products * modulus))
}

/// The place of the angle among the parameters.
const ANGLE: usize = 4;

fn squared_sine(angle_deg: f64) -> f64 {
    angle_deg.to_radians().sin().powi(2).clamp(0.0, 1.0)
}

fn angle_deg(squared_sine: f64) -> f64 {
    squared_sine.clamp(0.0, 1.0).sqrt().asin().to_degrees()
}

/// Change of sin² γ with γ [1/degree], at the least distance from where it is none.
fn slope(angle_deg: f64) -> f64 {
    let angle = angle_deg.clamp(MIN_ANGLE, 90.0 - MIN_ANGLE);
    1_f64.to_radians() * (2.0 * angle.to_radians()).sin()
}

/// A fit in sin² γ as one in γ.
fn in_degrees(mut fit: Fit, known: KnownFibres) -> Fit {
    let own = &mut fit.parameters[ANGLE];
    own.value = known.angle_deg.unwrap_or(angle_deg(own.value));
    own.upper = 90.0;
    own.scale = 10.0;
    fit.jacobian.column_mut(ANGLE).scale_mut(slope(own.value));
    for step in &mut fit.iterations {
        step.values[ANGLE] = angle_deg(step.values[ANGLE]);
    }
    fit
}

/// Parameters that start at these values, with sin² γ for γ and what is known of them fixed.
fn bounded(values: &[f64], least: f64, known: KnownFibres) -> Vec<Parameter> {
    let names = CandidateLaw::HolzapfelGasserOgden.names();
    let each = names.into_iter().zip(values).map(|(name, &value)| {
        let free = Parameter::new(name, value);
        let fix_known = |known: Option<f64>, own: Parameter| match known {
            Some(_) => own.fixed(),
            None => own,
        };
        match name {
            "c10_pa" => {
                let value = value.max(2.0 * least);
                Parameter::new(name, value).within(least, f64::INFINITY)
            }
            "dispersion" => fix_known(known.dispersion, free.within(0.0, 1.0 / 3.0).scaled(0.1)),
            "fibre_angle_deg" => {
                let own = Parameter::new(name, squared_sine(value)).within(0.0, 1.0);
                fix_known(known.angle_deg, own.scaled(0.3))
            }
            _ => free.within(0.0, f64::INFINITY),
        }
    });
    each.collect()
}

/// The fit that `start` leads to.
fn least(start: &[Parameter], pieces: &[Measured], known: KnownFibres) -> Result<Fit, Error> {
    let samples = pieces.iter().map(|own| own.stresses.len()).sum();
    let evaluate = |values: &[f64], residuals: &mut [f64], jacobian: &mut DMatrix<f64>| {
        write(values, pieces, known, residuals, jacobian)
    };
    least_squares_with_jacobian(start, samples, &Settings::default(), evaluate)
}

/// Residuals [Pa] of the law with these parameters, sin² γ among them, and their derivatives; none where it has no stress.
fn write(
    values: &[f64],
    pieces: &[Measured],
    known: KnownFibres,
    residuals: &mut [f64],
    jacobian: &mut DMatrix<f64>,
) -> Option<()> {
    let fibres = Fibres {
        k1: values[1],
        k2: values[2],
        dispersion: values[3],
        angle_deg: known
            .angle_deg
            .unwrap_or_else(|| angle_deg(values[ANGLE]).clamp(MIN_ANGLE, 90.0 - MIN_ANGLE)),
    };
    let of_angle = slope(fibres.angle_deg).recip();
    let law = HolzapfelGasserOgden::incompressible(values[0], fibres).ok()?;
    let mut row = 0;
    for piece in pieces {
        let own = law.turned_to(piece.loading.frame().ok()?);
        // Sides are sought from where those of the sample before were.
        let mut free = None;
        for (stretch, known) in piece.samples() {
            let found = deformed(&own, piece.loading.test.into(), stretch, free).ok()?;
            residuals[row] = found.nominal_stress - known;
            for (column, change) in found.by_parameter.iter().enumerate() {
                jacobian[(row, column)] = *change;
            }
            jacobian[(row, ANGLE)] *= of_angle;
            free = Some(found.free);
            row += 1;
        }
    }
    Some(())
}
