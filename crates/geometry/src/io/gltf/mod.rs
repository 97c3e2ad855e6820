//! glTF 2.0 and GLB: all triangles of all nodes of the scene, in place, in metres as the standard
//! has it. The crate `gltf` reads the document; the bytes are read here, because every offset must be
//! held against the length of its buffer before it is believed.

mod accessor;
mod buffers;

use std::path::Path;

use ::gltf::mesh::Mode;
use ::gltf::{Document, Gltf, Node, Primitive, Semantic};
use nalgebra::{Matrix4, Point3};

use self::buffers::Buffers;
use super::raw::RawMesh;
use crate::ReadFault;

/// First bytes of a GLB.
pub(crate) const MAGIC: &[u8] = b"glTF";

/// Reads a document or a GLB; `folder` is where its buffers may lie.
pub(crate) fn read(bytes: &[u8], folder: &Path) -> Result<RawMesh, ReadFault> {
    check_frame(bytes)?;
    let Gltf { document, blob } = Gltf::from_slice(bytes).map_err(|error| ReadFault::Gltf {
        cause: error.to_string(),
    })?;
    let buffers = Buffers::open(&document, blob, folder)?;
    let mut mesh = RawMesh::default();
    let mut seen = vec![false; document.nodes().len()];
    let mut waiting: Vec<_> = roots(&document)
        .into_iter()
        .map(|node| (node, Matrix4::identity()))
        .collect();
    while let Some((node, world_from_parent)) = waiting.pop() {
        // A node that is its own grandchild would be read for ever.
        if std::mem::replace(&mut seen[node.index()], true) {
            return Err(ReadFault::Gltf {
                cause: format!("node {} has several parents", node.index()),
            });
        }
        let parent_from_node = Matrix4::from(node.transform().matrix()).map(f64::from);
        let world_from_node = world_from_parent * parent_from_node;
        for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
            add_primitive(&mut mesh, &primitive, &buffers, &world_from_node)?;
        }
        waiting.extend(node.children().map(|child| (child, world_from_node)));
    }
    mesh.check_indices()
}

/// The crate subtracts the length of this header without a check.
fn check_frame(bytes: &[u8]) -> Result<(), ReadFault> {
    const HEADER_BYTES: u64 = 12;
    if !bytes.starts_with(MAGIC) {
        return Ok(());
    }
    let found = bytes.len() as u64;
    let announced = bytes.get(8..12).and_then(|four| four.try_into().ok());
    let announced = announced.map_or(0, |four| u64::from(u32::from_le_bytes(four)));
    if announced < HEADER_BYTES || announced > found {
        return Err(ReadFault::Truncated {
            what: "the GLB",
            expected: announced.max(HEADER_BYTES),
            found,
        });
    }
    Ok(())
}

/// Nodes without a parent: those of the scene, or all when there is none.
fn roots(document: &Document) -> Vec<Node<'_>> {
    let scene = document
        .default_scene()
        .or_else(|| document.scenes().next());
    if let Some(scene) = scene {
        return scene.nodes().collect();
    }
    let mut is_child = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children()) {
        is_child[child.index()] = true;
    }
    let is_root = |node: &Node<'_>| !is_child[node.index()];
    document.nodes().filter(is_root).collect()
}

fn add_primitive(
    mesh: &mut RawMesh,
    primitive: &Primitive<'_>,
    buffers: &Buffers,
    world_from_node: &Matrix4<f64>,
) -> Result<(), ReadFault> {
    let mode = primitive.mode();
    if !matches!(
        mode,
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
    ) {
        return Ok(());
    }
    let Some(positions) = primitive.get(&Semantic::Positions) else {
        return Ok(());
    };
    let first = mesh.vertices.len();
    let before = mesh.triangles.len();
    for position in accessor::positions(&positions, buffers)? {
        let in_world = world_from_node.transform_point(&Point3::from(position));
        mesh.add_vertex(in_world.coords)?;
    }
    let count = mesh.vertices.len() - first;
    let numbers = match primitive.indices() {
        Some(indices) => accessor::indices(&indices, buffers)?,
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
        mesh.triangles[before..]
            .iter_mut()
            .for_each(|triangle| triangle.swap(1, 2));
    }
    Ok(())
}

fn triangles(numbers: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => numbers
            .windows(3)
            .enumerate()
            .map(|(k, w)| {
                if k % 2 == 0 {
                    [w[0], w[1], w[2]]
                } else {
                    [w[1], w[0], w[2]]
                }
            })
            .collect(),
        Mode::TriangleFan => numbers
            .get(1..)
            .unwrap_or(&[])
            .windows(2)
            .map(|w| [numbers[0], w[0], w[1]])
            .collect(),
        _ => numbers
            .chunks_exact(3)
            .map(|w| [w[0], w[1], w[2]])
            .collect(),
    }
}
