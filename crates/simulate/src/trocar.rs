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
//! The tip goes against the hand across the shaft, λ times as far, and with it along the shaft; the work is
//! the same. The wall may rub along the shaft, −f tanh(v/v₀) n with v = n·ḣ, which never gives energy, and
//! resist that the shaft leans, −k h across the direction u in which it stands by itself; that is a spring.
//!
//! *How we know*: `trocar::…`.
//!
//! *Limits*: the fulcrum does not give way; no torque, neither of the tip nor of the roll; nearer to the
//! trocar than 1 cm a hand is taken as that far outside.

use palpate_files::scene::Tool;
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::Error;

/// Length of a shaft from its tip to the middle of the hand [m].
const SHAFT: f64 = 0.36;

/// A hand is never nearer to the trocar [m].
const LEAST: f64 = 0.01;

/// Friction is three quarters of its all at this speed [m/s]: slower than hands that mean to move.
const SLOW: f64 = 0.01;

/// Where a shaft passes through the abdominal wall, and what it feels there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trocar {
    /// The point through which it always passes [m].
    pub place: Vec3,
    /// Unit direction, outward, in which a shaft stands that nobody holds [-].
    pub upright: Vec3,
    /// From the tip to the hand [m].
    pub shaft: f64,
    /// Friction along the shaft [N].
    pub friction: f64,
    /// Force on the hand per way of the hand across [`Self::upright`] [N/m].
    pub stiffness: f64,
}

impl Trocar {
    /// At `place` [m], with a shaft of 0.36 m that stands by itself toward `organ` [m]; the wall neither rubs
    /// nor resists.
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

    /// The velocity of the tip [m/s] of a hand at `hand` [m] with `velocity` [m/s]; likewise of small ways [m].
    pub fn velocity_of_tip(&self, hand: &Vec3, velocity: &Vec3) -> Vec3 {
        let (outward, distance) = self.outside(hand);
        let along = outward * outward.dot(velocity);
        along - (velocity - along) * self.lever(distance)
    }

    /// What a hand at `hand` [m] feels of a `force` on the tip [N]: the same work.
    pub fn force_on_hand(&self, hand: &Vec3, force: &Vec3) -> Vec3 {
        // J is symmetric.
        self.velocity_of_tip(hand, force)
    }

    /// The force on the tip [N] that a hand at `hand` [m] feels as `force` [N]; none across a shaft whose tip
    /// is in the trocar, where the hand feels nothing of it.
    pub fn force_on_tip(&self, hand: &Vec3, force: &Vec3) -> Vec3 {
        let (outward, distance) = self.outside(hand);
        let along = outward * outward.dot(force);
        let lever = self.lever(distance);
        match lever.abs() > 1e-9 {
            true => along - (force - along) / lever,
            false => along,
        }
    }

    /// What the abdominal wall does to a hand at `hand` [m] with `velocity` [m/s]: friction and spring [N].
    pub fn wall_force(&self, hand: &Vec3, velocity: &Vec3) -> Vec3 {
        let (outward, _) = self.outside(hand);
        let rubs = -outward * (self.friction * (outward.dot(velocity) / SLOW).tanh());
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

    /// λ, way of the tip over way of the hand across the shaft [-]; below zero for a tip that has been drawn out.
    fn lever(&self, distance: f64) -> f64 {
        (self.shaft - distance) / distance
    }
}

/// A trocar lies outside the organ.
pub(crate) fn check(tool: &Tool, (surface, tree): (&Surface, &AabbTree)) -> Result<(), Error> {
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
