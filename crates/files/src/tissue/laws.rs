//! The table of elastic laws: the name and the parameters of each, and how other packages write it. A new law needs a
//! word, a row here, its keys in `Tissue::KEYS` and a constructor in `palpate_mechanics`.

use std::ops::Bound::{Excluded, Included};

use crate::words::words;
use crate::{Domain, Key};

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
        /// Ogden's law of one to three terms, incompressible.
        Ogden = "ogden",
        /// The reduced polynomial of order 1 to 3 (Yeoh's law), incompressible.
        ReducedPolynomial = "reduced_polynomial",
        /// The fibre-reinforced law of Holzapfel, Gasser and Ogden with dispersion, incompressible; `solve` and fits
        /// of pieces know the direction of its fibres.
        HolzapfelGasserOgden = "holzapfel_gasser_ogden",
    }
}

/// Properties of a law other than its stress.
#[derive(Debug)]
pub struct LawRow {
    /// Its name for people.
    pub title: &'static str,
    /// The keys of its parameters.
    pub(super) parameters: &'static [Key],
    /// Parameters of a term; a tissue has one term or more, up to all parameters.
    pub(super) term: usize,
    /// A constraint on several parameters.
    pub(super) positive: Option<Positive>,
    /// Abaqus' keyword, its options and its numbers; none where Abaqus has no such law.
    pub(crate) abaqus: Option<fn(&[f64]) -> AbaqusLaw>,
    /// FEBio's material; none where FEBio has no such law.
    pub(crate) febio: Option<fn(&[f64]) -> FebioLaw>,
}

/// A sum of parameters that must be above zero.
#[derive(Debug)]
pub(super) struct Positive {
    pub(super) what: &'static str,
    pub(super) of: fn(&[f64]) -> f64,
    pub(super) expected: &'static str,
}

/// A law as Abaqus' keywords.
pub(crate) struct AbaqusLaw {
    /// The keyword with its options.
    pub(crate) keyword: String,
    /// The numbers below it, in Abaqus' order.
    pub(crate) numbers: Vec<f64>,
    /// Directions of the families of fibres in the local system of an orientation, of length one [-].
    pub(crate) fibres: Vec<[f64; 3]>,
    /// Whether the bulk modulus is finite, so that it relaxes.
    pub(crate) compressible: bool,
}

/// A law as a material of FEBio.
pub(crate) struct FebioLaw {
    /// The type of the material.
    pub(crate) kind: &'static str,
    /// Its parameters, without a bulk modulus.
    pub(crate) numbers: Vec<(String, f64)>,
    /// Shear modulus at rest [Pa], of a law that keeps its volume.
    pub(crate) shear_modulus: Option<f64>,
    /// Whether it needs a local system of axes.
    pub(crate) has_axes: bool,
}

const POISSONS_RATIO: Domain = Domain::number("a number", [Excluded(-1.0), Excluded(0.5)])
    .usually(0.0, 0.5)
    .with_remark(
        "0.5 itself belongs to the incompressible laws, such as neo_hookean; 0.49 is near enough for most tissues",
    );

const FIBRE_STIFFNESS: Domain = Domain::quantity(
    "a stiffness of fibres",
    "pa",
    [Included(0.0), Included(1e11)],
)
.usually(1.0, 1e8);

const FIBRE_EXPONENT: Domain =
    Domain::number("an exponent", [Included(0.0), Included(1e5)]).usually(0.0, 2000.0);

const SIGNED_EXPONENT: Domain =
    Domain::number("an exponent", [Included(-1e4), Included(1e4)]).usually(-100.0, 100.0);

/// The default of a missing parameter.
const OTHER: &str = "another law";

/// The widest domain of the laws that have it.
const C10: Key = Key::estimate(
    "c10_pa",
    Domain::SIGNED_MODULUS,
    "`neo_hookean`, `reduced_polynomial`: C10, half the shear modulus; `holzapfel_gasser_ogden`: that of the matrix; \
     `mooney_rivlin`: C10.",
)
.optional("1333.0", OTHER);

pub(super) const LINEAR: LawRow = LawRow {
    title: "linear",
    parameters: &[
        Key::estimate(
            "youngs_modulus_pa",
            Domain::MODULUS,
            "`linear`: Young's modulus. All moduli are instantaneous: `prony` says how they fall.",
        )
        .optional("8000.0", OTHER)
        .in_template(),
        Key::estimate(
            "poissons_ratio",
            POISSONS_RATIO,
            "`linear`: Poisson's ratio.",
        )
        .optional("0.45", OTHER)
        .in_template(),
    ],
    term: 2,
    positive: None,
    abaqus: Some(|p| AbaqusLaw {
        keyword: "*ELASTIC".to_owned(),
        numbers: p.to_vec(),
        fibres: Vec::new(),
        compressible: true,
    }),
    febio: Some(|p| FebioLaw {
        kind: "isotropic elastic",
        numbers: named(["E", "v"], p),
        shear_modulus: None,
        has_axes: false,
    }),
};

