use std::sync::Arc;

use nalgebra::DMatrix;
use palpate_files::Estimate;
use palpate_files::tissue::{Elasticity, LawName};
use palpate_mechanics::{Law, law_named};

/// A law that can be fitted: a modulus, to which all force is proportional, and shape parameters of the force, none or
/// more. In these parameters, the modulus hardly affects the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CandidateLaw {
    /// The modulus is C₁₀.
    NeoHookean,
    /// The modulus is C₁₀ + C₀₁, the shape C₀₁ over it.
    MooneyRivlin,
    /// The exponential law of Blatz, Chu and Wayland: the modulus is γ, the shape α.
    Exponential,
    /// Ogden's law: the modulus is Σ μ; the shapes are the α, and the part of the modulus that each further term has of
    /// what the terms after it leave.
    Ogden(Terms),
    /// The reduced polynomial: the modulus is C₁₀, the shapes are C₂₀ and C₃₀ over it.
    ReducedPolynomial(Terms),
    /// The law of Holzapfel, Gasser and Ogden, of pieces alone: the modulus is C₁₀, the shapes are k₁ over it, k₂, the
    /// dispersion and the angle of the fibres [degrees].
    HolzapfelGasserOgden,
}

/// Terms of a law that may have several.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Terms {
    /// One.
    One = 1,
    /// Two.
    Two = 2,
    /// Three.
    Three = 3,
}

impl Terms {
    /// So many; none where no law has as many.
    pub fn of(count: usize) -> Option<Self> {
        [Self::One, Self::Two, Self::Three]
            .into_iter()
            .find(|terms| terms.count() == count)
    }

    /// How many.
    pub fn count(self) -> usize {
        self as usize
    }
}

/// Where a shape is sought [-].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeRange {
    /// The least.
    pub lower: f64,
    /// Where a fit begins.
    pub start: f64,
    /// The largest.
    pub upper: f64,
}

const fn range(lower: f64, start: f64, upper: f64) -> ShapeRange {
    ShapeRange {
        lower,
        start,
        upper,
    }
}

/// The α of each term of Ogden's law. The signs of the first two differ, and the third is larger than the first: else
/// terms could change places. Below one, the force of a term falls in tension.
const ALPHAS: [&[ShapeRange]; 3] = [
    &[range(1.0, 3.0, 30.0)],
    &[range(1.0, 3.0, 30.0), range(-30.0, -2.0, -1.0)],
    &[
        range(1.0, 2.0, 4.0),
        range(-30.0, -2.0, -1.0),
        range(4.0, 8.0, 30.0),
    ],
];
/// The part of a further term of Ogden's law.
const PART: ShapeRange = range(0.0, 0.3, 0.9);
/// C₂₀ and C₃₀ over C₁₀: with both above zero the law is stable at every stretch.
const COEFFICIENTS: [ShapeRange; 2] = [range(0.0, 0.1, 20.0), range(0.0, 0.05, 20.0)];
/// k₁ over C₁₀, k₂, the dispersion and the angle of fibres [degrees].
const FIBRES: [ShapeRange; 4] = [
    range(0.0, 5.0, 1e9),
    range(0.0, 1.0, 1e5),
    range(0.0, 0.1, 1.0 / 3.0),
    range(0.0, 30.0, 90.0),
];

impl CandidateLaw {
    /// Those that are sought unless others are asked for, the simplest first.
    pub const DEFAULT: [Self; 3] = [Self::NeoHookean, Self::MooneyRivlin, Self::Exponential];

    /// The names of all that can be sought, the simplest first.
    pub const NAMES: [LawName; 6] = [
        LawName::NeoHookean,
        LawName::MooneyRivlin,
        LawName::Exponential,
        LawName::Ogden,
        LawName::ReducedPolynomial,
        LawName::HolzapfelGasserOgden,
    ];

    /// Its name in files.
    pub fn name(self) -> LawName {
        match self {
            Self::NeoHookean => LawName::NeoHookean,
            Self::MooneyRivlin => LawName::MooneyRivlin,
            Self::Exponential => LawName::Exponential,
            Self::Ogden(_) => LawName::Ogden,
            Self::ReducedPolynomial(_) => LawName::ReducedPolynomial,
            Self::HolzapfelGasserOgden => LawName::HolzapfelGasserOgden,
        }
    }

