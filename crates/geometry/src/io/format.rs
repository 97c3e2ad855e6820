use std::fmt;
use std::path::Path;

use super::{gltf, stl};
use crate::ReadFault;

/// The format of a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// STL, binary or text.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// PLY, binary or text.
    Ply,
    /// glTF 2.0, as a document or a GLB.
    Gltf,
}

impl MeshFormat {
    /// The format of a file by its extension, checked against its first bytes.
    ///
    /// # Errors
    /// When the extension is not known, or the content is plainly of another format.
    pub fn of(path: &Path, bytes: &[u8]) -> Result<Self, ReadFault> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let expected = match extension.to_ascii_lowercase().as_str() {
            "stl" => Self::Stl,
            "obj" => Self::Obj,
            "ply" => Self::Ply,
            "gltf" | "glb" => Self::Gltf,
            _ => {
                let found = extension.chars().take(40).collect();
                return Err(ReadFault::UnknownExtension { found });
            }
        };
        // The free header of a binary STL may begin like anything, but its length decides.
        if expected == Self::Stl && stl::has_binary_length(bytes) {
            return Ok(expected);
        }
        match by_content(bytes) {
            Some(found) if found != expected => Err(ReadFault::WrongContent { expected, found }),
            _ => Ok(expected),
        }
    }
}

impl fmt::Display for MeshFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Ply => "PLY",
            Self::Gltf => "glTF",
        })
    }
}

/// The format that the first bytes are sure of; OBJ has no mark.
fn by_content(bytes: &[u8]) -> Option<MeshFormat> {
    if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
        Some(MeshFormat::Ply)
    } else if bytes.starts_with(gltf::MAGIC) || bytes.trim_ascii_start().starts_with(b"{") {
        Some(MeshFormat::Gltf)
    } else if stl::has_binary_length(bytes) || stl::looks_like_text(bytes) {
        Some(MeshFormat::Stl)
    } else {
        None
    }
}
