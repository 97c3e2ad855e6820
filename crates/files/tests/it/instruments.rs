//! Files of instruments. Judges: the export of another program (afmformats 0.18.7) for a real JPK curve; numbers that an
//! independent writer, below, put into small files; damaged files give an error or what was in them.

use std::path::PathBuf;

use palpate_files::recording::{ForeignColumns, IndenterShape, RecordingHeader};
use palpate_files::{Error, Recording};

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

/// CRC-32 bit by bit [ITU-T V.42].
fn checksum(bytes: &[u8]) -> u32 {
    let turn = |sum: u32, byte: &u8| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ (0xEDB8_8320 * (sum & 1))
        })
    };
    !bytes.iter().fold(!0, turn)
}

/// A ZIP archive; every second part is deflated, in blocks that are stored [RFC 1951, section 3.2.4].
fn archive(parts: &[(String, Vec<u8>)]) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (place, (name, content)) in parts.iter().enumerate() {
        let mut packed = content.clone();
        if place % 2 == 1 {
            let length = content.len() as u16;
            packed = [
                &[1],
                &length.to_le_bytes()[..],
                &(!length).to_le_bytes(),
                content,
            ]
            .concat();
        }
        let method = if place % 2 == 1 { 8u16 } else { 0 };
        let numbers = [checksum(content), packed.len() as u32, content.len() as u32];
        let mut common = [20u16, 0, method, 0, 0].map(u16::to_le_bytes).concat();
        common.extend(numbers.map(u32::to_le_bytes).concat());
        common.extend([name.len() as u16, 0].map(u16::to_le_bytes).concat());
        let at = file.len() as u32;
        file.extend([&b"PK\x03\x04"[..], &common, name.as_bytes(), &packed].concat());
        let after = [[0u8; 10].to_vec(), at.to_le_bytes().to_vec()].concat();
        let entry = [&b"PK\x01\x02\x14\x00"[..], &common, &after, name.as_bytes()];
        directory.extend(entry.concat());
    }
    let (at, size) = (file.len() as u32, directory.len() as u32);
    let count = parts.len() as u16;
    file.extend(directory);
    file.extend(b"PK\x05\x06\0\0\0\0");
    file.extend([count, count].map(u16::to_le_bytes).concat());
    file.extend([size, at].map(u32::to_le_bytes).concat());
    file.extend([0, 0]);
    file
}

const SENSITIVITY: f64 = 2e-8;
const SPRING_CONSTANT: f64 = 0.05;
/// Raw numbers: a height that falls by 1 µm a step, and a deflection that rises at the end.
const HEIGHTS: [i16; 6] = [500, 400, 300, 200, 100, 0];
const DEFLECTIONS: [i16; 6] = [0, 0, 0, 0, 100, 300];

/// The parts of a segment of two samples or more, in a folder.
fn segment(folder: &str, style: &str, samples: std::ops::Range<usize>) -> Vec<(String, Vec<u8>)> {
    let header = format!(
        "#a comment\nforce-segment-header.force-segment-header-info.*=0\nforce-segment-header.duration={}\n\
         force-segment-header.settings.style={style}\n\
         force-segment-header.environment.xy-scanner-position-map.xy-scanner.stage.position.x=1.5E-5\n\
         force-segment-header.environment.xy-scanner-position-map.xy-scanner.stage.position.y=-2E-6\n\
         channel.height.lcd-info.*=0\nchannel.height.data.file.name=channels/height.dat\n\
         channel.vDeflection.lcd-info.*=1\nchannel.vDeflection.data.file.name=channels/vDeflection.dat\n",
        0.5 * samples.len() as f64
    );
    let shorts = |own: &[i16]| {
        own[samples.clone()]
            .iter()
            .flat_map(|n| n.to_be_bytes())
            .collect()
    };
    vec![
        (format!("{folder}segment-header.properties"), header.into()),
        (format!("{folder}channels/height.dat"), shorts(&HEIGHTS)),
        (
            format!("{folder}channels/vDeflection.dat"),
            shorts(&DEFLECTIONS),
        ),
    ]
}

/// What segments share. Volts are a hundredth of the raw height and a tenth, less one, of the raw deflection.
fn shared(conversions: bool) -> (String, Vec<u8>) {
    let mut text = "force-segment-header-info.0.environment.xy-scanner-position-map.xy-scanners.active-xy-scanner.name=stage\n\
        lcd-info.0.encoder.type=signedshort\nlcd-info.0.encoder.scaling.offset=0\nlcd-info.0.encoder.scaling.multiplier=0.01\n\
        lcd-info.0.conversion-set.conversions.base=volts\nlcd-info.0.conversion-set.conversions.default=calibrated\n\
        lcd-info.0.conversion-set.conversion.calibrated.base-calibration-slot=nominal\n\
        lcd-info.0.conversion-set.conversion.calibrated.scaling.offset=1E-4\n\
        lcd-info.0.conversion-set.conversion.calibrated.scaling.multiplier=0.5\n\
        lcd-info.0.conversion-set.conversion.calibrated.scaling.unit.unit=m\n\
        lcd-info.0.conversion-set.conversion.nominal.base-calibration-slot=volts\n\
        lcd-info.0.conversion-set.conversion.nominal.scaling.offset=0\n\
        lcd-info.0.conversion-set.conversion.nominal.scaling.multiplier=2E-6\n\
        lcd-info.1.encoder.type=signedshort\nlcd-info.1.encoder.scaling.offset=-1\nlcd-info.1.encoder.scaling.multiplier=0.1\n\
        lcd-info.1.conversion-set.conversions.base=volts\nlcd-info.1.conversion-set.conversions.default=force\n"
        .to_owned();
    if conversions {
        for (own, base, size) in [
            ("distance", "volts", SENSITIVITY),
            ("force", "distance", SPRING_CONSTANT),
        ] {
            let key = format!("lcd-info.1.conversion-set.conversion.{own}");
            text += &format!(
                "{key}.base-calibration-slot={base}\n{key}.scaling.offset=0\n{key}.scaling.multiplier={size:E}\n"
            );
        }
    }
    ("shared-data/header.properties".to_owned(), text.into())
}

fn general() -> (String, Vec<u8>) {
    let text = "force-scan-series.description.instrument=JPK\\:1\nforce-scan-series.description.source-software=6.1\n";
    ("header.properties".to_owned(), text.into())
}

fn single(conversions: bool) -> Vec<u8> {
    let mut parts = vec![general(), shared(conversions)];
    parts.extend(segment("segments/0/", "extend", 0..4));
    parts.extend(segment("segments/1/", "retract", 4..6));
    archive(&parts)
}

fn check(recording: &Recording) {
    // The base falls by 1 µm a step, 0.01 V/1 · 2 µm/V · 0.5 · 100; the deflection is 0.1 V · 20 nm/V for each raw number.
    let height = |n: i16| f64::from(n) * 1e-8;
    let deflection = |n: i16| 2e-9 * f64::from(n);
    let both = HEIGHTS.iter().zip(&DEFLECTIONS);
    let tip: Vec<f64> = both.map(|(z, d)| height(*z) + deflection(*d)).collect();
    assert_eq!(recording.time_s(), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5]);
    for (place, depth) in recording.depth_m().iter().enumerate() {
        // Rounding of heights of 0.1 mm.
        assert!(
            (depth - (tip[0] - tip[place])).abs() < 1e-19 + 1e-15 * 1e-4 * 4.0,
            "{depth}"
        );
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