    /// The law of this name, with one term of Ogden's or two of the reduced polynomial; none where it is not sought.
    pub fn of_name(name: LawName) -> Option<Self> {
        match name {
            LawName::Ogden => Some(Self::Ogden(Terms::One)),
            LawName::ReducedPolynomial => Some(Self::ReducedPolynomial(Terms::Two)),
            LawName::HolzapfelGasserOgden => Some(Self::HolzapfelGasserOgden),
            _ => Self::DEFAULT.into_iter().find(|law| law.name() == name),
        }
    }

    /// The same with other terms; none of a law that has no terms.
    pub fn with_terms(self, terms: Terms) -> Option<Self> {
        match self {
            Self::NeoHookean
            | Self::MooneyRivlin
            | Self::Exponential
            | Self::HolzapfelGasserOgden => None,
            Self::Ogden(_) => Some(Self::Ogden(terms)),
            Self::ReducedPolynomial(_) => Some(Self::ReducedPolynomial(terms)),
        }
    }

    /// The law of this name that has so many parameters; none where there is none.
    pub fn with_parameters(name: LawName, count: usize) -> Option<Self> {
        let law = Self::of_name(name)?;
        let all = [1, 2, 3].into_iter().filter_map(Terms::of);
        let each = all.filter_map(|terms| law.with_terms(terms));
        let mut each = each.chain([law]);
        each.find(|law| law.count() == count)
    }

    /// Where its shapes are sought, in their order.
    pub fn shapes(self) -> Vec<ShapeRange> {
        match self {
            Self::NeoHookean => Vec::new(),
            Self::MooneyRivlin => vec![range(0.0, 0.3, 0.9)],
            Self::Exponential => vec![range(0.0, 0.5, 20.0)],
            Self::Ogden(terms) => {
                let each = ALPHAS[terms.count() - 1].iter().enumerate();
                let each = each.map(|(place, alpha)| match place {
                    0 => vec![*alpha],
                    _ => vec![PART, *alpha],
                });
                each.flatten().collect()
            }
            Self::ReducedPolynomial(terms) => COEFFICIENTS[..terms.count() - 1].to_vec(),
            Self::HolzapfelGasserOgden => FIBRES.to_vec(),
        }
    }

    /// Where a fit begins to seek its shapes [-].
    pub fn start(self) -> Vec<f64> {
        self.shapes().iter().map(|range| range.start).collect()
    }

    /// The shear modulus at rest over the modulus [-].
    pub(super) fn shear(self) -> f64 {
        match self {
            Self::NeoHookean
            | Self::MooneyRivlin
            | Self::ReducedPolynomial(_)
            | Self::HolzapfelGasserOgden => 2.0,
            Self::Exponential | Self::Ogden(_) => 1.0,
        }
    }

    /// How many parameters it has.
    pub fn count(self) -> usize {
        1 + self.shapes().len()
    }

    /// The law of a `modulus` [Pa] and shapes [-].
    ///
    /// # Errors
    /// When they are none of a law.
    pub fn of(self, modulus: f64, shape: &[f64]) -> Result<Arc<dyn Law>, palpate_mechanics::Error> {
        let parameters = self.parameters(modulus, shape);
        let values: Vec<_> = parameters.iter().map(|parameter| parameter.value).collect();
        law_named(self.name(), &values)
    }

    /// The law of unit modulus with these shapes [-].
    pub(super) fn unit(self, shape: &[f64]) -> Result<Arc<dyn Law>, palpate_mechanics::Error> {
        self.of(1.0, shape)
    }

    /// Change of the force of unit modulus with each shape [N], from its changes with the parameters of the law.
    pub(super) fn by_shape(self, shape: &[f64], sensitivities: &[f64]) -> Vec<f64> {
        let own = self.parameters(1.0, shape);
        let by = |place: usize| {
            let each = own.iter().zip(sensitivities);
            each.map(|(parameter, change)| parameter.by[1 + place] * change)
                .sum()
        };
        (0..shape.len()).map(by).collect()
    }

