//! The parts of a glTF document that place triangles; everything else is passed over.

use nalgebra::{Matrix4, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde::Deserialize;

use crate::ReadFault;

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Document {
    pub(super) asset: Asset,
    pub(super) extensions_required: Vec<String>,
    pub(super) scene: Option<usize>,
    pub(super) scenes: Vec<Scene>,
    pub(super) nodes: Vec<Node>,
    pub(super) meshes: Vec<Mesh>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffer_views: Vec<View>,
    pub(super) buffers: Vec<Buffer>,
}

#[derive(Debug, Default, Deserialize)]
pub(super) struct Asset {
    pub(super) version: String,
}

#[derive(Debug, Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub(super) nodes: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    /// Column by column.
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    /// x, y, z, w.
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<usize>,
    /// 4 triangles, 5 a strip, 6 a fan; below points and lines.
    pub(super) mode: Option<u32>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    #[serde(default)]
    pub(super) byte_offset: usize,
    /// 5121, 5123, 5125 unsigned of one, two, four bytes; 5126 single precision.
    pub(super) component_type: u32,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) sparse: Option<serde::de::IgnoredAny>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub(super) buffer: usize,
    #[serde(default)]
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    pub(super) byte_stride: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: usize,
}

impl Document {
    pub(super) fn parse(text: &[u8]) -> Result<Self, ReadFault> {
        let document: Self = serde_json::from_slice(text).map_err(ReadFault::invalid_gltf)?;
        if !document.asset.version.starts_with("2.") {
            let version = document.asset.version.chars().take(20).collect::<String>();
            return Err(ReadFault::invalid_gltf(format!(
                "found version `{version}` where 2.0 was expected"
            )));
        }
        let packed = |name: &String| name.contains("compression") || name.contains("quantization");
        if document.extensions_required.iter().any(packed) {
            return Err(ReadFault::Unsupported {
                what: "compressed glTF geometry",
            });
        }
        Ok(document)
    }

    /// Nodes without a parent: those of the scene, or all when there is none.
    pub(super) fn roots(&self) -> Vec<usize> {
        if let Some(scene) = self.scenes.get(self.scene.unwrap_or(0)) {
            return scene.nodes.clone();
        }
        let mut is_root = vec![true; self.nodes.len()];
        for &child in self.nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_root) = is_root.get_mut(child) {
                *is_root = false;
            }
        }
        (0..self.nodes.len())
            .filter(|&node| is_root[node])
            .collect()
    }
}

impl Node {
    pub(super) fn parent_from_node(&self) -> Matrix4<f64> {
        if let Some(matrix) = self.matrix {
            return Matrix4::from_column_slice(&matrix);
        }
        let translation = Translation3::from(self.translation.unwrap_or_default());
        let [x, y, z, w] = self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let scale = Vector3::from(self.scale.unwrap_or([1.0; 3]));
        (translation * rotation).to_homogeneous() * Matrix4::new_nonuniform_scaling(&scale)
    }
}

/// The part that a number in the document names.
pub(super) fn part<'a, T>(parts: &'a [T], number: usize, what: &str) -> Result<&'a T, ReadFault> {
    parts.get(number).ok_or_else(|| {
        ReadFault::invalid_gltf(format!("there is no {what} {number} among {}", parts.len()))
    })
}
