//! The hands of the window: one per tool that a mouse, keys or a gamepad may move, all at once.
//!
//! A hand keeps what it holds: where nobody moves it, it stays, and shut jaws stay shut. The mouse moves
//! one hand, as a [`Gesture`] while its jaws are open, and as a `Pull` once they are shut; keys and sticks
//! move each hand along the picture's axes and along its shaft, x ← x + v Δt.
//!
//! It is arithmetic on places and knows no window but for the layout of the keys.
//!
//! *How we know*: `hands::…`.
//!
//! *Limits*: a hand that is moved by keys may go through an organ, as a mouse may not; it stays within
//! `FARTHEST` sizes of the organ.
//!
//! [`Gesture`]: super::gesture::Gesture

pub mod gamepad;
pub mod gamepads;
pub mod keys;

use nalgebra::UnitQuaternion;
use palpate_geometry::Vec3;
use palpate_simulate::ShownTool;

use super::gesture::{Aim, Mouse};
use crate::Camera;

/// Speed of a hand that a key moves [m/s], of one that is moved finely, and of its roll [rad/s].
const SPEED: f64 = 0.030;
const FINE: f64 = 0.006;
const ROLL: f64 = 1.6;

/// Jaws go from open to shut in this time [s].
const CLOSING: f64 = 0.25;

/// From the middle of the organ, in its sizes [-].
const FARTHEST: f64 = 2.0;

/// Way of a pull along the line of sight, per step of the wheel [m].
const WHEEL: f64 = 0.0005;

/// Distance before the surface at which a tool with a trocar is taken up [m].
const WAITING: f64 = 0.018;

/// How a hand is moved, by keys or sticks, each from -1 to 1 [-].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Drive {
    /// To the right of the picture, up in it, and in along the shaft.
    pub way: [f64; 3],
    /// About the shaft, counter-clockwise seen from the hand.
    pub roll: f64,
    /// Slowly.
    pub fine: bool,
    /// The jaws change from open to shut or back.
    pub jaws: bool,
    /// Whether a cutting tool cuts.
    pub cuts: bool,
}

impl Drive {
    /// Whether the hand is moved.
    pub fn moves(&self) -> bool {
        self.roll != 0.0 || self.way.iter().any(|part| *part != 0.0)
    }

    /// Combines the commands of `self` and `other`.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            way: [0, 1, 2].map(|k| (self.way[k] + other.way[k]).clamp(-1.0, 1.0)),
            roll: (self.roll + other.roll).clamp(-1.0, 1.0),
            fine: self.fine || other.fine,
            jaws: self.jaws != other.jaws,
            cuts: self.cuts || other.cuts,
        }
    }
}

/// Surroundings of a hand.
#[derive(Debug, Clone, Copy)]
pub struct HandContext<'a> {
    /// From where it is seen.
    pub camera: &'a Camera,
    /// Width of the picture over its height.
    pub aspect: f64,
    /// The middle of the organ [m] and its size [m].
    pub middle: (Vec3, f64),
}

/// Shut jaws that the mouse drags.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pull {
    /// Where the button went down.
    began: (f64, f64),
    /// Where the tip was then [m].
    from: Vec3,
    /// Towards the eye by the wheel [m].
    nearer: f64,
}

/// A hand and what it does with its tool.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Hand {
    /// The tip [m] and from the tool's frame to the scene; none before it is taken up.
    pub place: Option<(Vec3, UnitQuaternion<f64>)>,
    /// About the shaft [rad].
    pub roll: f64,
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Whether its jaws are to be shut.
    pub is_shut: bool,
    /// Whether it cuts.
    pub cuts: bool,
    /// Whether keys moved it last, so that a mouse that rests does not.
    pub by_keys: bool,
    pull: Option<Pull>,
}

impl Hand {
    /// Moves it for `elapsed` [s]; `trocar` [m] is where its shaft passes.
    pub fn drive(
        &mut self,
        drive: &Drive,
        elapsed: f64,
        trocar: Option<&Vec3>,
        room: &HandContext<'_>,
    ) {
        if drive.jaws {
            self.is_shut = !self.is_shut;
            // Open jaws stay where they are until the mouse moves.
            self.by_keys |= !self.is_shut;
            self.pull = None;
        }
        self.cuts = drive.cuts;
        let elapsed = elapsed.clamp(0.0, 0.1);
        let wanted = f64::from(u8::from(self.is_shut || self.cuts));
        let change = elapsed / CLOSING;
        self.grip += (wanted - self.grip).clamp(-change, change);
        if !drive.moves() {
            return;
        }
        self.by_keys = true;
        self.pull = None;
        let (tip, turned) = self.place.unwrap_or_else(|| begin(room));
        let [right, up, _] = room.camera.axes();
        let shaft = trocar
            .and_then(|at| (at - tip).try_normalize(1e-9))
            .unwrap_or(turned * Vec3::z());
        let speed = if drive.fine { FINE } else { SPEED };
        let [across, along, inward] = drive.way;
        let way = across * right + along * up - inward * shaft;
        self.roll += ROLL * drive.roll * elapsed;
        self.place = Some((within(tip + speed * elapsed * way, room), turned));
    }

