use palpate_files::{Scene, Tissue};
use palpate_geometry::Surface;
use sha2::{Digest, Sha256};

/// A name for what was simulated: the first 16 hexadecimal digits of the SHA-256 of surface, tissue,
/// model and tools. Folders and file names do not count.
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
    hash.update(format!(
        "{:?}{:?}{:?}{:?}{:?}{:?}{:?}{:?}",
        tissue.elasticity,
        tissue.prony,
        scene.organ.anchor,
        scene.model,
        scene.tools,
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
