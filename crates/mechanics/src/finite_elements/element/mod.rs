//! Reference elements, before they have a place in a mesh.
//!
//! All are quadratic in the displacement. [`ElementKind::Quad9`] lies in the half-plane (r, z) of an
//! axisymmetric body; the others are solids.
//!
//! *How we know*: `battery::…`, one for all kinds.
//!
//! *Limits*: no shells, no linear elements (they lock or are far too stiff under a punch).

#[cfg(test)]
mod battery;
mod quadrature;
mod tensor;
mod tetrahedron;

/// The kinds of element, with the numbering of their nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementKind {
    /// Biquadratic quadrilateral; node i + 3 j stands at ξ = i − 1, η = j − 1.
    Quad9,
    /// Triquadratic hexahedron; node i + 3 j + 9 k stands at ξ = i − 1, η = j − 1, ζ = k − 1.
    Hex27,
    /// Quadratic tetrahedron; corners 0 to 3, then the middles of 01, 12, 02, 03, 13, 23.
    Tet10,
}

/// A point of an element's own coordinates, with its share of the reference volume.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QuadraturePoint {
    pub(crate) at: [f64; 3],
    pub(crate) weight: f64,
}

impl ElementKind {
    /// Number of nodes.
    pub fn nodes(self) -> usize {
        match self {
            Self::Quad9 => 9,
            Self::Hex27 => 27,
            Self::Tet10 => 10,
        }
    }

    /// Number of coordinates, which is that of displacements at a node.
    pub fn dimension(self) -> usize {
        match self {
            Self::Quad9 => 2,
            Self::Hex27 | Self::Tet10 => 3,
        }
    }

    /// Shape functions [-] at `at`, one for each node.
    pub(crate) fn shape(self, at: [f64; 3], values: &mut [f64]) {
        match self {
            Self::Quad9 | Self::Hex27 => tensor::shape(self.dimension(), at, values),
            Self::Tet10 => tetrahedron::shape(at, values),
        }
    }

    /// Their gradients in the element's own coordinates [-], one for each node.
    pub(crate) fn shape_gradients(self, at: [f64; 3], gradients: &mut [[f64; 3]]) {
        match self {
            Self::Quad9 | Self::Hex27 => tensor::gradients(self.dimension(), at, gradients),
            Self::Tet10 => tetrahedron::gradients(at, gradients),
        }
    }

    /// Its corners, where the pressures of a mixed element stand.
    pub fn corners(self) -> &'static [usize] {
        match self {
            Self::Quad9 => &[0, 2, 6, 8],
            Self::Hex27 => &[0, 2, 6, 8, 18, 20, 24, 26],
            Self::Tet10 => &[0, 1, 2, 3],
        }
    }

    /// Functions of one degree less [-] at `at`, one for each corner.
    pub(crate) fn corner_shape(self, at: [f64; 3], values: &mut [f64]) {
        match self {
            Self::Quad9 | Self::Hex27 => tensor::corner_shape(self.dimension(), at, values),
            Self::Tet10 => values.copy_from_slice(&tetrahedron::barycentric(at)[..values.len()]),
        }
    }

    /// A rule that is exact for the stiffness of an undistorted element.
    pub(crate) fn quadrature(self) -> Vec<QuadraturePoint> {
        match self {
            Self::Quad9 => quadrature::gauss(2),
            Self::Hex27 => quadrature::gauss(3),
            Self::Tet10 => quadrature::tetrahedron(),
        }
    }

    /// The nodes' own coordinates.
    pub fn node_coordinates(self, node: usize) -> [f64; 3] {
        match self {
            Self::Quad9 | Self::Hex27 => tensor::node(self.dimension(), node),
            Self::Tet10 => tetrahedron::node(node),
        }
    }
}
