//! Tissue that slides between two faces: the pull along them is at most what friction bears.
//!
//! Tissue can slide sideways and out of the open end, never toward the joint. With q the pull along the faces,
//! S the stiffness of the patch there and a the part of a new force that does not relax at once, a slide δ
//! along what is left of the pull is found from
//!
//! ```text
//! |q′| = 2 μ N,   q′ = q − a S δ,   δ = γ q′   ⟹   q′ = (1 + γ a S)⁻¹ q
//! ```
//!
//! |q′| falls with γ ≥ 0. The tissue goes where it is pulled, so that a slide only takes energy. Where another tool
//! touches the organ, more or less of the pull goes than S says; the next slide is as much shorter or longer.

use nalgebra::{Matrix2, Matrix3, Vector2};
use palpate_geometry::Vec3;

use crate::simulation::Simulation;
use crate::state::ToolState;
use crate::tool::Tool;

/// A pull beyond what friction bears that is none [-].
const BEYOND: f64 = 1e-9;

/// What the slides of a step have done so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slides {
    /// The direction of the pull before the last one [-] and how far it was beyond what friction bears [N]; none before
    /// the first.
    before: Option<(Vector2<f64>, f64)>,
    /// The length of a slide over that in an organ which only this tool touches [-].
    longer: f64,
}

/// A slide is longer or shorter by that at most [-]: the coupling of two tools is bounded (`global`).
const LONGEST: f64 = 200.0;

impl Slides {
    pub(super) const NONE: Self = Self {
        before: None,
        longer: 1.0,
    };

    /// How long the next slide is [-], where the `pull` [N] is beyond the `limit` [N] that friction bears: the secant
    /// through the last two.
    fn next(&mut self, pull: &Vector2<f64>, limit: f64) -> f64 {
        let size = pull.norm();
        if let Some((direction, beyond)) = self.before.replace((pull / size, size - limit)) {
            let gone = 1.0 - (pull.dot(&direction) - limit) / beyond;
            self.longer = match gone > 0.0 {
                true => (self.longer / gone).clamp(1.0 / LONGEST, LONGEST),
                false => 1.0,
            };
        }
        self.longer
    }
}

/// Slides the tissue of a tool where it is pulled too hard; whether it has.
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
    let felt = |elastic: Vec3| {
        let mut history = state.history;
        history.advance(series, elastic, elapsed)
    };
    let Some(hold) = &state.grip.hold else {
        return false;
    };
    let turned = hold.turned().to_rotation_matrix();
    let force = felt(state.elastic);
    let at_once = (felt(state.elastic + Vec3::x()) - force).x;
    let pull = turned.inverse() * force;
    let stiffness = turned.matrix().tr_mul(&state.stiffness) * turned.matrix() * at_once;
    let Some((by, pull)) = slide(&pull, &stiffness, limit) else {
        return false;
    };
    let longer = state.grip.slides.next(&pull, limit);
    if let Some(hold) = &mut state.grip.hold {
        hold.slide(&(by * longer));
    }
    true
}

/// How far tissue slides [m] that is pulled by `pull` [N] and answers with `stiffness` [N/m], all in the tool's frame, and
/// the part of the pull [N] that it slides by; none where friction bears the `limit` [N] of it.
fn slide(pull: &Vec3, stiffness: &Matrix3<f64>, limit: f64) -> Option<(Vec3, Vector2<f64>)> {
    let aside = Vector2::new(pull.y, 0.0);
    let out = Vector2::new(pull.y, pull.z);
    let outward = pull.z < 0.0;
    let pull = if outward { out } else { aside };
    let size = pull.norm();
    // Not finite is no pull.
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
    // With γ S of a million of a million nothing of the pull is left.
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

    /// Judge: springs of 2 and of 220 N/m that are taken for 100: the second slide, of the length that the first has
    /// shown, leaves what friction bears.
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
