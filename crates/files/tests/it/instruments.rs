//! Files of instruments. Judges: the export of another program (afmformats 0.18.7) for a real JPK curve; numbers that an
//! independent writer, `jpk_files`, put into small files; damaged files give an error or what was in them.

use std::path::PathBuf;

use palpate_files::recording::{ForeignColumns, IndenterShape, RecordingHeader};
use palpate_files::{Error, Recording};

use crate::jpk_files::{
    DEFLECTIONS, HEIGHTS, Numbers, SENSITIVITY, SPRING_CONSTANT, archive, archive_of, floating,
    general, segment, shared, single, single_parts,
};

/// A file of the AFM recordings in the data folder; none, with a notice, where that is not there.
fn real(name: &str) -> Option<Vec<u8>> {
    let lent = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let folder = std::env::var_os("PALPATE_DATA").map_or(PathBuf::from(lent), PathBuf::from);
    let path = folder.join("characterization/afm").join(name);
    let bytes = std::fs::read(&path).ok();
    if bytes.is_none() {
        println!("passed over: no {}; set PALPATE_DATA", path.display());
    }
    bytes
}

fn read_with(bytes: &[u8], name: &str, said: &RecordingHeader) -> Result<Vec<Recording>, Error> {
    Recording::parse_all(bytes, name, &ForeignColumns::default(), said)
}

fn read(bytes: &[u8], name: &str) -> Result<Vec<Recording>, Error> {
    read_with(bytes, name, &RecordingHeader::default())
}

fn check(recording: &Recording) {
    // Rounding of heights of 0.1 mm.
    check_to(recording, 1e-19 + 1e-15 * 1e-4 * 4.0);
}

/// Depths to a tolerance [m].
fn check_to(recording: &Recording, tolerance: f64) {
    // The base falls by 1 µm a step, 0.01 V/1 · 2 µm/V · 0.5 · 100; the deflection is 0.1 V · 20 nm/V for each raw number.
    let height = |n: i16| f64::from(n) * 1e-8;
    let deflection = |n: i16| 2e-9 * f64::from(n);
    let both = HEIGHTS.iter().zip(&DEFLECTIONS);
    let tip: Vec<f64> = both.map(|(z, d)| height(*z) + deflection(*d)).collect();
    assert_eq!(recording.time_s(), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]);
    for (place, depth) in recording.depth_m().iter().enumerate() {
        assert!((depth - (tip[0] - tip[place])).abs() < tolerance, "{depth}");
        let force = SPRING_CONSTANT * (deflection(DEFLECTIONS[place]) - SENSITIVITY);
        assert!(
            (recording.force_n()[place] - force).abs() < 1e-12 * 3e-8,
            "{force}"
        );
    }
    assert!(!recording.begins_at_contact() && !recording.is_foreign());
}

#[test]
fn what_was_written_is_read() {
    let all = read(&single(true), "a.jpk-force").unwrap();
    check(&all[0]);
    let header = &all[0].header;
    assert_eq!(header.position_m, Some([1.5e-5, -2e-6, 0.0]));
    assert_eq!(header.source.as_deref(), Some("JPK:1, 6.1"));
    assert_eq!((header.site.as_deref(), all.len()), (None, 1));
    let remark = &all[0].remarks()[0];
    assert!(
        remark.contains("extend 2.000 s, retract 1.000 s") && remark.contains("0.05000 N/m"),
        "{remark}"
    );
}

/// The calibration is missing, and then stated.
#[test]
fn a_missing_calibration_is_asked_for() {
    let file = single(false);
    let said = |sensitivity, constant| RecordingHeader {
        sensitivity_m_per_v: sensitivity,
        spring_constant_n_per_m: constant,
        ..RecordingHeader::default()
    };
    for (stated, key) in [
        (
            said(None, Some(SPRING_CONSTANT)),
            "--set sensitivity_m_per_v=",
        ),
        (
            said(Some(SENSITIVITY), None),
            "--set spring_constant_n_per_m=",
        ),
    ] {
        let error = read_with(&file, "a.jpk-force", &stated).unwrap_err();
        assert!(
            error.is_input() && error.to_string().contains(key),
            "{error}"
        );
    }
    let all = read_with(
        &file,
        "a.jpk-force",
        &said(Some(SENSITIVITY), Some(SPRING_CONSTANT)),
    )
    .unwrap();
    check(&all[0]);
}

#[test]
fn a_map_has_a_recording_for_each_place() {
    let mut parts = vec![general(), shared(true)];
    for curve in [2, 10, 0] {
        parts.extend(segment(
            &format!("index/{curve}/segments/0/"),
            "extend",
            0..6,
        ));
    }
    let all = read(&archive(&parts), "folder/map.jpk-force-map").unwrap();
    let sites: Vec<_> = all
        .iter()
        .map(|own| own.header.site.as_deref().unwrap())
        .collect();
    assert_eq!(sites, ["map 0", "map 2", "map 10"]);
    all.iter().for_each(check);
}

