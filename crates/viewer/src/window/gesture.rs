//! The hand of a mouse, which has two dimensions: over the organ the tool hovers; a pressed button touches,
//! dragged down it goes deeper, dragged sideways it slides. While it cuts it slides both ways and stays as deep
//! as it was.
//!
//! It is arithmetic on places of the picture and knows no window, so that tests can move it for hours.
//!
//! *How we know*: `gestures::…`, `invariants::dragging_over_every_organ`.

use nalgebra::UnitQuaternion;
use palpate_files::scene::{Tip, TipShape};
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::{Camera, Picked, pick};

/// What a scene gives to a gesture.
#[derive(Debug, Clone, Copy)]
pub struct GestureContext<'a> {
    /// The organ at rest.
    pub surface: &'a Surface,
    /// The tree of its mesh.
    pub tree: &'a AabbTree,
    /// From where it is seen.
    pub camera: &'a Camera,
    /// Width of the picture over its height.
    pub aspect: f64,
    /// What is moved.
    pub tip: Tip,
}

/// The mouse, from one picture to the next; places from (0, 0), upper left, to (1, 1), lower right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mouse {
    /// Where it is; none outside of the picture.
    pub place: Option<(f64, f64)>,
    /// Whether the button is down that touches.
    pub pressed: bool,
    /// Turns of the wheel, away from the hand [steps].
    pub wheel: f64,
    /// Whether the tool cuts.
    pub cuts: bool,
}

/// Where the tool is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aim {
    /// Its tip [m].
    pub tip: Vec3,
    /// From the tool's frame to the scene.
    pub turned: UnitQuaternion<f64>,
    /// Where it is put down first [m], if its way there would lead through the organ.
    pub from: Option<Vec3>,
    /// Where it is over the resting surface [m].
    pub over: Vec3,
    /// How deep it is meant to be [m]; negative above the surface.
    pub depth: f64,
}

/// A press that lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Press {
    /// The line of the picture that it slides along, and the one at which it is not deeper than a touch.
    line: f64,
    zero: f64,
    /// What was there, or where the tool has slid to since.
    over: Picked,
    /// Depth by the wheel [m].
    by_wheel: f64,
}

/// The state of the hand.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Gesture {
    press: Option<Press>,
    /// The last place that the tool was over.
    over: Option<Picked>,
    aim: Option<Aim>,
}

/// Depth at once when the button goes down [m], and at the end of a drag over the whole picture [m].
const TOUCH: f64 = 0.001;
const DEEPEST: f64 = 0.025;
/// Depth of one step of the wheel [m].
const WHEEL: f64 = 0.0005;
/// Height of a tool that hovers [m].
const HOVER: f64 = 0.004;

impl Gesture {
    /// Takes the mouse's next state; the aim is none as long as the tool has not come over the organ.
    pub fn follow(&mut self, mouse: &Mouse, ground: &GestureContext<'_>) -> Option<Aim> {
        let seen = |place| {
            pick(
                (ground.surface, ground.tree),
                ground.camera,
                place,
                ground.aspect,
            )
        };
        match (mouse.pressed, self.press, mouse.place) {
            (true, Some(mut press), Some(place)) => {
                if mouse.cuts {
                    let before = self.aim.map_or(TOUCH, |aim| aim.depth);
                    press.line = place.1;
                    press.zero = place.1 - (before - TOUCH - press.by_wheel) / DEEPEST;
                }
                // Else sideways only: down the picture is into the tissue.
                if let Some(over) = seen((place.0, press.line)) {
                    press.over = over;
                }
                press.by_wheel = (press.by_wheel + WHEEL * mouse.wheel).clamp(-DEEPEST, DEEPEST);
                self.press = Some(press);
                let dragged = DEEPEST * (place.1 - press.zero);
                let depth = (TOUCH + dragged + press.by_wheel).clamp(-HOVER, DEEPEST);
                self.go(&press.over, depth, ground);
            }
            (true, None, Some(place)) => {
                let over = seen(place);
                self.press = over.map(|over| Press {
                    line: place.1,
                    zero: place.1,
                    over,
                    by_wheel: 0.0,
                });
                if let Some(over) = over {
                    self.leap(&over, TOUCH, ground);
                }
            }
            // A press goes on where the mouse has left the picture.
            (true, _, None) => {}
            (false, _, place) => {
                self.press = None;
                let over = place.and_then(seen).or(self.over);
                if let Some(over) = over {
                    self.leap(&over, -HOVER, ground);
                }
            }
        }
        self.aim
    }

    fn go(&mut self, over: &Picked, depth: f64, ground: &GestureContext<'_>) {
        self.over = Some(*over);
        self.aim = aimed(over, depth, ground);
    }

    /// From above the surface, wherever the tool was.
    fn leap(&mut self, over: &Picked, depth: f64, ground: &GestureContext<'_>) {
        self.go(over, depth, ground);
        let above = aimed(over, -HOVER, ground).map(|above| above.tip);
        if let Some(aim) = &mut self.aim {
            aim.from = above;
        }
    }

    /// Whether the tool is being pressed in.
    pub fn is_pressing(&self) -> bool {
        self.press.is_some()
    }

    /// Where the tool is to be.
    pub fn aim(&self) -> Option<Aim> {
        self.aim
    }
}

fn aimed(over: &Picked, depth: f64, ground: &GestureContext<'_>) -> Option<Aim> {
    let overhang = match ground.tip.shape {
        TipShape::Flat => 0.0,
        TipShape::Sphere => ground.tip.radius_m,
    };
    let tip = over.point + (overhang - depth) * over.normal;
    let [right, up, back] = ground.camera.axes();
    // Held by a hand beside the camera: steep on the surface, and not in the way of the eye.
    let held = 0.9 * over.normal + 0.45 * up + 0.40 * right + 0.15 * back;
    let shaft = held.try_normalize(1e-3).unwrap_or(over.normal);
    let turned = UnitQuaternion::rotation_between(&Vec3::z(), &shaft)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI));
    tip.iter().all(|c| c.is_finite()).then_some(Aim {
        tip,
        turned,
        from: None,
        over: over.point,
        depth,
    })
}
