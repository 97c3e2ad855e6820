use nalgebra::{Matrix3, Vector3};

use crate::Vec3;

/// The links of a PHANTOM Premium 1.5, as far as needed for their weight and reach: the kinematics and statics of
/// [Çavuşoğlu, Feygin and Tendick 2002].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linkage {
    /// Lengths l₁, l₂, l₃, l₅, l₆ [m].
    pub lengths: [f64; 5],
    /// Masses of links a, c and the balanced bodies be, df [kg].
    pub masses: [f64; 4],
    /// Acceleration of gravity [m/s²]; zero for a device whose weight is balanced.
    pub gravity: f64,
}

impl Linkage {
    /// The published numbers, with the weight of the links.
    pub fn premium() -> Self {
        Self {
            lengths: [0.215, 0.170, 0.0325, -0.0368, 0.0527],
            masses: [0.0202, 0.0249, 0.2359, 0.1906],
            gravity: 9.81,
        }
    }

    /// Position of the handle [m] for joint `angles` [rad]: x right, y up, z toward the user, zero at rest.
    pub fn position(&self, angles: &Vec3) -> Vec3 {
        let [l1, l2, ..] = self.lengths;
        let reach = l1 * angles.y.cos() + l2 * angles.z.sin();
        Vec3::new(
            angles.x.sin() * reach,
            l2 - l2 * angles.z.cos() + l1 * angles.y.sin(),
            -l1 + angles.x.cos() * reach,
        )
    }

    /// The Jacobian: handle motion per joint rate, one column for each joint [m].
    pub fn jacobian(&self, angles: &Vec3) -> Matrix3<f64> {
        let [l1, l2, ..] = self.lengths;
        let (s1, c1) = angles.x.sin_cos();
        let (s2, c2) = angles.y.sin_cos();
        let (s3, c3) = angles.z.sin_cos();
        let reach = l1 * c2 + l2 * s3;
        Matrix3::from_columns(&[
            Vector3::new(c1 * reach, 0.0, -s1 * reach),
            Vector3::new(-s1 * l1 * s2, l1 * c2, -c1 * l1 * s2),
            Vector3::new(s1 * l2 * c3, l2 * s3, c1 * l2 * c3),
        ])
    }

    /// The joint angles for a handle at `position` [m]; none if out of reach. The elbow is bent as at rest.
    pub fn angles(&self, position: &Vec3) -> Option<Vec3> {
        let [l1, l2, ..] = self.lengths;
        let (x, z) = (position.x, position.z + l1);
        let (out, up) = (x.hypot(z), position.y - l2);
        // out = l₁ cos q₂ + l₂ sin q₃ and up = l₁ sin q₂ − l₂ cos q₃: the sum of their squares depends on q₃ − q₂ alone.
        let sine = (out * out + up * up - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
        if sine.is_nan() || sine.abs() > 1.0 {
            return None;
        }
        let elbow = sine.asin();
        let (along, across) = (l1 + l2 * sine, l2 * elbow.cos());
        let upper = up.atan2(out) + across.atan2(along);
        Some(Vec3::new(x.atan2(z), upper, upper + elbow))
    }

    /// The force on the handle [N] that balances the weight of the links at `position` [m]; none if out of reach.
    pub fn holding_force(&self, position: &Vec3) -> Option<Vec3> {
        let angles = self.angles(position)?;
        let back = self.jacobian(&angles).transpose().try_inverse()?;
        Some(back * self.weight(&angles))
    }

    /// The length over which a force at the handle turns each joint [m].
    pub fn moment_arms(&self) -> Vec3 {
        let [l1, l2, ..] = self.lengths;
        Vec3::new(l1, l1, l2)
    }

    /// The torque of gravity at each joint [N m], g(q) = ∂V/∂q of the equation of motion.
    pub fn weight(&self, angles: &Vec3) -> Vec3 {
        let [upper, lower] = self.moments();
        Vec3::new(0.0, upper * angles.y.cos(), lower * angles.z.sin())
    }

    /// Potential energy [J], zero with joints at zero.
    pub fn potential(&self, angles: &Vec3) -> f64 {
        let [upper, lower] = self.moments();
        upper * angles.y.sin() + lower * (1.0 - angles.z.cos())
    }

    /// Largest moment of the weight about joints two and three [N m].
    fn moments(&self) -> [f64; 2] {
        let [l1, l2, l3, l5, l6] = self.lengths;
        let [ma, mc, mbe, mdf] = self.masses;
        [
            0.5 * self.gravity * (2.0 * l1 * ma + 2.0 * l5 * mbe + l1 * mc),
            0.5 * self.gravity * (l2 * ma + 2.0 * l3 * mc - 2.0 * l6 * mdf),
        ]
    }
}