/// A file that is cut short is refused; one whose byte is another is refused, or is read the same where that byte says
/// nothing, or differs in a header without a checksum of its own meaning (name, position): never a panic.
#[test]
fn damaged_files_are_refused_or_read() {
    let whole = single(true);
    for end in 0..whole.len() {
        if let Ok(all) = read(&whole[..end], "a.jpk-force") {
            panic!("{end} of {} bytes were read: {all:?}", whole.len());
        }
    }
    let mut refused = 0;
    for place in 0..whole.len() {
        for turned in [1, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[place] ^= turned;
            match read(&bytes, "a.jpk-force") {
                Ok(all) => all.iter().for_each(check),
                Err(error) => {
                    assert!(error.to_string().starts_with("a.jpk-force"), "{error}");
                    refused += 1;
                }
            }
        }
    }
    assert!(2 * refused > 3 * whole.len(), "{refused}");
}

/// Judge: the writer above, after the specification; an archive that is cut short or damaged, as above.
#[test]
fn archive_with_numbers_of_64_bits_is_read() {
    let parts = single_parts(true);
    let whole = archive_of(&parts, Numbers::Long);
    check(&read(&whole, "a.jpk-force").unwrap()[0]);
    for end in 0..whole.len() {
        assert!(read(&whole[..end], "a.jpk-force").is_err(), "{end}");
    }
    for place in 0..whole.len() {
        for turned in [1, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[place] ^= turned;
            if let Ok(all) = read(&bytes, "a.jpk-force") {
                all.iter().for_each(check);
            }
        }
    }
}

/// As many parts as a map of 64 × 64 curves may have: more than a number of 16 bits counts.
#[test]
fn archive_of_very_many_parts_is_read() {
    let mut parts = single_parts(true);
    parts.extend((0..70_000).map(|place| (format!("thumbnails/{place}"), Vec::new())));
    check(&read(&archive_of(&parts, Numbers::Long), "a.jpk-force").unwrap()[0]);
}

/// Judge: the same curve in whole numbers, to the single precision of heights of 5 µm and twice as much. The keys are
/// those of a real file with a smoothed height in single precision; a deflection in such numbers was not found in any.
#[test]
fn channels_of_floating_point_numbers_are_read() {
    let tolerance = 2.0 * 5e-6 * f64::from(f32::EPSILON);
    for base in ["volts", "distance", "force"] {
        let all = read(&floating(base, true), "a.jpk-force").unwrap();
        check_to(&all[0], tolerance);
        let header = &all[0].header;
        let known = [header.spring_constant_n_per_m, header.sensitivity_m_per_v];
        for (own, truth) in known.into_iter().zip([SPRING_CONSTANT, SENSITIVITY]) {
            let own = own.unwrap();
            assert!((own / truth - 1.0).abs() < 1e-14, "{base}: {own}");
        }
        let error = read(&floating(base, false), "a.jpk-force").unwrap_err();
        assert!(
            error.to_string().contains("--set spring_constant_n_per_m="),
            "{error}"
        );
        let said = RecordingHeader {
            spring_constant_n_per_m: Some(SPRING_CONSTANT),
            ..RecordingHeader::default()
        };
        let all = read_with(&floating(base, false), "a.jpk-force", &said).unwrap();
        check_to(&all[0], tolerance);
    }
}

/// Sizes that are lies take no memory.
#[test]
fn a_size_that_cannot_be_is_refused() {
    let mut file = single(true);
    let at = file
        .windows(4)
        .position(|own| own == b"PK\x01\x02")
        .unwrap();
    file[at + 24..at + 28].copy_from_slice(&0x0fff_ffff_u32.to_le_bytes());
    let error = read(&file, "a.jpk-force").unwrap_err().to_string();
    assert!(
        error.contains("states a size that it cannot have"),
        "{error}"
    );
}

/// A part of an archive whose parts are deflated.
fn unpacked(archive: &[u8], name: &str) -> Vec<u8> {
    use std::io::Read;
    let at = archive
        .windows(name.len())
        .position(|own| own == name.as_bytes())
        .unwrap()
        - 30;
    let header = &archive[at..];
    let number = |place: usize| u16::from_le_bytes([header[place], header[place + 1]]) as usize;
    let packed = &header[30 + number(26) + number(28)..];
    let mut bytes = Vec::new();
    flate2::read::DeflateDecoder::new(packed)
        .read_to_end(&mut bytes)
        .unwrap();
    bytes
}

