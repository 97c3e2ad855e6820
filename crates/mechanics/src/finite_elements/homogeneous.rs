//! A piece of incompressible tissue that is deformed homogeneously, its fibres in any direction: the nominal stress, and its
//! change with the parameters of the law.
//!
//! A strip that is pulled along e₁ stretches by λ, and its sides are free: where its fibres are askew it shears by s,
//!   F = [λ, s, 0; 0, b, 0; 0, 0, 1/(λ b)],
//! in the frame in which the material line along the load keeps its direction. s and ln b are those of least energy W, which
//! Newton's method finds with line searches; then P₁₂ = 0, and both sides have the stress of the pressure. A sheet in planar
//! tension has F = diag(λ, 1, 1/λ), a piece in simple shear F = 1 + γ e₁ ⊗ e₂. The stress is S = dW/dc of the amount c, λ or
//! γ, so that the pressure has no part in it. With y the free strains,
//!   dS/dp = ∂²W/∂c∂p − (∂²W/∂c∂y)(∂²W/∂y²)⁻¹ ∂²W/∂y∂p.
//!
//! *How we know*: `homogeneous_piece::…` (closed forms in principal stretches, invariants with a simplex search of their own,
//! central differences).
//!
//! *Limits*: the homogeneous state; the clamps of a short strip that is askew keep it from shearing. The third axis is one of
//! symmetry: fibres lie in the plane of the first two.

use nalgebra::{Matrix2, Matrix3, SVector, Vector2};

use crate::material::law::Law;
use crate::{Error, Vec3};

/// How a piece is deformed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Homogeneous {
    /// Stretched along the first axis, its sides free.
    Uniaxial,
    /// Stretched along the first axis, as wide as it is along the second.
    PlanarTension,
    /// Its planes normal to the second axis move along the first.
    SimpleShear,
}

/// A piece that is deformed.
#[derive(Debug, Clone, PartialEq)]
pub struct Deformed {
    /// P₁₁ of a stretch, P₁₂ of a shear [Pa].
    pub nominal_stress: f64,
    /// Its change with each parameter of the law, in their order [Pa over the unit of the parameter].
    pub by_parameter: Vec<f64>,
    /// s and ln b of a strip, zero else [-]: a start for the next amount.
    pub free: [f64; 2],
}

/// Steps of Newton's method, and halvings of each.
const STEPS: usize = 60;
const HALVINGS: usize = 40;
/// The last step over strains [-].
const ARRIVED: f64 = 1e-12;
/// Part of an energy that rounding leaves open [-].
const ROUNDING: f64 = 1e-14;

/// The piece of this `law` at the `amount` [-], a stretch or the shear γ. A strip is sought from the strains `free` of a
/// stretch near by; none: from those of an isotropic one.
///
/// # Errors
/// Where the law has no stress: at a stretch of zero or less, or where an exponential overflows.
pub fn deformed(
    law: &dyn Law,
    how: Homogeneous,
    amount: f64,
    free: Option<[f64; 2]>,
) -> Result<Deformed, Error> {
    let refused = Error::StretchOutOfRange { stretch: amount };
    let is_sound = amount.is_finite() && (amount > 0.0 || how == Homogeneous::SimpleShear);
    let found = is_sound.then(|| find(law, how, amount, free)).flatten();
    let is_number = |found: &Deformed| {
        let mut all = found.by_parameter.iter().chain([&found.nominal_stress]);
        all.all(|value| value.is_finite())
    };
    found.filter(is_number).ok_or(refused)
}

fn find(law: &dyn Law, how: Homogeneous, amount: f64, free: Option<[f64; 2]>) -> Option<Deformed> {
    let isotropic = || [0.0, -0.5 * amount.ln()];
    let mut free = match how {
        Homogeneous::Uniaxial => free.unwrap_or_else(isotropic),
        Homogeneous::PlanarTension | Homogeneous::SimpleShear => [0.0; 2],
    };
    let mut state = State::of(law, how, amount, free);
    if how == Homogeneous::Uniaxial {
        let mut steps = 0;
        loop {
            let step = state.newton()?;
            if step.norm() <= ARRIVED {
                break;
            }
            (free, state) = search(law, amount, free, &state, step)?;
            steps += 1;
            if steps > STEPS {
                return None;
            }
        }
    }
    let inverse = match how {
        Homogeneous::Uniaxial => state.hessian.try_inverse()?,
        _ => Matrix2::zeros(),
    };
    let lever = inverse * state.mixed;
    let by = (0..law.parameters().len()).map(|index| {
        let change = law.sensitivities(index, &state.f).0;
        let of_free = state.directions.map(|d| change.dot(&d));
        change.dot(&state.along) - lever.dot(&Vector2::from(of_free))
    });
    Some(Deformed {
        nominal_stress: state.stress,
        by_parameter: by.collect(),
        free,
    })
}

