use nalgebra::Matrix3;

use crate::Vec3;

/// A force linearized at the position for which it was computed: f(x) = f₀ + K (x − x₀). The model sends it to the
/// servo loop as one value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineForce {
    /// The time for which it was computed, on the loop's clock [s].
    pub time: f64,
    /// Whether there is contact; without contact the force is zero everywhere.
    pub contact: bool,
    /// x₀, where the force was computed [m].
    pub position: Vec3,
    /// f₀, the force there [N].
    pub force: Vec3,
    /// K = ∂f/∂x [N/m]; negative definite, since tissue pushes back.
    pub gradient: Matrix3<f64>,
    /// Unit normal along which the force pushes and never pulls [-]; zero if it may do both.
    pub normal: Vec3,
    /// Distance from x₀ beyond which the force stays constant [m].
    pub trust_radius: f64,
}

/// No model has been compared with tissue over longer ways from one answer to the next [m].
const TRUST_RADIUS: f64 = 0.005;

impl AffineForce {
    /// No contact, at `time` [s].
    pub fn none(time: f64) -> Self {
        Self {
            time,
            contact: false,
            position: Vec3::zeros(),
            force: Vec3::zeros(),
            gradient: Matrix3::zeros(),
            normal: Vec3::zeros(),
            trust_radius: TRUST_RADIUS,
        }
    }

    /// Contact at `position` [m] with `force` [N] and its `gradient` [N/m], computed for `time` [s]; it may push and
    /// pull, and its trust radius is 5 mm.
    pub fn new(time: f64, position: Vec3, force: Vec3, gradient: Matrix3<f64>) -> Self {
        Self {
            contact: true,
            position,
            force,
            gradient,
            ..Self::none(time)
        }
    }

    /// f(x) [N] at `position` [m]: within the trust radius, and never pulling.
    pub fn at(&self, position: &Vec3) -> Vec3 {
        if !self.contact {
            return Vec3::zeros();
        }
        let away = position - self.position;
        let shorter = (self.trust_radius / away.norm()).min(1.0);
        let force = self.force + self.gradient * (away * shorter);
        self.without_pull(force)
    }

    /// `force` [N], or zero where it would pull.
    pub(crate) fn without_pull(&self, force: Vec3) -> Vec3 {
        let directed = self.normal != Vec3::zeros();
        if directed && force.dot(&self.normal) <= 0.0 {
            return Vec3::zeros();
        }
        force
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spring() -> AffineForce {
        let gradient = Matrix3::from_diagonal(&Vec3::new(-10.0, -10.0, -50.0));
        let force = Vec3::new(0.0, 0.0, 0.1);
        AffineForce {
            normal: Vec3::z(),
            ..AffineForce::new(0.0, Vec3::zeros(), force, gradient)
        }
    }

    #[test]
    fn a_spring_is_a_spring_until_it_would_pull() {
        let none = Vec3::zeros();
        let pressed = spring().at(&Vec3::new(1e-3, 0.0, -1e-3));
        // By hand: 0.1 + 50 × 0.001, −10 × 0.001.
        assert!((pressed - Vec3::new(-0.01, 0.0, 0.15)).norm() < 1e-15);
        assert_eq!(spring().at(&Vec3::new(1e-3, 0.0, 3e-3)), none);
        assert_eq!(AffineForce::none(0.0).at(&none), none);
    }

    #[test]
    fn beyond_its_trust_it_stays() {
        let edge = spring().at(&Vec3::new(0.0, 0.0, -5e-3));
        let beyond = spring().at(&Vec3::new(0.0, 0.0, -80e-3));
        // Rounding.
        assert!((edge - beyond).norm() < 1e-15, "{edge} {beyond}");
    }
}
