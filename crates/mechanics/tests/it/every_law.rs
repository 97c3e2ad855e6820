//! Every implementor of [`Law`], to run a battery over: a new one joins by a line here.

use nalgebra::{Matrix3, Rotation3};
use palpate_mechanics::{
    Exponential, FibreFrame, Fibres, HolzapfelGasserOgden, Law, LinearElastic, MooneyRivlin,
    NeoHookean, Ogden, ReducedPolynomial, Strain, Tangent, Vec3,
};

use crate::contacts::{MODULUS, Random};

type Builder = Box<dyn Fn(&[f64]) -> Box<dyn Law>>;

/// A law under test.
pub(crate) struct Candidate {
    pub(crate) name: String,
    pub(crate) law: Box<dyn Law>,
    /// The same law with other values of its parameters.
    pub(crate) rebuilt: Builder,
    /// Young's modulus at rest, by hand [Pa]; without its fibres.
    pub(crate) youngs_modulus: f64,
    /// The law, if it has fibres.
    pub(crate) fibres: Option<HolzapfelGasserOgden>,
}

impl Candidate {
    fn new<L: Law + 'static>(
        parameters: &[f64],
        youngs_modulus: f64,
        build: impl Fn(&[f64]) -> L + 'static,
    ) -> Self {
        let law = build(parameters);
        Self {
            name: format!("{law:?}"),
            law: Box::new(law),
            rebuilt: Box::new(move |parameters| Box::new(build(parameters))),
            youngs_modulus,
            fibres: None,
        }
    }

    fn with_fibres(parameters: &[f64], bulk_modulus: Option<f64>) -> Self {
        let build = move |p: &[f64]| with_fibres(p, bulk_modulus);
        let youngs_modulus = match bulk_modulus {
            Some(bulk) => 9.0 * bulk * 2.0 * parameters[0] / (3.0 * bulk + 2.0 * parameters[0]),
            None => 6.0 * parameters[0],
        };
        Self {
            fibres: Some(build(parameters)),
            ..Self::new(parameters, youngs_modulus, build)
        }
    }

    /// Whether the tangent has no jump near a deformation: where no fibre is about to stretch.
    pub(crate) fn is_smooth_near(&self, f: &Matrix3<f64>) -> bool {
        let far = |law: &HolzapfelGasserOgden| law.fibre_strains(f).iter().all(|e| e.abs() > 0.05);
        self.fibres.as_ref().is_none_or(far)
    }

    /// A random deformation near which the tangent has no jump.
    pub(crate) fn deformation(&self, random: &mut Random) -> Matrix3<f64> {
        loop {
            let f = deformation(random);
            if self.is_smooth_near(&f) {
                return f;
            }
        }
    }

    pub(crate) fn is_incompressible(&self) -> bool {
        self.law.volume().bulk_modulus.is_infinite()
    }

    pub(crate) fn is_finite_strain(&self) -> bool {
        self.law.volume().strain == Strain::Finite
    }

    /// Of all that is finite: the whole, or distortion alone where the volume cannot change [Pa].
    pub(crate) fn energy(&self, f: &Matrix3<f64>) -> f64 {
        if self.is_incompressible() {
            self.law.distortion_energy(f)
        } else {
            self.law.energy(f)
        }
    }

    /// As [`Candidate::energy`].
    pub(crate) fn stress(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        if self.is_incompressible() {
            self.law.distortion_stress(f)
        } else {
            self.law.stress(f)
        }
    }

    /// As [`Candidate::energy`].
    pub(crate) fn tangent(&self, f: &Matrix3<f64>) -> Tangent {
        if self.is_incompressible() {
            self.law.distortion_tangent(f)
        } else {
            self.law.tangent(f)
        }
    }
}

/// α of the exponential law: softening, hardly more than zero, and up to the stiffest tissue.
const ALPHAS: [f64; 5] = [-0.5, 1e-9, 0.5, 5.0, 20.0];

/// C01 over C10 + C01.
const SHARES: [f64; 5] = [0.0, 0.3, 1.0, 1.5, -0.5];

