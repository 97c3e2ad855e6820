use nalgebra::Matrix3;
use palpate_servo::Vec3;
use palpate_servo::dynamics::Linkage;

/// Joints of the machine: about the upright axis, of the upper and of the lower link [rad], and how they turn
/// [rad/s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joints {
    /// q [rad].
    pub angles: Vec3,
    /// q̇ [rad/s].
    pub rates: Vec3,
}

/// A PHANTOM Premium 1.5 as links without weightless parts: M(q) q̈ + C(q, q̇) q̇ + g(q) = τ + Jᵀ F
/// [Çavuşoğlu, Feygin and Tendick 2002].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// Lengths, masses and weight.
    pub linkage: Linkage,
    /// Inertias about x, y and z of a, c, be, df, and about y of the base [kg m²].
    inertias: [[f64; 3]; 4],
    base: f64,
    /// Damping of each joint [N m s].
    pub damping: f64,
}

/// Longest step of its motion [s].
const LONGEST: f64 = 100e-6;

impl RigidBody {
    /// The published numbers, with the weight of the links and without friction.
    pub fn premium() -> Self {
        Self {
            linkage: Linkage::premium(),
            inertias: [
                [0.4864e-4, 0.001843e-4, 0.4864e-4],
                [0.959e-4, 0.959e-4, 0.0051e-4],
                [11.09e-4, 10.06e-4, 0.591e-4],
                [7.11e-4, 0.629e-4, 6.246e-4],
            ],
            base: 11.87e-4,
            damping: 0.0,
        }
    }

    /// M(q) [kg m²].
    pub fn inertia(&self, angles: &Vec3) -> Matrix3<f64> {
        let [l1, l2, l3, ..] = self.linkage.lengths;
        let [ma, mc, ..] = self.linkage.masses;
        let [a, c, be, df] = self.inertias;
        let turning = [a, c, be, df].iter().map(|i| i[1] + i[2]).sum::<f64>();
        let reaching = 4.0 * l1 * l1 * ma + l2 * l2 * ma + l1 * l1 * mc + 4.0 * l3 * l3 * mc;
        let [upper, lower, both] = self.waves();
        let m11 = 0.5 * turning
            + self.base
            + reaching / 8.0
            + upper * (2.0 * angles.y).cos()
            + lower * (2.0 * angles.z).cos()
            + both * angles.y.cos() * angles.z.sin();
        let m22 = be[0] + c[0] + l1 * l1 * ma + 0.25 * l1 * l1 * mc;
        let m33 = a[0] + df[0] + 0.25 * l2 * l2 * ma + l3 * l3 * mc;
        let m23 = -0.5 * both * (angles.y - angles.z).sin();
        Matrix3::new(m11, 0.0, 0.0, 0.0, m22, m23, 0.0, m23, m33)
    }

    /// Coefficients of cos 2 q₂, cos 2 q₃ and cos q₂ sin q₃ in M₁₁ [kg m²].
    fn waves(&self) -> [f64; 3] {
        let [l1, l2, l3, ..] = self.linkage.lengths;
        let [ma, mc, ..] = self.linkage.masses;
        let [a, c, be, df] = self.inertias;
        [
            0.5 * (be[1] - be[2] + c[1] - c[2]) + l1 * l1 * (4.0 * ma + mc) / 8.0,
            0.5 * (a[1] - a[2] + df[1] - df[2]) - (l2 * l2 * ma + 4.0 * l3 * l3 * mc) / 8.0,
            l1 * (l2 * ma + l3 * mc),
        ]
    }

    /// ∂M/∂q₂ and ∂M/∂q₃ [kg m²]; with q₁ it does not change.
    fn inertia_changes(&self, angles: &Vec3) -> [Matrix3<f64>; 2] {
        let [upper, lower, both] = self.waves();
        let (s2, c2) = angles.y.sin_cos();
        let (s3, c3) = angles.z.sin_cos();
        let m23 = 0.5 * both * (angles.y - angles.z).cos();
        let changes = [
            (-2.0 * upper * (2.0 * angles.y).sin() - both * s2 * s3, -m23),
            (-2.0 * lower * (2.0 * angles.z).sin() + both * c2 * c3, m23),
        ];
        changes.map(|(m11, m23)| Matrix3::new(m11, 0.0, 0.0, 0.0, 0.0, m23, 0.0, m23, 0.0))
    }

