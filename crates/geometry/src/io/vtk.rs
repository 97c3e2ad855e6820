//! VTK XML files for ParaView: a surface with fields (`.vtp`), a grid of cells with fields (`.vtu`),
//! and a series of them in time (`.pvd`).

mod grid;

pub use grid::{CellKind, Cells, unstructured_grid};

use super::base64;
use crate::{NodeId, Vec3};

/// A named field with one value per vertex; in a grid, per node or per cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointField<'a> {
    /// As it is to appear in ParaView.
    pub name: &'a str,
    /// One value for each, in any unit, which the name should state.
    pub values: FieldValues<'a>,
}

/// The values of a field at each vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldValues<'a> {
    /// A number.
    Scalars(&'a [f64]),
    /// A vector.
    Vectors(&'a [Vec3]),
}

impl FieldValues<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Scalars(values) => values.len(),
            Self::Vectors(values) => values.len(),
        }
    }
}

/// The bytes of a `.vtp` file with vertices at `positions` [m], `triangles` and fields.
///
/// # Panics
/// When a field does not have one value per vertex.
pub fn polydata(
    positions: &[Vec3],
    triangles: &[[NodeId; 3]],
    fields: &[PointField<'_>],
) -> Vec<u8> {
    let fields: String = fields
        .iter()
        .map(|one| field(one, positions.len()))
        .collect();
    let points = vectors("Points", positions);
    let connectivity = integers(
        "connectivity",
        triangles.iter().flatten().map(|node| i64::from(node.0)),
    );
    let offsets = integers("offsets", (1..=triangles.len()).map(|k| 3 * k as i64));
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PolyData>\n\
         <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n\
         <PointData>\n{fields}</PointData>\n\
         <Points>\n{points}</Points>\n\
         <Polys>\n{connectivity}{offsets}</Polys>\n\
         </Piece>\n\
         </PolyData>\n\
         </VTKFile>\n",
        positions.len(),
        triangles.len()
    )
    .into_bytes()
}

/// The bytes of a `.pvd` file: the files of a series, each with its time [s].
pub fn collection(files: &[(f64, &str)]) -> Vec<u8> {
    let entries: String = files
        .iter()
        .map(|(time_s, file_name)| {
            let file_name = escaped(file_name);
            format!("<DataSet timestep=\"{time_s}\" part=\"0\" file=\"{file_name}\"/>\n")
        })
        .collect();
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <Collection>\n{entries}</Collection>\n\
         </VTKFile>\n"
    )
    .into_bytes()
}

fn field(field: &PointField<'_>, expected: usize) -> String {
    let given = field.values.len();
    assert_eq!(given, expected, "field `{}`", field.name);
    match field.values {
        FieldValues::Scalars(values) => scalars(field.name, values),
        FieldValues::Vectors(values) => vectors(field.name, values),
    }
}

fn scalars(name: &str, values: &[f64]) -> String {
    let bytes = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    array(name, "Float64", 1, bytes)
}

fn vectors(name: &str, values: &[Vec3]) -> String {
    let bytes = values
        .iter()
        .flat_map(|v| [v.x, v.y, v.z])
        .flat_map(f64::to_le_bytes)
        .collect();
    array(name, "Float64", 3, bytes)
}

fn integers(name: &str, values: impl Iterator<Item = i64>) -> String {
    array(
        name,
        "Int64",
        1,
        values.flat_map(i64::to_le_bytes).collect(),
    )
}

/// An array as base64 of its length in bytes followed by the bytes themselves.
fn array(name: &str, kind: &str, components: usize, bytes: Vec<u8>) -> String {
    let mut whole = (bytes.len() as u64).to_le_bytes().to_vec();
    whole.extend(bytes);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"binary\">\n{}\n</DataArray>\n",
        escaped(name),
        base64::encode(&whole)
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_names_its_files_and_times() {
        let text = String::from_utf8(collection(&[(0.0, "a.vtp"), (0.5, "b&c.vtp")])).unwrap();
        assert!(text.contains("timestep=\"0\" part=\"0\" file=\"a.vtp\""));
        assert!(text.contains("timestep=\"0.5\" part=\"0\" file=\"b&amp;c.vtp\""));
    }

    #[test]
    fn an_array_begins_with_its_length() {
        let text = scalars("force_n", &[1.0]);
        let coded = text.lines().nth(1).unwrap();
        let expected = [8u64.to_le_bytes(), 1f64.to_le_bytes()].concat();
        assert_eq!(base64::decode(coded).unwrap(), expected);
        assert!(text.contains("Name=\"force_n\""));
    }
}
