//! Tetrahedra that cover a body, and their cuts by its surface.

use crate::{AabbTree, Surface, Vec3};

/// A point nearer to the surface than this part of the edge lies on it [-].
const ON: f64 = 1e-9;

/// Tetrahedra around and in a body, each of whose points is inside, outside or on its surface.
pub(super) trait Background {
    /// How many points there are.
    fn points(&self) -> usize;

    /// How many edges are cut.
    fn cuts(&self) -> usize;

    fn place(&self, number: u32) -> Place;

    /// Current position of a point [m].
    fn position(&self, number: u32) -> Vec3;

    /// The cut of the edge between these points [m], and its number.
    fn cut(&self, inside: u32, outside: u32) -> Option<(u32, Vec3)>;

    /// Whether the quadrilateral that the face p, q, n keeps (n being outside) is cut from p to the cut
    /// of q, rather than from q to the cut of p. The answer must be the same for both tetrahedra at the face, and
    /// must not be cyclic over the three faces at a point outside.
    fn diagonal_from_first(&self, p: u32, q: u32, n: u32) -> bool;

    /// Visits all tetrahedra.
    fn visit(&self, see: &mut dyn FnMut([u32; 4]));
}

/// The place of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Inside,
    Outside,
    On,
}

impl Place {
    /// Of a point at a signed distance from the surface [m], an end of edges of about this length [m].
    pub(super) fn at(distance: f64, edge: f64) -> Self {
        if distance.abs() <= ON * edge {
            Self::On
        } else if distance < 0.0 {
            Self::Inside
        } else {
            Self::Outside
        }
    }
}

/// A cut of an edge, from the point inside to the one outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    pub(super) ends: [u32; 2],
    pub(super) position: Vec3,
}

/// Among `cuts` in ascending order of their ends.
pub(super) fn find_cut(cuts: &[Cut], inside: u32, outside: u32) -> Option<(u32, Vec3)> {
    let ends = [inside, outside];
    let found = cuts.binary_search_by_key(&ends, |cut| cut.ends).ok()?;
    Some((found as u32, cuts[found].position))
}

/// The first point where a segment from inside to outside leaves the body. A ray may slip through a
/// gap of rounding; then halving finds a change of sign.
pub(super) fn crossing(surface: &Surface, tree: &AabbTree, from: Vec3, to: Vec3) -> Vec3 {
    let way = to - from;
    let length = way.norm();
    let hit = tree.cast(surface.mesh(), &from, &(way / length), length);
    if let Some(hit) = hit {
        return from + way * (hit.distance / length);
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if surface.signed_distance(tree, &(from + way * middle)).1 < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    from + way * (0.5 * (low + high))
}