/// Ψ = C₁₀ (I₁ − 3); C₁₀ is half the shear modulus.
const NEO_HOOKEAN: LawRow = LawRow {
    title: "neo-Hookean",
    parameters: &[C10.within(Domain::MODULUS)],
    term: 1,
    positive: None,
    abaqus: Some(|p| hyperelastic("NEO HOOKE".to_owned(), p, 1)),
    febio: Some(|p| mooney_rivlin(p[0], 0.0)),
};

/// Ψ = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3). A fit may put one of the two below zero; only the sum must stay above it.
pub(super) const MOONEY_RIVLIN: LawRow = LawRow {
    title: "Mooney-Rivlin",
    parameters: &[
        C10,
        Key::estimate(
            "c01_pa",
            Domain::SIGNED_MODULUS,
            "`mooney_rivlin`: C01; c10_pa + c01_pa is half the shear modulus.",
        )
        .optional("300.0", OTHER),
    ],
    term: 2,
    positive: Some(Positive {
        what: "c10_pa + c01_pa",
        of: |p| p.iter().sum(),
        expected: "numbers such that c10_pa + c01_pa, half the shear modulus, is above 0",
    }),
    abaqus: Some(|p| hyperelastic("MOONEY-RIVLIN".to_owned(), p, 1)),
    febio: Some(|p| mooney_rivlin(p[0], p[1])),
};

/// The law of Blatz, Chu and Wayland: Ψ = γ / (2 α (α + 1)) Σ (exp(α (λᵢ² − 1)) − 1). γ is the shear modulus; with
/// α = 0 it is neo-Hookean with C₁₀ = γ/2.
pub(super) const EXPONENTIAL: LawRow = LawRow {
    title: "exponential",
    parameters: &[
        Key::estimate(
            "gamma_pa",
            Domain::MODULUS,
            "`exponential`: gamma, a third of Young's modulus at small strain.",
        )
        .optional("2667.0", OTHER),
        Key::estimate("alpha", Domain::EXPONENT, "`exponential`: alpha.").optional("0.5", OTHER),
    ],
    term: 2,
    positive: None,
    abaqus: None,
    febio: None,
};

/// Ψ = Σ_p 2 μ_p/α_p² (λ₁^α_p + λ₂^α_p + λ₃^α_p − 3), Abaqus' scaling; FEBio's c_p is 2 μ_p.
pub(super) const OGDEN: LawRow = LawRow {
    title: "Ogden",
    parameters: &[
        Key::estimate(
            "mu_1_pa",
            Domain::SIGNED_MODULUS,
            "`ogden`: mu of the first term; all mu together are the shear modulus.",
        )
        .optional("2300.0", OTHER),
        Key::estimate(
            "alpha_1",
            SIGNED_EXPONENT,
            "`ogden`: alpha of the first term.",
        )
        .optional("4.3", OTHER),
        Key::estimate(
            "mu_2_pa",
            Domain::SIGNED_MODULUS,
            "`ogden`: mu of the second term.",
        )
        .optional("100.0", "one term"),
        Key::estimate(
            "alpha_2",
            SIGNED_EXPONENT,
            "`ogden`: alpha of the second term.",
        )
        .optional("-2.0", "one term"),
        Key::estimate(
            "mu_3_pa",
            Domain::SIGNED_MODULUS,
            "`ogden`: mu of the third term.",
        )
        .optional("10.0", "two terms"),
        Key::estimate(
            "alpha_3",
            SIGNED_EXPONENT,
            "`ogden`: alpha of the third term.",
        )
        .optional("9.0", "two terms"),
    ],
    term: 2,
    positive: Some(Positive {
        what: "the sum of mu_1_pa, mu_2_pa and mu_3_pa",
        of: |p| p.iter().step_by(2).sum(),
        expected: "numbers such that the sum of all mu, the shear modulus, is above 0",
    }),
    abaqus: Some(|p| hyperelastic(format!("OGDEN, N={}", p.len() / 2), p, p.len() / 2)),
    febio: Some(|p| FebioLaw {
        kind: "Ogden",
        numbers: (1..)
            .zip(p.as_chunks().0)
            .flat_map(|(i, &[mu, alpha])| [(format!("c{i}"), 2.0 * mu), (format!("m{i}"), alpha)])
            .collect(),
        shear_modulus: Some(p.iter().step_by(2).sum()),
        has_axes: false,
    }),
};

/// Ψ = C₁₀ (I₁ − 3) + C₂₀ (I₁ − 3)² + C₃₀ (I₁ − 3)³; C₁₀ is half the shear modulus.
pub(super) const REDUCED_POLYNOMIAL: LawRow = LawRow {
    title: "reduced polynomial",
    parameters: &[
        C10.within(Domain::MODULUS),
        Key::estimate(
            "c20_pa",
            Domain::SIGNED_MODULUS,
            "`reduced_polynomial`: C20.",
        )
        .optional("500.0", "one term"),
        Key::estimate(
            "c30_pa",
            Domain::SIGNED_MODULUS,
            "`reduced_polynomial`: C30.",
        )
        .optional("200.0", "two terms"),
    ],
    term: 1,
    positive: None,
    abaqus: Some(|p| hyperelastic(format!("REDUCED POLYNOMIAL, N={}", p.len()), p, p.len())),
    febio: Some(|p| FebioLaw {
        kind: "Yeoh",
        numbers: named(["c1", "c2", "c3"], p),
        shear_modulus: p.first().map(|c10| 2.0 * c10),
        has_axes: false,
    }),
};

