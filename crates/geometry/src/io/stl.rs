//! STL, binary and text. Written here rather than taken from a crate because a truncated file must
//! be distinguished from a whole one by its length, and because names are missing or odd in files
//! in the wild.

use super::raw::RawMesh;
use super::text::{lines, number, unexpected};
use crate::{ReadFault, Vec3};

const HEADER_BYTES: usize = 84;
const TRIANGLE_BYTES: usize = 50;

/// Whether the length is that of a binary STL with the triangles that it announces.
pub(crate) fn has_binary_length(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|n| bytes.len() as u64 == binary_length(n))
}

/// Whether this is a text STL. A binary header may begin with `solid` too, but has zero bytes.
pub(crate) fn looks_like_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(512)];
    let word = start.trim_ascii_start().get(..5);
    word.is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !start.contains(&0)
}

pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, ReadFault> {
    if !has_binary_length(bytes) && looks_like_text(bytes) {
        read_text(bytes)
    } else {
        read_binary(bytes)
    }
}

fn announced(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER_BYTES - 4..HEADER_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

fn binary_length(triangles: u32) -> u64 {
    HEADER_BYTES as u64 + TRIANGLE_BYTES as u64 * u64::from(triangles)
}

fn read_binary(bytes: &[u8]) -> Result<RawMesh, ReadFault> {
    let found = bytes.len() as u64;
    let triangles = announced(bytes).ok_or(ReadFault::Truncated {
        what: "the header of a binary STL",
        expected: HEADER_BYTES as u64,
        found,
    })?;
    let expected = binary_length(triangles);
    if found != expected {
        return Err(ReadFault::WrongLength {
            triangles,
            expected,
            found,
        });
    }
    let mut mesh = RawMesh::default();
    for record in bytes[HEADER_BYTES..].chunks_exact(TRIANGLE_BYTES) {
        // The normal comes first and is not used: the order of the corners gives the same.
        let coordinate = |k: usize| {
            let at = 12 + 4 * k;
            let four = [record[at], record[at + 1], record[at + 2], record[at + 3]];
            f64::from(f32::from_le_bytes(four))
        };
        let corner = |k: usize| Vec3::from_fn(|axis, _| coordinate(3 * k + axis));
        add_triangle(&mut mesh, [corner(0), corner(1), corner(2)])?;
    }
    mesh.check_indices()
}

fn read_text(bytes: &[u8]) -> Result<RawMesh, ReadFault> {
    let mut mesh = RawMesh::default();
    let mut corners = Vec::new();
    let mut ended = false;
    let mut last = 0;
    for (line_number, line) in lines(bytes) {
        last = line_number;
        let mut words = line.split_ascii_whitespace();
        let Some(keyword) = words.next() else {
            continue;
        };
        match keyword.to_ascii_lowercase().as_str() {
            "solid" => ended = false,
            "facet" | "outer" | "endfacet" => {}
            "vertex" => {
                let mut coordinate = || number(words.next(), line_number);
                corners.push(Vec3::new(coordinate()?, coordinate()?, coordinate()?));
            }
            "endloop" => {
                let three = <[Vec3; 3]>::try_from(std::mem::take(&mut corners))
                    .map_err(|_| unexpected(line_number, &line, "three `vertex` lines before"))?;
                add_triangle(&mut mesh, three)?;
            }
            "endsolid" => ended = true,
            _ => return Err(unexpected(line_number, &line, "a line of a text STL")),
        }
    }
    if !ended || !corners.is_empty() {
        return Err(ReadFault::EndsEarly {
            line: last,
            expected: "`endsolid`",
        });
    }
    mesh.check_indices()
}

fn add_triangle(mesh: &mut RawMesh, corners: [Vec3; 3]) -> Result<(), ReadFault> {
    let first = mesh.vertices.len() as u32;
    for corner in corners {
        mesh.add_vertex(corner)?;
    }
    mesh.add_face(&[first, first + 1, first + 2])
}
