use super::rigid_tool::RigidShape;
use super::supports::RigidSurface;

/// Numbers of the caller that do not fit a finite element model: found before any work.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Mismatch {
    /// A support names a node that the mesh does not have.
    #[error("{what} names node {node} of a mesh of {nodes} nodes; give numbers below {nodes}")]
    NodeBeyondMesh {
        /// Which support.
        what: &'static str,
        /// The number given, from 0.
        node: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A support fixes a component that the displacement of a node does not have.
    #[error(
        "component {axis} of node {node} is fixed, but a node has {dimension} components; give a number below {dimension}"
    )]
    ComponentOutOfRange {
        /// The number given, from 0.
        axis: usize,
        /// The node.
        node: usize,
        /// Components of a displacement.
        dimension: usize,
    },
    /// A side of a cavity with too few nodes or too many.
    #[error(
        "side {side} of the cavity has {found} nodes; give {expected}, in the order of `Cavity`"
    )]
    CavitySide {
        /// The side's number, from 0.
        side: usize,
        /// How many nodes it has.
        found: usize,
        /// How many it must have.
        expected: usize,
    },
    /// A node slides on a sphere where nothing can.
    #[error(
        "node {node} slides on a rigid surface, which only an axisymmetric body of Quad9 elements can, outside a path; fix its displacement instead"
    )]
    CannotSlide {
        /// The node.
        node: usize,
    },
    /// A rigid surface that there cannot be.
    #[error(
        "node {node} slides on the surface {surface:?}; give a finite height, and a positive radius or an angle between 0 and π/2"
    )]
    SurfaceOutOfRange {
        /// The node.
        node: usize,
        /// The surface [m, rad].
        surface: RigidSurface,
    },
    /// A force of friction that is no number.
    #[error(
        "node {node} slides with a tangential force of {force_ratio} times the normal force; give a finite number, 0 without friction"
    )]
    ForceRatioOutOfRange {
        /// The node.
        node: usize,
        /// The value given [-].
        force_ratio: f64,
    },
    /// A coefficient that no friction has.
    #[error(
        "an indenter with a coefficient of friction of {coefficient}; give a finite number that is not negative"
    )]
    FrictionOutOfRange {
        /// The coefficient [-].
        coefficient: f64,
    },
    /// An indenter that there cannot be.
    #[error(
        "the indenter {shape:?} does not exist; give an edge that is rounded to less than the radius, and a half angle between 0 and \
         π/2"
    )]
    IndenterOutOfRange {
        /// Its shape [m, rad].
        shape: RigidShape,
    },
    /// A node slides that is also fixed, or slides twice.
    #[error(
        "node {node} slides on a rigid surface and is fixed as well, or slides on two; remove one of the supports"
    )]
    SlidesAndIsFixed {
        /// The node.
        node: usize,
    },
    /// Numbers that do not belong to the model.
    #[error("{what} has {found} numbers; give {expected}, those of this model")]
    WrongLength {
        /// Which list.
        what: &'static str,
        /// How many numbers it has.
        found: usize,
        /// How many it must have.
        expected: usize,
    },
    /// A path that does not set out.
    #[error("the first step of the path goes to {first} of the full load; give a number above 0")]
    FirstStepOutOfRange {
        /// The value given [-].
        first: f64,
    },
    /// A size of elements that no mesh can have.
    #[error(
        "elements are {edge} times as long as the patch is wide; give a number above 0 and at most 1"
    )]
    ElementSizeOutOfRange {
        /// The value given [-].
        edge: f64,
    },
    /// Half a ball that ends next to its punch.
    #[error(
        "the half ball has {radius} times the radius of its punch; give a number of at least 3"
    )]
    HalfBallTooSmall {
        /// The value given [-].
        radius: f64,
    },
    /// Lines of a mesh under a punch that do not fit together.
    #[error(
        "the {line} lines of the mesh under a punch do not ascend or do not meet their neighbours; give two ascending places or more, the first where the line before ends"
    )]
    PunchedLinesOutOfOrder {
        /// Which line.
        line: &'static str,
    },
}

impl Mismatch {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::NodeBeyondMesh { .. }
            | Self::ComponentOutOfRange { .. }
            | Self::CavitySide { .. }
            | Self::CannotSlide { .. }
            | Self::SurfaceOutOfRange { .. }
            | Self::ForceRatioOutOfRange { .. }
            | Self::FrictionOutOfRange { .. }
            | Self::IndenterOutOfRange { .. }
            | Self::SlidesAndIsFixed { .. }
            | Self::WrongLength { .. }
            | Self::FirstStepOutOfRange { .. }
            | Self::ElementSizeOutOfRange { .. }
            | Self::HalfBallTooSmall { .. }
            | Self::PunchedLinesOutOfOrder { .. } => true,
        }
    }
}
