//! Moves of boundary vertices that do not make tetrahedra worse.

use super::facets::{Facets, On};
use crate::mesh::tetrahedra::{dihedral_angles, six_fold_volume};
use crate::{AabbTree, Surface, Vec3};

/// Angles below this are not made by moving a vertex to a level or a sharp edge [rad].
pub(super) const MOVED_FLOOR: f64 = 0.17;

/// Angles below this are not made by splitting an edge [rad].
pub(super) const CUT_FLOOR: f64 = 0.05;

/// A chord of a sharp edge is this near to it, in lengths of the chord [-].
const NEAR_EDGE: f64 = 0.2;

/// A surface, its tree, and its facets where it has sharp edges.
pub(super) struct SearchedSurface<'a> {
    surface: &'a Surface,
    tree: AabbTree,
    pub(super) facets: Option<Facets<'a>>,
}

impl<'a> SearchedSurface<'a> {
    pub(super) fn new(surface: &'a Surface) -> Self {
        Self {
            surface,
            tree: AabbTree::new(surface.mesh()),
            facets: Facets::new(surface),
        }
    }

    /// The facets that a point [m] lies on; none where there are no sharp edges.
    pub(super) fn facets_at(&self, point: &Vec3) -> On {
        let facets = self.facets.as_ref();
        facets.map_or_else(On::new, |facets| facets.at(&self.tree, point))
    }

    /// The point of the surface nearest to `point` [m].
    pub(super) fn nearest(&self, point: &Vec3) -> Vec3 {
        self.tree.nearest(self.surface.mesh(), point).on.position
    }

    /// The point of the surface nearest to a point of the chord between two others [m]; on a sharp edge, where the chord is one of it.
    pub(super) fn under_chord(&self, ends: [&Vec3; 2]) -> impl Fn(&Vec3) -> Vec3 {
        let on = ends.map(|end| self.facets_at(end));
        let reach = NEAR_EDGE * (ends[1] - ends[0]).norm();
        move |point| {
            let facets = self.facets.as_ref();
            let edge = facets.and_then(|facets| facets.nearest_on_edge(point, [&on[0], &on[1]]));
            let edge = edge.filter(|place| (place - point).norm() <= reach);
            edge.unwrap_or_else(|| self.nearest(point))
        }
    }

    /// New position of a vertex that slides from `start` towards `target` [m] and stays on its
    /// facets.
    pub(super) fn slide(&self, start: &Vec3, target: &Vec3) -> Vec3 {
        let nearest = self.nearest(target);
        let own = self.facets_at(start);
        match own.is_empty() || own == self.facets_at(&nearest) {
            true => nearest,
            false => *start,
        }
    }
}

/// Dihedral quality: the smallest of all angles between faces and of their supplements [rad];
/// negative when inverted.
pub(crate) fn dihedral_quality(positions: &[Vec3; 4]) -> f64 {
    if six_fold_volume(positions) <= 0.0 {
        return -1.0;
    }
    dihedral_angles(positions)
        .into_iter()
        .map(|angle| angle.min(std::f64::consts::PI - angle))
        .fold(f64::INFINITY, f64::min)
}

/// Moves `node` to `target` [m], unless a tetrahedron around it would then have a lower quality than
/// both `floor` [rad] and the worst before. Returns whether it moved.
pub(crate) fn move_if_valid<'a>(
    vertices: &mut [Vec3],
    star: impl Iterator<Item = [u32; 4]> + Clone + 'a,
    node: u32,
    target: Vec3,
    floor: f64,
) -> bool {
    let worst = |vertices: &[Vec3]| {
        star.clone()
            .map(|nodes| dihedral_quality(&nodes.map(|n| vertices[n as usize])))
            .fold(f64::INFINITY, f64::min)
    };
    let before = worst(vertices);
    let here = std::mem::replace(&mut vertices[node as usize], target);
    if worst(vertices) >= before.min(floor) {
        return true;
    }
    vertices[node as usize] = here;
    false
}
