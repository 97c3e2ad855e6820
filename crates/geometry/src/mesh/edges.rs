use crate::{NodeId, TriangleId};

/// One side of one triangle, with its ends in ascending order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    pub(crate) low: NodeId,
    pub(crate) high: NodeId,
    pub(crate) triangle: TriangleId,
    /// Whether the triangle runs from `low` to `high`.
    pub(crate) ascending: bool,
}

/// All sides of all triangles, sorted so that those of one edge lie together (see [`by_edge`]).
///
/// Sorted rather than hashed, so that every walk over them has the same order on every run.
pub(crate) fn sides(triangles: &[[NodeId; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (number, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            if from == to {
                continue;
            }
            sides.push(Side {
                low: from.min(to),
                high: from.max(to),
                triangle: TriangleId(number as u32),
                ascending: from < to,
            });
        }
    }
    sides.sort_unstable();
    sides
}

/// The sides of one edge at a time.
pub(crate) fn by_edge(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
}
