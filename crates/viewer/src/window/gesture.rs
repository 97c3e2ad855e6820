//! The hand of a mouse, which has two dimensions: over the organ the tool hovers; a pressed button touches,
//! dragged down it goes deeper, dragged sideways it slides. Let go, the tool comes out as a critically damped spring
//! brings it, x = x₀ + (x₁ − x₀)(1 − (1 + ωt) e^(−ωt)), for tissue is not left in an instant by any hand. While it cuts it slides both ways and stays as deep
//! as it was.
//!
//! It is arithmetic on places of the picture and knows no window, so that tests can move it for hours.
//!
//! *How we know*: `gestures::…`, `invariants::dragging_over_every_organ`.

use nalgebra::UnitQuaternion;
use palpate_files::scene::{Tip, TipShape};
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::{Camera, Picked, pick};

/// Context of a gesture in a scene.
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
    /// Time since the last picture [s].
    pub elapsed: f64,
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
    /// The line at which the mouse was in the picture before.
    last: f64,
    /// What was there, or where the tool has slid to since.
    over: Picked,
    /// Depth by the wheel [m].
    by_wheel: f64,
}

/// A tool that comes out after a press.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Return {
    /// Where it was pressed in.
    over: Picked,
    /// How deep [m].
    depth: f64,
    /// For how long it has been coming out [s].
    since: f64,
}

/// The state of the hand.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Gesture {
    press: Option<Press>,
    back: Option<Return>,
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
/// A tool comes out in this time [s], when a hundredth of its way is left: (1 + ωt) e^(−ωt) = 0.01 at ωt = 6.64.
const RETURN: f64 = 0.3;
const RETURN_RATE: f64 = 6.64 / RETURN;

impl Gesture {
    /// Takes the mouse's next state; the aim is none as long as the tool has not come over the organ.
    pub fn follow(&mut self, mouse: &Mouse, ground: &GestureContext<'_>) -> Option<Aim> {
        let seen = |place| {
            pick(
                ground.surface,
                ground.tree,
                ground.camera,
                place,
                ground.aspect,
            )
        };
        match (mouse.pressed, self.press, mouse.place) {
            (true, Some(mut press), Some(place)) => {
                if mouse.cuts {
                    let before = self.aim.map_or(TOUCH, |aim| aim.depth);
                    // A blade moves as the mouse does, and does not go to where that has come while it went deeper.
                    press.line += place.1 - press.last;
                    press.zero = place.1 - (before - TOUCH - press.by_wheel) / DEEPEST;
                }
                press.last = place.1;
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
                self.back = None;
                let over = seen(place);
                self.press = over.map(|over| Press {
                    line: place.1,
                    zero: place.1,
                    last: place.1,
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
                if let (Some(press), Some(aim)) = (self.press.take(), self.aim) {
                    self.back = Some(Return {
                        over: press.over,
                        depth: aim.depth,
                        since: 0.0,
                    });
                }
                if self.come_out(mouse.elapsed, ground) {
                    return self.aim;
                }
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

    /// Takes a tool that was let go further out; whether it still is on its way.
    fn come_out(&mut self, elapsed: f64, ground: &GestureContext<'_>) -> bool {
        let Some(mut back) = self.back.take() else {
            return false;
        };
        back.since += elapsed.max(0.0);
        if back.since >= RETURN {
            return false;
        }
        let turns = RETURN_RATE * back.since;
        let left = (1.0 + turns) * (-turns).exp();
        self.go(&back.over, -HOVER + (back.depth + HOVER) * left, ground);
        self.back = Some(back);
        true
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

    /// Whether the tool comes out after a press.
    pub fn is_returning(&self) -> bool {
        self.back.is_some()
    }
}

fn aimed(over: &Picked, depth: f64, ground: &GestureContext<'_>) -> Option<Aim> {
    let overhang = match ground.tip.shape {
        TipShape::Flat => 0.0,
        TipShape::Sphere => ground.tip.radius_m,
    };
    let tip = over.point + (overhang - depth) * over.normal;
    let [right, up, back] = ground.camera.axes();
    // Shaft of a hand next to the camera: steep on the surface, and out of the line of sight.
    let tilted = 0.9 * over.normal + 0.45 * up + 0.40 * right + 0.15 * back;
    let shaft = tilted.try_normalize(1e-3).unwrap_or(over.normal);
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
