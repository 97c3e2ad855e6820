use std::ops::Bound::Excluded;

use crate::words::{either, words};
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
        /// Ogden's law with one to three terms, incompressible.
        Ogden = "ogden",
        /// The reduced polynomial with one to three terms (Yeoh's law), incompressible.
        ReducedPolynomial = "reduced_polynomial",
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
    /// Ψ = Σ_p 2 μ_p/α_p² (Σᵢ λᵢ^α_p − 3), one to three terms, the first ones there.
    Ogden {
        /// The terms.
        terms: [Option<OgdenTerm>; 3],
    },
    /// Ψ = Σᵢ Cᵢ₀ (I₁ − 3)^i, one to three terms.
    ReducedPolynomial {
        /// C₁₀ [Pa], half the shear modulus at rest.
        c10_pa: Estimate,
        /// C₂₀ and C₃₀ [Pa], the first ones there.
        higher_pa: [Option<Estimate>; 2],
    },
}

/// A term of Ogden's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OgdenTerm {
    /// μ [Pa], its part of the shear modulus at rest.
    pub mu_pa: Estimate,
    /// α [-].
    pub alpha: Estimate,
}

/// The keys of the terms of Ogden's law.
const OGDEN: [[&str; 2]; 3] = [
    ["mu_1_pa", "alpha_1"],
    ["mu_2_pa", "alpha_2"],
    ["mu_3_pa", "alpha_3"],
];

/// The keys of the higher terms of the reduced polynomial.
const HIGHER: [&str; 2] = ["c20_pa", "c30_pa"];

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
            Self::Ogden { .. } => LawName::Ogden,
            Self::ReducedPolynomial { .. } => LawName::ReducedPolynomial,
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
            Self::Ogden { terms } => {
                let terms = OGDEN.iter().zip(terms.into_iter().flatten());
                terms
                    .flat_map(|([mu, alpha], term)| [(*mu, term.mu_pa), (*alpha, term.alpha)])
                    .collect()
            }
            Self::ReducedPolynomial { c10_pa, higher_pa } => {
                let higher = HIGHER.into_iter().zip(higher_pa);
                let higher = higher.filter_map(|(key, constant)| Some((key, constant?)));
                [("c10_pa", c10_pa)].into_iter().chain(higher).collect()
            }
        }
    }

    /// The law of a tissue that is `factor` times as stiff at every strain.
    pub fn stiffened(mut self, factor: f64) -> Self {
        let stiffen = |modulus: &mut Estimate| modulus.value *= factor;
        match &mut self {
            Self::Linear {
                youngs_modulus_pa, ..
            } => stiffen(youngs_modulus_pa),
            Self::NeoHookean { c10_pa } => stiffen(c10_pa),
            Self::MooneyRivlin { c10_pa, c01_pa } => [c10_pa, c01_pa].into_iter().for_each(stiffen),
            Self::Exponential { gamma_pa, .. } => stiffen(gamma_pa),
            Self::Ogden { terms } => {
                let terms = terms.iter_mut().flatten();
                terms.for_each(|term| stiffen(&mut term.mu_pa));
            }
            Self::ReducedPolynomial { c10_pa, higher_pa } => {
                stiffen(c10_pa);
                higher_pa.iter_mut().flatten().for_each(stiffen);
            }
        }
        self
    }

    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let law = keys.word_or_former("law", LawName::WORDS, LawName::FORMER)?;
        let law = law.ok_or_else(|| {
            keys.missing(
                "law",
                either(
                    &LawName::WORDS
                        .iter()
                        .map(|(word, _)| format!("{word:?}"))
                        .collect::<Vec<_>>(),
                ),
            )
        })?;
        check_parameters(keys, law)?;
        match law {
            LawName::Linear => Ok(Self::Linear {
                youngs_modulus_pa: keys.required_estimate("youngs_modulus_pa")?,
                poissons_ratio: keys.required_estimate("poissons_ratio")?,
            }),
            LawName::NeoHookean => Ok(Self::NeoHookean {
                c10_pa: positive_c10(keys)?,
            }),
            LawName::MooneyRivlin => mooney_rivlin(keys),
            LawName::Exponential => Ok(Self::Exponential {
                gamma_pa: keys.required_estimate("gamma_pa")?,
                alpha: keys.required_estimate("alpha")?,
            }),
            LawName::Ogden => ogden(keys),
            LawName::ReducedPolynomial => reduced_polynomial(keys),
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
        LawName::Ogden => &OGDEN.concat(),
        LawName::ReducedPolynomial => &["c10_pa", HIGHER[0], HIGHER[1]],
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

/// C10 of a law of which it is half the shear modulus.
fn positive_c10(keys: &Keys<'_>) -> Result<Estimate, Error> {
    let c10 = keys.estimate_within("c10_pa", Domain::MODULUS)?;
    c10.ok_or_else(|| keys.missing("c10_pa", Domain::MODULUS.expected()))
}

fn ogden(keys: &Keys<'_>) -> Result<Elasticity, Error> {
    let mut terms = [None; 3];
    let mut count = 0;
    for (number, [mu, alpha]) in OGDEN.into_iter().enumerate() {
        if number > 0 && !keys.contains(mu) && !keys.contains(alpha) {
            continue;
        }
        if number > count {
            let expected = format!("`{}` too, for terms are counted from 1", OGDEN[count][0]);
            return Err(keys.bad(mu, expected));
        }
        count += 1;
        terms[number] = Some(OgdenTerm {
            mu_pa: keys.required_estimate(mu)?,
            alpha: keys.required_estimate(alpha)?,
        });
    }
    let all = terms.iter().flatten();
    let sum: f64 = all.clone().map(|term| term.mu_pa.value).sum();
    if let Some(number) = all.clone().position(|term| term.alpha.value.abs() < 1e-3) {
        return Err(keys.bad(OGDEN[number][1], "an exponent of at least 0.001 in size"));
    }
    if sum > 0.0 {
        return Ok(Elasticity::Ogden { terms });
    }
    Err(Error::BadValue {
        place: keys.place().clone(),
        key: keys.full_name("mu_1_pa"),
        found: format!("a sum of all mu of {sum}"),
        expected: "numbers whose sum, the shear modulus at rest, is above 0".into(),
    })
}

fn reduced_polynomial(keys: &Keys<'_>) -> Result<Elasticity, Error> {
    let c10_pa = positive_c10(keys)?;
    let higher_pa = [keys.estimate(HIGHER[0])?, keys.estimate(HIGHER[1])?];
    if higher_pa[0].is_none() && higher_pa[1].is_some() {
        return Err(keys.missing(HIGHER[0], "a number, perhaps 0, for `c30_pa` is there"));
    }
    Ok(Elasticity::ReducedPolynomial { c10_pa, higher_pa })
}
