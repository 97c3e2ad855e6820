//! Pictures of tools: parts that are made once, in the tool's frame, and put in place for every
//! picture.
//!
//! The tip is the origin and the shaft runs along +z. Jaws turn about an axis along y, so that they open
//! along x, each by asin(o / (2 l)) at an opening o between tips at a distance l from the hinge; a grip of
//! 1 shuts them. A shaft is as long as it must be to reach its trocar: it is stretched, not made anew.
//!
//! *How we know*: `tests::every_part_bounds_a_solid`, `tests::jaws_open_as_far_as_they_say`, `golden::…`.
//!
//! *Limits*: the metal mirrors a fictitious room; a jaw does not bend.

mod hinge;
mod hook;
mod jaw;
mod revolved;
mod scissors;
mod solid;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use nalgebra::{Matrix4, UnitQuaternion};
use palpate_files::scene::{self, Jaws, Tip, TipShape, ToolKind};
use palpate_geometry::{TriangleMesh, Vec3};

use super::labels::Label;

/// Radius of a laparoscopic shaft [m].
const SHAFT: f64 = 0.0025;

/// Length of a shaft without a trocar [m], and what is seen of it beyond one [m].
const REACH: f64 = 0.3;
const BEYOND: f64 = 0.03;

/// Parts of a tool at most.
pub(super) const PARTS: usize = 5;

/// A tool where it is.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolPicture {
    /// Its shape.
    pub(super) shape: ToolShape,
    /// Its tip: the centre of a flat face or of a ball, or between the ends of jaws [m].
    pub(super) tip: Vec3,
    /// From the tool's frame to the scene; the shaft runs along its +z.
    pub(super) turned: UnitQuaternion<f64>,
    /// From the tip to the end of the shaft [m].
    reach: f64,
    /// From 0, open, to 1, shut [-].
    grip: f64,
    /// Where the shaft passes through the wall [m].
    trocar: Option<Vec3>,
    /// The place of the resting surface that it touches [m] and the radius of the mark there [m].
    pub(super) mark: Option<(Vec3, f64)>,
    /// Its label in a picture of labels.
    pub(super) label: Label,
}

/// Look of a tool.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ToolShape {
    kind: ToolKind,
    tip: TipShape,
    /// Of the tip [m].
    radius: f64,
    /// Radius of the shaft [m].
    pub(super) shaft: f64,
    jaws: JawSize,
    has_trocar: bool,
    /// Instead of what its kind looks like.
    look: Option<Look>,
}

/// A mesh in the tool's frame. Another one is another look, whatever it holds.
#[derive(Debug, Clone)]
struct Look(Arc<TriangleMesh>);

impl PartialEq for Look {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The jaws of a grasper, or the blades of scissors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JawSize {
    /// From the hinge to the tip [m].
    length: f64,
    /// [m]
    width: f64,
    /// Between the tips when they are open [m].
    opening: f64,
}

/// Width of blades, of which a scene says nothing [m].
const BLADES: f64 = 0.004;

/// Material of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Material {
    Steel,
    /// Insulation of a shaft.
    Black,
    /// A trocar, and the end of an insulation.
    Pale,
}

/// How a part is put in place.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    /// With the tool.
    Fixed,
    /// From a height [m] to the end of the shaft; one metre long as it was made.
    Stretched { from: f64 },
    /// About the hinge; 1 towards +x, -1 towards -x.
    Turned { side: f64 },
    /// On the shaft, where it passes through the wall.
    Sleeve,
}

/// A part: how it moves, what it is of, and position and normal of three corners of each triangle.
pub(super) struct Part {
    motion: Motion,
    material: Material,
    pub(super) corners: Vec<[f32; 6]>,
}

