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
//! the same. The wall may rub along the shaft, and resist that the shaft leans, −k h across the direction u in which it
//! stands by itself; that is a spring.
//!
//! Friction is that of bristles that bend before they slip [Dahl 1968], with the damping of their bending [Canudas de
//! Wit et al. 1995]. With ẋ = n·ḣ, the bend z and the largest force f,
//!
//! ```text
//! ż = ẋ − |ẋ| z/r,   F = −(f/r) (z + T ż),   |F| ≤ f
//! ```
//!
//! so that a still hand is held as by a spring and does not chatter: a force that followed the sign of a measured
//! velocity would feed the trembling that it is made of. Along a way of one direction z is an exponential, which is
//! taken exactly at any rate; what is stored is f z²/(2 r), never more than f r/2.
//!
//! *How we know*: `trocar::…`.
//!
//! *Limits*: the fulcrum does not give way; no torque, neither of the tip nor of the roll; nearer to the
//! trocar than 1 cm a hand is taken as that far outside.

use palpate_files::scene::Tool;
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::Error;

/// The way on which a bristle bends before it slips [m]: wide beside the resolution of devices, narrow beside what a
/// hand means to do.
const BEND: f64 = 1e-3;

/// T, the damping of a bristle over its stiffness [s]: more than the delay of a loop at 1 kHz takes away, which is a
/// tick and a half.
const BEND_DAMPING: f64 = 3e-3;

/// Length of a shaft from its tip to the middle of the hand [m].
const SHAFT: f64 = 0.36;

/// A hand is never nearer to the trocar [m].
const LEAST: f64 = 0.01;

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

    /// What the abdominal wall does to a hand at `hand` [m], `dt` [s] after the last: friction and spring [N].
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

    /// λ, way of the tip over way of the hand across the shaft [-]; below zero for a tip that has been drawn out.
    fn lever(&self, distance: f64) -> f64 {
        (self.shaft - distance) / distance
    }
}

/// How the wall holds a shaft.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ShaftFriction {
    /// z/r [-].
    bent: f64,
    /// How far the hand was from the trocar last [m].
    distance: Option<f64>,
}

impl ShaftFriction {
    /// F/f [-], positive away from the trocar, of a hand that has come to `distance` [m] from it in `dt` [s].
    pub fn part(&mut self, distance: f64, dt: f64) -> f64 {
        let way = self.distance.map_or(0.0, |last| distance - last) / BEND;
        self.distance = Some(distance);
        let slipping = way.signum();
        let bent = slipping + (self.bent - slipping) * (-way.abs()).exp();
        let bending = if dt > 0.0 {
            (bent - self.bent) / dt
        } else {
            0.0
        };
        self.bent = bent;
        -(bent + BEND_DAMPING * bending).clamp(-1.0, 1.0)
    }

    /// What the bristles store, over f [m]: z²/(2 r).
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
