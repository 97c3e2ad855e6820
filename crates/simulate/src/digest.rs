use palpate_files::scene::DeviceKind;
use palpate_files::{Scene, Tissue};
use palpate_geometry::Surface;
use sha2::{Digest, Sha256};

/// A name for what was simulated: the first 16 hexadecimal digits of the SHA-256 of surface, tissue,
/// model and tools. Folders, file names and devices do not count.
pub(crate) fn digest(scene: &Scene, surface: &Surface, tissue: &Tissue) -> String {
    let mut hash = Sha256::new();
    for vertex in surface.mesh().vertices() {
        for coordinate in vertex.iter() {
            hash.update(coordinate.to_le_bytes());
        }
    }
    for node in surface.mesh().triangles().iter().flatten() {
        hash.update(node.0.to_le_bytes());
    }
    // Who moves a tool does not change what it meets.
    let mut tools = scene.tools.clone();
    tools
        .iter_mut()
        .for_each(|tool| tool.device = DeviceKind::None);
    hash.update(format!(
        "{:?}{:?}{:?}{:?}{:?}{:?}{:?}{:?}",
        tissue.elasticity,
        tissue.prony,
        scene.organ.anchor,
        scene.model,
        tools,
        scene.cutting,
        scene.organ.layers,
        scene.organ.nodules
    ));
    let bytes = hash.finalize();
    bytes[..8]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}
