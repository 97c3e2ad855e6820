use std::path::PathBuf;

use palpate_devices::OpenError;
use palpate_geometry::{MeshError, OrganError, ReadError, SimplifyError};

/// Why a scene cannot be simulated.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file of the scene is invalid or cannot be read.
    #[error(transparent)]
    File(#[from] palpate_files::Error),
    /// A mesh cannot be read.
    #[error(transparent)]
    Mesh(#[from] ReadError),
    /// A mesh encloses no solid.
    #[error("{path}: {fault}", path = path.display())]
    NoSolid {
        /// The mesh.
        path: PathBuf,
        /// What is wrong with it.
        fault: MeshError,
    },
    /// A scene with undrawn random numbers.
    #[error(
        "the scene draws its numbers for each attempt; draw a variant of it first (`draw_variant`)"
    )]
    NotDrawn,
    /// A neighbour cannot have the location that the scene gives it.
    #[error(
        "a neighbour bounds no solid where it is placed ({fault}); give `at_m` and `scale` that fit a body"
    )]
    Misplaced {
        /// The problem with it there.
        fault: MeshError,
    },
    /// A neighbour that bends has no fixed part.
    #[error(
        "the anchor of body number {number} beside the organ (those of `[[neighbour]]`, then further `[[organ]]`) takes in \
         no vertex of it, and it could move without force; give planes, boxes or spheres of the scene that take in a part of \
         its surface"
    )]
    LooseNeighbour {
        /// In the order of the scene, from 1.
        number: usize,
    },
    /// A built-in organ cannot be made.
    #[error(transparent)]
    Organ(#[from] OrganError),
    /// The model cannot be made.
    #[error(transparent)]
    Model(#[from] palpate_mechanics::Error),
    /// A mesh cannot be made coarser.
    #[error(transparent)]
    Simplify(#[from] SimplifyError),
    /// The coarse mechanical mesh encloses no solid.
    #[error(
        "the mechanical mesh that was made of the organ's: {0}; set another `model.mechanical_triangles`"
    )]
    MechanicalMesh(MeshError),
    /// The anchor and the touchable region leave no touchable triangle.
    #[error(
        "no triangle of the organ can be touched: the anchor holds all of them, or `organ.touchable` names none that is free; make `organ.anchor` smaller or `organ.touchable` larger"
    )]
    NothingTouchable,
    /// The layers are thicker than their body.
    #[error(
        "down to the layer {layer:?} the layers are {sum_mm} mm thick, but the organ is {wall_mm} mm thick in most places; give thinner `organ.layer`s",
        sum_mm = millimetres(*sum),
        wall_mm = millimetres(*wall)
    )]
    LayersTooThick {
        /// The layer.
        layer: String,
        /// Thickness of the layers down to it [m].
        sum: f64,
        /// Thickness of the organ [m].
        wall: f64,
    },
    /// A cut is deeper than the organ is thick.
    #[error(
        "a cut would be {depth_mm} mm deep, but the organ is {wall_mm} mm thick in most places; set a smaller `cutting.depth_m`",
        depth_mm = millimetres(*depth),
        wall_mm = millimetres(*wall)
    )]
    CutTooDeep {
        /// Its depth [m].
        depth: f64,
        /// Thickness of the organ [m].
        wall: f64,
    },
    /// A stored response belongs to other inputs.
    #[error("{path} is the response of another organ; delete it, and it is made again when it is needed", path = path.display())]
    OtherResponse {
        /// The file.
        path: PathBuf,
    },
    /// A device or its loop cannot be run.
    #[error(transparent)]
    Servo(#[from] palpate_servo::Fault),
    /// The number of devices differs from the number of tools.
    #[error(
        "the scene has {tools} tools, but {devices} devices were given; give one, or none, for each"
    )]
    OtherDevices {
        /// Tools of the scene.
        tools: usize,
        /// Given devices, including nones.
        devices: usize,
    },
    /// The centre of an estimated inclusion is outside the organ.
    #[error(
        "the middle of the organ's part {name:?} lies {} mm outside of the organ; move it in (`palpate mesh info` reports where the organ lies)",
        millimetres(*.outside)
    )]
    EstimatedOutside {
        /// Its name.
        name: String,
        /// How far outside [m].
        outside: f64,
    },
    /// An inclusion reaches out of the organ.
    #[error(
        "the organ's part {name:?} reaches {} mm out of the organ; make it smaller or move it in (`palpate mesh info` tells where the organ lies)",
        millimetres(*.outside)
    )]
    InclusionOutside {
        /// Its name.
        name: String,
        /// How far [m].
        outside: f64,
    },
    /// The elements do not enclose a cavity.
    #[error(
        "the elements of the nonlinear model do not enclose the cavity {name:?}: it is too small for them, or too close to the surface or to another one; make it larger, move it, or raise `model.nodes`"
    )]
    CavityNotEnclosed {
        /// Its name.
        name: String,
    },
    /// The organ has no equilibrium with the pressures in its cavities.
    #[error(
        "the organ does not come to rest under the pressure in its cavities, which its tissue bears as it is when it has relaxed; lower their `pressure_pa`"
    )]
    CavityPressure,
    /// Two inclusions overlap.
    #[error("the organ's parts {one:?} and {other:?} overlap; move them apart")]
    InclusionsOverlap {
        /// The name of one.
        one: String,
        /// The name of the other.
        other: String,
    },
    /// A session was recorded under conditions other than those of its scene now.
    #[error(
        "the session was recorded with the {what} {was}, and its scene now has {is}; it can be scored, but not be played again"
    )]
    OtherSession {
        /// The condition.
        what: &'static str,
        /// Its recorded value.
        was: String,
        /// Its current value.
        is: String,
    },
    /// No expert session at this path.
    #[error(
        "{path} holds no session; name a session's folder, or a folder in which there are some", path = path.display()
    )]
    NoExpert {
        /// The path.
        path: std::path::PathBuf,
    },
    /// The rows of a session cannot be written.
    #[error("{cause}")]
    Unrecorded {
        /// The reason, in a sentence.
        cause: String,
    },
    /// There is nothing to replay.
    #[error("the session has no row; record one in which a tool moves")]
    EmptySession,
    /// The device of a tool cannot be opened.
    #[error("the tool {tool:?} has no device: {why}")]
    NoDevice {
        /// The tool.
        tool: String,
        /// The reason.
        why: OpenError,
    },
    /// A tool would pass through the abdominal wall inside the organ.
    #[error(
        "the trocar of the tool {tool:?} lies inside the organ, {:.1} mm below its surface; move `trocar_m` to the abdominal wall, outside of it", 1e3 * depth
    )]
    TrocarInOrgan {
        /// The tool.
        tool: String,
        /// How deep it lies [m].
        depth: f64,
    },
    /// The target of a task is on no touchable surface.
    #[error(
        "`task.touch.target_m` is {:.1} mm from the nearest neighbour that collides, but only a tip within {:.1} mm of it counts; move it to the surface of that neighbour", 1e3 * distance, 1e3 * tolerance
    )]
    TargetOutOfReach {
        /// Distance of the surface [m].
        distance: f64,
        /// Largest allowed distance [m].
        tolerance: f64,
    },
    /// The line of a cutting task has no length.
    #[error("the line of `task.cut` is too short to be one; give it some millimetres")]
    NoLine,
    /// The line of a cutting task is away from the organ.
    #[error(
        "the line of `task.cut` is up to {:.1} mm from the organ's surface, but no cut more than {:.1} mm from it passes; move it to the surface, or make it smaller", 1e3 * distance, 1e3 * tolerance
    )]
    LineOffOrgan {
        /// The largest distance from the surface [m].
        distance: f64,
        /// The largest allowed distance [m].
        tolerance: f64,
    },
    /// The model thread panicked.
    #[error("the model thread panicked, and the devices were stopped; report it as a defect")]
    ModelPanicked,
    /// Another model cannot take over during this touch.
    #[error("the simulation cannot continue with this model: {why}; restart")]
    NoTakeOver {
        /// The reason.
        why: &'static str,
    },
    /// The motion moves a tool that is not in the scene.
    #[error("the motion moves the tool {found:?}, but the scene has {known}; name one of these")]
    UnknownTool {
        /// The name in the motion.
        found: String,
        /// The names in the scene.
        known: String,
    },
    /// The motion has implausibly many steps.
    #[error(
        "the motion lasts {duration} s, which is {steps} steps of {step} s; at most {most} are played: cut the motion or set a longer `model.step_s`"
    )]
    TooLong {
        /// Length of the motion [s].
        duration: f64,
        /// Length of a step [s].
        step: f64,
        /// Number of steps.
        steps: u64,
        /// Largest number of steps.
        most: u64,
    },
}

