//! Every reader of the crate, given any bytes. `fuzz/fuzz_targets/meshes.rs` has this file too.

use std::path::Path;

use palpate_geometry::vtk::{CellKind, Cells, FieldValues, PointField, unstructured_grid};
use palpate_geometry::{
    ImportedMesh, ImportedTetrahedra, LengthUnit, WriteFormat, read_label_map, read_mesh,
    read_tetrahedra,
};

/// The letters that name readers, each with a file of its format.
pub(crate) const NAMES: [(u8, &str); 11] = [
    (b's', "a.stl"),
    (b'o', "a.obj"),
    (b'p', "a.ply"),
    (b'g', "a.gltf"),
    (b'b', "a.glb"),
    (b'm', "a.msh"),
    (b'k', "a.vtk"),
    (b'u', "a.vtu"),
    (b'n', "a.nii"),
    (b'z', "a.nii.gz"),
    (b'r', "a.nrrd"),
];

/// Gives all but the first byte to the reader that the first byte names.
pub(crate) fn read_as_told(bytes: &[u8], folder: &Path) {
    let Some((reader, bytes)) = bytes.split_first() else {
        return;
    };
    match NAMES.iter().find(|(letter, _)| letter == reader) {
        Some((_, name @ ("a.nii" | "a.nii.gz" | "a.nrrd"))) => survive_map(folder, name, bytes),
        Some((_, name @ ("a.msh" | "a.vtk" | "a.vtu"))) => survive_volume(folder, name, bytes),
        Some((_, name)) => drop(survive(folder, name, bytes)),
        None => {}
    }
}

/// Reads the bytes as a surface. An error must be short, and a mesh the same when it is written and read again.
pub(crate) fn survive(folder: &Path, name: &str, bytes: &[u8]) -> Option<ImportedMesh> {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    let unit = LengthUnit::Metre;
    let imported = read_mesh(&path, Some(unit)).map_err(short).ok()?;
    for (format, name) in [(WriteFormat::Ply, "b.ply"), (WriteFormat::Obj, "b.obj")] {
        let path = folder.join(name);
        std::fs::write(&path, format.bytes(&imported.mesh, unit)).unwrap();
        assert_eq!(read_mesh(&path, Some(unit)).unwrap().mesh, imported.mesh);
    }
    Some(imported)
}

/// The same for a file of tetrahedra.
pub(crate) fn survive_volume(folder: &Path, name: &str, bytes: &[u8]) {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    let read = |path: &Path| read_tetrahedra(path, Some(LengthUnit::Metre));
    let Ok(ImportedTetrahedra { mesh, .. }) = read(&path).map_err(short) else {
        return;
    };
    let nodes: Vec<u32> = mesh.tetrahedra().iter().flatten().map(|n| n.0).collect();
    let cells = Cells {
        kind: CellKind::Tetrahedron,
        nodes: &nodes,
    };
    let path = folder.join("b.vtu");
    let regions = (0..mesh.tetrahedra().len()).map(|t| f64::from(mesh.region(t)));
    let regions: Vec<f64> = regions.collect();
    let field = PointField {
        name: "region",
        values: FieldValues::Scalars(&regions),
    };
    let bytes = unstructured_grid(mesh.vertices(), &cells, &[], &[field]);
    std::fs::write(&path, bytes).unwrap();
    let again = read(&path).unwrap();
    assert_eq!((again.mesh, again.turned), (mesh, 0));
}

/// The same for a label map, which nobody writes.
pub(crate) fn survive_map(folder: &Path, name: &str, bytes: &[u8]) {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    if let Ok(map) = read_label_map(&path).map_err(short) {
        drop(map.labels());
    }
}

fn short(error: impl ToString) {
    let message = error.to_string();
    assert!(message.len() < 1000, "{message}");
}
