//! A bar stretched without friction: the nominal stress of any law, at one point.
//!
//! F = diag(λ, l₂, l₃). The sides are free, P₂₂ = P₃₃ = 0. Of an isotropic law l₂ = l₃ = l: where the volume cannot change,
//! l = λ^(−½), and P₂₂ is made zero by the pressure, P₁₁ = (∂W/∂F)₁₁ − (∂W/∂F)₂₂ cof₁₁/cof₂₂; else l is solved for, by
//! Newton's method between bounds. With fibres, l₂ = l eˢ and l₃ = l e⁻ˢ: the sum of P₂₂ l₂ and P₃₃ l₃ is made zero as above,
//! and their difference, which no pressure changes, by the s that bisection finds.
//!
//! *How we know*: `uniaxial::…` (closed forms), `homogeneous::a_bar_is_stretched` (distorted elements),
//! `fibres::a_strip_is_pulled`.
//!
//! *Limits*: the homogeneous state, of fibres that lie in a plane of the axes, symmetric about one of them, so that nothing
//! shears (see [`super::homogeneous`]); that a bar may neck or buckle is not asked.

use nalgebra::Matrix3;

use crate::material::law::Law;
use crate::{Error, Strain};

/// A bar that is stretched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretched {
    /// Nominal stress P₁₁ [Pa].
    pub nominal_stress: f64,
    /// Stretches l₂ and l₃ of its sides [-].
    pub lateral: [f64; 2],
}

/// Nominal stress P₁₁ [Pa] at the stretch λ [-], deformed over undeformed length.
///
/// # Errors
/// Where the law has no stress: at λ ≤ 0, or where an exponential overflows.
pub fn nominal_stress(law: &dyn Law, stretch: f64) -> Result<f64, Error> {
    Ok(stretched(law, stretch)?.nominal_stress)
}

/// The bar at the stretch λ [-], deformed over undeformed length.
///
/// # Errors
/// As [`nominal_stress`].
pub fn stretched(law: &dyn Law, stretch: f64) -> Result<Stretched, Error> {
    let refused = Error::StretchOutOfRange { stretch };
    if !(stretch > 0.0 && stretch.is_finite()) {
        return Err(refused);
    }
    let split = match law.has_fibres() {
        true => split(law, stretch).ok_or(refused.clone())?,
        false => 0.0,
    };
    let sides = sides(law, stretch, split).ok_or(refused.clone())?;
    let f = gradient(stretch, sides);
    let nominal_stress = if law.volume().bulk_modulus.is_finite() {
        law.stress(&f)[(0, 0)]
    } else {
        let (stress, along) = (
            law.distortion_stress(&f),
            law.volume().dilation_gradient(&f),
        );
        stress[(0, 0)] - stress[(1, 1)] / along[(1, 1)] * along[(0, 0)]
    };
    match nominal_stress.is_finite() {
        true => Ok(Stretched {
            nominal_stress,
            lateral: sides,
        }),
        false => Err(refused),
    }
}

/// l₂ and l₃ of this `split` s.
fn sides(law: &dyn Law, stretch: f64, split: f64) -> Option<[f64; 2]> {
    let mean = if law.volume().bulk_modulus.is_finite() {
        lateral(law, stretch, split)?
    } else {
        // A small strain without a change of volume would have tr F = 3.
        match law.volume().strain {
            Strain::Finite => stretch.sqrt().recip(),
            Strain::Small => 1.0 - 0.5 * (stretch - 1.0),
        }
    };
    Some([mean * split.exp(), mean * (-split).exp()])
}

/// The s at which both sides are free.
fn split(law: &dyn Law, stretch: f64) -> Option<f64> {
    let difference = |split: f64| {
        let sides = sides(law, stretch, split)?;
        let stress = law.distortion_stress(&gradient(stretch, sides));
        let found = stress[(1, 1)] * sides[0] - stress[(2, 2)] * sides[1];
        found.is_finite().then_some(found)
    };
    let start = difference(0.0)?;
    if start == 0.0 {
        return Some(0.0);
    }
    // The sides that are pulled more give way.
    let towards = -start.signum();
    let (mut near, mut step) = (0.0, 0.1);
    let mut far = loop {
        match difference(near + towards * step) {
            Some(found) if found * start > 0.0 => {
                near += towards * step;
                step *= 1.5;
            }
            Some(_) => break near + towards * step,
            None => step *= 0.5,
        }
        if !(1e-12..100.0).contains(&step) {
            return None;
        }
    };
    while (far - near).abs() > 2.0 * f64::EPSILON * (1.0 + far.abs()) {
        let middle = 0.5 * (near + far);
        if middle == near || middle == far {
            break;
        }
        if difference(middle)? * start > 0.0 {
            near = middle;
        } else {
            far = middle;
        }
    }
    Some(0.5 * (near + far))
}

fn gradient(along: f64, across: [f64; 2]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&[along, across[0], across[1]].into())
}

/// The mean lateral stretch l at which the sides are free of stress together. It pulls the sides inward if they are
/// too far out, so the sign of the stress shows on which side of a guess it lies.
fn lateral(law: &dyn Law, stretch: f64, split: f64) -> Option<f64> {
    let parts = [split.exp(), (-split).exp()];
    let at = |l: f64| gradient(stretch, parts.map(|part| part * l));
    let side = |l: f64| {
        let stress = law.stress(&at(l));
        0.5 * (parts[0] * stress[(1, 1)] + parts[1] * stress[(2, 2)])
    };
    if law.volume().strain == Strain::Small {
        // Linear: one step is exact.
        let [low, high] = [0.0, 1.0].map(side);
        return Some(low / (low - high));
    }
    let (mut low, mut high) = (1.0, 1.0);
    while side(low) > 0.0 {
        low *= 0.7;
    }
    while side(high) < 0.0 {
        high *= 1.4;
    }
    let mut l = stretch.sqrt().recip().clamp(low, high);
    for _ in 0..200 {
        let stress = side(l);
        if stress > 0.0 {
            high = l;
        } else {
            low = l;
        }
        let tangent = law.tangent(&at(l));
        let slope = |i: usize, j: usize| parts[i] * tangent[(4 + 4 * i, 4 + 4 * j)] * parts[j];
        let slope = 0.5 * (slope(0, 0) + slope(0, 1) + slope(1, 0) + slope(1, 1));
        let next = l - stress / slope;
        // Outside the bounds, or no number: halve.
        let next = if next > low && next < high {
            next
        } else {
            0.5 * (low + high)
        };
        let step = (next - l).abs();
        l = next;
        if step <= 4.0 * f64::EPSILON * l {
            return Some(l);
        }
    }
    (high - low <= 1e-12 * l).then_some(l)
}