/// Rounded to a hundredth.
fn millimetres(length: f64) -> f64 {
    (1e5 * length).round() / 100.0
}

impl Error {
    /// Whether the input is invalid, rather than the disk at fault.
    pub fn is_input(&self) -> bool {
        match self {
            Self::NoSolid { fault, .. }
            | Self::Misplaced { fault }
            | Self::MechanicalMesh(fault) => fault.is_input(),
            Self::NoDevice { why, .. } => why.is_input(),
            Self::File(error) => error.is_input(),
            Self::Mesh(error) => error.is_input(),
            Self::Organ(error) => error.is_input(),
            Self::Model(error) => error.is_input(),
            Self::Simplify(error) => error.is_input(),
            Self::Servo(error) => error.is_input(),
            Self::Unrecorded { .. } | Self::ModelPanicked | Self::NoTakeOver { .. } => false,
            Self::NotDrawn
            | Self::NothingTouchable
            | Self::LooseNeighbour { .. }
            | Self::LayersTooThick { .. }
            | Self::CutTooDeep { .. }
            | Self::OtherResponse { .. }
            | Self::OtherDevices { .. }
            | Self::EstimatedOutside { .. }
            | Self::InclusionOutside { .. }
            | Self::InclusionsOverlap { .. }
            | Self::CavityNotEnclosed { .. }
            | Self::CavityPressure
            | Self::OtherSession { .. }
            | Self::NoExpert { .. }
            | Self::EmptySession
            | Self::TrocarInOrgan { .. }
            | Self::TargetOutOfReach { .. }
            | Self::NoLine
            | Self::LineOffOrgan { .. }
            | Self::UnknownTool { .. }
            | Self::TooLong { .. } => true,
        }
    }
}
