//! Recordings of other programs, read as they are.

use std::fs;
use std::path::{Path, PathBuf};

use palpate_characterize::clean::SegmentKind::{Hold, Ramp, Retreat};
use palpate_characterize::{CleanRecording, CleanSettings, clean};
use palpate_files::Recording;
use palpate_files::recording::{ForeignColumns, RecordingHeader};

use crate::data;

fn files(folder: &Path) -> Vec<PathBuf> {
    let all = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut tables: Vec<_> = all
        .filter(|path| path.extension().is_some_and(|end| end == "csv"))
        .collect();
    tables.sort();
    tables
}

fn cleaned(path: &Path, columns: &ForeignColumns) -> CleanRecording {
    let recording = Recording::read_foreign(path, columns).unwrap();
    clean(&recording, &CleanSettings::default())
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Judge: the machine's program: the indenter rests for 0.4 s at the surface, goes down and stays for
/// ten seconds; and the force, which has left the sensor's 3 mN
/// behind half a second after contact.
#[test]
fn real_meat_is_read_without_a_word() {
    let Some(folder) = data::folder() else {
        return;
    };
    let files = files(&folder.join("meat_indentation_GPL3"));
    assert_eq!(files.len(), 72);
    for path in files {
        let clean = cleaned(&path, &ForeignColumns::default());
        let name = path.display();
        let contact = clean.handling.contact;
        // It rests for 0.4 s, and some specimens were still out of reach then.
        assert!((0.25..3.5).contains(&contact.time_s), "{name}: {contact:?}");
        assert!(contact.offset_n.abs() < 0.025, "{name}: {contact:?}");
        let next = clean.force[contact.sample + 6];
        assert!(next > 0.008, "{name}: {contact:?} {next} N");
        let [ramp, hold] = clean.segments.as_slice() else {
            panic!("{name}: {:?}", clean.segments);
        };
        assert_eq!((ramp.kind, hold.kind), (Ramp, Hold), "{name}");
        let held = clean.duration(hold);
        assert!((9.0..11.0).contains(&held), "{name}: held for {held} s");
        assert!(clean.force.iter().all(|force| force.is_finite()));
    }
}

/// Judge: the heads of the files: 10 mm/min from first contact to 67 % of 30 mm.
#[test]
fn real_silicone_is_read_without_a_word() {
    let Some(folder) = data::folder() else {
        return;
    };
    for path in files(&folder.join("silicone_phantoms")) {
        let clean = cleaned(&path, &ForeignColumns::default());
        let name = path.display();
        assert!(
            clean.handling.contact.depth_m < 0.5e-3,
            "{name}: {:?}",
            clean.handling.contact
        );
        assert_eq!(clean.segments.len(), 1, "{name}: {:?}", clean.segments);
        assert_eq!(clean.segments[0].kind, Ramp);
        let speed = clean.depth.last().unwrap() / clean.time.last().unwrap();
        assert!((speed * 6e4 - 10.0).abs() < 0.2, "{name}: {speed} m/s");
    }
}

/// Judge: what the exporter noted of the segments; a force microscope counts height, which falls.
#[test]
fn real_force_microscopy_is_read_by_the_name_of_its_height() {
    let Some(folder) = data::folder() else {
        return;
    };
    let columns = ForeignColumns {
        depth: Some("height_piezo_m".to_owned()),
        ..ForeignColumns::default()
    };
    let folder = folder.join("afm");
    let cell = cleaned(
        &folder.join("afm_stress_relaxation_cell1-0008.csv"),
        &columns,
    );
    assert_eq!(cell.handling.signs, [-1.0, 1.0]);
    let offset = cell.handling.contact.offset_n;
    assert!((offset + 116.6e-9).abs() < 1e-9, "{offset} N");
    let kinds: Vec<_> = cell.segments.iter().map(|own| own.kind).collect();
    assert_eq!(kinds, [Ramp, Hold, Retreat]);
    assert!((cell.duration(&cell.segments[1]) - 30.0).abs() < 0.1);
    for (file, offset) in [
        ("afm_creep_brain_pr14.csv", 11.23e-9),
        ("afm_creep_polymergel_pr14.csv", 0.40e-9),
    ] {
        let clean = cleaned(&folder.join(file), &columns);
        let seen = clean.handling.contact.offset_n;
        assert!((seen - offset).abs() < 0.3e-9, "{file}: {seen} N");
        assert_eq!(clean.handling.signs, [-1.0, 1.0]);
    }
}

/// Judge: the instrument's own column of indentation, which is above zero from 10.526 s and a displacement of 73.08 µm on,
/// where its threshold of force is reached; the sensor's zero rises by 0.7 nN of 49 nN before. As a table that column is the
/// depth. As the instrument's own file, contact is searched over the displacement. Tolerance: a sample, and 3 of the stated
/// errors.
#[test]
fn real_optical_indentation_is_read_without_a_word() {
    let Some(folder) = data::folder() else {
        return;
    };
    let path = folder.join("afm/chiaro_AEBP1_Indentation_002.txt");
    let columns = ForeignColumns::default();
    let table = cleaned(&path, &columns);
    assert!(table.depth.iter().all(|depth| depth.is_finite()));
    assert_eq!(table.segments[0].kind, Ramp);
    let time = table.handling.contact.time_s;
    assert!((time - 10.526).abs() < 1.5e-3, "{time}");
    let own = Recording::read_all(&path, &columns, &RecordingHeader::default()).unwrap();
    let contact = clean(&own[0], &CleanSettings::default())
        .unwrap()
        .handling
        .contact;
    println!("{contact:?}");
    let error = contact.depth_error_m.unwrap();
    // Depth counts from the first sample, whose displacement is 81.2 nm.
    let off = 73.08e-6 - 0.0812e-6 - contact.depth_m;
    assert!(
        (0.0..3.0 * error).contains(&off) && error < 1.5e-6,
        "{contact:?}"
    );
    assert!(contact.drift_n_per_s.unwrap() > 0.0);
}

/// Judge: the tables themselves.
#[test]
fn real_rubber_is_read_as_a_cube() {
    let Some(folder) = data::folder() else {
        return;
    };
    let columns = ForeignColumns {
        force_unit: Some("MPa".to_owned()),
        ..ForeignColumns::default()
    };
    for (file, rows) in [
        ("treloar1944_uniaxial.csv", 24),
        ("treloar1944_uniaxial_example.csv", 21),
    ] {
        let clean = cleaned(&folder.join("rubber").join(file), &columns);
        assert_eq!(clean.time.len(), rows, "{file}");
        assert_eq!(clean.warnings.len(), 1, "{file}: {:?}", clean.warnings);
        let pulled = -clean.depth[rows - 1];
        let stress = -clean.force[rows - 1];
        assert!(
            (4.0..8.0).contains(&pulled) && (3e6..8e6).contains(&stress),
            "{file}: {pulled} {stress}"
        );
    }
}