    /// Takes over where a script has it.
    pub fn show(&mut self, tool: &ShownTool, room: &HandContext<'_>) {
        let (_, turned) = self.place.unwrap_or_else(|| begin(room));
        self.place = Some((tool.tip, turned));
        self.grip = tool.grip.max(f64::from(u8::from(tool.cuts)));
        self.cuts = tool.cuts;
        self.pull = None;
        self.by_keys = true;
    }

    /// Takes over where a gesture of the mouse wants it.
    pub fn follow(&mut self, aim: &Aim) {
        self.by_keys = false;
        self.pull = None;
        self.place = Some((aim.tip, aim.turned));
    }

    /// Moves shut jaws with the mouse: in the plane of the picture, and by the wheel along the line of sight.
    /// Without a pressed button they stay.
    pub fn pull(&mut self, mouse: &Mouse, room: &HandContext<'_>) {
        let (Some((tip, turned)), true, Some(place)) = (self.place, mouse.pressed, mouse.place)
        else {
            // A pull goes on where the mouse has left the picture.
            if !mouse.pressed {
                self.pull = None;
            }
            return;
        };
        self.by_keys = false;
        let mut pull = self.pull.unwrap_or(Pull {
            began: place,
            from: tip,
            nearer: 0.0,
        });
        // Away from the hand is into the picture.
        pull.nearer -= WHEEL * mouse.wheel;
        let [right, up, back] = room.camera.axes();
        let ahead = (room.camera.eye - pull.from).dot(&back).max(1e-3);
        let height = 2.0 * ahead * (0.5 * room.camera.field_of_view).tan();
        let across = (place.0 - pull.began.0) * height * room.aspect;
        let along = (pull.began.1 - place.1) * height;
        let to = pull.from + across * right + along * up + pull.nearer * back;
        self.pull = Some(pull);
        self.place = Some((within(to, room), turned));
    }

    /// Whether its jaws hold, or are about to.
    pub fn holds(&self) -> bool {
        self.is_shut
    }

    /// Whether the mouse drags its shut jaws.
    pub fn is_pulling(&self) -> bool {
        self.pull.is_some()
    }

    /// Puts it before a surface that the way from `trocar` [m] meets after `distance` [m] on its way to
    /// the middle of the organ.
    pub fn wait(&mut self, trocar: &Vec3, distance: f64, room: &HandContext<'_>) {
        let Some(inward) = (room.middle.0 - trocar).try_normalize(1e-9) else {
            return;
        };
        let tip = trocar + (distance - WAITING).max(0.25 * distance) * inward;
        let turned = UnitQuaternion::rotation_between(&Vec3::z(), &-inward).unwrap_or_default();
        self.place = Some((tip, turned));
        self.by_keys = true;
    }

    /// From the tool's frame to the scene, with its roll.
    pub fn turned(&self) -> Option<UnitQuaternion<f64>> {
        let (_, turned) = self.place?;
        Some(turned * UnitQuaternion::from_axis_angle(&Vec3::z_axis(), self.roll))
    }
}

/// Where a tool without a trocar is taken up: between the eye and the organ, its shaft up and to the right.
fn begin(room: &HandContext<'_>) -> (Vec3, UnitQuaternion<f64>) {
    let [right, up, back] = room.camera.axes();
    let (middle, size) = room.middle;
    let shaft: Vec3 = 0.5 * back + 0.6 * up + 0.4 * right;
    let turned = UnitQuaternion::rotation_between(&Vec3::z(), &shaft).unwrap_or_default();
    (middle + 0.55 * size * back, turned)
}

fn within(tip: Vec3, room: &HandContext<'_>) -> Vec3 {
    let (middle, size) = room.middle;
    let away = tip - middle;
    let far = FARTHEST * size;
    match away.norm() > far {
        true => middle + far * away.normalize(),
        false => tip,
    }
}
