use super::super::rigid_tool::RigidShape;

/// Invalid parts of a solid problem.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// Neither a patch, a tool nor a load.
    #[error(
        "nothing moves or loads the body; give a patch, a tool, a weight, or a force or pressure on its surface"
    )]
    NothingLoads,
    /// A path of a tool without a beginning and an end.
    #[error("the path of tool {} has no two finite places; give where it begins and where it goes", tool + 1)]
    NoPath {
        /// Number of the tool, from 0.
        tool: usize,
    },
    /// The numbers of a tool's shape are of none.
    #[error(
        "tool {} has the shape {shape:?}; give positive lengths [m], a half angle between 0 and π/2 rad, a cylinder at least as \
         long as it is thick, and edges rounded by less than half of what they belong to", tool + 1
    )]
    NoShape {
        /// Number of the tool, from 0.
        tool: usize,
        /// The shape given.
        shape: RigidShape,
    },
    /// A coefficient of friction that is none.
    #[error("tool {} has the coefficient of friction {coefficient}; give a number from 0", tool + 1)]
    NoFriction {
        /// Number of the tool, from 0.
        tool: usize,
        /// The coefficient given [-].
        coefficient: f64,
    },
    /// A density that is none.
    #[error("the density is {density} kg/m3; give a positive number")]
    DensityOutOfRange {
        /// The value given [kg/m³].
        density: f64,
    },
    /// An acceleration or a force without a direction.
    #[error("{name} is {found:?}; give three finite numbers that are not all zero")]
    NoDirection {
        /// Its name.
        name: &'static str,
        /// The value given.
        found: [f64; 3],
    },
    /// A pressure that is none.
    #[error("the pressure of load {} is {found} Pa; give a number that is not zero", load + 1)]
    NoPressure {
        /// Number of the load, from 0.
        load: usize,
        /// The value given [Pa].
        found: f64,
    },
    /// No triangle of the boundary is in the region of a load.
    #[error(
        "load {} acts on no triangle of the body; give a plane, box or sphere that takes in a part of its surface", load + 1
    )]
    EmptyLoad {
        /// Its number, from 0.
        load: usize,
    },
    /// The line of a force leaves the boundary.
    #[error(
        "the line of load {} lies {distance} m off the surface; move it to the surface", load + 1
    )]
    LineOffSurface {
        /// Number of the force, from 0.
        load: usize,
        /// The largest distance of a point of the line [m].
        distance: f64,
    },
    /// The line of a force has no length.
    #[error("the line of load {} has no length; give two different ends", load + 1)]
    NoLine {
        /// Number of the force, from 0.
        load: usize,
    },
    /// A point whose displacement is asked for is outside the body.
    #[error("point {} lies {distance} m outside the body; move it into the body", point + 1)]
    PointOutside {
        /// Its number, from 0.
        point: usize,
        /// Its distance [m].
        distance: f64,
    },
}
