//! Pieces that cuts have detached from all that is fixed.
//!
//! The triangles of the uncut surface that would join such a piece to the rest are neither displayed nor touched.

use palpate_geometry::{NodeId, TriangleId, TriangleMesh};
use palpate_mechanics::nonlinear::{EmbeddedPoints, NonlinearModel};

/// The detached piece of each vertex of a surface.
#[derive(Debug, Clone, Default)]
pub(super) struct Detached {
    /// From 1 on; zero for what is fixed. Empty without detached pieces.
    of_vertex: Vec<u32>,
}

impl Detached {
    /// For the vertices that are `embedded` in the elements of `model`.
    pub(super) fn new(model: &NonlinearModel, embedded: &EmbeddedPoints) -> Self {
        let of_vertex = match model.free_pieces() {
            0 => Vec::new(),
            _ => embedded.free_pieces(model).collect(),
        };
        Self { of_vertex }
    }

    /// The piece of each vertex; empty without detached pieces.
    pub(super) fn of_vertices(&self) -> &[u32] {
        &self.of_vertex
    }

    /// The piece of a vertex, from 1 on; zero if that is fixed.
    pub(super) fn piece(&self, vertex: NodeId) -> u32 {
        self.of_vertex.get(vertex.index()).copied().unwrap_or(0)
    }

    /// Whether a triangle of `mesh` is within one piece.
    pub(super) fn is_within_one(&self, mesh: &TriangleMesh, triangle: TriangleId) -> bool {
        is_within_one(&self.of_vertex, &mesh.corners(triangle))
    }

    /// Whether two triangles of `mesh` are within the same piece.
    pub(super) fn is_same(&self, mesh: &TriangleMesh, pair: [TriangleId; 2]) -> bool {
        let [one, other] = pair.map(|triangle| mesh.corners(triangle));
        let first = |corners: [NodeId; 3]| self.of_vertex.get(corners[0].index());
        is_within_one(&self.of_vertex, &one)
            && is_within_one(&self.of_vertex, &other)
            && first(one) == first(other)
    }
}

/// Whether a triangle with these corners is within one piece, as far as the pieces of its vertices are known.
pub(crate) fn is_within_one(of_vertex: &[u32], corners: &[NodeId; 3]) -> bool {
    let mut known = corners
        .iter()
        .filter_map(|node| of_vertex.get(node.index()));
    let first = known.next();
    known.all(|piece| Some(piece) == first)
}
