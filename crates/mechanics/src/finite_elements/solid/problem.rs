use crate::contact::Friction;
use std::sync::Arc;

use palpate_files::scene::Region;
use palpate_geometry::{Surface, TetrahedronMesh};

use crate::Vec3;
use crate::material::law::Law;

/// What the solid fills.
#[derive(Debug, Clone)]
pub enum Body {
    /// The inside of a surface.
    Surface(Surface),
    /// Tetrahedra, whose boundary is taken as it stands.
    Volume(TetrahedronMesh),
}

/// The part of the boundary that a tool moves: what lies within a radius of a point and hangs together
/// with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedPatch {
    /// Its centre [m]; the nearest point of the boundary is taken.
    pub center: Vec3,
    /// Its radius [m].
    pub radius: f64,
    /// How far every point of it moves [m].
    pub displacement: Vec3,
    /// Whether it moves along with all of the displacement, or only with the component along it.
    pub grip: Friction,
}

/// A solid that is held in one place and moved in another.
#[derive(Debug, Clone)]
pub struct SolidProblem {
    /// The body.
    pub body: Body,
    /// Where it is held: in the triangles of its boundary whose centroid lies in one of the regions.
    pub anchor: Region,
    /// Where it is moved.
    pub patch: MovedPatch,
    /// Its law; with [`crate::Strain::Small`] all is linear.
    pub law: Arc<dyn Law>,
}
