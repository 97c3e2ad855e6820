//! Surfaces of label maps: closed whatever the voxels, and as large as they are.

use std::ops::ControlFlow;
use std::path::Path;

use palpate_geometry::{
    Isosurface, IsosurfaceError, IsosurfaceSettings, LabelMap, MeshReport, ReadFault,
    SimplifyError, Surface, Vec3, deviation, inspect, isosurface, isosurface_with_progress,
    read_label_map, read_mesh,
};

use crate::data;
use crate::label_maps::{Nifti, nrrd};
use crate::shapes::Random;

fn map_of(bytes: &[u8], name: &str) -> LabelMap {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    read_label_map(&folder.path().join(name)).unwrap()
}

fn surface_of(
    map: &LabelMap,
    label: u16,
    settings: &IsosurfaceSettings,
) -> (Isosurface, MeshReport) {
    let found = isosurface(map, label, settings).unwrap();
    let report = inspect(&found.simplified.mesh);
    assert!(
        report.closed && report.manifold && report.oriented,
        "{report:?}"
    );
    assert_eq!(report.components, 1);
    Surface::new(found.simplified.mesh.clone()).unwrap();
    (found, report)
}

/// As many triangles as there are, and the steps of the voxels.
const RAW: IsosurfaceSettings = IsosurfaceSettings {
    smoothing: 0,
    triangles: usize::MAX,
};

/// All 256 patterns of 2 x 2 x 2 voxels, the ambiguous ones among them.
#[test]
#[ignore = "long"]
fn every_pattern_of_eight_voxels_is_closed() {
    for case in 1..256u32 {
        let voxels = (0..8).map(|k| (case >> k & 1) as u16).collect();
        let map = map_of(&Nifti::new([2, 2, 2], voxels).bytes(), "a.nii");
        for smoothing in [0, 10] {
            let settings = IsosurfaceSettings { smoothing, ..RAW };
            let (found, report) = surface_of(&map, 1, &settings);
            let left = (case.count_ones() as usize - found.other_voxels) as f64 * 1e-9;
            // Rounding.
            assert!((found.voxel_volume - left).abs() < 1e-20, "{case:08b}");
            assert_eq!(report.genus, Some(0), "{case:08b}");
        }
    }
}

/// Judge: the definition of a solid, on noise where every pattern meets every other.
#[test]
#[ignore = "long"]
fn random_voxels_bound_one_solid() {
    let mut random = Random(7);
    for part in [0.3, 0.5, 0.7, 0.9] {
        for _ in 0..10 {
            let voxels = (0..6 * 7 * 8)
                .map(|_| u16::from(random.unit() < part))
                .collect();
            let map = map_of(&Nifti::new([6, 7, 8], voxels).bytes(), "a.nii");
            let (found, _) = surface_of(&map, 1, &RAW);
            assert!(found.is_cut);
        }
    }
}

/// A ball of 20 mm in voxels of the given size [mm], none of it cut.
fn ball(spacing: [f64; 3]) -> Nifti {
    let size = spacing.map(|step| (44.0 / step) as usize + 1);
    let middle = [0, 1, 2].map(|k| 0.5 * (size[k] - 1) as f64 * spacing[k] + 0.21);
    let mut voxels = Vec::new();
    for z in 0..size[2] {
        for y in 0..size[1] {
            for x in 0..size[0] {
                let from = [x, y, z].map(|i| i as f64);
                let squared = (0..3).map(|k| (from[k] * spacing[k] - middle[k]).powi(2));
                voxels.push(u16::from(squared.sum::<f64>() < 400.0));
            }
        }
    }
    let mut nifti = Nifti::new(size, voxels);
    nifti.rows = [0, 1, 2].map(|k| {
        let mut row = [0.0; 4];
        row[k] = spacing[k];
        row[3] = -middle[k];
        row
    });
    nifti
}

