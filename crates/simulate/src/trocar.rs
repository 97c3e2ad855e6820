//! The fulcrum: a shaft that always passes through one point of the abdominal wall.
//!
//! A rigid shaft of length ℓ has the tip at one end and the hand at the other. With h the hand as seen from the
//! trocar, ρ = |h| and n = h/ρ,
//!
//! ```text
//! tip = trocar − (ℓ − ρ) n
//! ẋ_tip = J ḣ,   J = n nᵀ − λ (1 − n nᵀ),   λ = (ℓ − ρ)/ρ
//! F_hand = Jᵀ F_tip,   J = Jᵀ
//! ```
//!
//! The tip moves against the hand across the shaft, λ times as far, and with it along the shaft; the work is the same.
//! The wall may cause friction along the shaft, and resist the tilt of the shaft by −k h across its neutral direction
//! u, like a spring.
//!
//! Friction is that of bristles that bend before they slip [Dahl 1968], with the damping of their bending [Canudas de
//! Wit et al. 1995]. With ẋ = n·ḣ, the bend z and the largest force f,
//!
//! ```text
//! ż = ẋ − |ẋ| z/r,   F = −(f/r) (z + T ż),   |F| ≤ f
//! ```
//!
//! so that a still hand is held as by a spring and does not chatter: a force with the sign of a measured velocity would
//! amplify the tremor in it. Along a path in one direction z is an exponential, which is computed exactly at any rate;
//! the stored energy is f z²/(2 r), never more than f r/2.
//!
//! *How we know*: `trocar::…`.
//!
//! *Limits*: the fulcrum is rigid; no torque, neither of the tip nor of the roll; nearer to the trocar than 1 cm a hand
//! is treated as if at that distance outside.

use palpate_files::scene::Tool;
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::Error;

/// The distance over which a bristle bends before it slips [m]: large compared with the resolution of devices, small
/// compared with intended motions of a hand.
const BEND: f64 = 1e-3;

/// T, the damping of a bristle over its stiffness [s]: more than the delay of a loop at 1 kHz removes, which is a tick
/// and a half.
const BEND_DAMPING: f64 = 3e-3;

/// Length of a shaft from its tip to the middle of the hand [m].
const SHAFT: f64 = 0.36;

/// A hand is never nearer to the trocar [m].
const LEAST: f64 = 0.01;

/// A point at which a shaft passes through the abdominal wall, and the wall's forces on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trocar {
    /// The fulcrum [m].
    pub place: Vec3,
    /// Unit direction, outward, of a shaft that no hand holds [-].
    pub upright: Vec3,
    /// From the tip to the hand [m].
    pub shaft: f64,
    /// Friction along the shaft [N].
    pub friction: f64,
    /// Force on the hand per displacement of the hand across [`Self::upright`] [N/m].
    pub stiffness: f64,
}

impl Trocar {
    /// At `place` [m], with a shaft of 0.36 m whose neutral direction points to `organ` [m], and a wall without
    /// friction and stiffness.
    pub fn new(place: Vec3, organ: &Vec3) -> Self {
        Self {
            place,
            upright: (place - organ).try_normalize(0.0).unwrap_or_else(Vec3::z),
            shaft: SHAFT,
            friction: 0.0,
            stiffness: 0.0,
        }
    }

    /// The tip [m] of a hand at `hand` [m].
    pub fn tip(&self, hand: &Vec3) -> Vec3 {
        let (outward, distance) = self.outside(hand);
        self.place - outward * (self.shaft - distance)
    }

    /// The hand [m] of a tip at `tip` [m].
    pub fn hand(&self, tip: &Vec3) -> Vec3 {
        let inward = tip - self.place;
        let outward = (-inward).try_normalize(0.0).unwrap_or(self.upright);
        self.place + outward * (self.shaft - inward.norm()).max(LEAST)
    }

    /// The velocity of the tip [m/s] of a hand at `hand` [m] with `velocity` [m/s]; also for small displacements [m].
    pub fn velocity_of_tip(&self, hand: &Vec3, velocity: &Vec3) -> Vec3 {
        let (outward, distance) = self.outside(hand);
        let along = outward * outward.dot(velocity);
        along - (velocity - along) * self.lever(distance)
    }

    /// The force on a hand at `hand` [m] due to a `force` on the tip [N]: the same work.
    pub fn force_on_hand(&self, hand: &Vec3, force: &Vec3) -> Vec3 {
        // J is symmetric.
        self.velocity_of_tip(hand, force)
    }

    /// The force on the tip [N] that gives `force` [N] on a hand at `hand` [m]; zero across a shaft whose tip is in the
    /// trocar, since the hand feels nothing of it.
    pub fn force_on_tip(&self, hand: &Vec3, force: &Vec3) -> Vec3 {
        let (outward, distance) = self.outside(hand);
        let along = outward * outward.dot(force);
        let lever = self.lever(distance);
        match lever.abs() > 1e-9 {
            true => along - (force - along) / lever,
            false => along,
        }
    }

    /// The force of the abdominal wall on a hand at `hand` [m], `dt` [s] after the last: friction and spring [N].
    pub fn wall_force(&self, hand: &Vec3, friction: &mut ShaftFriction, dt: f64) -> Vec3 {
        let (outward, distance) = self.outside(hand);
        let rubs = outward * (self.friction * friction.part(distance, dt));
        let away = hand - self.place;
        let across = away - self.upright * self.upright.dot(&away);
        rubs - across * self.stiffness
    }

    /// Unit direction from the trocar to the hand [-], and the distance [m].
    fn outside(&self, hand: &Vec3) -> (Vec3, f64) {
        let away = hand - self.place;
        let distance = away.norm();
        let outward = away.try_normalize(0.0).unwrap_or(self.upright);
        (outward, distance.max(LEAST))
    }

    /// λ, tip motion over hand motion across the shaft [-]; negative for a tip that has been drawn out.
    fn lever(&self, distance: f64) -> f64 {
        (self.shaft - distance) / distance
    }
}

/// The friction state of a shaft in the wall.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ShaftFriction {
    /// z/r [-].
    bent: f64,
    /// Last distance of the hand from the trocar [m].
    distance: Option<f64>,
}

impl ShaftFriction {
    /// F/f [-], positive away from the trocar, for a hand that has moved to `distance` [m] from it in `dt` [s].
    pub fn part(&mut self, distance: f64, dt: f64) -> f64 {
        let travel = self.distance.map_or(0.0, |last| distance - last) / BEND;
        self.distance = Some(distance);
        let slipping = travel.signum();
        let bent = slipping + (self.bent - slipping) * (-travel.abs()).exp();
        let bending = if dt > 0.0 {
            (bent - self.bent) / dt
        } else {
            0.0
        };
        self.bent = bent;
        -(bent + BEND_DAMPING * bending).clamp(-1.0, 1.0)
    }

    /// Energy stored in the bristles, over f [m]: z²/(2 r).
    pub fn stored(&self) -> f64 {
        0.5 * BEND * self.bent * self.bent
    }
}

/// A trocar lies outside the organ.
pub(crate) fn check(tool: &Tool, surface: &Surface, tree: &AabbTree) -> Result<(), Error> {
    let Some(place) = tool.trocar_m else {
        return Ok(());
    };
    let (_, signed) = surface.signed_distance(tree, &Vec3::from(place));
    if signed > 0.0 {
        return Ok(());
    }
    Err(Error::TrocarInOrgan {
        tool: tool.name.clone(),
        depth: -signed,
    })
}
