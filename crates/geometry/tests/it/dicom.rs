//! Segmentations of DICOM. Judge: files of another library (`dicom/make.py`), of balls whose place is known.

use std::path::{Path, PathBuf};

use palpate_geometry::{
    DicomSeries, IsosurfaceSettings, LabelMap, ReadFault, Vec3, isosurface, read_dicom_folder,
    read_label_map,
};

use crate::shapes::Random;

const KINDS: [&str; 5] = [
    "bits.dcm",
    "parts.dcm",
    "labels.dcm",
    "parts-rle.dcm",
    "labels-rle.dcm",
];

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/it/dicom")
        .join(name)
}

fn map(name: &str) -> LabelMap {
    read_label_map(&file(name)).unwrap()
}

/// A folder with copies of files, and one that is something else.
fn folder(names: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    for name in names {
        std::fs::copy(file(name), inner.join(name)).unwrap();
    }
    std::fs::write(folder.path().join("notes.txt"), "nothing").unwrap();
    folder
}

/// The place of a voxel of the series [m], by the angle and the spacings in `make.py`.
fn place(along: f64, down: f64, slice: f64) -> Vec3 {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let mm = Vec3::new(-30.0, 12.5, 100.0)
        + along * Vec3::new(cos, sin, 0.0)
        + 1.5 * down * Vec3::new(0.0, 0.0, -1.0)
        + 2.5 * slice * Vec3::new(-sin, cos, 0.0);
    1e-3 * mm
}

#[test]
fn balls_are_where_they_were_drawn() {
    let raw = IsosurfaceSettings {
        smoothing: 0,
        triangles: usize::MAX,
    };
    for kind in KINDS {
        let map = map(kind);
        let labels = map.labels();
        // Empty frames were left out, but of parts.
        let is_at_end = map
            .warnings()
            .iter()
            .any(|own| own.contains("empty frames"));
        assert_eq!(is_at_end, !kind.starts_with("parts"), "{kind}");
        let told: Vec<_> = labels
            .iter()
            .map(|label| (label.number, label.name.as_deref(), label.voxels))
            .collect();
        assert_eq!(
            told,
            [(1, Some("liver"), 249), (2, Some("tumour"), 71)],
            "{kind}"
        );
        let expected = [1e-3, 1.5e-3, 2.5e-3];
        for (spacing, expected) in map.spacing().into_iter().zip(expected) {
            assert!((spacing - expected).abs() < 1e-9, "{kind} {spacing}");
        }
        for (label, middle) in [(1, place(8.0, 8.0, 4.0)), (2, place(17.0, 12.0, 6.0))] {
            let found = isosurface(&map, label, &raw).unwrap();
            // The voxels of a ball around a voxel's middle are symmetric about it.
            let (low, high) = found.simplified.mesh.bounds();
            let off = 0.5 * (low + high) - middle;
            assert!(!found.is_cut, "{kind} {label}");
            // Positions are written with six digits after the point [mm].
            assert!(off.norm() < 1e-8, "{kind} {label} {off}");
        }
    }
}

#[test]
fn a_folder_tells_its_series_and_is_its_only_segmentation() {
    let one = folder(&["bits.dcm", "image.dcm"]);
    let found = read_dicom_folder(one.path()).unwrap();
    let series = DicomSeries {
        modality: "CT".to_owned(),
        images: 1,
        size: [24, 20],
        spacing_m: None,
    };
    assert_eq!(found.series, [series]);
    assert_eq!((found.segmentations.len(), found.others), (1, 1));
    assert_eq!(read_label_map(one.path()).unwrap(), map("bits.dcm"));
    for (names, count) in [(&KINDS[..], "5"), (&["image.dcm"], "0")] {
        let error = read_label_map(folder(names).path()).unwrap_err();
        assert!(matches!(error.fault, ReadFault::NotOneSegmentation { .. }));
        assert!(error.to_string().contains(count) && error.is_input());
    }
}

#[test]
fn an_image_is_no_segmentation() {
    let error = read_label_map(&file("image.dcm")).unwrap_err();
    assert!(matches!(error.fault, ReadFault::NotASegmentation { .. }));
    assert!(error.to_string().contains("CT"), "{error}");
}

#[test]
fn damaged_segmentations_never_panic() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.dcm");
    let mut random = Random(5);
    let mut refused = 0;
    for kind in KINDS {
        let whole = std::fs::read(file(kind)).unwrap();
        for round in 0..70 {
            let mut bytes = whole.clone();
            if round % 2 == 0 {
                bytes.truncate(random.below(bytes.len()));
            } else {
                for _ in 0..1 + random.below(4) {
                    let at = random.below(bytes.len());
                    bytes[at] = random.below(256) as u8;
                }
            }
            std::fs::write(&path, &bytes).unwrap();
            if let Err(error) = read_label_map(&path) {
                refused += 1;
                assert!(error.to_string().len() < 600, "{error}");
            }
        }
    }
    // Cut files at least.
    assert!(refused > 170, "{refused}");
}
