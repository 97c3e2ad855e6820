use serde::Serialize;

/// A reason not to touch a mesh as it is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MeshProblem {
    /// Which.
    pub kind: ProblemKind,
    /// How many edges, vertices, triangles or pieces have it.
    pub count: usize,
    /// The remedy, as a sentence.
    #[serde(rename = "mend")]
    pub remedy: &'static str,
}

/// The problems that a mesh can have.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ProblemKind {
    /// Edges with one triangle.
    NotClosed,
    /// Edges with more than two triangles, and vertices where separate fans touch.
    NotManifold,
    /// Edges whose triangles disagree about the outside; all triangles when they face inward.
    NotOriented,
    /// Pieces that do not hang together.
    SeveralPieces,
    /// Triangles that pass through others.
    SelfIntersecting,
    /// Shells that are a thin sheet with two sides instead of a solid.
    DoubleWall,
    /// Triangles with hardly any area.
    DegenerateTriangles,
    /// Triangles with a corner below two degrees.
    SliverTriangles,
    /// Vertices that no triangle uses.
    UnusedVertices,
    /// The size is that of no organ.
    ImplausibleSize,
}

impl ProblemKind {
    /// The problem with its remedy, unless it does not occur.
    pub(super) fn times(self, count: usize) -> Option<MeshProblem> {
        (count > 0).then(|| MeshProblem {
            kind: self,
            count,
            remedy: self.remedy(),
        })
    }

    fn remedy(self) -> &'static str {
        match self {
            Self::NotClosed => {
                "Weld coincident vertices; if borders remain, wrap the mesh (`palpate mesh wrap`) or fill the holes."
            }
            Self::NotManifold => {
                "Remove inner walls and doubled triangles, and pull apart what touches in a vertex; or wrap the mesh."
            }
            Self::NotOriented => "Turn all triangles to face outward.",
            Self::SeveralPieces => {
                "Weld coincident vertices; if several pieces remain, keep one, join them, or wrap the mesh."
            }
            Self::SelfIntersecting => {
                "Wrap the mesh (`palpate mesh wrap`), or pull the crossing parts apart in a mesh editor."
            }
            Self::DoubleWall => {
                "The mesh is a thin sheet with an inner and an outer side; keep the outer side and close it to a solid."
            }
            Self::DegenerateTriangles => {
                "Weld coincident vertices, then remesh the surface where triangles have no area."
            }
            Self::SliverTriangles => {
                "Remesh the surface with even triangles if results are uneven there."
            }
            Self::UnusedVertices => "Drop the vertices that no triangle uses.",
            Self::ImplausibleSize => {
                "An organ measures 5 mm to 0.6 m; set mesh_unit to the unit of the file."
            }
        }
    }
}
