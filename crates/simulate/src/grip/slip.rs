//! Slip of tissue between two faces: friction limits the pull along them.
//!
//! Tissue can slide sideways and out of the open end, never toward the joint. With q the pull along the faces,
//! S the stiffness of the patch there and a the part of a new force that does not relax at once, a slide δ
//! along what is left of the pull is found from
//!
//! ```text
//! |q′| = 2 μ N,   q′ = q − a S δ,   δ = γ q′   ⟹   q′ = (1 + γ a S)⁻¹ q
//! ```
//!
//! |q′| falls with γ ≥ 0. The tissue moves in the direction of the pull, so that a slide only dissipates energy. Where
//! another tool touches the organ, the pull falls more or less than by S; the next slide is shorter or longer
//! accordingly.

use nalgebra::{Matrix2, Matrix3, Vector2};
use palpate_geometry::Vec3;

use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// Excess pull over friction that counts as none [-].
const BEYOND: f64 = 1e-9;

/// The slides of a step so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slides {
    /// The direction of the last but one pull [-] and its excess over the friction limit [N]; none before the first.
    before: Option<(Vector2<f64>, f64)>,
    /// The length of a slide relative to that in an organ that only this tool touches [-].
    longer: f64,
}

/// Largest factor by which a slide is longer or shorter [-]: the coupling of two tools is bounded (`global`).
const LONGEST: f64 = 200.0;

impl Slides {
    pub(super) const NONE: Self = Self {
        before: None,
        longer: 1.0,
    };

    /// Length of the next slide [-], where the `pull` [N] exceeds the friction `limit` [N]: the secant through the last
    /// two.
    fn next(&mut self, pull: &Vector2<f64>, limit: f64) -> f64 {
        let size = pull.norm();
        if let Some((direction, beyond)) = self.before.replace((pull / size, size - limit)) {
            let removed = 1.0 - (pull.dot(&direction) - limit) / beyond;
            self.longer = match removed > 0.0 {
                true => (self.longer / removed).clamp(1.0 / LONGEST, LONGEST),
                false => 1.0,
            };
        }
        self.longer
    }
}

/// Slides the tissue of a tool where the pull exceeds friction; returns whether it has.
pub(super) fn slip(
    simulation: &Simulation,
    tool: &Tool,
    elapsed: f64,
    state: &mut ToolState,
) -> bool {
    let Some(jaws) = &tool.jaws else {
        return false;
    };
    let limit = 2.0 * jaws.friction * state.press(simulation, tool);
    let series = &simulation.material.prony;
    let rendered = |elastic: Vec3| {
        let mut history = state.history;
        history.advance(series, elastic, elapsed)
    };
    let Some(hold) = &state.grip.grasp else {
        return false;
    };
    let turned = hold.turned().to_rotation_matrix();
    let force = rendered(state.elastic);
    let at_once = (rendered(state.elastic + Vec3::x()) - force).x;
    let pull = turned.inverse() * force;
    let stiffness = turned.matrix().tr_mul(&state.stiffness) * turned.matrix() * at_once;
    let Some((by, pull)) = slide(&pull, &stiffness, limit) else {
        return false;
    };
    let longer = state.grip.slides.next(&pull, limit);
    if let Some(hold) = &mut state.grip.grasp {
        hold.slide(&(by * longer));
    }
    true
}

/// The slide [m] of tissue under the pull `pull` [N] with `stiffness` [N/m], all in the tool's frame, and the part of
/// the pull [N] that it removes; none if friction bears it, up to `limit` [N].
fn slide(pull: &Vec3, stiffness: &Matrix3<f64>, limit: f64) -> Option<(Vec3, Vector2<f64>)> {
    let aside = Vector2::new(pull.y, 0.0);
    let out = Vector2::new(pull.y, pull.z);
    let outward = pull.z < 0.0;
    let pull = if outward { out } else { aside };
    let size = pull.norm();
    // A pull that is not finite counts as none.
    if !(size > limit * (1.0 + BEYOND) && size.is_finite()) {
        return None;
    }
    let mut along = stiffness.fixed_view::<2, 2>(1, 1).into_owned();
    if !outward {
        along[(0, 1)] = 0.0;
        along[(1, 0)] = 0.0;
    }
    let left = |gamma: f64| -> Option<Vector2<f64>> {
        (Matrix2::identity() + along * gamma).lu().solve(&pull)
    };
    // With γ S of a trillion nothing of the pull is left.
    let (mut low, mut high) = (0.0, 1.0 / along.norm());
    while left(high)?.norm() > limit && high * along.norm() < 1e12 {
        low = high;
        high *= 4.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if left(middle)?.norm() > limit {
            low = middle;
        } else {
            high = middle;
        }
    }
    let by = left(high)? * high;
    let by = Vec3::new(0.0, by.x, if outward { by.y.min(0.0) } else { 0.0 });
    let slides = by.norm() > 0.0 && by.iter().all(|component| component.is_finite());
    slides.then_some((by, pull))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: by hand; a spring of 100 N/m that bears 0.3 N of 0.5 N slides 2 mm.
    #[test]
    fn a_slide_leaves_what_friction_bears() {
        let spring = Matrix3::identity() * 100.0;
        let by = slide(&Vec3::new(9.0, 0.3, -0.4), &spring, 0.3).unwrap().0;
        assert!(
            (by - Vec3::new(0.0, 1.2e-3, -1.6e-3)).norm() < 1e-12,
            "{by}"
        );
        assert!(slide(&Vec3::new(9.0, 0.3, -0.4), &spring, 0.5).is_none());
        // Toward the joint the jaws themselves bear it.
        assert!(slide(&Vec3::new(0.0, 0.0, 0.4), &spring, 0.3).is_none());
        let aside = slide(&Vec3::new(0.0, 0.5, 0.4), &spring, 0.3).unwrap().0;
        assert!(
            (aside - Vec3::new(0.0, 2e-3, 0.0)).norm() < 1e-12,
            "{aside}"
        );
        // Without friction all of it goes.
        let all = slide(&Vec3::new(0.0, 0.0, -0.4), &spring, 0.0).unwrap().0;
        assert!((all.z + 4e-3).abs() < 1e-9, "{all}");
    }

    /// Judge: springs of 2 and of 220 N/m with an assumed stiffness of 100: the second slide, with the length from the
    /// first, leaves the friction limit.
    #[test]
    fn a_slide_learns_from_the_one_before() {
        for (stiffness, limit) in [(2.0, 0.1), (220.0, 0.0)] {
            let mut slides = Slides::NONE;
            let mut pull = Vector2::new(0.0, -0.5);
            for _ in 0..2 {
                let longer = slides.next(&pull, limit);
                let beyond = pull.normalize() * (pull.norm() - limit);
                pull -= beyond * (longer * stiffness / 100.0);
            }
            assert!((pull.norm() - limit).abs() < 1e-12, "{stiffness}: {pull}");
        }
    }

    /// Judge: the definition, in a patch that is softer one way than the other.
    #[test]
    fn what_is_left_is_the_limit() {
        let stiffness = Matrix3::new(90.0, 5.0, 9.0, 5.0, 140.0, -30.0, 9.0, -30.0, 60.0);
        let pull = Vec3::new(0.2, 0.7, -0.9);
        let (by, slid_by) = slide(&pull, &stiffness, 0.25).unwrap();
        assert_eq!(slid_by, pull.yz());
        let left = pull - stiffness * by;
        assert!((left.yz().norm() - 0.25).abs() < 1e-9);
        assert!(left.yz().dot(&by.yz()) > 0.999_999 * 0.25 * by.norm());
    }
}