    /// The law's own parameters and their derivatives with modulus and shapes, each a row. The one at a place belongs
    /// to the shape before that place.
    pub fn parameters(self, modulus: f64, shape: &[f64]) -> Vec<LawParameter> {
        let of = |name, value, by: &[f64]| LawParameter {
            name,
            value,
            by: by.to_vec(),
        };
        match (self, shape) {
            (Self::MooneyRivlin, &[part]) => vec![
                of("c10_pa", modulus * (1.0 - part), &[1.0 - part, -modulus]),
                of("c01_pa", modulus * part, &[part, modulus]),
            ],
            (Self::Exponential, &[alpha]) => vec![
                of("gamma_pa", modulus, &[1.0, 0.0]),
                of("alpha", alpha, &[0.0, 1.0]),
            ],
            (Self::Ogden(_), shape) => of_ogden(modulus, shape),
            (Self::HolzapfelGasserOgden, &[stiffness, k2, dispersion, angle]) => vec![
                of("c10_pa", modulus, &[1.0, 0.0, 0.0, 0.0, 0.0]),
                of(
                    "k1_pa",
                    modulus * stiffness,
                    &[stiffness, modulus, 0.0, 0.0, 0.0],
                ),
                of("k2", k2, &[0.0, 0.0, 1.0, 0.0, 0.0]),
                of("dispersion", dispersion, &[0.0, 0.0, 0.0, 1.0, 0.0]),
                of("fibre_angle_deg", angle, &[0.0, 0.0, 0.0, 0.0, 1.0]),
            ],
            (law, shape) => {
                // C₁₀, alone or with further coefficients.
                let names = law.name().row().keys();
                let count = 1 + shape.len();
                let parts = [1.0].into_iter().chain(shape.iter().copied());
                let each = names.zip(parts).enumerate();
                each.map(|(place, (name, part))| {
                    let mut by = vec![0.0; count];
                    by[place] = modulus;
                    by[0] = part;
                    of(name, modulus * part, &by)
                })
                .collect()
            }
        }
    }

    /// The names of its parameters.
    pub fn names(self) -> Vec<&'static str> {
        self.name().row().keys().take(self.count()).collect()
    }

    /// The law's own parameters, in their order, as modulus and shapes. None where a shape is beyond what is sought.
    pub(super) fn to_shape_parameters(self, own: &[f64]) -> Option<ShapeParameters> {
        let (modulus, shape) = match (self, own) {
            (Self::NeoHookean, &[modulus]) => (modulus, Vec::new()),
            (Self::MooneyRivlin, &[c10, c01]) => (c10 + c01, vec![c01 / (c10 + c01)]),
            (Self::Exponential, &[modulus, alpha]) => (modulus, vec![alpha]),
            (Self::Ogden(_), own) => {
                let (mut modulus, mut shape) = (own[0], vec![own[1]]);
                for [mu, alpha] in own[2..].as_chunks().0 {
                    modulus += mu;
                    shape.extend([mu / modulus, *alpha]);
                }
                (modulus, shape)
            }
            (Self::HolzapfelGasserOgden, &[c10, k1, k2, dispersion, angle]) => {
                (c10, vec![k1 / c10, k2, dispersion, angle])
            }
            (_, own) => (own[0], own[1..].iter().map(|each| each / own[0]).collect()),
        };
        let mut each = self.shapes().into_iter().zip(&shape);
        let is_sought = each.all(|(range, value)| (range.lower..=range.upper).contains(value));
        let by = to_shape(&self.parameters(modulus, &shape));
        (modulus > 0.0 && is_sought).then_some(ShapeParameters { modulus, shape, by })
    }

    /// Modulus [Pa] and shapes [-] of the law with these parameters, in their order; none where they are not sought.
    pub fn as_shape(self, parameters: &[f64]) -> Option<(f64, Vec<f64>)> {
        let own = self.to_shape_parameters(parameters)?;
        Some((own.modulus, own.shape))
    }

    /// The law as files hold it, from its parameters in their order.
    ///
    /// # Panics
    /// When there are not as many as [`Self::parameters`] has.
    pub fn elasticity(self, parameters: &[Estimate]) -> Elasticity {
        Elasticity::new(self.name(), parameters).expect("as many parameters as the law has")
    }
}