/// The strains after so much of a step as makes the energy less, or the last of it to rounding.
fn search(
    law: &dyn Law,
    amount: f64,
    from: [f64; 2],
    state: &State,
    step: Vector2<f64>,
) -> Option<([f64; 2], State)> {
    let mut part = 1.0;
    for _ in 0..HALVINGS {
        let free = [from[0] + part * step[0], from[1] + part * step[1]];
        let next = State::of(law, Homogeneous::Uniaxial, amount, free);
        if next.energy <= state.energy + ROUNDING * state.energy.abs().max(state.size) {
            return Some((free, next));
        }
        part *= 0.5;
    }
    None
}

/// Energy and its derivatives at one deformation.
struct State {
    f: Matrix3<f64>,
    energy: f64,
    /// A stiffness [Pa].
    size: f64,
    /// ∂F/∂c and ∂F/∂y of the two free strains.
    along: Matrix3<f64>,
    directions: [Matrix3<f64>; 2],
    stress: f64,
    gradient: Vector2<f64>,
    hessian: Matrix2<f64>,
    mixed: Vector2<f64>,
}

impl State {
    fn of(law: &dyn Law, how: Homogeneous, amount: f64, free: [f64; 2]) -> Self {
        let shear = Vec3::x() * Vec3::y().transpose();
        let diagonal = |x: f64, y: f64, z: f64| Matrix3::from_diagonal(&[x, y, z].into());
        let [s, log] = free;
        let wide = log.exp();
        let (thick, f, along) = match how {
            Homogeneous::SimpleShear => (1.0, Matrix3::identity() + amount * shear, shear),
            _ => {
                let thick = 1.0 / (amount * wide);
                let f = diagonal(amount, wide, thick) + s * shear;
                (thick, f, diagonal(1.0, 0.0, -thick / amount))
            }
        };
        let directions = [shear, diagonal(0.0, wide, -thick)];
        let found = law.distortion(&f);
        let (p, tangent) = (&found.stress, &found.tangent);
        let flat = |d: &Matrix3<f64>| SVector::<f64, 9>::from_column_slice(d.as_slice());
        let second = |a: &Matrix3<f64>, b: &Matrix3<f64>| (tangent * flat(a)).dot(&flat(b));
        let [first, last] = &directions;
        let cross = second(first, last);
        // F bends as b does.
        let bent = p.dot(&diagonal(0.0, wide, thick));
        let bent_along = match how {
            Homogeneous::Uniaxial => p[(2, 2)] * thick / amount,
            _ => 0.0,
        };
        Self {
            energy: found.energy,
            size: tangent[(0, 0)].abs(),
            stress: p.dot(&along),
            gradient: Vector2::new(p.dot(first), p.dot(last)),
            hessian: Matrix2::new(
                second(first, first),
                cross,
                cross,
                second(last, last) + bent,
            ),
            mixed: Vector2::new(second(first, &along), second(last, &along) + bent_along),
            f,
            along,
            directions,
        }
    }

    /// A step downhill: Newton's, with what makes the Hessian positive.
    fn newton(&self) -> Option<Vector2<f64>> {
        let eigen = self.hessian.symmetric_eigen();
        let most = eigen.eigenvalues.amax();
        let least = 1e-8 * most;
        if !(most > 0.0 && most.is_finite()) {
            return None;
        }
        let parts = eigen.eigenvectors.tr_mul(&self.gradient);
        let scaled = parts.zip_map(&eigen.eigenvalues, |g, own| -g / own.abs().max(least));
        let step = eigen.eigenvectors * scaled;
        // Beyond this an exponential overflows.
        let longest = 0.5;
        Some(step * (longest / step.norm()).min(1.0))
    }
}