/// Judge: the same curve as another program exported it, sample by sample. Times have six digits there, forces seven and
/// heights nine.
#[test]
fn real_jpk_curve_is_what_another_program_exported() {
    let archive = real("afm_stress_relaxation_cell1_15curves_jpk.zip");
    let Some((archive, table)) = archive.zip(real("afm_stress_relaxation_cell1-0008.csv")) else {
        return;
    };
    let file = unpacked(&archive, "cell1-0008.jpk-force");
    let all = read(&file, "cell1-0008.jpk-force").unwrap();
    let recording = &all[0];
    let header = &recording.header;
    assert_eq!((all.len(), header.site.as_deref()), (1, None));
    let known = [header.spring_constant_n_per_m, header.sensitivity_m_per_v].map(Option::unwrap);
    for (own, stated) in known.into_iter().zip([1.0677, 1.1028e-7]) {
        assert!((own / stated - 1.0).abs() < 1e-12, "{own} {stated}");
    }
    let table = String::from_utf8(table).unwrap();
    let rows = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    let rows: Vec<Vec<f64>> = rows
        .map(|row| row.split(',').map(|own| own.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), recording.time_s().len());
    let tip = |row: &[f64]| row[2] + row[1] / 1.0677;
    for (place, row) in rows.iter().enumerate() {
        let (time, force) = (recording.time_s()[place], recording.force_n()[place]);
        assert!((time - row[0]).abs() <= 5e-6 * row[0], "{time} {row:?}");
        assert!(
            (force - row[1]).abs() <= 5.1e-7 * row[1].abs() + 1e-16,
            "{force} {row:?}"
        );
        let depth = recording.depth_m()[place];
        // Two heights, rounded to half of 1e-12 m, and two forces.
        assert!(
            (depth - (tip(&rows[0]) - tip(row))).abs() < 1.2e-12,
            "{depth} {row:?}"
        );
    }
    // The writer of the real file knows nothing of ours: cut short it is refused too.
    for end in (0..file.len()).step_by(997) {
        assert!(read(&file[..end], "f").is_err(), "{end}");
    }
}

/// Judge: the file's own header and its last line, converted by hand.
#[test]
fn real_chiaro_text_is_read() {
    let Some(bytes) = real("chiaro_AEBP1_Indentation_002.txt") else {
        return;
    };
    let all = read(&bytes, "chiaro.txt").unwrap();
    let (recording, header) = (&all[0], &all[0].header);
    assert_eq!(header.indenter_shape, Some(IndenterShape::Sphere));
    assert_eq!(header.indenter_radius_m, Some(27.5e-6));
    assert_eq!(header.spring_constant_n_per_m, Some(0.019));
    let [x, y, _] = header.position_m.unwrap();
    assert!((x - 5314.32e-6).abs() < 1e-12 && (y - 5500.88e-6).abs() < 1e-12);
    assert_eq!(recording.time_s().len(), 13_827);
    // Piezo less cantilever, against the first sample.
    let text: String = bytes.iter().map(|&byte| byte as char).collect();
    let last: Vec<f64> = text
        .trim_end()
        .rsplit('\n')
        .next()
        .unwrap()
        .split('\t')
        .map(|own| own.trim().parse().unwrap())
        .collect();
    let depth = 1e-9 * (last[4] - last[3] - (64.971622 + 16.214418));
    assert!(
        (recording.depth_m().last().unwrap() - depth).abs() < 1e-15,
        "{depth}"
    );
    assert!((recording.force_n().last().unwrap() - 1e-6 * last[1]).abs() < 1e-18);
    assert!(
        recording.remarks()[0].contains("E[v=0.500] = 117.0 Pa"),
        "{:?}",
        recording.remarks()
    );
}

/// A text of the same form, cut short at each byte: an error or fewer samples.
#[test]
fn optics11_text_that_is_damaged_is_refused_or_read() {
    let text = "Date\t1\nX-position (um)\t1,5\tY-position (um)\t2\nk (N/m)\t0.5\nTip radius (um)\t10\nDevice:\tPiuma\n\
        Time (s)\tLoad (uN)\tIndentation (nm)\tCantilever (nm)\tPiezo (nm)\n0,5\t0\t0\t0\t0\n1\t1\t0\t2000\t3000\n";
    let all = read(text.as_bytes(), "f").unwrap();
    assert_eq!(all[0].time_s(), [0.5, 1.0]);
    assert!(
        (all[0].depth_m()[1] - 1e-6).abs() < 1e-18,
        "{:?}",
        all[0].depth_m()
    );
    assert_eq!(all[0].header.indenter_radius_m, Some(1e-5));
    for end in 0..text.len() {
        match read(&text.as_bytes()[..end], "f") {
            Ok(all) => assert!(all[0].time_s().len() <= 2),
            Err(error) => assert!(
                error.is_input() && error.to_string().starts_with('f'),
                "{error}"
            ),
        }
    }
}
