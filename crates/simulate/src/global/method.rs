use palpate_files::scene::ResponseMethod;
use palpate_geometry::Surface;

use crate::walls::Walls;

/// More tetrahedra are not tried: a wall with so many takes minutes, a thick body some gigabytes.
pub(super) const MAX_TETRAHEDRA: f64 = 25_000.0;

/// Where a wall is lost between tetrahedra, ones with this part of the edge are tried [-], so many times
/// in all.
const SHORTER: f64 = 0.8;
const TRIES: i32 = 3;

/// The method that solves a response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Method {
    BoundaryElements,
    /// With tetrahedra whose edges are no longer than this [m].
    FiniteElements {
        edge: f64,
    },
}

impl Method {
    /// Its name, for people.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::BoundaryElements => "boundary elements",
            Self::FiniteElements { .. } => "condensed finite elements",
        }
    }

    /// Finite-element settings for a surface with its walls, if requested: the best first, the next ones for the case
    /// that walls are lost between its tetrahedra, of which there are at most `most`. Only finite elements support
    /// several tissues.
    pub(super) fn finite(
        wanted: ResponseMethod,
        has_regions: bool,
        surface: &Surface,
        walls: &Walls,
        most: f64,
    ) -> Vec<Self> {
        let finite = match wanted {
            ResponseMethod::Automatic => has_regions || walls.are_thin(),
            ResponseMethod::BoundaryElements => false,
            ResponseMethod::FiniteElements => true,
        };
        if !finite {
            return Vec::new();
        }
        let shortest = (12.0 * surface.mesh().volume() / most).cbrt();
        // Where no wall bends, they need not be as small as the triangles.
        let edge = walls.edge_of_tetrahedra().max(shortest);
        let edges = (0..TRIES).map(|tries| edge * SHORTER.powi(tries));
        let edges = edges.filter(|edge| *edge >= shortest);
        edges.map(|edge| Self::FiniteElements { edge }).collect()
    }
}
