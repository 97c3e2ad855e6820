//! Damaged files: whatever the bytes, a reader gives a mesh or an error, and never panics.

use std::collections::BTreeSet;
use std::path::Path;

use palpate_geometry::{inspect, repair};
use proptest::prelude::*;
use proptest::test_runner::Config;

use crate::readers::{self, NAMES, survive_map, survive_volume};
use crate::{files, label_maps, volumes};

/// Few cases by default, many with `PALPATE_FULL=1`.
fn config() -> Config {
    Config {
        cases: if crate::wants_full() { 20_000 } else { 300 },
        failure_persistence: None,
        ..Config::default()
    }
}

/// Reads the bytes as a surface, and on with whatever comes out.
fn survive(folder: &Path, name: &str, bytes: &[u8]) {
    if let Some(imported) = readers::survive(folder, name, bytes) {
        inspect(&imported.mesh);
        if let Err(error) = repair(&imported.mesh) {
            let message = error.to_string();
            assert!(message.len() < 1000, "{message}");
        }
    }
}

/// The corpus of `fuzz/`: what led a reader somewhere new.
#[test]
fn the_corpus_is_read_or_refused() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/meshes");
    let folder = tempfile::tempdir().unwrap();
    let mut met = BTreeSet::new();
    for entry in std::fs::read_dir(corpus).unwrap() {
        let path = entry.unwrap().path();
        println!("{}", path.display());
        let bytes = std::fs::read(path).unwrap();
        met.extend(bytes.first().copied());
        readers::read_as_told(&bytes, folder.path());
    }
    assert!(
        NAMES.iter().all(|(letter, _)| met.contains(letter)),
        "{met:?}"
    );
}

/// A start that makes a reader believe the rest.
fn promising_start() -> impl Strategy<Value = &'static [u8]> {
    let starts: [&[u8]; 8] = [
        b"",
        b"solid\n",
        b"glTF\x02\0\0\0",
        b"{\"asset\":{\"version\":\"2.0\"},",
        b"ply\nformat ascii 1.0\nelement vertex ",
        b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint uint vertex_indices\nend_header\n",
        b"v 0 0 0\nf ",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 ",
    ];
    prop::sample::select(starts.to_vec())
}

#[derive(Debug, Clone)]
enum Damage {
    Cut(prop::sample::Index),
    Set(prop::sample::Index, u8),
    SetFour(prop::sample::Index, u32),
    Insert(prop::sample::Index, Vec<u8>),
    Remove(prop::sample::Index, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    let at = any::<prop::sample::Index>;
    let tricky = prop::sample::select(vec![0, 1, 0x7FC0_0000, 0x7F80_0000, u32::MAX, 1 << 31]);
    let words = [
        "-1",
        "999999999999",
        "nan",
        "1e999",
        "\"count\":",
        "[",
        "}",
        "\n",
        " 0 ",
    ];
    let word = prop::sample::select(words.to_vec()).prop_map(|w| w.as_bytes().to_vec());
    prop_oneof![
        at().prop_map(Damage::Cut),
        (at(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        (at(), tricky).prop_map(|(at, four)| Damage::SetFour(at, four)),
        (at(), word).prop_map(|(at, word)| Damage::Insert(at, word)),
        (at(), 1..20usize).prop_map(|(at, length)| Damage::Remove(at, length)),
    ]
}

fn damaged(mut bytes: Vec<u8>, damages: &[Damage]) -> Vec<u8> {
    for damage in damages {
        if bytes.is_empty() {
            break;
        }
        match damage {
            Damage::Cut(at) => bytes.truncate(at.index(bytes.len())),
            Damage::Set(at, byte) => {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            Damage::SetFour(at, four) => {
                let at = at.index(bytes.len());
                for (byte, new) in bytes[at..].iter_mut().zip(four.to_le_bytes()) {
                    *byte = new;
                }
            }
            Damage::Insert(at, word) => {
                let at = at.index(bytes.len());
                bytes.splice(at..at, word.iter().copied());
            }
            Damage::Remove(at, length) => {
                let at = at.index(bytes.len());
                bytes.drain(at..(at + length).min(bytes.len()));
            }
        }
    }
    bytes
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn arbitrary_bytes_never_panic(
        start in promising_start(),
        rest in prop::collection::vec(any::<u8>(), 0..300),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let bytes = [start, &rest].concat();
        for name in ["a.stl", "a.obj", "a.ply", "a.gltf", "a.glb"] {
            survive(folder.path(), name, &bytes);
        }
    }

    #[test]
    fn damaged_files_never_panic(damages in prop::collection::vec(damage(), 1..4)) {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in files::all(&files::tetrahedron()) {
            survive(folder.path(), name, &damaged(bytes, &damages));
        }
    }

    #[test]
    fn damaged_volumes_never_panic(damages in prop::collection::vec(damage(), 1..4)) {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in volumes::all() {
            survive_volume(folder.path(), name, &damaged(bytes, &damages));
        }
    }

    #[test]
    fn damaged_label_maps_never_panic(damages in prop::collection::vec(damage(), 1..4)) {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in label_maps::all() {
            survive_map(folder.path(), name, &damaged(bytes, &damages));
        }
    }

    #[test]
    fn arbitrary_bytes_are_no_volume(rest in prop::collection::vec(any::<u8>(), 0..300)) {
        let folder = tempfile::tempdir().unwrap();
        for (name, start) in [
            ("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"),
            ("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n"),
            ("a.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nCELLS "),
            ("a.vtu", "<VTKFile type=\"UnstructuredGrid\"><Points><DataArray "),
        ] {
            survive_volume(folder.path(), name, &rest);
            survive_volume(folder.path(), name, &[start.as_bytes(), &rest].concat());
        }
    }
}
