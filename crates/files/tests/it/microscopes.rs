//! Binary files of force microscopes. Judge: numbers that independent writers, below, put into small files, after Igor Pro
//! Technical Note 003 and after the vendor's reader of `.nid`; damaged files give an error or what was in them.

use palpate_files::recording::{ForeignColumns, RecordingHeader};
use palpate_files::{Error, Recording};

fn read_with(bytes: &[u8], said: &RecordingHeader) -> Result<Vec<Recording>, Error> {
    Recording::parse_all(bytes, "f", &ForeignColumns::default(), said)
}

pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Recording>, Error> {
    read_with(bytes, &RecordingHeader::default())
}

/// Positions towards the specimen and deflections [m].
pub(crate) const POSITIONS: [f64; 4] = [1e-6, 1.5e-6, 2e-6, 1.25e-6];
pub(crate) const DEFLECTIONS: [f64; 4] = [-1e-9, -1e-9, 4e-8, 1e-8];
pub(crate) const SPRING_CONSTANT: f64 = 0.5;

pub(crate) fn check(recording: &Recording, tolerance: f64) {
    let tip = |place: usize| POSITIONS[place] - DEFLECTIONS[place];
    for (place, deflection) in DEFLECTIONS.iter().enumerate() {
        let depth = recording.depth_m()[place];
        assert!((depth - (tip(place) - tip(0))).abs() < tolerance, "{depth}");
        let force = recording.force_n()[place];
        assert!(
            (force - SPRING_CONSTANT * deflection).abs() < tolerance,
            "{force}"
        );
    }
    assert!(!recording.begins_at_contact() && !recording.is_foreign());
}

/// A wave of version 5 with doubles, its header in either order of bytes.
fn wave(is_big: bool, labels: &[&str], columns: &[Vec<f64>], note: &str) -> Vec<u8> {
    let order = |mut bytes: Vec<u8>| {
        if is_big {
            bytes.reverse();
        }
        bytes
    };
    let mut file = vec![0u8; 384];
    let mut put = |at: usize, bytes: Vec<u8>| {
        let bytes = order(bytes);
        file[at..at + bytes.len()].copy_from_slice(&bytes);
    };
    let rows = columns[0].len();
    let size = 8 * rows * columns.len();
    let label_bytes = 32 * (labels.len() + 1);
    let long = |own: usize| (own as i32).to_le_bytes().to_vec();
    put(0, 5i16.to_le_bytes().to_vec());
    put(4, long(320 + size));
    put(12, long(note.len()));
    put(40, long(label_bytes));
    put(64 + 12, long(rows * columns.len()));
    put(64 + 16, 4i16.to_le_bytes().to_vec());
    put(64 + 68, long(rows));
    put(64 + 72, long(columns.len()));
    put(64 + 84, 5e-4f64.to_le_bytes().to_vec());
    let sum = short_sum(&file, is_big);
    let check = order(sum.wrapping_neg().to_le_bytes().to_vec());
    file[2..4].copy_from_slice(&check);
    for value in columns.iter().flatten() {
        file.extend(order(value.to_le_bytes().to_vec()));
    }
    file.extend(note.as_bytes());
    for label in std::iter::once(&"").chain(labels) {
        let mut own = [0u8; 32];
        own[..label.len()].copy_from_slice(label.as_bytes());
        file.extend(own);
    }
    file
}

pub(crate) const NOTE: &str = "Version:16.11\rSpringConstant: 0.5\rInvOLS: 2e-08\rMicroscopeModel:MFP3D\rXLVDT:1.5e-5\rYLVDT:-2e-6\r";

pub(crate) fn force_wave(is_big: bool) -> Vec<u8> {
    let columns = [vec![0.0; 4], DEFLECTIONS.to_vec(), POSITIONS.to_vec()];
    wave(is_big, &["Raw", "Defl", "ZSnsr"], &columns, NOTE)
}

#[test]
fn igor_wave_is_read_as_written() {
    for is_big in [false, true] {
        let all = read(&force_wave(is_big)).unwrap();
        check(&all[0], 1e-20);
        assert_eq!(all[0].time_s(), [0.0, 5e-4, 1e-3, 1.5e-3]);
        let header = &all[0].header;
        assert_eq!(header.position_m, Some([1.5e-5, -2e-6, 0.0]));
        assert_eq!(header.source.as_deref(), Some("Asylum Research MFP3D"));
        assert_eq!(header.spring_constant_n_per_m, Some(SPRING_CONSTANT));
        assert_eq!(header.sensitivity_m_per_v, Some(2e-8));
    }
}