pub(crate) fn every_law() -> Vec<Candidate> {
    let mut laws = Vec::new();
    for nu in [-0.3, 0.0, 0.3, 0.45, 0.499] {
        laws.push(Candidate::new(&[MODULUS, nu], MODULUS, |p| {
            LinearElastic::new(p[0], p[1]).unwrap()
        }));
    }
    let c10 = MODULUS / 6.0;
    // For a ratio κ/μ, E = 9 κ μ / (3 κ + μ).
    let modulus = |shear: f64, ratio: f64| 9.0 * ratio / (3.0 * ratio + 1.0) * shear;
    laws.push(Candidate::new(&[c10], 6.0 * c10, |p| {
        NeoHookean::incompressible(p[0]).unwrap()
    }));
    for ratio in [1.0, 10.0, 1000.0] {
        let bulk = ratio * 2.0 * c10;
        let youngs = modulus(2.0 * c10, ratio);
        laws.push(Candidate::new(&[c10], youngs, move |p| {
            NeoHookean::compressible(p[0], bulk).unwrap()
        }));
    }
    for share in SHARES {
        let [c10, c01] = [c10 * (1.0 - share), c10 * share];
        let shear = 2.0 * (c10 + c01);
        let (parameters, bulk) = ([c10, c01], 10.0 * shear);
        laws.push(Candidate::new(&parameters, 6.0 * (c10 + c01), |p| {
            MooneyRivlin::incompressible(p[0], p[1]).unwrap()
        }));
        laws.push(Candidate::new(
            &parameters,
            modulus(shear, 10.0),
            move |p| MooneyRivlin::compressible(p[0], p[1], bulk).unwrap(),
        ));
    }
    let gamma = MODULUS / 3.0;
    for alpha in ALPHAS {
        let (parameters, bulk) = ([gamma, alpha], 10.0 * gamma);
        laws.push(Candidate::new(&parameters, 3.0 * gamma, |p| {
            Exponential::incompressible(p[0], p[1]).unwrap()
        }));
        laws.push(Candidate::new(
            &parameters,
            modulus(gamma, 10.0),
            move |p| Exponential::compressible(p[0], p[1], bulk).unwrap(),
        ));
    }
    // Terms with shares of μ: stiff, soft, of both signs, and nearly or wholly Hencky's.
    for terms in OGDEN {
        let shear = MODULUS / 3.0;
        let parameters = terms.map(|[share, alpha]| [share * shear, alpha]).concat();
        let order = if parameters[2] == 0.0 { 2 } else { 6 };
        let (parameters, bulk) = (&parameters[..order], 10.0 * shear);
        laws.push(Candidate::new(parameters, 3.0 * shear, |p| {
            Ogden::incompressible(p.as_chunks().0).unwrap()
        }));
        laws.push(Candidate::new(parameters, modulus(shear, 10.0), move |p| {
            Ogden::compressible(p.as_chunks().0, bulk).unwrap()
        }));
    }
    // W′ stays positive: with two terms by their signs, with three by its discriminant.
    for shares in [&[1.0][..], &[1.0, 0.3], &[1.0, -0.3, 0.5]] {
        let parameters: Vec<f64> = shares.iter().map(|share| share * c10).collect();
        let (parameters, bulk) = (&parameters, 20.0 * c10);
        laws.push(Candidate::new(parameters, 6.0 * c10, |p| {
            ReducedPolynomial::incompressible(p).unwrap()
        }));
        laws.push(Candidate::new(
            parameters,
            modulus(2.0 * c10, 10.0),
            move |p| ReducedPolynomial::compressible(p, bulk).unwrap(),
        ));
    }
    for [k1, k2, dispersion, angle] in FIBRES {
        let parameters = &[c10, k1 * MODULUS, k2, dispersion, angle];
        laws.push(Candidate::with_fibres(parameters, None));
        laws.push(Candidate::with_fibres(parameters, Some(20.0 * c10)));
    }
    laws
}

/// k1 in moduli, k2, dispersion and angle of laws with fibres: of one direction and two, without stiffening, without
/// direction, and without fibres.
const FIBRES: [[f64; 4]; 6] = [
    [0.5, 1.0, 0.0, 0.0],
    [2.0, 5.0, 0.1, 40.0],
    [1.0, 0.0, 0.226, 49.98],
    [0.5, 2.0, 1.0 / 3.0, 30.0],
    [0.3, 1.0, 0.05, 90.0],
    [0.0, 1.0, 0.1, 60.0],
];

/// The law of C10, k1, k2, dispersion and angle, in a frame along no axis.
pub(crate) fn with_fibres(p: &[f64], bulk_modulus: Option<f64>) -> HolzapfelGasserOgden {
    let fibres = Fibres {
        k1: p[1],
        k2: p[2],
        dispersion: p[3],
        angle_deg: p[4],
    };
    let law = match bulk_modulus {
        Some(bulk) => HolzapfelGasserOgden::compressible(p[0], fibres, bulk),
        None => HolzapfelGasserOgden::incompressible(p[0], fibres),
    };
    let frame = FibreFrame::new(&Vec3::new(1.0, 2.0, -1.0), &Vec3::new(0.3, -1.0, 2.0));
    law.unwrap().turned_to(frame.unwrap())
}

/// Shares of μ and exponents α of Ogden's law.
pub(crate) const OGDEN: [[[f64; 2]; 3]; 6] = [
    [[1.0, 2.0], [0.0; 2], [0.0; 2]],
    [[1.0, 0.0], [0.0; 2], [0.0; 2]],
    [[1.0, 1e-9], [0.0; 2], [0.0; 2]],
    [[1.0, -25.0], [0.0; 2], [0.0; 2]],
    [[1.0, 25.0], [0.0; 2], [0.0; 2]],
    [[0.9, 1.3], [0.2, 5.0], [-0.1, -2.0]],
];

/// A deformation of up to a fifth that does not turn inside out.
pub(crate) fn deformation(random: &mut Random) -> Matrix3<f64> {
    Matrix3::identity() + 0.2 * Matrix3::from_fn(|_, _| random.sign())
}

pub(crate) fn rotation(random: &mut Random) -> Matrix3<f64> {
    *Rotation3::new(3.0 * random.vector()).matrix()
}
