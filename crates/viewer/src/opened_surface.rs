use std::sync::atomic::{AtomicU64, Ordering};

use palpate_geometry::{CutSurface, NodeId, Surface, TriangleId, TriangleMesh, Vec3};
use palpate_simulate::gape;
use palpate_simulate::interactive::OpenedSnapshot;

use crate::render::single_precision;

/// No two surfaces have the same triangles, as far as a picture knows.
static NEXT: AtomicU64 = AtomicU64::new(1);

/// A cut surface that is opened for a picture, without mechanics.
#[derive(Debug, Clone)]
pub struct OpenedSurface {
    mesh: TriangleMesh,
    places: Vec<Vec3>,
    drawn: OpenedSnapshot,
}

impl OpenedSurface {
    /// Of `cut` in `surface`, whose vertices are at `moved` [m], with openings up to `width` wide [m].
    pub fn new(cut: &CutSurface, surface: &Surface, moved: &[Vec3], width: f64) -> Self {
        let rims = rims(cut);
        let mut places = Vec::new();
        cut.place(surface, moved, 0.0, &mut places);
        for (place, way) in places.iter_mut().zip(gape(cut, width)) {
            *place += way;
        }
        let mesh = cut.mesh().clone();
        let triangles = mesh.triangles().iter();
        Self {
            drawn: OpenedSnapshot {
                version: NEXT.fetch_add(1, Ordering::Relaxed),
                rest: single_precision(mesh.vertices()),
                places: single_precision(&places),
                triangles: triangles
                    .map(|corners| corners.map(|node| node.0))
                    .collect(),
                detached: Vec::new(),
                parts: Vec::new(),
                around: Vec::new(),
                below: Vec::new(),
                rims: rims.iter().map(|ends| ends.map(|node| node.0)).collect(),
            },
            places,
            mesh,
        }
    }

    /// As pictures take it.
    pub fn drawn(&self) -> &OpenedSnapshot {
        &self.drawn
    }

    /// The triangles at rest.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Where the vertices are [m].
    pub fn places(&self) -> &[Vec3] {
        &self.places
    }
}

/// The ends of the open edges of `cut`.
fn rims(cut: &CutSurface) -> Vec<[NodeId; 2]> {
    let of_triangle = |triangle: TriangleId| {
        let corners = cut.mesh().corners(triangle);
        let sides = cut.sides(triangle).into_iter().enumerate();
        sides
            .filter(|(_, side)| side.is_some())
            .map(move |(edge, _)| [corners[edge], corners[(edge + 1) % 3]])
    };
    cut.mesh().triangle_ids().flat_map(of_triangle).collect()
}