/// Judges: the closed forms of a ball, and that nothing shrinks when voxels are refined.
#[test]
fn a_ball_keeps_its_volume_and_shape() {
    let exact_volume = 4.0 / 3.0 * std::f64::consts::PI * 8e-6;
    let exact_area = 4.0 * std::f64::consts::PI * 4e-4;
    // Steps would add half of the area; waves of a tenth of a voxel over ten add a hundredth. Thick
    // slices end in flats that are wider than what is smoothed: up to 15 mm where they touch the poles.
    let cases = [([2.0; 3], 0.01), ([1.0; 3], 0.01), ([0.8, 0.8, 3.0], 0.03)];
    for (spacing, more_area) in cases {
        let map = map_of(&ball(spacing).bytes(), "ball.nii");
        let (found, report) = surface_of(&map, 1, &IsosurfaceSettings::default());
        // The voxels count the volume to about their face area at random; 1 % is asked for.
        assert!((found.voxel_volume / exact_volume - 1.0).abs() < 0.01);
        assert!((report.volume_m3 / found.voxel_volume - 1.0).abs() < 2e-3);
        let area = report.area_m2 / exact_area;
        assert!((area - 1.0).abs() < more_area, "{spacing:?}: {area}");
        let off = found.simplified.mesh.vertices().iter();
        let off = off.map(|v| (v.norm() - 0.02).abs()).fold(0.0, f64::max);
        // The picture leaves half a voxel open.
        assert!(off < 0.5e-3 * spacing[2], "{spacing:?}: {off}");
        assert_eq!((report.genus, report.self_intersections), (Some(0), 0));
        assert!(!found.is_cut);
    }
}

/// A turned block of voxels of three sizes; mirrored, too: judge is the same place by hand.
#[test]
fn the_place_of_the_file_is_kept() {
    let turn = nalgebra::Rotation3::new(Vec3::new(0.3, -0.5, 0.8)).into_inner();
    for mirror in [1.0, -1.0] {
        let steps = turn * nalgebra::Matrix3::from_diagonal(&Vec3::new(2.0, 3.0, 4.0 * mirror));
        let mut nifti = Nifti::new([8, 8, 8], vec![3; 512]);
        nifti.rows = [0, 1, 2].map(|i| [steps[(i, 0)], steps[(i, 1)], steps[(i, 2)], 10.0]);
        let map = map_of(&nifti.bytes(), "turned.nii");
        let (found, report) = surface_of(&map, 3, &IsosurfaceSettings::default());
        assert!((report.volume_m3 / (512.0 * 24e-9) - 1.0).abs() < 2e-3);
        let ras = steps * Vec3::repeat(3.5) + Vec3::repeat(10.0);
        let expected = 1e-3 * Vec3::new(-ras.x, -ras.y, ras.z);
        let mesh = &found.simplified.mesh;
        let middle: Vec3 = mesh.vertices().iter().sum::<Vec3>() / mesh.vertices().len() as f64;
        // Vertices of a symmetric body are not spread evenly: a tenth of a voxel.
        assert!((middle - expected).norm() < 4e-4, "{middle} {expected}");
        // The same block by the qform.
        if mirror == 1.0 {
            let again = map_of(&nifti.with_qform(&turn, [2.0, 3.0, 4.0]).bytes(), "q.nii");
            for k in 0..3 {
                // The quaternion is in single precision.
                assert!((again.spacing()[k] / map.spacing()[k] - 1.0).abs() < 1e-6);
            }
            let (by_qform, _) = surface_of(&again, 3, &IsosurfaceSettings::default());
            let mesh = by_qform.simplified.mesh;
            let middle = mesh.vertices().iter().sum::<Vec3>() / mesh.vertices().len() as f64;
            assert!((middle - expected).norm() < 4e-4, "{middle} {expected}");
        }
    }
}

#[test]
fn nrrd_is_nifti_in_other_words() {
    let nifti = ball([1.5; 3]);
    let expected = map_of(&nifti.bytes(), "a.nii");
    for (packed, big_endian) in [(false, false), (true, false), (false, true)] {
        let map = map_of(&nrrd(&nifti, packed, big_endian), "a.nrrd");
        assert_eq!(map.labels()[0].name.as_deref(), Some("ball"));
        assert_eq!(map.labels()[0].voxels, expected.labels()[0].voxels);
        let settings = IsosurfaceSettings::default();
        let [ours, theirs] = [&map, &expected].map(|m| surface_of(m, 1, &settings).0);
        // Decimal places of the header; NIfTI has single precision.
        assert!(deviation(&ours.simplified.mesh, &theirs.simplified.mesh).max < 1e-7);
    }
}