    /// Kinetic and potential energy [J], the latter from joints at zero.
    pub fn energy(&self, joints: &Joints) -> f64 {
        let moving = 0.5
            * joints
                .rates
                .dot(&(self.inertia(&joints.angles) * joints.rates));
        moving + self.linkage.potential(&joints.angles)
    }

    /// The mass that a hand feels along each axis [kg] with joints at `angles` [rad]: the diagonal of
    /// J⁻ᵀ M J⁻¹. None where a joint cannot move the handle.
    pub fn apparent_mass(&self, angles: &Vec3) -> Option<Vec3> {
        let back = self.linkage.jacobian(angles).try_inverse()?;
        Some((back.transpose() * self.inertia(angles) * back).diagonal())
    }

    /// Moves `joints` on for `elapsed` [s] under the torques of the motors [N m] and a `force` on the handle
    /// [N]: the classical method of Runge and Kutta in steps of 100 µs at most.
    pub fn advance(&self, joints: &mut Joints, torque: &Vec3, force: &Vec3, elapsed: f64) {
        let steps = (elapsed / LONGEST).ceil().clamp(1.0, 20_000.0);
        let step = elapsed / steps;
        for _ in 0..steps as u32 {
            *joints = self.step(joints, torque, force, step);
        }
    }

    fn step(&self, joints: &Joints, torque: &Vec3, force: &Vec3, step: f64) -> Joints {
        let change = |joints: &Joints| Joints {
            angles: joints.rates,
            rates: self.acceleration(joints, torque, force),
        };
        let a = change(joints);
        let b = change(&after(joints, &a, 0.5 * step));
        let c = change(&after(joints, &b, 0.5 * step));
        let d = change(&after(joints, &c, step));
        let mean = Joints {
            angles: (a.angles + (b.angles + c.angles) * 2.0 + d.angles) / 6.0,
            rates: (a.rates + (b.rates + c.rates) * 2.0 + d.rates) / 6.0,
        };
        after(joints, &mean, step)
    }

    /// Dry friction of up to `friction` [N] at the handle during `elapsed` [s], as torques on the lengths of the
    /// links: it takes speed and never turns it.
    pub(crate) fn rub(&self, joints: &mut Joints, friction: f64, elapsed: f64) {
        let (arms, inertia) = (self.linkage.moment_arms(), self.inertia(&joints.angles));
        for joint in 0..3 {
            let most = friction * arms[joint] * elapsed / inertia[(joint, joint)];
            joints.rates[joint] -= joints.rates[joint].clamp(-most, most);
        }
    }

    /// q̈ [rad/s²]. C q̇ = Ṁ q̇ − ½ ∂(q̇ᵀ M q̇)/∂q.
    pub(super) fn acceleration(&self, joints: &Joints, torque: &Vec3, force: &Vec3) -> Vec3 {
        let Joints { angles, rates } = joints;
        let [by_upper, by_lower] = self.inertia_changes(angles);
        let changing = (by_upper * rates.y + by_lower * rates.z) * rates;
        let half = |change: &Matrix3<f64>| 0.5 * rates.dot(&(change * rates));
        let turning = changing - Vec3::new(0.0, half(&by_upper), half(&by_lower));
        let driven = torque + self.linkage.jacobian(angles).transpose() * force;
        let left = driven - turning - self.linkage.weight(angles) - rates * self.damping;
        // A mass that moves has an inverse; at worst the joints stay.
        let inertia = self.inertia(angles).cholesky();
        inertia.map_or_else(Vec3::zeros, |factor| factor.solve(&left))
    }
}

/// `joints` after `time` [s] of `change`.
pub(super) fn after(joints: &Joints, change: &Joints, time: f64) -> Joints {
    Joints {
        angles: joints.angles + change.angles * time,
        rates: joints.rates + change.rates * time,
    }
}
