//! How large a force may be.

use crate::Vec3;

/// `force` [N], shortened to `most` [N] where it is longer. Its direction stays, which limits on each axis
/// would turn.
pub fn saturate(force: &Vec3, most: f64) -> Vec3 {
    // Squares of a force beyond 1e154 N would be infinite.
    let largest = force.amax();
    let scaled = if largest > 1e100 {
        force / largest
    } else {
        *force
    };
    let size = scaled.norm();
    if size <= most && scaled == *force {
        return *force;
    }
    let shortened = scaled * (most / size);
    // Rounding may leave it a last digit too long.
    shortened * (most / shortened.norm()).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_force_keeps_its_direction() {
        let force = Vec3::new(30.0, -40.0, 0.0);
        // A 3-4-5 triangle.
        assert!((saturate(&force, 5.0) - Vec3::new(3.0, -4.0, 0.0)).norm() < 1e-15);
        assert_eq!(saturate(&force, 50.0), force);
        assert_eq!(saturate(&Vec3::zeros(), 1.0), Vec3::zeros());
        assert_eq!(saturate(&(Vec3::x() * f64::MAX), 1.0), Vec3::x());
    }
}
