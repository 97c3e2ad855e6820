//! PLY, as text and binary of either byte order. Written here rather than taken from a crate because
//! every count must be checked against the length of the file before it is used.

mod header;
mod values;

use self::header::Element;
use self::values::{Values, check_size};
use super::raw::RawMesh;
use crate::{ReadFault, Vec3};

pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, ReadFault> {
    let header = header::read(bytes)?;
    for part in ["vertex", "face"] {
        if !header.elements.iter().any(|e| e.name == part) {
            let expected = if part == "face" { "faces" } else { "vertices" };
            return Err(ReadFault::MissingPart { expected });
        }
    }
    let mut values = Values::after(&header, bytes);
    let mut mesh = RawMesh::default();
    for element in &header.elements {
        check_size(element, &header, bytes)?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut mesh)?,
            "face" => read_faces(element, &mut values, &mut mesh)?,
            _ => skip(element, &mut values)?,
        }
    }
    mesh.check_indices()
}

fn read_vertices(
    element: &Element,
    values: &mut Values<'_>,
    mesh: &mut RawMesh,
) -> Result<(), ReadFault> {
    let column = |name: &str| element.properties.iter().position(|p| p.name == name);
    let (Some(x), Some(y), Some(z)) = (column("x"), column("y"), column("z")) else {
        return Err(ReadFault::MissingPart {
            expected: "`x`, `y` and `z` of the vertices",
        });
    };
    let mut row = Vec::new();
    let mut list = Vec::new();
    for _ in 0..element.count {
        row.clear();
        for property in &element.properties {
            row.push(match property.length {
                None => values.next(property.value)?,
                Some(_) => {
                    read_list(property, values, &mut list, mesh.vertices.len())?;
                    f64::NAN
                }
            });
        }
        mesh.add_vertex(Vec3::new(row[x], row[y], row[z]))?;
    }
    Ok(())
}

fn read_faces(
    element: &Element,
    values: &mut Values<'_>,
    mesh: &mut RawMesh,
) -> Result<(), ReadFault> {
    let is_corners = |p: &header::Property| {
        p.length.is_some() && ["vertex_indices", "vertex_index"].contains(&p.name.as_str())
    };
    let corners = element.properties.iter().position(is_corners);
    let corners = corners.ok_or(ReadFault::MissingPart {
        expected: "`vertex_indices` of the faces",
    })?;
    let mut list = Vec::new();
    for _ in 0..element.count {
        let face = mesh.faces();
        let vertices = mesh.vertices.len();
        for (column, property) in element.properties.iter().enumerate() {
            if property.length.is_none() {
                values.next(property.value)?;
                continue;
            }
            read_list(property, values, &mut list, face)?;
            if column == corners {
                let numbers = list
                    .iter()
                    .map(|&number| vertex_number(number, face, vertices));
                mesh.add_face(&numbers.collect::<Result<Vec<_>, _>>()?)?;
            }
        }
    }
    Ok(())
}

fn skip(element: &Element, values: &mut Values<'_>) -> Result<(), ReadFault> {
    // A table without columns takes no room, however many rows it announces.
    if element.properties.is_empty() {
        return Ok(());
    }
    let mut list = Vec::new();
    for row in 0..element.count {
        for property in &element.properties {
            match property.length {
                None => values.next(property.value).map(drop)?,
                Some(_) => read_list(property, values, &mut list, row as usize)?,
            }
        }
    }
    Ok(())
}

fn read_list(
    property: &header::Property,
    values: &mut Values<'_>,
    list: &mut Vec<f64>,
    row: usize,
) -> Result<(), ReadFault> {
    list.clear();
    let Some(length) = property.length else {
        return Ok(());
    };
    let length = values.next(length)?;
    if !(0.0..=f64::from(u32::MAX)).contains(&length) || length.fract() != 0.0 {
        return Err(ReadFault::BadListLength { row, found: length });
    }
    // Grown while it is read: the file ends before a wrong length has filled the memory.
    for _ in 0..length as u64 {
        list.push(values.next(property.value)?);
    }
    Ok(())
}

fn vertex_number(number: f64, face: usize, vertices: usize) -> Result<u32, ReadFault> {
    if !(0.0..=f64::from(u32::MAX)).contains(&number) || number.fract() != 0.0 {
        return Err(ReadFault::BadIndex {
            face,
            found: number as i64,
            vertices,
        });
    }
    Ok(number as u32)
}
