use std::ops::ControlFlow;

use palpate_geometry::{TriangleId, Vec3};
use palpate_mechanics::boundary_elements::BoundaryProblem;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::surface_response::{
    MovedTriangle, PatchContact, PatchWorkspace, Reciprocity, SurfaceResponse, TouchId,
};

use super::body::Body;
use crate::Error;

/// Young's modulus [Pa]; no displacement depends on it.
const YOUNGS_MODULUS: f64 = 1e4;

/// A body whose triangle opposite the fixed ones is pressed in, bonded to a tool.
pub(crate) struct Pressed {
    /// The pressed triangle.
    pub(crate) triangle: TriangleId,
    /// Its centroid at rest [m].
    pub(crate) place: Vec3,
    /// Its unit outward normal at rest [-].
    pub(crate) normal: Vec3,
    /// Displacement of all centroids [m].
    pub(crate) displacements: Vec<Vec3>,
}

impl Pressed {
    /// By `depth` [m].
    pub(crate) fn new(body: &Body, depth: f64) -> Result<Self, Error> {
        let triangle = body.opposite()[0];
        let problem = BoundaryProblem {
            touchable: &[triangle],
            ..body.problem()
        };
        let go_on = &mut |_| ControlFlow::Continue(());
        let response: SurfaceResponse = problem.solve(usize::MAX, go_on)?;
        let normal = body.touched_normal();
        let moved = MovedTriangle {
            triangle: TouchId(0),
            displacement: -depth * normal,
        };
        let contact = PatchContact {
            friction: Friction::Bonded,
            reciprocity: Reciprocity::Imposed,
            youngs_modulus: YOUNGS_MODULUS,
        };
        let mut workspace = PatchWorkspace::new(1);
        let forces = response.press(&[moved], &contact, &mut workspace);
        let [force] = forces.unwrap_or_default() else {
            return Err(Error::failed(
                "the triangle moves against the force on it; its mesh is too coarse to be pressed",
            ));
        };
        let mesh = body.surface.mesh();
        let mut field = vec![0.0_f32; 3 * mesh.triangles().len()];
        response.add_field(moved.triangle, &(force / YOUNGS_MODULUS), &mut field);
        let displacements = field
            .as_chunks()
            .0
            .iter()
            .map(|&[x, y, z]| Vec3::new(f64::from(x), f64::from(y), f64::from(z)));
        Ok(Self {
            triangle,
            place: mesh.positions(triangle).iter().sum::<Vec3>() / 3.0,
            normal,
            displacements: displacements.collect(),
        })
    }
}
