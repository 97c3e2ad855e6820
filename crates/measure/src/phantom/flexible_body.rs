use std::f64::consts::TAU;

use super::rigid_body::after;
use super::{Joints, RigidBody};
use palpate_servo::Vec3;

/// The three joints with rotors that drive them through compliant cables and links, each a spring. This compliance
/// keeps a real machine from rendering the stiffness that its friction would allow [Díaz and Gil 2010].
///
/// ```text
/// M(q) q̈ + C q̇ + g = k (θ − q) + c (θ̇ − q̇) + Jᵀ F,     J_r θ̈ = τ − k (θ − q) − c (θ̇ − q̇)
/// ```
///
/// Its encoders are on the motors, as in the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlexibleBody {
    /// The links.
    pub links: RigidBody,
    /// J_r of each rotor behind its transmission [kg m²].
    pub rotors: Vec3,
    /// k of each joint [N m/rad].
    pub stiffness: Vec3,
    /// c of each joint [N m s/rad].
    pub damping: Vec3,
}

/// Joints and the rotors that turn them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlexibleJoints {
    /// q.
    pub links: Joints,
    /// θ, as they are seen at the joints.
    pub rotors: Joints,
}

/// Longest step of its motion [s]: a part in a hundred of the fastest swing.
const LONGEST: f64 = 50e-6;

impl FlexibleBody {
    /// A PHANTOM Premium 1.5: rotors of 1.08e-6 kg m² behind 13.3, 11.2 and 11.2 to 1, and the 3.5 N/mm that its
    /// maker states at the ends of the links, as in the two masses of (7.5). The damping is 3 % of critical. At
    /// rest they swing at 151, 179 and 148 Hz.
    pub fn premium() -> Self {
        let links = RigidBody::premium();
        let rotors = Vec3::new(13.3, 11.2, 11.2).map(|ratio: f64| 1.08e-6 * ratio * ratio);
        let stiffness = links.linkage.moment_arms().map(|arm| 3545.0 * arm * arm);
        let masses = links.inertia(&Vec3::zeros()).diagonal();
        let reduced = rotors.zip_map(&masses, |rotor, mass| rotor * mass / (rotor + mass));
        let damping = stiffness.zip_map(&reduced, |k, mass| 0.03 * 2.0 * (k * mass).sqrt());
        Self {
            links,
            rotors,
            stiffness,
            damping,
        }
    }

    /// At rest with joints at zero.
    pub fn at_rest() -> FlexibleJoints {
        let still = Joints {
            angles: Vec3::zeros(),
            rates: Vec3::zeros(),
        };
        FlexibleJoints {
            links: still,
            rotors: still,
        }
    }

    /// How fast rotor and link of each joint swing against one another with joints at `angles` [rad], if nothing
    /// is damped and no other joint moves [Hz].
    pub fn structural_frequencies(&self, angles: &Vec3) -> Vec3 {
        let masses = self.links.inertia(angles).diagonal();
        let both = masses.zip_map(&self.rotors, |mass, rotor| 1.0 / mass + 1.0 / rotor);
        self.stiffness
            .zip_map(&both, |k, both| (k * both).sqrt() / TAU)
    }

    /// Moves `joints` on for `elapsed` [s] under the torques of the motors [N m] and a `force` on the handle
    /// [N], like [`RigidBody::advance`].
    pub fn advance(&self, joints: &mut FlexibleJoints, torque: &Vec3, force: &Vec3, elapsed: f64) {
        let steps = (elapsed / LONGEST).ceil().clamp(1.0, 20_000.0);
        let step = elapsed / steps;
        for _ in 0..steps as u32 {
            *joints = self.step(joints, torque, force, step);
        }
    }

    fn step(
        &self,
        joints: &FlexibleJoints,
        torque: &Vec3,
        force: &Vec3,
        step: f64,
    ) -> FlexibleJoints {
        let moved = |by: &FlexibleJoints, part: f64| FlexibleJoints {
            links: after(&joints.links, &by.links, part * step),
            rotors: after(&joints.rotors, &by.rotors, part * step),
        };
        let a = self.change(joints, torque, force);
        let b = self.change(&moved(&a, 0.5), torque, force);
        let c = self.change(&moved(&b, 0.5), torque, force);
        let d = self.change(&moved(&c, 1.0), torque, force);
        let mut next = *joints;
        for (change, weight) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
            next.links = after(&next.links, &change.links, weight * step / 6.0);
            next.rotors = after(&next.rotors, &change.rotors, weight * step / 6.0);
        }
        next
    }

    /// Rates and accelerations.
    fn change(&self, joints: &FlexibleJoints, torque: &Vec3, force: &Vec3) -> FlexibleJoints {
        let FlexibleJoints { links, rotors } = joints;
        let twist = rotors.angles - links.angles;
        let twisting = rotors.rates - links.rates;
        let passed = twist.component_mul(&self.stiffness) + twisting.component_mul(&self.damping);
        FlexibleJoints {
            links: Joints {
                angles: links.rates,
                rates: self.links.acceleration(links, &passed, force),
            },
            rotors: Joints {
                angles: rotors.rates,
                rates: (torque - passed).component_div(&self.rotors),
            },
        }
    }

    /// Dry friction of up to `friction` [N] at the handle during `elapsed` [s], in the motors and their cables:
    /// like [`RigidBody::rub`], on the rotors.
    pub(crate) fn rub(&self, joints: &mut FlexibleJoints, friction: f64, elapsed: f64) {
        let most =
            self.links.linkage.moment_arms().component_div(&self.rotors) * (friction * elapsed);
        for joint in 0..3 {
            let rate = &mut joints.rotors.rates[joint];
            *rate -= rate.clamp(-most[joint], most[joint]);
        }
    }
}