/// Deflections in volts by the sensitivity; rows that a trigger left empty; another column of the position.
#[test]
fn igor_wave_in_volts_needs_its_sensitivity() {
    let mut columns = [
        DEFLECTIONS.iter().map(|d| d / 2e-8).collect::<Vec<f64>>(),
        POSITIONS.to_vec(),
    ];
    columns.iter_mut().for_each(|own| own.push(f64::NAN));
    let labels = ["DeflV", "Raw"];
    let all = read(&wave(false, &labels, &columns, NOTE)).unwrap();
    check(&all[0], 1e-20);
    assert_eq!(all[0].time_s().len(), 4);
    let error = read(&wave(false, &labels, &columns, "SpringConstant: 0.5\r")).unwrap_err();
    assert!(
        error.to_string().contains("--set sensitivity_m_per_v="),
        "{error}"
    );
    let error = read(&wave(false, &labels, &columns, "InvOLS: 1e-8\r")).unwrap_err();
    assert!(
        error.to_string().contains("--set spring_constant_n_per_m="),
        "{error}"
    );
    let error = read(&wave(false, &["DeflV", "Phase"], &columns, NOTE)).unwrap_err();
    assert!(error.to_string().contains("DeflV, Phase"), "{error}");
}

/// The sum of headers as short numbers.
pub(crate) fn short_sum(headers: &[u8], is_big: bool) -> i16 {
    let pairs = headers.chunks(2).map(|pair| [pair[0], pair[1]]);
    let shorts = pairs.map(|pair| match is_big {
        true => i16::from_be_bytes(pair),
        false => i16::from_le_bytes(pair),
    });
    shorts.fold(0, i16::wrapping_add)
}

/// A file of force curves at so many places.
fn nid(places: usize) -> Vec<u8> {
    nid_with(places, "")
}

/// A header of one line of force curves at each place, with more sections, and its numbers of 32 bits.
fn nid_with(places: usize, sections: &str) -> Vec<u8> {
    let mut text = "[DataSet]\r\nGroupCount=2\r\nGr0-Name=Spec forward\r\nGr0-Count=8\r\nGr1-Name=Spec backward\r\nGr1-Count=8\r\n\
        Gr0-Ch0=DataSet-0:0\r\nGr0-Ch7=DataSet-0:7\r\nGr1-Ch0=DataSet-1:0\r\nGr1-Ch7=DataSet-1:7\r\n\r\n\
        [DataSet\\DataSetInfos\\Global]\r\nHead type=FlexAFM\r\n\r\n\
        [DataSet\\Calibration\\Cantilever]\r\nProp0=D[0.5]*[N/m]\r\n\r\n\
        [DataSet\\Parameters\\Spectroscopy]\r\nFwModTime=D[1]*[s]\r\nFwModDatapoints=L[4]*[]\r\nBwModTime=D[0.5]*[s]\r\n\
        BwModDatapoints=L[1]*[]\r\n\r\n"
        .to_owned();
    text += sections;
    // Forward three of four points, backward one.
    for (group, frame, points, own) in [(0, "forward", 4, 3), (1, "backward", 1, 1)] {
        for (channel, name, unit, least, range) in [
            (0, "Deflection", "N", -1e-6, 2e-6),
            (7, "Z-Axis Sensor", "m", -4e-6, 8e-6),
        ] {
            text += &format!(
                "[DataSet-{group}:{channel}]\r\nPoints={points}\r\nLines={places}\r\nFrame=Spec {frame}\r\nDim2Name={name}\r\n\
                 Dim2Unit={unit}\r\nDim2Range={range:e}\r\nDim2Min={least:e}\r\nSaveMode=Binary\r\nSaveBits=32\r\n\
                 SaveSign=Signed\r\nSaveOrder=Intel\r\n"
            );
            for line in 0..places {
                text += &format!("LineDim{line}Points={own}\r\n");
            }
            text += "\r\n";
        }
    }
    let mut file = text.into_bytes();
    file.extend(b"\r\n\r\n#!");
    let forces: Vec<f64> = DEFLECTIONS.iter().map(|d| SPRING_CONSTANT * d).collect();
    for samples in [&[0, 1, 2, 2][..], &[3]] {
        for (values, half) in [(&forces[..], 1e-6), (&POSITIONS[..], 4e-6)] {
            for _ in 0..places {
                for sample in samples {
                    let raw = (values[*sample] / half * f64::from(1u32 << 31)).round() as i32;
                    file.extend(raw.to_le_bytes());
                }
            }
        }
    }
    file
}

/// Judge: what was written, to half a step of 32 bits of 8 µm.
#[test]
fn nanosurf_curves_are_read_as_written() {
    let all = read(&nid(2)).unwrap();
    assert_eq!(all.len(), 2);
    for (place, own) in all.iter().enumerate() {
        check(own, 4e-15);
        assert_eq!(own.time_s(), [0.0, 0.25, 0.5, 0.75]);
        assert_eq!(own.header.site.as_deref(), Some(&*format!("f {place}")));
        assert_eq!(own.header.source.as_deref(), Some("Nanosurf FlexAFM"));
    }
    let one = read(&nid(1)).unwrap();
    assert_eq!((one.len(), one[0].header.site.as_deref()), (1, None));
    let text = nid(1);
    let at = text.windows(5).position(|own| own == b"Prop0").unwrap();
    let mut unstated = text.clone();
    unstated[at] = b'Q';
    let error = read(&unstated).unwrap_err();
    assert!(
        error.to_string().contains("--set spring_constant_n_per_m="),
        "{error}"
    );
    let said = RecordingHeader {
        spring_constant_n_per_m: Some(SPRING_CONSTANT),
        ..RecordingHeader::default()
    };
    check(&read_with(&unstated, &said).unwrap()[0], 4e-15);
}