/// Ψ = C₁₀ (I₁ − 3) + k₁/(2 k₂) Σ (exp(k₂ ⟨E⟩²) − 1), E = κ (I₁ − 3) + (1 − 3 κ)(I₄ − 1), over two families of fibres at
/// ±γ to a reference axis. Abaqus takes the numbers as they are, and the directions from the orientation of the section
/// [Abaqus 2017, *ANISOTROPIC HYPERELASTIC and *ORIENTATION, LOCAL DIRECTIONS]; FEBio's c is 2 C₁₀, its angle is in degrees to
/// the first of its material axes, in the plane of the first two [FEBio, Holzapfel-Gasser-Ogden]. In both ⟨E⟩ is as here.
pub(super) const HOLZAPFEL_GASSER_OGDEN: LawRow = LawRow {
    title: "Holzapfel-Gasser-Ogden",
    parameters: &[
        C10.within(Domain::MODULUS),
        Key::estimate(
            "k1_pa",
            FIBRE_STIFFNESS,
            "`holzapfel_gasser_ogden`: k1, the stiffness of each of its two families of fibres.",
        )
        .optional("996600.0", OTHER),
        Key::estimate(
            "k2",
            FIBRE_EXPONENT,
            "`holzapfel_gasser_ogden`: k2, how fast the fibres stiffen.",
        )
        .optional("524.6", OTHER),
        Key::estimate(
            "dispersion",
            Domain::DISPERSION,
            "`holzapfel_gasser_ogden`: kappa, the dispersion of the fibres of a family around its direction.",
        )
        .optional("0.226", OTHER),
        Key::estimate(
            "fibre_angle_deg",
            Domain::FIBRE_ANGLE,
            "`holzapfel_gasser_ogden`: the angle gamma of the two families to the reference axis, on either side of it; at 0 \
             and at 90 they are one, of twice k1. The problem says where the axis is.",
        )
        .optional("49.98", OTHER),
    ],
    term: 5,
    positive: None,
    abaqus: Some(|p| {
        let (sin, cos) = p[4].to_radians().sin_cos();
        AbaqusLaw {
            keyword: "*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2".to_owned(),
            // 2/κ is zero for an incompressible law.
            numbers: vec![p[0], 0.0, p[1], p[2], p[3]],
            fibres: vec![[cos, sin, 0.0], [cos, -sin, 0.0]],
            compressible: false,
        }
    }),
    febio: Some(|p| FebioLaw {
        kind: "Holzapfel-Gasser-Ogden",
        numbers: named(
            ["c", "k1", "k2", "kappa", "gamma"],
            &[2.0 * p[0], p[1], p[2], p[3], p[4]],
        ),
        shear_modulus: Some(2.0 * p[0]),
        has_axes: true,
    }),
};

impl LawName {
    /// Whether it has fibres, whose direction a model must know.
    pub fn has_fibres(self) -> bool {
        matches!(self, Self::HolzapfelGasserOgden)
    }

    /// Its properties.
    pub fn row(self) -> &'static LawRow {
        match self {
            Self::Linear => &LINEAR,
            Self::NeoHookean => &NEO_HOOKEAN,
            Self::MooneyRivlin => &MOONEY_RIVLIN,
            Self::Exponential => &EXPONENTIAL,
            Self::Ogden => &OGDEN,
            Self::ReducedPolynomial => &REDUCED_POLYNOMIAL,
            Self::HolzapfelGasserOgden => &HOLZAPFEL_GASSER_OGDEN,
        }
    }
}

impl LawRow {
    /// The keys of its parameters, in the order of the documentation.
    pub fn keys(&self) -> impl Iterator<Item = &'static str> {
        self.parameters.iter().map(|key| key.name)
    }
}

/// `coefficients` of a law, then Abaqus' 2/κ of each of its `terms`: zero for what keeps its volume, which takes hybrid
/// elements.
fn hyperelastic(kind: String, coefficients: &[f64], terms: usize) -> AbaqusLaw {
    AbaqusLaw {
        keyword: format!("*HYPERELASTIC, {kind}"),
        numbers: [coefficients, &vec![0.0; terms]].concat(),
        fibres: Vec::new(),
        compressible: false,
    }
}

fn mooney_rivlin(c1: f64, c2: f64) -> FebioLaw {
    FebioLaw {
        kind: "Mooney-Rivlin",
        numbers: named(["c1", "c2"], &[c1, c2]),
        shear_modulus: Some(2.0 * (c1 + c2)),
        has_axes: false,
    }
}

fn named<const N: usize>(names: [&str; N], values: &[f64]) -> Vec<(String, f64)> {
    let names = names.into_iter().map(str::to_owned);
    names.zip(values.iter().copied()).collect()
}
