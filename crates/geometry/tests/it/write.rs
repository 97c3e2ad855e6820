//! What is written is read back.

use std::path::Path;

use palpate_geometry::{LengthUnit, Organ, WriteFormat, inspect, read_mesh};

/// Judge: the readers, which are held against outside codes elsewhere.
#[test]
fn a_mesh_comes_back_in_every_format_and_unit() {
    let mesh = Organ::Kidney.surface_mesh(500).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.stl", "a.obj", "a.ply"] {
        for unit in [LengthUnit::Metre, LengthUnit::Millimetre] {
            let path = folder.path().join(name);
            let bytes = WriteFormat::of(&path).unwrap().bytes(&mesh, unit);
            std::fs::write(&path, bytes).unwrap();
            let back = read_mesh(&path, Some(unit)).unwrap().mesh;
            let (ours, theirs) = (inspect(&mesh), inspect(&back));
            assert_eq!((ours.vertices, ours.genus), (theirs.vertices, theirs.genus));
            // STL has single precision, over sizes of 0.1 m.
            let tolerance = if name == "a.stl" { 1e-6 } else { 1e-14 };
            assert!(
                (ours.volume_m3 / theirs.volume_m3 - 1.0).abs() < tolerance,
                "{name}"
            );
        }
    }
}

#[test]
fn a_format_that_is_not_written_is_refused() {
    let fault = WriteFormat::of(Path::new("a.glb")).unwrap_err().to_string();
    assert!(fault.contains("`glb`") && fault.contains(".stl"), "{fault}");
}