/// Where the curves of a file with such tables of places were measured, along x and y [m], and all remarks.
fn places(curves: usize, mode: &str, table: &str) -> (Vec<Option<[f64; 2]>>, String) {
    let sections = format!(
        "[DataSet\\SpecInfos\\SpecHeader]\r\nSpecMode={mode}\r\n\r\n[DataSet\\SpecInfos\\{}\r\n\r\n",
        table.replace('|', "\r\n")
    );
    let all = read(&nid_with(curves, &sections)).unwrap();
    all.iter().for_each(|own| check(own, 4e-15));
    let place = |own: &Recording| own.header.position_m.map(|[x, y, _]| [x, y]);
    let remarks = all.iter().flat_map(Recording::remarks).cloned();
    (all.iter().map(place).collect(), remarks.collect())
}

fn check_places(found: &[Option<[f64; 2]>], expected: &[[f64; 2]]) {
    assert_eq!(found.len(), expected.len());
    for (own, known) in found.iter().zip(expected) {
        let own = own.unwrap();
        // Rounding of a few micrometres.
        let is_near = own.iter().zip(known).all(|(a, b)| (a - b).abs() < 1e-20);
        assert!(is_near, "{own:?} {known:?}");
    }
}

/// Judge: places by hand, for the line of a real map of 10 × 10 curves, whose scan goes back and forth; a table that does
/// not fit gives no places and a remark.
#[test]
fn nanosurf_map_has_the_places_of_its_grid() {
    let table = |line: &str| format!("SpecMapTable]|Count=1|Map0={line}");
    let real = table("-2.25e-06;2.25e-06;-2.25e-06;2.25e-06;10;10;0;1");
    let (found, _) = places(22, "Map", &real);
    let there = (0..10).map(|step| -2.25e-6 + 0.5e-6 * f64::from(step));
    let there: Vec<f64> = there.collect();
    let first = there.iter().map(|x| [*x, -2.25e-6]);
    let second = there.iter().rev().map(|x| [*x, -1.75e-6]);
    let third = [[-2.25e-6, -1.25e-6], [-1.75e-6, -1.25e-6]];
    let expected: Vec<_> = first.chain(second).chain(third).collect();
    check_places(&found, &expected);

    let (found, _) = places(2, "Map", &table("1e-6;3e-6;2e-6;2e-6;2;1;0;0"));
    check_places(&found, &[[1e-6, 2e-6], [3e-6, 2e-6]]);
    let (found, _) = places(1, "Map", &table("1e-6;1e-6;2e-6;2e-6;1;1;0;0"));
    check_places(&found, &[[1e-6, 2e-6]]);

    for (line, why) in [
        ("0;1e-6;0;1e-6;1;2;0;1", "fewer places than"),
        ("0;1e-6;0;1e-6;0;9;0;1", "fewer places than"),
        ("0;1e-6;0;1e-6;2;2;30;1", "rotated"),
        ("0;1e-6;0;1e99;2;2;0;1", "not stated"),
        ("0;1e-6;0;1e-6;2", "not stated"),
        ("0;1e-6;0;1e-6;two;2;0;1", "not stated"),
    ] {
        let (found, remarks) = places(3, "Map", &table(line));
        assert_eq!(found, [None; 3], "{line}");
        assert!(remarks.contains(why), "{remarks}");
    }
}

/// Judge: the numbers of the list, in the units that it states.
#[test]
fn nanosurf_list_of_places_is_read() {
    let listed =
        "SpecPosTable]|PosAxis=Z;X;Y|PosUnit=m;um;m|Count=2|Pos0=0;1.5;-2e-6|Pos1=0;-3;4e-6";
    let (found, remarks) = places(2, "Position list", listed);
    check_places(&found, &[[1.5e-6, -2e-6], [-3e-6, 4e-6]]);
    assert!(!remarks.contains("not known"), "{remarks}");
    let (found, remarks) = places(3, "Position list", listed);
    assert_eq!(found, [None; 3]);
    assert!(remarks.contains("fewer places than"), "{remarks}");
}

/// Files that are cut short are refused; those of which a byte is another are refused or read: never a panic.
#[test]
fn damaged_microscope_files_are_refused_or_read() {
    let table =
        "[DataSet\\SpecInfos\\SpecMapTable]\r\nCount=1\r\nMap0=0;1e-6;0;1e-6;1;2;0;1\r\n\r\n";
    for whole in [force_wave(false), force_wave(true), nid_with(2, table)] {
        for end in 0..whole.len() {
            match read(&whole[..end]) {
                Ok(all) => panic!("{end} of {} bytes were read: {all:?}", whole.len()),
                Err(error) => assert!(
                    error.is_input() && error.to_string().starts_with('f'),
                    "{error}"
                ),
            }
        }
        for place in 0..whole.len() {
            for turned in [1, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[place] ^= turned;
                if let Err(error) = read(&bytes) {
                    assert!(
                        error.is_input() && error.to_string().starts_with('f'),
                        "{error}"
                    );
                }
            }
        }
    }
}
