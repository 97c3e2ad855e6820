//! Segmentations of DICOM. Judge: files of another library (`dicom/make.py`), of balls whose place is known.

use std::path::{Path, PathBuf};

use palpate_geometry::{
    DicomSeries, IsosurfaceSettings, LabelMap, ReadFault, Vec3, isosurface, read_dicom_folder,
    read_label_map,
};

use crate::shapes::Random;

const KINDS: [&str; 12] = [
    "bits.dcm",
    "parts.dcm",
    "labels.dcm",
    "bits-rle.dcm",
    "parts-rle.dcm",
    "labels-rle.dcm",
    "bits-jpeg2000.dcm",
    "labels-jpeg2000.dcm",
    "parts-jpeg.dcm",
    "labels-jpeg.dcm",
    "bits-deflated-frames.dcm",
    "parts-deflated.dcm",
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
    let series = DicomSeries {
        modality: "CT".to_owned(),
        images: 1,
        size: [24, 20],
        spacing_m: None,
    };
    for image in ["image.dcm", "image-jpeg.dcm", "image-deflated.dcm"] {
        let one = folder(&["bits.dcm", image]);
        let found = read_dicom_folder(one.path()).unwrap();
        assert_eq!(found.series, std::slice::from_ref(&series), "{image}");
        assert_eq!((found.segmentations.len(), found.others), (1, 1));
        assert_eq!(read_label_map(one.path()).unwrap(), map("bits.dcm"));
    }
    for (names, count) in [(&KINDS[..], "12"), (&["image.dcm"], "0")] {
        let error = read_label_map(folder(names).path()).unwrap_err();
        assert!(matches!(error.fault, ReadFault::NotOneSegmentation { .. }));
        assert!(error.to_string().contains(count) && error.is_input());
    }
}

/// Labels that differ from voxel to voxel; JPEG with all predictors, with restart markers, with fewer bits, and three
/// fragments for each frame.
#[test]
fn compression_changes_no_voxel() {
    assert_eq!(map("labels16-jpeg.dcm"), map("labels16.dcm"));
    for kind in KINDS {
        let (name, _) = kind.split_once(['-', '.']).unwrap();
        assert_eq!(map(kind), map(&format!("{name}.dcm")), "{kind}");
    }
}

/// Reads a file after all `from` in it became `to`.
fn changed(name: &str, from: &[u8], to: &[u8]) -> Result<LabelMap, String> {
    let mut bytes = std::fs::read(file(name)).unwrap();
    replace(&mut bytes, from, to);
    read(&bytes)
}

fn replace(bytes: &mut [u8], from: &[u8], to: &[u8]) {
    for at in 0..bytes.len() - from.len() {
        if bytes[at..].starts_with(from) {
            bytes[at..at + to.len()].copy_from_slice(to);
        }
    }
}

fn read(bytes: &[u8]) -> Result<LabelMap, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("changed.dcm");
    std::fs::write(&path, bytes).unwrap();
    read_label_map(&path).map_err(|error| error.to_string())
}

#[test]
fn other_compression_is_refused_with_a_remedy() {
    let jpeg_ls = read_label_map(&file("labels-jpegls.dcm")).unwrap_err();
    let jpeg_ls = jpeg_ls.to_string();
    assert!(
        jpeg_ls.contains("JPEG-LS") && jpeg_ls.contains("dcmdjpls"),
        "{jpeg_ls}"
    );
    let lossy = changed("labels-jpegls.dcm", b".1.2.4.80", b".1.2.4.50").unwrap_err();
    assert!(lossy.contains("lossy JPEG"), "{lossy}");
}

#[test]
fn compression_that_may_be_lossy_is_read_with_a_warning() {
    let mut bytes = std::fs::read(file("labels-jpeg2000.dcm")).unwrap();
    let expected = map("labels.dcm");
    replace(&mut bytes, b".1.2.4.90", b".1.2.4.91");
    // The file says that nothing was lost.
    assert_eq!(read(&bytes).unwrap(), expected);
    replace(
        &mut bytes,
        b"\x28\0\x10\x21CS\x02\x0000",
        b"\x28\0\x10\x21CS\x02\x0001",
    );
    let map = read(&bytes).unwrap();
    assert_eq!(map.labels(), expected.labels());
    assert_eq!(map.warnings().len(), expected.warnings().len() + 1);
    assert!(map.warnings()[0].contains("may be lossy"));
    // JPEG without the lowest bit of each pixel.
    let map = self::map("labels-transform.dcm");
    let labels: Vec<_> = map.labels().iter().map(|l| (l.number, l.voxels)).collect();
    assert_eq!(labels, [(2, 71)]);
    assert!(map.warnings()[0].contains("may be lossy"));
}

#[test]
fn an_invalid_frame_is_named() {
    for (name, from, to, cause) in [
        // The size of the frame, the predictor, and the number of its rows.
        (
            "labels-jpeg.dcm",
            &b"\x08\x00\x14\x00\x18\x01"[..],
            &b"\x08\x00\x14\x00\x17"[..],
            "another size",
        ),
        (
            "labels-jpeg.dcm",
            b"\xff\xda\x00\x08\x01\x01\x00\x01",
            b"\xff\xda\x00\x08\x01\x01\x00\x08",
            "scan header",
        ),
        (
            "labels-jpeg2000.dcm",
            b"\x00\x00\x00\x18\x00\x00\x00\x14",
            b"\x7f\xff\xff\xff\x7f\xff\xff\xff",
            "",
        ),
        (
            "bits-rle.dcm",
            b"\x01\x00\x00\x00\x40\x00\x00\x00",
            b"\x01\x00\x00\x00\xff\xff\xff\xff",
            "run lengths",
        ),
    ] {
        let error = changed(name, from, to).unwrap_err();
        assert!(
            error.contains("changed.dcm: frame 1 ") && error.contains(cause),
            "{error}"
        );
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
    for kind in KINDS.into_iter().chain(["labels16-jpeg.dcm"]) {
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
    assert!(refused > 450, "{refused}");
}
