//! Wavefront OBJ: vertices and faces; groups, materials, normals and textures are passed over.
//! Written here rather than taken from a crate because the usual one cuts the mesh at the borders
//! of its groups and reads single precision.

use super::raw::RawMesh;
use super::text::{lines, number, unexpected};
use crate::{ReadFault, Vec3};

pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, ReadFault> {
    let mut mesh = RawMesh::default();
    let mut corners = Vec::new();
    for (line_number, line) in lines(bytes) {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut coordinate = || number(words.next(), line_number);
                mesh.add_vertex(Vec3::new(coordinate()?, coordinate()?, coordinate()?))?;
            }
            Some("f") => {
                corners.clear();
                for word in words {
                    corners.push(corner(word, &mesh, line_number)?);
                }
                mesh.add_face(&corners)?;
            }
            _ => {}
        }
    }
    mesh.check_indices()
}

/// A corner as `7`, `7/1`, `7/1/3` or `7//3`, from one; negative counts back from the last vertex.
fn corner(word: &str, mesh: &RawMesh, line: usize) -> Result<u32, ReadFault> {
    let position = word.split('/').next().unwrap_or("");
    let found: i64 = position
        .parse()
        .map_err(|_| unexpected(line, word, "a vertex number"))?;
    let vertices = mesh.vertices.len();
    let from_zero = match found {
        1.. => found.checked_sub(1),
        0 => None,
        ..0 => found.checked_add(vertices as i64),
    };
    from_zero
        .and_then(|n| u32::try_from(n).ok())
        .ok_or(ReadFault::BadIndex {
            face: mesh.faces(),
            found,
            vertices,
        })
}
