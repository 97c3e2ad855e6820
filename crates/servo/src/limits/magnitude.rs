//! The limit of the force's magnitude.

use crate::Vec3;

/// `force` [N], saturated at the magnitude `most` [N]. Its direction stays; limits on each axis would turn it.
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
    // Rounding may leave it one last digit too large.
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
