use crate::Vec3;

/// A plane that fixes the part of an organ on the side that its normal points away from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnchorPlane {
    /// A point on the plane [m].
    pub point: Vec3,
    /// Unit normal [-]; points to the free side.
    pub normal: Vec3,
}

impl AnchorPlane {
    /// Whether a triangle with this `centroid` [m] is fixed.
    pub fn contains(&self, centroid: &Vec3) -> bool {
        (centroid - self.point).dot(&self.normal) < 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_behind_the_normal_is_held() {
        let plane = AnchorPlane {
            point: Vec3::new(0.0, 0.0, 0.001),
            normal: Vec3::z(),
        };
        assert!(plane.contains(&Vec3::zeros()));
        assert!(!plane.contains(&Vec3::new(0.0, 0.0, 0.002)));
    }
}
