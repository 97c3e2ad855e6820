use crate::contact::Friction;
use std::sync::Arc;

use palpate_files::scene::{CavityContent, Region};
use palpate_geometry::{Surface, TetrahedronMesh};

use super::super::rigid_tool::RigidTool;
use crate::material::law::Law;
use crate::regions::RegionPlace;
use crate::{FibreField, Vec3};

/// The geometry of the solid.
#[derive(Debug, Clone)]
pub enum Body {
    /// The inside of a surface.
    Surface(Surface),
    /// Tetrahedra, whose boundary is taken as it stands.
    Volume(TetrahedronMesh),
}

/// The part of the boundary that a tool moves: the connected part within a radius of a point. It does not turn: on a lobe that
/// bends under it this takes a moment that no face in contact has, and the force is too large, by half in an example
/// (`docs/theory/boundary_elements.md`, thin rims). A [`RigidTool`] loses contact instead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedPatch {
    /// Its centre [m]; the nearest point of the boundary is taken.
    pub center: Vec3,
    /// Its radius [m].
    pub radius: f64,
    /// Displacement of every point of it [m].
    pub displacement: Vec3,
    /// Whether it moves along with all of the displacement, or only with the component along it.
    pub friction: Friction,
}

/// Loads on a body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loads {
    /// Its weight, if it has one.
    pub weight: Option<Weight>,
    /// Forces and pressures on its boundary.
    pub on_surface: Vec<SurfaceLoad>,
}

/// Gravity and density of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weight {
    /// Acceleration of gravity [m/s²].
    pub gravity: Vec3,
    /// Density at rest [kg/m³], where no region has its own.
    pub density: f64,
}

/// A part of the body that is not of its tissue.
#[derive(Debug, Clone)]
pub struct SolidRegion {
    /// Its name in warnings.
    pub name: String,
    /// Its place.
    pub place: SolidPlace,
    /// Its content.
    pub content: RegionContent,
}

/// The content of a region of a solid.
#[derive(Debug, Clone)]
pub enum RegionContent {
    /// A tissue.
    Tissue {
        /// Its law, for small or finite strain as that of the body.
        law: Arc<dyn Law>,
        /// Density at rest [kg/m³].
        density: f64,
    },
    /// Nothing that is solid. Tissue encloses it.
    Cavity(CavityContent),
}

/// The place of a region of a solid.
#[derive(Debug, Clone)]
pub enum SolidPlace {
    /// A layer, a shape or what a surface encloses; the tetrahedra are made not to cross its border.
    Bounded(RegionPlace),
    /// The tetrahedra of [`Body::Volume`] that have this number.
    Cells(u32),
}

/// A load on a part of the boundary.
#[derive(Debug, Clone, PartialEq)]
pub enum SurfaceLoad {
    /// A force whose direction is constant.
    Force {
        /// The part.
        place: LoadPlace,
        /// The whole force [N].
        force: Vec3,
    },
    /// A pressure that stays normal to the boundary.
    Pressure {
        /// The part, at rest; none is all of the outer boundary.
        region: Option<Region>,
        /// Towards the inside [Pa]; a suction is negative.
        pressure: f64,
    },
}

/// The place where a force acts.
#[derive(Debug, Clone, PartialEq)]
pub enum LoadPlace {
    /// Evenly on the part of the boundary, at rest, in a region.
    Faces(Region),
    /// Evenly along a straight line on the boundary, such as an edge, between two points [m].
    Line([Vec3; 2]),
}

/// A solid that is fixed in one place, and moved or loaded in others.
#[derive(Debug, Clone)]
pub struct SolidProblem {
    /// The body.
    pub body: Body,
    /// The fixed triangles of its boundary: those whose centroid lies in one of the regions.
    pub anchor: Region,
    /// The part that is moved, if any.
    pub patch: Option<MovedPatch>,
    /// Its law outside of the regions; with [`crate::Strain::Small`] all is linear.
    pub law: Arc<dyn Law>,
    /// Parts of other tissue, and cavities. Shapes and surfaces are above layers, and these above cells.
    pub regions: Vec<SolidRegion>,
    /// Directions of its fibres, if it has any.
    pub fibres: Option<FibreField>,
    /// Its loads. Loads and the displacement of the patch grow together from rest.
    pub loads: Loads,
    /// Rigid tools that press it, after loads and patch have come to their full size. They move together; one whose path has
    /// fewer parts stays at its end.
    pub tools: Vec<RigidTool>,
    /// Points of the body whose displacement is computed [m].
    pub points: Vec<Vec3>,
}

impl SolidProblem {
    /// A homogeneous body that nothing moves or loads.
    pub fn new(body: Body, anchor: Region, law: Arc<dyn Law>) -> Self {
        Self {
            body,
            anchor,
            patch: None,
            law,
            regions: Vec::new(),
            fibres: None,
            loads: Loads::default(),
            tools: Vec::new(),
            points: Vec::new(),
        }
    }
}
