use nalgebra::Matrix3;

use crate::Vec3;

/// Pull towards the middle of an edge, as part of the quadric's largest curvature [-]: decides where
/// the planes leave a choice, and moves a vertex by this part of an edge at most.
const TETHER: f64 = 1e-3;

/// Sum of squared distances to planes, each with a weight [m²]: a quadratic form of the position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quadric {
    matrix: Matrix3<f64>,
    vector: Vec3,
    constant: f64,
}

impl Quadric {
    pub(crate) fn zero() -> Self {
        Self {
            matrix: Matrix3::zeros(),
            vector: Vec3::zeros(),
            constant: 0.0,
        }
    }

    /// Squared distance to the plane through `point` [m] with unit `normal`, times `weight` [m²].
    pub(crate) fn of_plane(point: &Vec3, normal: &Vec3, weight: f64) -> Self {
        let offset = normal.dot(point);
        Self {
            matrix: weight * normal * normal.transpose(),
            vector: -weight * offset * normal,
            constant: weight * offset * offset,
        }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            matrix: self.matrix + other.matrix,
            vector: self.vector + other.vector,
            constant: self.constant + other.constant,
        }
    }

    /// The same with all weights times `factor` [-].
    pub(crate) fn times(&self, factor: f64) -> Self {
        Self {
            matrix: factor * self.matrix,
            vector: factor * self.vector,
            constant: factor * self.constant,
        }
    }

    /// Value at a position [m⁴].
    pub(crate) fn at(&self, x: &Vec3) -> f64 {
        let value = x.dot(&(self.matrix * x + 2.0 * self.vector)) + self.constant;
        // Rounding may leave a little less than nothing.
        value.max(0.0)
    }

    /// The minimum of the value, shifted slightly towards `middle` [m].
    pub(crate) fn least_near(&self, middle: &Vec3) -> Vec3 {
        let tether = TETHER * self.matrix.trace();
        let tethered = self.matrix + Matrix3::from_diagonal_element(tether);
        let slope = self.matrix * middle + self.vector;
        match tethered.cholesky() {
            Some(factor) => middle - factor.solve(&slope),
            None => *middle,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the corner of three planes, wherever the search starts.
    #[test]
    fn three_planes_meet_in_their_corner() {
        let corner = Vec3::new(0.3, -0.2, 0.1);
        let planes = [Vec3::x(), Vec3::y(), Vec3::z()];
        let quadric = planes.iter().fold(Quadric::zero(), |sum, normal| {
            sum.plus(&Quadric::of_plane(&corner, normal, 2.0))
        });
        let start = corner + Vec3::new(0.1, 0.1, -0.1);
        let found = quadric.least_near(&start);
        // The tether shortens the move by three thousandths, on either of three equal planes.
        assert!((found - corner).norm() < 4e-3 * (start - corner).norm());
        assert!((quadric.at(&start) - 2.0 * 0.03).abs() < 1e-12);
        assert!(quadric.at(&corner) < 1e-15);
    }

    #[test]
    fn where_planes_leave_a_choice_the_middle_is_kept() {
        let quadric = Quadric::of_plane(&Vec3::zeros(), &Vec3::z(), 1.0);
        let found = quadric.least_near(&Vec3::new(0.5, 0.25, 0.1));
        assert_eq!((found.x, found.y), (0.5, 0.25));
        assert!(found.z.abs() < 2e-4);
    }
}