impl ToolPicture {
    /// `tool` at `position` [m], turned by the quaternion `orientation` (x, y, z, w), with a shaft up to its trocar and a
    /// little beyond. Its jaws are open.
    pub fn new(tool: &scene::Tool, position: [f64; 3], orientation: [f64; 4]) -> Self {
        let [x, y, z, w] = orientation;
        let at = Vec3::from(position);
        let trocar = tool.trocar_m.map(Vec3::from);
        let reach = trocar.map_or(REACH, |trocar| (trocar - at).norm() + BEYOND);
        Self {
            shape: ToolShape::of(tool),
            tip: at,
            turned: UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z)),
            reach: reach.max(0.03),
            grip: 0.0,
            trocar,
            mark: None,
            label: Label::Tool(0),
        }
    }

    /// The same as another label.
    #[must_use]
    pub fn labelled(mut self, label: Label) -> Self {
        self.label = label;
        self
    }

    /// The same, with a mark where it touches the resting surface [m].
    #[must_use]
    pub fn touching(mut self, place: Vec3) -> Self {
        self.mark = Some((place, 1.35 * self.shape.radius.max(5e-4)));
        self
    }

    /// The same with the look of a mesh in its frame, if it has one.
    #[must_use]
    pub fn looking_like(mut self, mesh: Option<&Arc<TriangleMesh>>) -> Self {
        self.shape.look = mesh.cloned().map(Look);
        self
    }

    /// The same with its jaws closed by `grip`, from 0, open, to 1, shut [-].
    #[must_use]
    pub fn gripping(mut self, grip: f64) -> Self {
        self.grip = grip.clamp(0.0, 1.0);
        self
    }

    /// The axis of the part that shades the organ [m].
    pub(super) fn capsule(&self) -> (Vec3, Vec3) {
        let along = self.turned * Vec3::z();
        let lift = match self.shape.kind {
            ToolKind::Grasper | ToolKind::Scissors => 0.5 * self.shape.jaws.length,
            ToolKind::Hook => 0.5 * hook::LENGTH,
            ToolKind::Probe => match self.shape.tip {
                TipShape::Flat => self.shape.shaft,
                TipShape::Sphere => 0.0,
            },
        };
        let far = self.reach.min(0.12);
        (self.tip + lift * along, self.tip + far * along)
    }

    /// From the frame that `part` was made in to the scene.
    pub(super) fn placed(&self, part: &Part) -> Matrix4<f64> {
        let mut placed = self.turned.to_homogeneous();
        placed.fixed_view_mut::<3, 1>(0, 3).copy_from(&self.tip);
        placed * self.moved(part.motion)
    }

    /// From a part's own frame to the tool's.
    fn moved(&self, motion: Motion) -> Matrix4<f64> {
        match motion {
            Motion::Fixed => Matrix4::identity(),
            Motion::Stretched { from } => {
                let length = (self.reach - from).max(1e-3);
                Matrix4::new_translation(&(from * Vec3::z()))
                    * Matrix4::new_nonuniform_scaling(&Vec3::new(1.0, 1.0, length))
            }
            Motion::Turned { side } => {
                let hinge = self.shape.jaws.length * Vec3::z();
                // The jaw hangs below its hinge: a turn about -y takes it towards +x.
                let angle = -side * self.shape.jaws.angle() * (1.0 - self.grip);
                Matrix4::new_translation(&hinge)
                    * Matrix4::from_axis_angle(&Vec3::y_axis(), angle)
                    * Matrix4::new_translation(&-hinge)
            }
            Motion::Sleeve => {
                let along = self.turned * Vec3::z();
                let up = self.trocar.map_or(0.0, |at| (at - self.tip).dot(&along));
                Matrix4::new_translation(&(up * Vec3::z()))
            }
        }
    }
}

impl Part {
    /// Colour, as linear red, green and blue, and polish [-].
    pub(super) fn look(&self) -> [f32; 4] {
        match self.material {
            Material::Steel => [0.78, 0.80, 0.84, 1.0],
            Material::Black => [0.030, 0.032, 0.036, 0.0],
            Material::Pale => [0.42, 0.50, 0.54, 0.0],
        }
    }
}

