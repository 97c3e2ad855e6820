use super::{PointField, array, field, integers, vectors};
use crate::Vec3;

/// The kind of the cells of a grid, with VTK's order of nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellKind {
    /// Four corners.
    Tetrahedron,
    /// Four corners, then the middles of the edges 01, 12, 02, 03, 13, 23.
    QuadraticTetrahedron,
    /// Four corners, then the middles of the edges 01, 12, 23, 30, then the centre.
    BiquadraticQuad,
    /// Eight corners (four below, four above), the middles of the edges below, above and upright,
    /// the centres of the faces −x, +x, −y, +y, −z, +z, and the centre.
    TriquadraticHexahedron,
}

impl CellKind {
    /// The number that VTK has for it.
    pub fn code(self) -> u8 {
        match self {
            Self::Tetrahedron => 10,
            Self::QuadraticTetrahedron => 24,
            Self::BiquadraticQuad => 28,
            Self::TriquadraticHexahedron => 29,
        }
    }

    /// Nodes of a cell.
    pub fn nodes(self) -> usize {
        match self {
            Self::Tetrahedron => 4,
            Self::QuadraticTetrahedron => 10,
            Self::BiquadraticQuad => 9,
            Self::TriquadraticHexahedron => 27,
        }
    }
}

/// The cells of a grid, all of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cells<'a> {
    /// Their kind.
    pub kind: CellKind,
    /// Their nodes, one cell after the other.
    pub nodes: &'a [u32],
}

/// The bytes of a `.vtu` file with nodes at `positions` [m], `cells`, fields with one value per node
/// and fields with one value per cell.
///
/// # Panics
/// When a field has another number of values, or the nodes do not make whole cells.
pub fn unstructured_grid(
    positions: &[Vec3],
    cells: &Cells<'_>,
    point_fields: &[PointField<'_>],
    cell_fields: &[PointField<'_>],
) -> Vec<u8> {
    let per_cell = cells.kind.nodes();
    assert_eq!(cells.nodes.len() % per_cell, 0, "nodes make whole cells");
    let count = cells.nodes.len() / per_cell;
    let all = |fields: &[PointField<'_>], expected: usize| -> String {
        fields.iter().map(|one| field(one, expected)).collect()
    };
    let point_fields = all(point_fields, positions.len());
    let cell_fields = all(cell_fields, count);
    let points = vectors("Points", positions);
    let connectivity = integers("connectivity", cells.nodes.iter().map(|&n| i64::from(n)));
    let offsets = integers("offsets", (1..=count).map(|k| (per_cell * k) as i64));
    let types = array("types", "UInt8", 1, vec![cells.kind.code(); count]);
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{count}\">\n\
         <PointData>\n{point_fields}</PointData>\n\
         <CellData>\n{cell_fields}</CellData>\n\
         <Points>\n{points}</Points>\n\
         <Cells>\n{connectivity}{offsets}{types}</Cells>\n\
         </Piece>\n\
         </UnstructuredGrid>\n\
         </VTKFile>\n",
        positions.len()
    )
    .into_bytes()
}
