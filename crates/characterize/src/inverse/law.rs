use std::sync::Arc;

use palpate_files::Estimate;
use palpate_files::tissue::{Elasticity, LawName};
use palpate_mechanics::{Law, law_named};

/// A law that can be sought: a modulus, which all force grows with, and perhaps a number for the shape of
/// the force. Seen so, the two hardly disturb one another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SoughtLaw {
    /// The modulus is C₁₀.
    NeoHookean,
    /// The modulus is C₁₀ + C₀₁, the shape C₀₁ over it.
    MooneyRivlin,
    /// The exponential law of Blatz, Chu and Wayland: the modulus is γ, the shape α.
    Exponential,
}

impl SoughtLaw {
    /// All, the simplest first.
    pub const ALL: [Self; 3] = [Self::NeoHookean, Self::MooneyRivlin, Self::Exponential];

    /// Its name in files.
    pub fn name(self) -> LawName {
        match self {
            Self::NeoHookean => LawName::NeoHookean,
            Self::MooneyRivlin => LawName::MooneyRivlin,
            Self::Exponential => LawName::Exponential,
        }
    }

    /// The law of a name in files, also one of an earlier version.
    pub fn named(name: &str) -> Option<Self> {
        let meant = LawName::from_word(name)?;
        Self::ALL.into_iter().find(|law| law.name() == meant)
    }

    /// Lower bound, start and upper bound of the shape [-]; none where there is none.
    pub fn shapes(self) -> Option<[f64; 3]> {
        match self {
            Self::NeoHookean => None,
            Self::MooneyRivlin => Some([0.0, 0.3, 0.9]),
            Self::Exponential => Some([0.0, 0.5, 20.0]),
        }
    }

    /// The law of a `modulus` [Pa] and a `shape` [-].
    ///
    /// # Errors
    /// When they are none of a law.
    pub fn of(self, modulus: f64, shape: f64) -> Result<Arc<dyn Law>, palpate_mechanics::Error> {
        let parameters = self.parameters(modulus, shape);
        let values: Vec<_> = parameters.iter().map(|parameter| parameter.value).collect();
        law_named(self.name(), &values)
    }

    /// The law of unit modulus with a `shape` [-].
    pub(super) fn unit(self, shape: f64) -> Result<Arc<dyn Law>, palpate_mechanics::Error> {
        self.of(1.0, shape)
    }

    /// Change of a force with the shape [N], from its changes with the parameters of the law.
    pub(super) fn by_shape(self, sensitivities: &[f64]) -> f64 {
        match self {
            Self::NeoHookean => 0.0,
            Self::MooneyRivlin => sensitivities[1] - sensitivities[0],
            Self::Exponential => sensitivities[1],
        }
    }

    /// The law's own parameters and their derivatives with modulus and shape, each a row.
    pub fn parameters(self, modulus: f64, shape: f64) -> Vec<LawParameter> {
        let of = |name, value, by| LawParameter { name, value, by };
        match self {
            Self::NeoHookean => vec![of("c10_pa", modulus, [1.0, 0.0])],
            Self::MooneyRivlin => vec![
                of("c10_pa", modulus * (1.0 - shape), [1.0 - shape, -modulus]),
                of("c01_pa", modulus * shape, [shape, modulus]),
            ],
            Self::Exponential => vec![
                of("gamma_pa", modulus, [1.0, 0.0]),
                of("alpha", shape, [0.0, 1.0]),
            ],
        }
    }

    /// The law's own two parameters as modulus and shape; of one alone, the second means nothing. None where
    /// the shape is beyond what is sought.
    pub(super) fn seen_as_shape(self, [first, second]: [f64; 2]) -> Option<SeenAsShape> {
        let seen = match self {
            Self::NeoHookean => SeenAsShape {
                modulus: first,
                shape: 0.0,
                by: [[1.0, 0.0], [0.0, 0.0]],
            },
            Self::MooneyRivlin => {
                let modulus = first + second;
                let shape = second / modulus;
                SeenAsShape {
                    modulus,
                    shape,
                    by: [[1.0, -shape / modulus], [1.0, (1.0 - shape) / modulus]],
                }
            }
            Self::Exponential => SeenAsShape {
                modulus: first,
                shape: second,
                by: [[1.0, 0.0], [0.0, 1.0]],
            },
        };
        let known = self
            .shapes()
            .map_or(0.0..=0.0, |[lower, _, upper]| lower..=upper);
        (seen.modulus > 0.0 && known.contains(&seen.shape)).then_some(seen)
    }

    /// Modulus [Pa] and shape [-] of the law with these parameters, in their order; none where they are not sought.
    pub fn as_shape(self, parameters: &[f64]) -> Option<(f64, f64)> {
        let of = |place: usize| parameters.get(place).copied().unwrap_or(0.0);
        let own = self.seen_as_shape([of(0), of(1)])?;
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

/// A parameter of a law, by the name that files give it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawParameter {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Its value [unit of its name].
    pub value: f64,
    /// Its change with the modulus and with the shape [unit of its name].
    pub by: [f64; 2],
}

/// A law's own parameters as modulus and shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct SeenAsShape {
    /// The modulus [Pa].
    pub modulus: f64,
    /// The shape [-].
    pub shape: f64,
    /// Change of modulus and shape with each of the law's own parameters.
    pub by: [[f64; 2]; 2],
}
