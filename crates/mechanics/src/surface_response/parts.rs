use palpate_geometry::TriangleId;

use crate::Vec3;
use crate::boundary_elements::Precision;

/// A triangle that a contact may load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchableTriangle {
    /// Its number in the mesh.
    pub triangle: TriangleId,
    /// Its centroid [m].
    pub centroid: Vec3,
    /// Outward unit normal [-].
    pub normal: Vec3,
    /// Area [m²].
    pub area: f64,
}

/// What a response consists of: to be written, and to be made one again.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseParts<T> {
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// The triangles that can be loaded, ascending in their numbers.
    pub touchable: Vec<TouchableTriangle>,
    /// Number of vertices of the mesh.
    pub vertices: usize,
    /// Displacements of the touchable triangles from unit forces on them, times E [1/m]: number
    /// 3 t (3 j + b) + 3 i + a is component a of triangle i from the component b on triangle j.
    pub at_triangles: Vec<T>,
    /// Displacements of the vertices, times E [1/m]: number 3 v (3 j + b) + 3 i + a is component a of
    /// vertex i from the component b on triangle j.
    pub at_vertices: Vec<T>,
}

impl<T: Precision> ResponseParts<T> {
    /// Of the right lengths, without a displacement.
    pub(crate) fn zeros(
        poissons_ratio: f64,
        touchable: Vec<TouchableTriangle>,
        vertices: usize,
    ) -> Self {
        let columns = 3 * touchable.len();
        Self {
            poissons_ratio,
            vertices,
            at_triangles: vec![T::of(0.0); columns * columns],
            at_vertices: vec![T::of(0.0); columns * 3 * vertices],
            touchable,
        }
    }

    /// What is wrong with them, if anything.
    pub(super) fn fault(&self) -> Option<&'static str> {
        let columns = 3 * self.touchable.len();
        let (square, wide) = (columns * columns, columns * 3 * self.vertices);
        let finite = |values: &[T]| values.iter().all(|&value| value.into().is_finite());
        let ascends = |pair: &[TouchableTriangle]| pair[0].triangle < pair[1].triangle;
        let sound = |t: &TouchableTriangle| {
            t.area > 0.0
                && t.area.is_finite()
                && (t.normal.norm() - 1.0).abs() < 1e-6
                && t.centroid.iter().all(|c| c.is_finite())
        };
        let yields = |k| self.at_triangles[k * columns + k] > T::of(0.0);
        if columns == 0 {
            Some("no triangle can be touched")
        } else if !self.touchable.windows(2).all(ascends) {
            Some("its triangles do not ascend")
        } else if !self.touchable.iter().all(sound) {
            Some("a triangle has no area, normal or place")
        } else if self.at_triangles.len() != square || self.at_vertices.len() != wide {
            Some("numbers are missing or too many")
        } else if !finite(&self.at_triangles) || !finite(&self.at_vertices) {
            Some("it holds values that are no numbers")
        } else if !(0..columns).all(yields) {
            Some("a triangle moves against its force")
        } else {
            None
        }
    }
}