/// Three labels that touch: each is closed on its own, and together they fill the block.
#[test]
fn touching_labels_share_their_volume() {
    let voxels = (0..1000).map(|k| 1 + (k % 10) as u16 / 4).collect();
    let map = map_of(&Nifti::new([10, 10, 10], voxels).bytes(), "a.nii");
    let labels = map.labels();
    let counts: Vec<_> = labels.iter().map(|l| (l.number, l.voxels)).collect();
    assert_eq!(counts, [(1, 400), (2, 400), (3, 200)]);
    let volumes = labels.iter().map(|label| {
        let (found, report) = surface_of(&map, label.number, &IsosurfaceSettings::default());
        assert!(found.is_cut);
        report.volume_m3
    });
    let sum: f64 = volumes.sum();
    assert!((sum / 1e-6 - 1.0).abs() < 2e-3, "{sum}");
}

#[test]
fn pieces_and_hollows_are_told() {
    let mut voxels = vec![1; 7 * 7 * 7];
    voxels[(3 * 7 + 3) * 7 + 3] = 2;
    voxels.extend(vec![0; 49]);
    voxels.extend([vec![1; 2], vec![0; 47]].concat());
    let map = map_of(&Nifti::new([7, 7, 9], voxels).bytes(), "a.nii");
    let (found, _) = surface_of(&map, 1, &IsosurfaceSettings::default());
    assert_eq!(
        (found.other_pieces, found.other_voxels, found.filled_voxels),
        (1, 2, 1)
    );
    let absent = isosurface(&map, 9, &IsosurfaceSettings::default()).unwrap_err();
    assert_eq!(
        absent,
        IsosurfaceError::Absent {
            label: 9,
            present: "1, 2".to_owned()
        }
    );
    assert!(
        absent
            .to_string()
            .contains("no voxel has the label 9; there are 1, 2")
    );
}

#[test]
fn a_picture_is_no_label_map() {
    let folder = tempfile::tempdir().unwrap();
    let fault = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.path().join(name), bytes).unwrap();
        read_label_map(&folder.path().join(name)).unwrap_err().fault
    };
    let good = ball([4.0; 3]);
    let bytes = good.bytes();
    let cut = fault("cut.nii", &bytes[..bytes.len() - 1]);
    assert!(matches!(cut, ReadFault::Truncated { .. }), "{cut}");
    assert!(matches!(
        fault("a.mha", &bytes),
        ReadFault::UnknownMapExtension { .. }
    ));
    // A block of 32767³ voxels that is not there.
    let mut huge = bytes.clone();
    huge[42..48].copy_from_slice(&[0xff, 0x7f, 0xff, 0x7f, 0xff, 0x7f]);
    assert!(matches!(
        fault("huge.nii", &huge),
        ReadFault::TooLarge { .. }
    ));
    let mut flat = bytes.clone();
    flat[280..328].fill(0);
    assert!(matches!(
        fault("flat.nii", &flat),
        ReadFault::BadHeader { .. }
    ));
    let fault = fault(
        "half.nrrd",
        b"NRRD0004\ntype: float\nsizes: 1 1 1\nencoding: raw\n\n\0\0\0\x3f",
    );
    assert!(
        matches!(fault, ReadFault::NotALabel { found: 0.5, .. }),
        "{fault}"
    );
}

/// Judges: the meshes that the voxels were made of, and the counts of the voxels.
#[test]
#[ignore = "long"]
fn real_organs_come_back_from_their_voxels() {
    let Some(folder) = data::folder() else {
        return;
    };
    let map = read_label_map(&folder.join("volumes/vhm_abdomen_labels_1mm.nii.gz")).unwrap();
    let mesh = read_mesh(&folder.join("meshes/vhm_kidney_left_raw.ply"), None).unwrap();
    // Patient's left, back and head of the voxels, where the mesh has z and y exchanged.
    let original = mesh
        .mesh
        .map_vertices(|v| Vec3::new(v.x, -v.z, v.y))
        .unwrap();
    let label = map
        .labels()
        .into_iter()
        .find(|l| l.name.as_deref() == Some("kidney_left"));
    let (found, report) = surface_of(&map, label.unwrap().number, &IsosurfaceSettings::default());
    assert!((report.volume_m3 / found.voxel_volume - 1.0).abs() < 2e-3);
    let back = deviation(&found.simplified.mesh, &original);
    println!(
        "kidney: {:.3} mm at most, {:.3} mm on the mean",
        1e3 * back.max,
        1e3 * back.mean
    );
    // Half of a voxel of 1 mm on the mean would be its steps; they are smoothed.
    assert!(back.mean < 0.2e-3, "{back:?}");
}

