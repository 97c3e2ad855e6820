//! A soft wall at the ends of a device's workspace, so that a hand does not hit its mechanical stops.

use crate::Vec3;

/// The force [N] of walls of `width` [m] inside the box between `corners` [m], on a hand at `position`
/// [m]: per side a spring that begins `width` before the end and reaches `most` [N] there.
pub fn wall_force(corners: &[Vec3; 2], position: &Vec3, width: f64, most: f64) -> Vec3 {
    let [least, greatest] = corners;
    Vec3::from_fn(|axis, _| {
        let from_below = (least[axis] + width - position[axis]).clamp(0.0, width);
        let from_above = (position[axis] - (greatest[axis] - width)).clamp(0.0, width);
        (from_below - from_above) * (most / width)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_pushes_inward_as_far_as_it_is_pressed() {
        let corners = [Vec3::repeat(-0.1), Vec3::repeat(0.1)];
        let at = |x| wall_force(&corners, &Vec3::new(x, 0.0, 0.0), 0.01, 3.0).x;
        assert_eq!(at(0.0), 0.0);
        assert_eq!(at(0.2), -3.0);
        assert_eq!(at(-0.2), 3.0);
        // Half of the width.
        assert!((at(0.095) + 1.5).abs() < 1e-12);
    }
}