impl Look {
    /// Position and normal of three corners of each triangle.
    fn corners(&self) -> Vec<[f32; 6]> {
        let mesh = &self.0;
        let corners = mesh.triangle_ids().flat_map(|id| {
            let normal = mesh.area_vector(id).try_normalize(0.0).unwrap_or_default();
            mesh.positions(id).map(|at| {
                [at.x, at.y, at.z, normal.x, normal.y, normal.z].map(|number| number as f32)
            })
        });
        corners.collect()
    }
}

impl JawSize {
    fn of(tool: &scene::Tool) -> Self {
        let jaws = tool.jaws.unwrap_or(match tool.kind {
            ToolKind::Scissors => Jaws::SCISSORS,
            _ => Jaws::GRASPER,
        });
        let is_blade = jaws.width_m <= 0.0;
        Self {
            length: jaws.length_m,
            width: if is_blade { BLADES } else { jaws.width_m },
            opening: jaws.opening_m,
        }
    }

    /// How far each jaw is turned when they are open [rad].
    fn angle(&self) -> f64 {
        // No jaw opens further than a right angle to the shaft.
        (0.5 * self.opening / self.length).clamp(0.0, 1.0).asin()
    }
}

impl ToolShape {
    fn of(tool: &scene::Tool) -> Self {
        let Tip {
            shape, radius_m, ..
        } = tool.tip;
        let shaft = SHAFT.max(match shape {
            TipShape::Flat => radius_m,
            TipShape::Sphere => 0.6 * radius_m,
        });
        Self {
            kind: tool.kind,
            tip: shape,
            radius: radius_m,
            shaft: match tool.kind {
                ToolKind::Probe => shaft,
                _ => SHAFT,
            },
            jaws: JawSize::of(tool),
            has_trocar: tool.trocar_m.is_some(),
            look: None,
        }
    }

    /// The parts, in their own frames.
    pub(super) fn parts(&self) -> Vec<Part> {
        let steel = |motion, corners| Part {
            motion,
            material: Material::Steel,
            corners,
        };
        let mut parts = match (&self.look, self.kind) {
            (Some(look), _) => vec![steel(Motion::Fixed, look.corners())],
            (None, ToolKind::Probe) => {
                let (tip, end) = revolved::probe(self.tip, self.radius, self.shaft);
                vec![
                    steel(Motion::Fixed, tip),
                    steel(Motion::Stretched { from: end }, revolved::shaft(self.shaft)),
                ]
            }
            (None, ToolKind::Grasper | ToolKind::Scissors) => {
                let blade = |side: f64| match self.kind {
                    ToolKind::Grasper => jaw::corners(&self.jaws, side),
                    _ => scissors::corners(&self.jaws, side),
                };
                let from = self.jaws.length + hinge::LENGTH;
                vec![
                    steel(Motion::Fixed, hinge::corners(&self.jaws, self.shaft)),
                    steel(Motion::Turned { side: 1.0 }, blade(1.0)),
                    steel(Motion::Turned { side: -1.0 }, blade(-1.0)),
                    self.insulated(from),
                ]
            }
            (None, ToolKind::Hook) => vec![
                steel(Motion::Fixed, hook::wire()),
                Part {
                    motion: Motion::Fixed,
                    material: Material::Pale,
                    corners: hook::collar(self.shaft),
                },
                self.insulated(hook::LENGTH),
            ],
        };
        if self.has_trocar {
            parts.push(Part {
                motion: Motion::Sleeve,
                material: Material::Pale,
                corners: revolved::sleeve(self.shaft),
            });
        }
        parts
    }

    /// A shaft that conducts only inside.
    fn insulated(&self, from: f64) -> Part {
        Part {
            motion: Motion::Stretched { from },
            material: Material::Black,
            corners: revolved::shaft(self.shaft),
        }
    }
}