/// Every organ of a CT; of the first six the border cuts all but the gallbladder.
#[test]
#[ignore = "long"]
fn real_ct_labels_are_closed() {
    let Some(folder) = data::folder() else {
        return;
    };
    let name = Path::new("volumes/totalsegmentator_example_seg.nii.gz");
    let map = read_label_map(&folder.join(name)).unwrap();
    for label in map.labels() {
        let (found, report) = surface_of(&map, label.number, &IsosurfaceSettings::default());
        let ratio = report.volume_m3 / found.voxel_volume;
        println!(
            "{} {:?}: {} triangles, genus {:?}, volume {ratio:.4}, cut {}, crossing {}",
            label.number,
            label.name,
            report.triangles,
            report.genus,
            found.is_cut,
            report.self_intersections
        );
        // Asked for: 1 %; of a few voxels of a rib there is no such shape.
        assert!(label.voxels < 500 || (ratio - 1.0).abs() < 0.01, "{ratio}");
        if label.number <= 6 {
            let name = label.name.unwrap();
            assert_eq!(found.is_cut, name != "gallbladder", "{name}");
        }
    }
}

/// Rods along all axes, so many voxels along each: the surface is everywhere, and no simplification can take its
/// handles away.
fn sponge(size: usize) -> LabelMap {
    let voxels = (0..size.pow(3)).map(|at| {
        let index = [at % size, at / size % size, at / size / size];
        let even = index.iter().filter(|&&k| k % 2 == 0).count();
        u16::from(even >= 2)
    });
    map_of(&Nifti::new([size; 3], voxels.collect()).bytes(), "a.nii")
}

/// The part that is done grows and ends near one, and who asks to cancel is heard soon.
#[test]
fn progress_is_told_and_heard() {
    let map = sponge(12);
    let mut parts = Vec::new();
    let settings = IsosurfaceSettings {
        smoothing: 10,
        triangles: 100,
    };
    let whole = isosurface_with_progress(&map, 1, &settings, &mut |part| {
        parts.push(part);
        ControlFlow::Continue(())
    });
    assert!(whole.unwrap().simplified.mesh.triangles().len() > 100);
    assert!(parts.is_sorted() && parts[0] >= 0.0, "{parts:?}");
    let last = parts[parts.len() - 1];
    assert!((0.9..=1.0).contains(&last), "{last}");
    // Often enough that a bar moves.
    assert!(parts.windows(2).all(|pair| pair[1] - pair[0] < 0.3));
    for end in [0.0, 0.05, 0.5, 0.9] {
        let mut after = 0;
        let cancelled = isosurface_with_progress(&map, 1, &settings, &mut |part| {
            after += usize::from(part >= end);
            match part < end {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        });
        let cancelled = cancelled.unwrap_err();
        assert_eq!(
            cancelled,
            IsosurfaceError::Simplify(SimplifyError::Cancelled)
        );
        assert_eq!(after, 1);
    }
}

/// A small file of a sponge can ask for any time: what is simplified has a bound, which the error states. 93 voxels along
/// each axis have some 4.9 million triangles.
#[test]
fn a_surface_of_too_many_triangles_is_refused() {
    let error = isosurface(&sponge(93), 1, &RAW).unwrap_err();
    assert_eq!(error, IsosurfaceError::TooLarge { label: 1 });
    let said = error.to_string();
    assert!(said.contains("more than 4000000 triangles") && said.contains("larger voxels"));
}

/// A header of a NRRD file is at most a mebibyte, so that what is sought in it takes no time.
#[test]
fn a_long_header_is_refused() {
    let whole = nrrd(&Nifti::new([2, 2, 2], vec![1; 8]), false, false);
    let end = whole.windows(2).position(|pair| pair == b"\n\n").unwrap();
    let with_keys = |count: usize| {
        let keys: String = (0..count)
            .map(|k| format!("Segment{k}_LabelValue:={}\nSegment{k}_Name:=part\n", k + 2))
            .collect();
        [&whole[..=end], keys.as_bytes(), &whole[end + 1..]].concat()
    };
    let map = map_of(&with_keys(10_000), "a.nrrd");
    assert_eq!(map.labels()[0].name.as_deref(), Some("ball"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.nrrd");
    std::fs::write(&path, with_keys(100_000)).unwrap();
    let error = read_label_map(&path).unwrap_err();
    let is_length = matches!(error.fault, ReadFault::BadHeader { what: "length", .. });
    assert!(is_length, "{error}");
}
