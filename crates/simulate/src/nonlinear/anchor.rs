use palpate_geometry::{AabbTree, Surface, Vec3};

/// The anchor of a body on the boundary of its mesh, which deviates from the surface by a part of an edge: a point of
/// the boundary is fixed if the closest point of the surface is.
pub(super) struct Anchor<'a> {
    surface: &'a Surface,
    tree: AabbTree,
    holds: Box<dyn Fn(&Vec3) -> bool + 'a>,
}

impl<'a> Anchor<'a> {
    /// The anchor of the body within `surface`; `holds` returns whether a point [m] is fixed.
    pub(super) fn new(surface: &'a Surface, holds: impl Fn(&Vec3) -> bool + 'a) -> Self {
        Self {
            surface,
            tree: AabbTree::new(surface.mesh()),
            holds: Box::new(holds),
        }
    }

    /// Whether a point of the boundary of the mesh [m] is fixed.
    pub(super) fn is_fixed(&self, place: &Vec3) -> bool {
        let mesh = self.surface.mesh();
        let nearest = self.tree.nearest(mesh, place);
        // An anchor that ends in the plane of a triangle contains it; rounding of a point on it would hide that.
        let corners = mesh.positions(nearest.triangle);
        (self.holds)(&nearest.on.position) || corners.iter().all(&self.holds)
    }
}
