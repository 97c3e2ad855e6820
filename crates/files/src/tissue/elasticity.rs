use std::ops::Bound::Excluded;

use crate::words::words;
use crate::{Domain, Error, Estimate, Keys};

words! {
    /// The name of an elastic law.
    pub enum LawName {
        /// Linear elasticity.
        Linear = "linear",
        /// Neo-Hookean, incompressible.
        NeoHookean = "neo_hookean",
        /// Mooney-Rivlin, incompressible.
        MooneyRivlin = "mooney_rivlin",
        /// The exponential law of Blatz, Chu and Wayland, incompressible.
        Exponential = "exponential" | "blatz",
    }
}

/// An elastic law with its parameters. All but [`Elasticity::Linear`] are incompressible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Elasticity {
    /// Linear elasticity.
    Linear {
        /// Young's modulus [Pa].
        youngs_modulus_pa: Estimate,
        /// Poisson's ratio [-], above -1 and below 0.5.
        poissons_ratio: Estimate,
    },
    /// Ψ = C₁₀ (I₁ − 3).
    NeoHookean {
        /// C₁₀ [Pa], half the shear modulus.
        c10_pa: Estimate,
    },
    /// Ψ = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3), with C₁₀ + C₀₁ above zero.
    MooneyRivlin {
        /// C₁₀ [Pa].
        c10_pa: Estimate,
        /// C₀₁ [Pa].
        c01_pa: Estimate,
    },
    /// The law of Blatz, Chu and Wayland: Ψ = γ / (2 α (α + 1)) Σ (exp(α (λᵢ² − 1)) − 1); with α = 0 it is
    /// neo-Hookean with C₁₀ = γ/2.
    Exponential {
        /// γ [Pa], a third of Young's modulus at small strain.
        gamma_pa: Estimate,
        /// α [-].
        alpha: Estimate,
    },
}

pub(super) const POISSONS_RATIO: Domain = Domain::number("a number", [Excluded(-1.0), Excluded(0.5)])
    .usually(0.0, 0.5)
    .with_remark(
        "0.5 itself belongs to the incompressible laws neo_hookean, mooney_rivlin and exponential; 0.49 is near \
         enough for most tissues",
    );

const SUM_POSITIVE: &str = "numbers such that c10_pa + c01_pa, half the shear modulus, is above 0";

impl Elasticity {
    /// The word of the law.
    pub fn law(&self) -> LawName {
        match self {
            Self::Linear { .. } => LawName::Linear,
            Self::NeoHookean { .. } => LawName::NeoHookean,
            Self::MooneyRivlin { .. } => LawName::MooneyRivlin,
            Self::Exponential { .. } => LawName::Exponential,
        }
    }

    /// The parameters with their keys, in the order of the documentation.
    pub fn parameters(&self) -> Vec<(&'static str, Estimate)> {
        match *self {
            Self::Linear {
                youngs_modulus_pa,
                poissons_ratio,
            } => vec![
                ("youngs_modulus_pa", youngs_modulus_pa),
                ("poissons_ratio", poissons_ratio),
            ],
            Self::NeoHookean { c10_pa } => vec![("c10_pa", c10_pa)],
            Self::MooneyRivlin { c10_pa, c01_pa } => vec![("c10_pa", c10_pa), ("c01_pa", c01_pa)],
            Self::Exponential { gamma_pa, alpha } => vec![("gamma_pa", gamma_pa), ("alpha", alpha)],
        }
    }

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let law = keys.word_or_former("law", LawName::WORDS, LawName::FORMER)?;
        let law = law.ok_or_else(|| {
            keys.missing(
                "law",
                "\"linear\", \"neo_hookean\", \"mooney_rivlin\" or \"exponential\"",
            )
        })?;
        check_parameters(keys, law)?;
        match law {
            LawName::Linear => Ok(Self::Linear {
                youngs_modulus_pa: keys.required_estimate("youngs_modulus_pa")?,
                poissons_ratio: keys.required_estimate("poissons_ratio")?,
            }),
            LawName::NeoHookean => {
                let c10_pa = keys.estimate_within("c10_pa", Domain::MODULUS)?;
                Ok(Self::NeoHookean {
                    c10_pa: c10_pa
                        .ok_or_else(|| keys.missing("c10_pa", Domain::MODULUS.expected()))?,
                })
            }
            LawName::MooneyRivlin => mooney_rivlin(keys),
            LawName::Exponential => Ok(Self::Exponential {
                gamma_pa: keys.required_estimate("gamma_pa")?,
                alpha: keys.required_estimate("alpha")?,
            }),
        }
    }
}

/// A parameter of another law is a mistake, not something to pass over.
fn check_parameters(keys: &Keys<'_>, law: LawName) -> Result<(), Error> {
    let of_law: &[&str] = match law {
        LawName::Linear => &["youngs_modulus_pa", "poissons_ratio"],
        LawName::NeoHookean => &["c10_pa"],
        LawName::MooneyRivlin => &["c10_pa", "c01_pa"],
        LawName::Exponential => &["gamma_pa", "alpha"],
    };
    let shared = &["name", "density_kg_m3", "law", "prony", "lumped", "source"];
    keys.only(&[of_law, shared].concat())
}

fn mooney_rivlin(keys: &Keys<'_>) -> Result<Elasticity, Error> {
    // A fit may put one of the two below zero; only the sum must stay above it.
    let c10_pa = keys.required_estimate("c10_pa")?;
    let c01_pa = keys.required_estimate("c01_pa")?;
    if c10_pa.value + c01_pa.value > 0.0 {
        return Ok(Elasticity::MooneyRivlin { c10_pa, c01_pa });
    }
    Err(Error::BadValue {
        place: keys.place().clone(),
        key: keys.full_name("c10_pa + c01_pa"),
        found: format!("{}", c10_pa.value + c01_pa.value),
        expected: SUM_POSITIVE.into(),
    })
}