/// μ and α of each term; the shapes are α₁ and for each further term its part φ of the modulus of the terms up to it, and
/// its α.
fn of_ogden(modulus: f64, shape: &[f64]) -> Vec<LawParameter> {
    let count = 1 + shape.len();
    let terms = count / 2;
    let part = |term: usize| if term == 0 { 1.0 } else { shape[2 * term - 1] };
    // What the terms after this one leave to it and those before, without the one `but`.
    let left = |term: usize, but: usize| -> f64 {
        let after = (term + 1..terms).filter(|other| *other != but);
        after.map(|other| 1.0 - part(other)).product()
    };
    let mut names = CandidateLaw::Ogden(Terms::One).name().row().keys();
    let mut all = Vec::with_capacity(count);
    for term in 0..terms {
        let share = part(term) * left(term, term);
        let mut by = vec![0.0; count];
        by[0] = share;
        if term > 0 {
            by[2 * term] = modulus * left(term, term);
        }
        for after in term + 1..terms {
            by[2 * after] = -modulus * part(term) * left(term, after);
        }
        let mut of_alpha = vec![0.0; count];
        of_alpha[2 * term + 1] = 1.0;
        let each = [(modulus * share, by), (shape[2 * term], of_alpha)];
        for ((value, by), name) in each.into_iter().zip(names.by_ref()) {
            all.push(LawParameter { name, value, by });
        }
    }
    all
}

/// A parameter of a law, by the name that files give it.
#[derive(Debug, Clone, PartialEq)]
pub struct LawParameter {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Its value [unit of its name].
    pub value: f64,
    /// Its change with the modulus and with each shape [unit of its name].
    pub by: Vec<f64>,
}

/// Change of the modulus and of each shape, a row for each, with each of the law's `own` parameters; zero where that
/// cannot be determined.
pub(super) fn to_shape(own: &[LawParameter]) -> DMatrix<f64> {
    let count = own.len();
    let by = DMatrix::from_fn(count, count, |row, column| own[row].by[column]);
    by.try_inverse()
        .unwrap_or_else(|| DMatrix::zeros(count, count))
}

/// A law's own parameters as modulus and shapes.
#[derive(Debug, Clone)]
pub(super) struct ShapeParameters {
    /// The modulus [Pa].
    pub modulus: f64,
    /// The shapes [-].
    pub shape: Vec<f64>,
    /// See [`to_shape`].
    pub by: DMatrix<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [CandidateLaw; 9] = [
        CandidateLaw::NeoHookean,
        CandidateLaw::MooneyRivlin,
        CandidateLaw::Exponential,
        CandidateLaw::Ogden(Terms::One),
        CandidateLaw::Ogden(Terms::Two),
        CandidateLaw::Ogden(Terms::Three),
        CandidateLaw::ReducedPolynomial(Terms::Two),
        CandidateLaw::ReducedPolynomial(Terms::Three),
        CandidateLaw::HolzapfelGasserOgden,
    ];

    /// Judge: central differences, right to the square of a step of 1e-5.
    #[test]
    fn parameters_change_with_modulus_and_shapes_as_differences_say() {
        for law in LAWS {
            let (modulus, start) = (700.0, law.start());
            let own = law.parameters(modulus, &start);
            assert_eq!(own.len(), law.count());
            for place in 0..law.count() {
                let moved = |sign: f64| {
                    let mut all = [&[modulus][..], &start].concat();
                    let step = sign * 1e-5 * all[place].abs();
                    all[place] += step;
                    (step, law.parameters(all[0], &all[1..]))
                };
                let [(step, more), (_, less)] = [1.0, -1.0].map(moved);
                for ((more, less), own) in more.iter().zip(less).zip(&own) {
                    let slope = (more.value - less.value) / (2.0 * step);
                    let off = (slope - own.by[place]).abs();
                    assert!(off < 1e-6 * slope.abs().max(1.0), "{law:?} {}", own.name);
                }
            }
        }
    }

    /// Judge: the numbers that went in.
    #[test]
    fn parameters_come_back_as_modulus_and_shapes() {
        for law in LAWS {
            let own = law.parameters(700.0, &law.start());
            let values: Vec<f64> = own.iter().map(|p| p.value).collect();
            let (modulus, shape) = law.as_shape(&values).unwrap();
            assert!((modulus - 700.0).abs() < 1e-9);
            for (found, known) in shape.iter().zip(law.start()) {
                assert!((found - known).abs() < 1e-12, "{law:?}");
            }
            let names: Vec<_> = own.iter().map(|p| p.name).collect();
            assert_eq!(names, law.names());
            assert_eq!(
                CandidateLaw::with_parameters(law.name(), law.count()),
                Some(law)
            );
        }
    }
}
