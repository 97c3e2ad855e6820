//! glTF 2.0 and GLB: all triangles of all nodes of the scene, in place, in metres as the standard
//! has it. Written here rather than taken from a crate because the usual one panics on damaged
//! documents and brings picture formats along.

mod accessor;
mod buffers;
mod document;
mod frame;

use std::path::Path;

use nalgebra::{Matrix4, Point3};

use self::accessor::Source;
use self::buffers::open_buffers;
use self::document::{Document, Primitive, part};
pub(crate) use self::frame::MAGIC;
use super::raw::RawMesh;
use crate::ReadFault;

/// Reads a document or a GLB; `folder` is where its buffers may lie.
pub(crate) fn read(bytes: &[u8], folder: &Path) -> Result<RawMesh, ReadFault> {
    let (text, chunk) = frame::split(bytes)?;
    let document = Document::parse(text)?;
    let source = Source {
        buffers: open_buffers(&document, chunk, folder)?,
        document: &document,
    };
    let mut mesh = RawMesh::default();
    let mut seen = vec![false; document.nodes.len()];
    let mut waiting: Vec<_> = document
        .roots()
        .into_iter()
        .map(|node| (node, Matrix4::identity()))
        .collect();
    while let Some((number, world_from_parent)) = waiting.pop() {
        let node = part(&document.nodes, number, "node")?;
        // A node that is its own grandchild would be read for ever.
        if std::mem::replace(&mut seen[number], true) {
            let cause = format!("node {number} has several parents");
            return Err(ReadFault::invalid_gltf(cause));
        }
        let world_from_node = world_from_parent * node.parent_from_node();
        if let Some(number) = node.mesh {
            for primitive in &part(&document.meshes, number, "mesh")?.primitives {
                add_primitive(&mut mesh, primitive, &source, &world_from_node)?;
            }
        }
        waiting.extend(node.children.iter().map(|&child| (child, world_from_node)));
    }
    mesh.check_indices()
}

fn add_primitive(
    mesh: &mut RawMesh,
    primitive: &Primitive,
    source: &Source<'_>,
    world_from_node: &Matrix4<f64>,
) -> Result<(), ReadFault> {
    let mode = primitive.mode.unwrap_or(4);
    let (4..=6, Some(positions)) = (mode, primitive.attributes.position) else {
        return Ok(());
    };
    let first = mesh.vertices.len();
    let before = mesh.triangles.len();
    for position in source.positions(positions)? {
        let in_world = world_from_node.transform_point(&Point3::from(position));
        mesh.add_vertex(in_world.coords)?;
    }
    let count = mesh.vertices.len() - first;
    let numbers = match primitive.indices {
        Some(indices) => source.indices(indices)?,
        None => (0..count as u32).collect(),
    };
    for corners in triangles(&numbers, mode) {
        if let Some(&wrong) = corners.iter().find(|&&c| c as usize >= count) {
            return Err(ReadFault::BadIndex {
                face: mesh.faces(),
                found: i64::from(wrong),
                vertices: count,
            });
        }
        mesh.add_face(&corners.map(|corner| corner + first as u32))?;
    }
    if world_from_node.determinant() < 0.0 {
        // A mirrored part would be inside out; the standard asks for this too.
        for triangle in &mut mesh.triangles[before..] {
            triangle.swap(1, 2);
        }
    }
    Ok(())
}

fn triangles(numbers: &[u32], mode: u32) -> Box<dyn Iterator<Item = [u32; 3]> + '_> {
    match mode {
        // Every other triangle of a strip runs backward.
        5 => {
            let strip = numbers.windows(3).enumerate();
            Box::new(strip.map(|(k, w)| [w[k % 2], w[1 - k % 2], w[2]]))
        }
        6 => {
            let rim = numbers.get(1..).unwrap_or(&[]).windows(2);
            Box::new(rim.map(|w| [numbers[0], w[0], w[1]]))
        }
        _ => Box::new(numbers.chunks_exact(3).map(|w| [w[0], w[1], w[2]])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_turn_as_their_first_triangle() {
        let all = |numbers, mode| triangles(numbers, mode).collect::<Vec<_>>();
        assert_eq!(all(&[0, 1, 2, 3], 5), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(all(&[0, 1, 2, 3], 6), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(all(&[0, 1, 2, 3], 4), [[0, 1, 2]]);
        assert!(all(&[], 6).is_empty());
    }
}
