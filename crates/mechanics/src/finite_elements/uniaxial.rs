//! A bar stretched without friction: the nominal stress of any law, at one point.
//!
//! F = diag(λ, l, l). The sides are free, P₂₂ = 0: of a volume that cannot change l = λ^(−½) and
//! P₂₂ is made zero by the pressure, P₁₁ = (∂W/∂F)₁₁ − (∂W/∂F)₂₂ cof₁₁/cof₂₂; else l is solved for, by
//! Newton's method between bounds.
//!
//! *How we know*: `uniaxial::…` (closed forms), `homogeneous::a_bar_is_stretched` (distorted elements).
//!
//! *Limits*: the homogeneous state; that a bar may neck or buckle is not asked.

use nalgebra::Matrix3;

use crate::material::law::Law;
use crate::{Error, Strain};

/// Nominal stress P₁₁ [Pa] at the stretch λ [-], deformed over undeformed length.
///
/// # Errors
/// Where the law has no stress: at λ ≤ 0, or where an exponential overflows.
pub fn nominal_stress(law: &dyn Law, stretch: f64) -> Result<f64, Error> {
    let refused = Error::StretchOutOfRange { stretch };
    if !(stretch > 0.0 && stretch.is_finite()) {
        return Err(refused);
    }
    let found = if law.volume().bulk_modulus.is_finite() {
        lateral(law, stretch).map(|l| law.stress(&gradient(stretch, l))[(0, 0)])
    } else {
        // A small strain without a change of volume would have tr F = 3.
        let l = match law.volume().strain {
            Strain::Finite => stretch.sqrt().recip(),
            Strain::Small => 1.0 - 0.5 * (stretch - 1.0),
        };
        let f = gradient(stretch, l);
        let (stress, along) = (
            law.distortion_stress(&f),
            law.volume().dilation_gradient(&f),
        );
        Some(stress[(0, 0)] - stress[(1, 1)] / along[(1, 1)] * along[(0, 0)])
    };
    found.filter(|stress| stress.is_finite()).ok_or(refused)
}

fn gradient(along: f64, across: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&[along, across, across].into())
}

/// The lateral stretch at which the sides are free of stress. It pulls the sides inward if they are
/// too far out, so the sign of the stress tells on which side of a guess it lies.
fn lateral(law: &dyn Law, stretch: f64) -> Option<f64> {
    let side = |l: f64| law.stress(&gradient(stretch, l))[(1, 1)];
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
        let tangent = law.tangent(&gradient(stretch, l));
        let next = l - stress / (tangent[(4, 4)] + tangent[(4, 8)]);
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
