//! Readers: one battery of round trips for all formats, and what each says of a bad file.

use std::path::{Path, PathBuf};

use palpate_geometry::{
    ImportedMesh, LengthUnit, ReadError, Surface, TriangleMesh, read_mesh, vtk,
};
use tempfile::TempDir;

use crate::{data, files};

/// A file of this name and content in a new folder.
fn written(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn read(name: &str, bytes: &[u8], unit: Option<LengthUnit>) -> Result<ImportedMesh, ReadError> {
    let (_folder, path) = written(name, bytes);
    read_mesh(&path, unit)
}

fn replaced(bytes: &[u8], old: &str, new: &str) -> Vec<u8> {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    assert!(text.contains(old), "`{old}` is in the file");
    text.replace(old, new).into_bytes()
}

fn file(name: &str) -> Vec<u8> {
    let all = files::all(&files::tetrahedron());
    all.into_iter().find(|(n, _)| *n == name).unwrap().1
}

#[test]
fn every_format_gives_the_mesh_back() {
    let mesh = files::tetrahedron();
    for (name, bytes) in files::all(&mesh) {
        let imported = read(name, &bytes, None).unwrap();
        let volume = imported.mesh.volume();
        assert!(
            (volume / mesh.volume() - 1.0).abs() < 1e-14,
            "{name}: {volume}"
        );
        assert_eq!(imported.mesh.vertices().len(), 4, "{name}");
        assert_eq!(imported.warnings, Vec::<String>::new());
        Surface::new(imported.mesh).unwrap();
    }
}

#[test]
fn an_explicit_unit_is_taken_with_a_warning_when_it_cannot_be() {
    for (name, bytes) in files::all(&files::tetrahedron()) {
        let imported = read(name, &bytes, Some(LengthUnit::Millimetre)).unwrap();
        let (low, high) = imported.mesh.bounds();
        assert_eq!((high - low).max(), 0.125e-3, "{name}");
        assert!(imported.warnings[0].contains("check mesh_unit"), "{name}");
        let says_standard = imported.warnings.iter().any(|w| w.contains("standard"));
        assert_eq!(says_standard, name.contains(".gl"), "{name}");
    }
}

#[test]
fn an_inch_is_25_4_mm() {
    let imported = read("in.obj", &file("text.obj"), Some(LengthUnit::Inch)).unwrap();
    let (low, high) = imported.mesh.bounds();
    assert!(((high - low).max() - 0.125 * 0.0254).abs() < 1e-18);
}

#[test]
fn a_unit_is_never_guessed_silently() {
    let large = files::tetrahedron().map_vertices(|v| 1000.0 * v).unwrap();
    for (name, bytes) in files::all(&large) {
        let result = read(name, &bytes, None);
        if name.contains(".gl") {
            assert!(result.unwrap().warnings[0].contains("125 m"));
            continue;
        }
        let message = result.unwrap_err().to_string();
        assert!(
            message.contains("125 m in metres and 0.125 m in millimetres"),
            "{message}"
        );
        assert!(message.contains("set mesh_unit"), "{message}");
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn polygons_become_triangles() {
    let vertices = "v 0 0 0\nv .1 0 0\nv .1 .1 0\nv 0 .1 0\nv -.1 .05 0\n";
    let obj = format!("{vertices}f 1 2 3 4 5\n");
    let mesh = read("polygon.obj", obj.as_bytes(), None).unwrap().mesh;
    assert_eq!(mesh.triangles().len(), 3);
    assert!((mesh.area() - 0.015).abs() < 1e-15);
    let ply = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\n\
               element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n\
               4 0 1 2 3\n0 0 0 .1 0 0\n.1 .1 0 0 .1 0\n";
    let mesh = read("polygon.ply", ply.as_bytes(), None).unwrap().mesh;
    assert_eq!(mesh.triangles().len(), 2);
}

#[test]
fn a_mirrored_node_still_faces_outward() {
    let bytes = replaced(
        &file("whole.gltf"),
        r#""scale":[2,2,2]"#,
        r#""scale":[-2,2,2]"#,
    );
    let mesh = read("mirrored.gltf", &bytes, None).unwrap().mesh;
    Surface::new(mesh).unwrap();
}

/// For each bad file the words that its message must have.
fn bad_files() -> Vec<(&'static str, Vec<u8>, &'static [&'static str])> {
    let (stl, glb) = (file("binary.stl"), file("whole.glb"));
    let (obj, ply, little) = (file("text.obj"), file("text.ply"), file("little.ply"));
    let gltf = file("whole.gltf");
    let mut nan = stl.clone();
    nan[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let outside = files::gltf_document(&files::tetrahedron(), r#""uri":"../x.bin","#);
    vec![
        ("empty.stl", vec![], &["empty"]),
        (
            "cut.stl",
            stl[..200].to_vec(),
            &["4 triangles", "284 bytes", "200 were found"],
        ),
        (
            "short.stl",
            stl[..50].to_vec(),
            &["84 bytes", "50 were found"],
        ),
        ("nan.stl", nan, &["vertex 0", "NaN"]),
        (
            "text_cut.stl",
            replaced(
                &file("text.stl"),
                "endsolid
",
                "",
            ),
            &["line 30", "endsolid"],
        ),
        (
            "bad.stl",
            b"solid\nfoo bar\n".to_vec(),
            &["line 2", "`foo bar`"],
        ),
        ("none.stl", b"solid\nendsolid\n".to_vec(), &["no triangles"]),
        (
            "index.obj",
            replaced(&obj, "f -4", "f 99"),
            &["vertex 98", "4 vertices"],
        ),
        (
            "zero.obj",
            replaced(&obj, "f -4", "f 0"),
            &["vertex 0", "4 vertices"],
        ),
        (
            "number.obj",
            b"v 0 x 0\n".to_vec(),
            &["line 1", "`x`", "a number"],
        ),
        ("short.obj", b"v 0 0 0\nf 1 1\n".to_vec(), &["2 corners"]),
        ("nan.obj", b"v 0 nan 0\n".to_vec(), &["vertex 0", "NaN"]),
        ("far.obj", b"v 0 1e300 0\n".to_vec(), &["vertex 0", "1e12"]),
        (
            "cut.ply",
            ply[..ply.len() - 9].to_vec(),
            &["line", "a number"],
        ),
        (
            "little.ply",
            little[..300].to_vec(),
            &["bytes", "300 were found"],
        ),
        (
            "huge.ply",
            replaced(&ply, "vertex 4", "vertex 99999999999999"),
            &["cut short"],
        ),
        (
            "corner.ply",
            replaced(&ply, "3 0 2 1", "3 0 2 7"),
            &["vertex 7", "4 vertices"],
        ),
        (
            "list.ply",
            replaced(&ply, "3 0 2 1", "-3 0 2 1"),
            &["list of -3"],
        ),
        (
            "type.ply",
            replaced(&ply, "double x", "quad x"),
            &["line 5", "quad x"],
        ),
        (
            "open.ply",
            b"ply\nformat ascii 1.0\n".to_vec(),
            &["end_header"],
        ),
        (
            "points.ply",
            replaced(&ply, "element face", "element edge"),
            &["no faces"],
        ),
        (
            "cut.glb",
            glb[..glb.len() - 9].to_vec(),
            &["bytes", "cut short"],
        ),
        (
            "tiny.glb",
            b"glTF\x02\0\0\0\x01\0\0\0".to_vec(),
            &["12 bytes"],
        ),
        ("json.gltf", gltf[..100].to_vec(), &["not valid"]),
        (
            "outside.gltf",
            outside.into_bytes(),
            &["../x.bin", "folder"],
        ),
        (
            "huge.gltf",
            replaced(&gltf, r#""count":4"#, r#""count":4000000000"#),
            &["bytes"],
        ),
        (
            "cycle.gltf",
            replaced(&gltf, r#""mesh":0,"#, r#""mesh":0,"children":[0],"#),
            &["several parents"],
        ),
        ("ply.obj", ply, &["OBJ", "content is PLY"]),
        ("mesh.xyz", obj, &["`xyz`", ".stl, .obj"]),
    ]
}

#[test]
fn a_bad_file_is_named_with_its_fault_and_its_mend() {
    for (name, bytes, words) in bad_files() {
        let message = read(name, &bytes, None).unwrap_err().to_string();
        for word in words.iter().chain([&name, &"; "]) {
            assert!(message.contains(word), "`{word}` is missing in: {message}");
        }
    }
}

#[test]
fn a_path_that_is_no_file_is_refused() {
    let folder = TempDir::new().unwrap();
    let missing = read_mesh(&folder.path().join("none.stl"), None).unwrap_err();
    assert!(missing.to_string().contains("no such file"));
    let path = folder.path().join("folder.stl");
    std::fs::create_dir(&path).unwrap();
    let message = read_mesh(&path, None).unwrap_err().to_string();
    assert!(message.contains("not a file") && message.contains("folder.stl"));
}

#[test]
fn a_buffer_beside_the_document_is_read() {
    let mesh = files::tetrahedron();
    let document = files::gltf_document(&mesh, r#""uri":"a%20b.bin","#);
    let (folder, path) = written("beside.gltf", document.as_bytes());
    assert!(
        read_mesh(&path, None)
            .unwrap_err()
            .to_string()
            .contains("a%20b.bin")
    );
    let glb = file("whole.glb");
    std::fs::write(folder.path().join("a b.bin"), &glb[glb.len() - 96..]).unwrap();
    assert_eq!(read_mesh(&path, None).unwrap().mesh.volume(), mesh.volume());
}

/// All buffers together hold as much as one file may. The large one has holes: it takes no room on the disk, and is
/// refused before it is read.
#[test]
fn buffers_together_are_bounded() {
    let document = r#"{"asset":{"version":"2.0"},"buffers":[
        {"uri":"small.bin","byteLength":12},{"uri":"large.bin","byteLength":12}]}"#;
    let (folder, path) = written("both.gltf", document.as_bytes());
    std::fs::write(folder.path().join("small.bin"), [0; 12]).unwrap();
    let large = std::fs::File::create(folder.path().join("large.bin")).unwrap();
    large.set_len((1 << 30) - 1).unwrap();
    let message = read_mesh(&path, None).unwrap_err().to_string();
    assert!(message.contains("1073741835 bytes"), "{message}");
    assert!(message.contains("at most 1073741824"), "{message}");
}

#[test]
fn polydata_says_how_much_it_holds() {
    let mesh = files::tetrahedron();
    let depths = [0.0, 1.0, 2.0, 3.0];
    let fields = [
        vtk::PointField {
            name: "depth_m",
            values: vtk::FieldValues::Scalars(&depths),
        },
        vtk::PointField {
            name: "displacement_m",
            values: vtk::FieldValues::Vectors(mesh.vertices()),
        },
    ];
    let bytes = vtk::polydata(mesh.vertices(), mesh.triangles(), &fields);
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains(r#"NumberOfPoints="4""#) && text.contains(r#"NumberOfPolys="4""#));
    assert!(text.contains(r#"Name="displacement_m" NumberOfComponents="3""#));
    if let Some(path) = std::env::var_os("PALPATE_KEEP_VTP") {
        std::fs::write(path, text).unwrap();
    }
}

#[test]
fn real_kidney_of_the_atlas_is_read_with_its_parts_in_place() {
    let Some(folder) = data::folder() else { return };
    let path = folder.join("meshes/hra_3d-vh-m-kidney-l.glb");
    let imported = read_mesh(&path, None).unwrap();
    let (low, high) = imported.mesh.bounds();
    let envelope = read_mesh(&folder.join("meshes/vhm_kidney_left_raw.ply"), None).unwrap();
    let (expected_low, expected_high) = envelope.mesh.bounds();
    println!(
        "{} triangles, {low:?} to {high:?}",
        imported.mesh.triangles().len()
    );
    // The envelope is 0.1 mm outside of the parts, and leaves out the vessels.
    assert!((low - expected_low).max() < 0.001 && (expected_high - high).max() < 0.001);
}

/// Judges: the crates `stl_io` and `tobj`, which share no code with the readers here.
#[test]
fn real_meshes_are_read_as_other_readers_do() {
    let Some(folder) = data::folder() else { return };
    let path = |name: &str| folder.join("meshes").join(name);
    let stl = path("vhm_kidney_left_5146.stl");
    let theirs = stl_io::read_stl(&mut std::fs::File::open(&stl).unwrap()).unwrap();
    let positions = theirs.vertices.iter().map(|v| v.0.map(f64::from)).collect();
    let corners = theirs
        .faces
        .iter()
        .map(|f| f.vertices.map(|n| n as u32))
        .collect();
    agree(&stl, positions, corners);

    let obj = path("vhm_kidney_left_688.obj");
    let (models, _) = tobj::load_obj(&obj, &tobj::LoadOptions::default()).unwrap();
    let theirs = &models[0].mesh;
    let positions = theirs.positions.chunks(3);
    let positions = positions
        .map(|p| [p[0], p[1], p[2]].map(f64::from))
        .collect();
    let corners = theirs
        .indices
        .chunks(3)
        .map(|t| [t[0], t[1], t[2]])
        .collect();
    agree(&obj, positions, corners);
}

fn agree(path: &Path, positions: Vec<[f64; 3]>, corners: Vec<[u32; 3]>) {
    let mesh: TriangleMesh = read_mesh(path, None).unwrap().mesh;
    assert_eq!(mesh.triangles().len(), corners.len());
    for (triangle, theirs) in mesh.triangle_ids().zip(&corners) {
        for (ours, &number) in mesh.positions(triangle).iter().zip(theirs) {
            let theirs = palpate_geometry::Vec3::from(positions[number as usize]);
            // They read single precision.
            assert!((ours - theirs).norm() < 1e-7, "{}", path.display());
        }
    }
}
