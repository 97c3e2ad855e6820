use std::path::Path;

use super::vtk;
use crate::{LengthUnit, ReadFault, TriangleMesh, Vec3};

/// A format that meshes are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WriteFormat {
    /// STL, binary: single precision, every corner written out.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// PLY, binary.
    Ply,
    /// VTK XML, for ParaView.
    Vtp,
}

impl WriteFormat {
    /// The format that the extension of a file names.
    ///
    /// # Errors
    /// When it is none of them.
    pub fn of(path: &Path) -> Result<Self, ReadFault> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        match extension.to_ascii_lowercase().as_str() {
            "stl" => Ok(Self::Stl),
            "obj" => Ok(Self::Obj),
            "ply" => Ok(Self::Ply),
            "vtp" => Ok(Self::Vtp),
            _ => Err(ReadFault::UnwrittenExtension {
                found: extension.chars().take(40).collect(),
            }),
        }
    }

    /// The bytes of a file that holds `mesh`, with its coordinates in `unit`.
    pub fn bytes(self, mesh: &TriangleMesh, unit: LengthUnit) -> Vec<u8> {
        let vertices = mesh.vertices().iter();
        let vertices: Vec<Vec3> = vertices.map(|v| v / unit.in_metres()).collect();
        match self {
            Self::Stl => stl(mesh, &vertices),
            Self::Obj => obj(mesh, &vertices),
            Self::Ply => ply(mesh, &vertices),
            Self::Vtp => vtk::polydata(&vertices, mesh.triangles(), &[]),
        }
    }
}

fn stl(mesh: &TriangleMesh, vertices: &[Vec3]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for triangle in mesh.triangle_ids() {
        let normal = mesh.area_vector(triangle).try_normalize(0.0);
        let corners = mesh.corners(triangle).map(|node| vertices[node.index()]);
        let all = [
            normal.unwrap_or_default(),
            corners[0],
            corners[1],
            corners[2],
        ];
        for c in all.iter().flat_map(|v| [v.x, v.y, v.z]) {
            bytes.extend((c as f32).to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

fn obj(mesh: &TriangleMesh, vertices: &[Vec3]) -> Vec<u8> {
    let places = vertices
        .iter()
        .map(|v| format!("v {} {} {}\n", v.x, v.y, v.z));
    let faces = mesh.triangles().iter().map(|corners| {
        let [a, b, c] = corners.map(|node| node.0 + 1);
        format!("f {a} {b} {c}\n")
    });
    places.chain(faces).collect::<String>().into_bytes()
}

fn ply(mesh: &TriangleMesh, vertices: &[Vec3]) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        vertices.len(),
        mesh.triangles().len()
    )
    .into_bytes();
    for c in vertices.iter().flat_map(|v| [v.x, v.y, v.z]) {
        bytes.extend(c.to_le_bytes());
    }
    for corners in mesh.triangles() {
        bytes.push(3);
        bytes.extend(corners.iter().flat_map(|node| node.0.to_le_bytes()));
    }
    bytes
}
