use crate::contact::Friction;
use nalgebra::Rotation3;

use super::super::cavity::Cavity;
use super::super::mesh::ElementMesh;
use super::super::model::FiniteElementModel;
use super::super::pressed_faces::PressedFaces;
use super::super::rigid_tool::{RigidTool, ToolLoad};
use super::super::supports::Supports;
use super::problem::MovedPatch;
use super::supports::PrescribedNodes;
use crate::{FibreFrame, Vec3};

/// The frame in which a body is solved: that of the scene, or one whose third axis points along the
/// displacement, so that a patch that slides across it has one prescribed component.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// From the scene into the frame.
    turn: Rotation3<f64>,
    /// The prescribed components of the patch.
    prescribed: [bool; 3],
    displacement: Vec3,
}

impl Frame {
    pub(super) fn new(patch: Option<&MovedPatch>) -> Self {
        let Some(patch) = patch else {
            return Self {
                turn: Rotation3::identity(),
                prescribed: [false; 3],
                displacement: Vec3::zeros(),
            };
        };
        let along = patch.displacement;
        let axis = along.iamax();
        let is_axis = (0..3).all(|i| i == axis || along[i] == 0.0);
        let (turn, prescribed) = match patch.friction {
            Friction::Bonded => (Rotation3::identity(), [true; 3]),
            Friction::Frictionless if is_axis => {
                (Rotation3::identity(), [0, 1, 2].map(|i| i == axis))
            }
            Friction::Frictionless => {
                // Nearly opposite vectors have no rotation between them.
                let to = if along.z < 0.0 { -Vec3::z() } else { Vec3::z() };
                let turn = Rotation3::rotation_between(&along, &to);
                (turn.unwrap_or_default(), [false, false, true])
            }
        };
        Self {
            turn,
            prescribed,
            displacement: turn * along,
        }
    }

    /// The same with a patch that is free.
    pub(super) fn without_patch(&self) -> Self {
        Self {
            prescribed: [false; 3],
            ..*self
        }
    }

    pub(super) fn mesh_in_frame(&self, mut mesh: ElementMesh) -> ElementMesh {
        for node in &mut mesh.nodes {
            *node = self.turn * *node;
        }
        mesh
    }

    /// A vector of the frame in the scene.
    pub(super) fn in_scene(&self, vector: &Vec3) -> Vec3 {
        self.turn.inverse() * vector
    }

    /// Directions of the scene in the frame.
    pub(super) fn fibres_in_frame(&self, fibres: &FibreFrame) -> FibreFrame {
        fibres.turned(&self.turn)
    }

    /// A tool in the frame.
    pub(super) fn tool_in_frame(&self, tool: &RigidTool) -> RigidTool {
        RigidTool {
            orientation: self.turn * tool.orientation,
            path: tool.path.iter().map(|place| self.turn * place).collect(),
            ..tool.clone()
        }
    }

    /// The force on a tool, from the frame to the scene.
    pub(super) fn load_in_scene(&self, load: &ToolLoad) -> ToolLoad {
        ToolLoad {
            position: self.in_scene(&load.position),
            force: self.in_scene(&load.force),
            moment: self.in_scene(&load.moment),
            ..*load
        }
    }

    /// A vector of the scene in the frame.
    pub(super) fn in_frame(&self, vector: &Vec3) -> Vec3 {
        self.turn * vector
    }
}

/// Boundary conditions and loads of a solid.
#[derive(Debug)]
pub(super) struct Conditions<'a> {
    pub(super) frame: &'a Frame,
    pub(super) prescribed: &'a PrescribedNodes,
    /// Whole forces at the unknowns [N], in the frame.
    pub(super) load: &'a [f64],
    /// Whole pressures in cavities [Pa].
    pub(super) pressures: &'a [(&'a Cavity, f64)],
    /// Whole pressures on the outer boundary [Pa].
    pub(super) pressed: &'a [(PressedFaces, f64)],
    /// Whole growths of the cavities that are full of a fluid [m³].
    pub(super) growths: &'a [f64],
}

impl Conditions<'_> {
    /// Whether there is a patch that moves, or a load.
    pub(super) fn move_or_load(&self) -> bool {
        let has_fluid = self.growths.iter().any(|growth| *growth != 0.0);
        let has_pressure = !(self.pressures.is_empty() && self.pressed.is_empty());
        has_fluid
            || has_pressure
            || self.frame.prescribed.contains(&true)
            || self.load.iter().any(|force| *force != 0.0)
    }

    /// The supports at this `part` [-] of the displacement of the patch and of the loads.
    pub(super) fn supports(&self, model: &FiniteElementModel, part: f64) -> Supports<'_> {
        let Self {
            frame,
            prescribed,
            load,
            pressures,
            pressed,
            growths,
        } = self;
        let mut supports = Supports::none(model);
        supports.growths = growths.iter().map(|growth| part * growth).collect();
        supports.dead_load = Some((load, part));
        for (cavity, pressure) in *pressures {
            supports = supports.press(cavity, part * pressure);
        }
        let pressed = pressed.iter();
        supports.pressed = pressed.map(|(faces, own)| (faces, part * own)).collect();
        for axis in 0..3 {
            supports = supports.fix(model, prescribed.anchored.iter().copied(), axis, 0.0);
            if frame.prescribed[axis] {
                let at = part * frame.displacement[axis];
                supports = supports.fix(model, prescribed.moved.iter().copied(), axis, at);
            }
        }
        supports
    }
}
