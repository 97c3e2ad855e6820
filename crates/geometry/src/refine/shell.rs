//! Vertices of the boundary move, and no tetrahedron may suffer.

use crate::mesh::tetrahedra::{dihedral_angles, six_fold_volume};
use crate::{AabbTree, Surface, Vec3};

/// A surface and its tree.
pub(super) struct SearchedSurface<'a> {
    surface: &'a Surface,
    tree: AabbTree,
}

impl<'a> SearchedSurface<'a> {
    pub(super) fn new(surface: &'a Surface) -> Self {
        let tree = AabbTree::new(surface.mesh());
        Self { surface, tree }
    }

    /// The point of the surface nearest to `point` [m].
    pub(super) fn nearest(&self, point: &Vec3) -> Vec3 {
        self.tree.nearest(self.surface.mesh(), point).on.position
    }
}

/// How far its angles are from flat: the smallest of all angles between faces and of their
/// supplements [rad]; negative when it is inverted.
pub(crate) fn dihedral_quality(positions: &[Vec3; 4]) -> f64 {
    if six_fold_volume(positions) <= 0.0 {
        return -1.0;
    }
    dihedral_angles(positions)
        .into_iter()
        .map(|angle| angle.min(std::f64::consts::PI - angle))
        .fold(f64::INFINITY, f64::min)
}

/// Moves `node` to `target` [m], unless one of the tetrahedra around it would then be less open than
/// both `floor` [rad] and the worst of them before. Whether it moved.
pub(crate) fn move_if_sound<'a>(
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
