//! Igor binary waves of one column, two of which are a curve. Judge: numbers that an independent writer, below, put into
//! small files after Igor Pro Technical Note 003.

use palpate_files::recording::{
    ForeignColumns, RecordingHeader, deflection_beside, position_beside,
};
use palpate_files::{Error, Recording};

use crate::microscopes::{
    DEFLECTIONS, NOTE, POSITIONS, SPRING_CONSTANT, check, force_wave, read, short_sum,
};

/// A wave of one column, of a version before 5, with numbers of 32 bits.
struct OldWave {
    version: i16,
    is_big: bool,
    name: &'static str,
    unit: &'static str,
    row_unit: &'static str,
    step: f64,
    values: Vec<f64>,
    note: &'static str,
}

impl OldWave {
    fn bytes(&self) -> Vec<u8> {
        let order = |mut bytes: Vec<u8>| {
            if self.is_big {
                bytes.reverse();
            }
            bytes
        };
        let short = |own: usize| order((own as i16).to_le_bytes().to_vec());
        let long = |own: usize| order((own as i32).to_le_bytes().to_vec());
        let padded = |text: &str, length: usize| {
            let mut own = text.as_bytes().to_vec();
            own.resize(length, 0);
            own
        };
        let size = 126 + 4 * self.values.len();
        let note = if self.version == 1 { "" } else { self.note };
        let mut file = [short(self.version as usize), long(size)].concat();
        if self.version > 1 {
            file.extend(long(note.len()));
        }
        // The length of a formula, and of a picture.
        for _ in 1..self.version {
            file.extend(long(0));
        }
        let checksum = file.len();
        file.extend(short(0));
        let wave = [
            short(2),
            long(0),
            padded(self.name, 20),
            vec![0; 8],
            padded(self.unit, 4),
            padded(self.row_unit, 4),
            long(self.values.len()),
            short(0),
            order(self.step.to_le_bytes().to_vec()),
            vec![0; 54],
        ];
        file.extend(wave.concat());
        // The headers end with place for four numbers.
        let headers = file.len() + 16;
        let numbers = self.values.iter();
        let numbers = numbers.flat_map(|own| order((*own as f32).to_le_bytes().to_vec()));
        file.extend(numbers);
        file.extend([0; 16]);
        file.extend(note.as_bytes());
        let covered = short_sum(&file[..headers], self.is_big);
        let own = order(covered.wrapping_neg().to_le_bytes().to_vec());
        file[checksum..checksum + 2].copy_from_slice(&own);
        file
    }
}

fn old_wave(version: i16, is_big: bool, is_deflection: bool) -> OldWave {
    let values = if is_deflection {
        DEFLECTIONS
    } else {
        POSITIONS
    };
    OldWave {
        version,
        is_big,
        name: if is_deflection {
            "Curve7Defl"
        } else {
            "Curve7ZSnsr"
        },
        unit: "m",
        row_unit: "s",
        step: 5e-4,
        values: values.to_vec(),
        note: NOTE,
    }
}

/// Writes both waves of a curve, and reads the first.
fn read_pair(names: [&str; 2], waves: [&OldWave; 2]) -> Result<Vec<Recording>, Error> {
    let folder = tempfile::tempdir().unwrap();
    for (name, wave) in names.iter().zip(waves) {
        std::fs::write(folder.path().join(name), wave.bytes()).unwrap();
    }
    let said = RecordingHeader {
        spring_constant_n_per_m: Some(SPRING_CONSTANT),
        ..RecordingHeader::default()
    };
    let path = folder.path().join(names[0]);
    Recording::read_all(path, &ForeignColumns::default(), &said)
}

/// Judge: what was written, to the single precision of 2 µm and twice as much. No real curve of such a version is known to
/// us; headers and checksums fit those of the small waves that come with the package igor2.
#[test]
fn waves_of_one_column_are_read_in_pairs() {
    let names = ["Curve7Defl_1.ibw", "Curve7ZSnsr_1.ibw"];
    let tolerance = 4.0 * 2e-6 * f64::from(f32::EPSILON);
    for version in [1, 2, 3] {
        for is_big in [false, true] {
            let waves = [true, false].map(|own| old_wave(version, is_big, own));
            let all = read_pair(names, [&waves[0], &waves[1]]).unwrap();
            check(&all[0], tolerance);
            assert_eq!(all[0].time_s(), [0.0, 5e-4, 1e-3, 1.5e-3]);
            let position = all[0].header.position_m;
            assert_eq!(position.is_some(), version > 1, "the note has it");
        }
    }
    // Volts by the unit, or by the name.
    for (unit, name) in [("V", names[0]), ("", "Curve7DeflV_1.ibw")] {
        let mut volts = old_wave(2, false, true);
        volts.unit = unit;
        volts.values.iter_mut().for_each(|own| *own /= 2e-8);
        let position = old_wave(2, false, false);
        let all = read_pair([name, names[1]], [&volts, &position]).unwrap();
        check(&all[0], tolerance);
    }
}

#[test]
fn waves_of_one_column_that_are_no_pair_are_refused() {
    let names = ["Curve7Defl_1.ibw", "Curve7ZSnsr_1.ibw"];
    let error = read(&old_wave(2, false, true).bytes()).unwrap_err();
    assert!(error.is_input(), "{error}");
    let said = error.to_string();
    assert!(
        said.contains("Curve7Defl") && said.contains("ZSnsr") && said.contains("Concatenate"),
        "{said}"
    );
    let position = || old_wave(2, true, false);
    let few = POSITIONS[..3].to_vec();
    let others = [
        (
            OldWave {
                unit: "V",
                ..position()
            },
            "not in metres",
        ),
        (
            OldWave {
                row_unit: "m",
                ..position()
            },
            "not in seconds",
        ),
        (
            OldWave {
                step: 1e-3,
                ..position()
            },
            "other rows",
        ),
        (
            OldWave {
                values: few,
                ..position()
            },
            "other rows",
        ),
    ];
    for (position, why) in others {
        let error = read_pair(names, [&old_wave(2, true, true), &position]).unwrap_err();
        assert!(
            error.is_input() && error.to_string().contains(why),
            "{error}"
        );
    }
    // The wave of the position alone.
    let both = [&old_wave(2, true, false), &old_wave(2, true, true)];
    let error = read_pair([names[1], names[0]], both).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("name the file of the deflection"),
        "{error}"
    );
}

/// In a folder, the position is a part of the curve of its deflection.
#[test]
fn a_position_belongs_to_its_deflection() {
    let folder = tempfile::tempdir().unwrap();
    let [deflection, position, whole] =
        ["a_Defl3.ibw", "a_Raw3.ibw", "a_DeflV4.ibw"].map(|name| folder.path().join(name));
    std::fs::write(&position, old_wave(2, true, false).bytes()).unwrap();
    assert_eq!(deflection_beside(&position), None);
    std::fs::write(&deflection, old_wave(2, true, true).bytes()).unwrap();
    assert_eq!(deflection_beside(&position), Some(deflection.clone()));
    assert_eq!(position_beside(&deflection), Some(position.clone()));
    assert_eq!(position_beside(&whole), None);
    // A wave with columns of its own is a curve.
    std::fs::write(&position, force_wave(true)).unwrap();
    assert_eq!(deflection_beside(&position), None);
}

/// Cut short: refused; a byte that is another: refused or read, never a panic.
#[test]
fn damaged_pairs_of_waves_are_refused_or_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Defl.ibw");
    let columns = ForeignColumns::default();
    for version in [1, 2, 3] {
        let position = old_wave(version, version == 2, false).bytes();
        std::fs::write(folder.path().join("ZSnsr.ibw"), position).unwrap();
        let whole = old_wave(version, version == 2, true).bytes();
        let read = |bytes: &[u8]| {
            let said = RecordingHeader {
                spring_constant_n_per_m: Some(SPRING_CONSTANT),
                ..RecordingHeader::default()
            };
            Recording::parse_all(bytes, &path, &columns, &said)
        };
        // Behind the numbers are zeros that say nothing, and in version 1 nothing else.
        let needed = whole.len() - if version == 1 { 16 } else { 0 };
        for end in 0..needed {
            let refused = read(&whole[..end]);
            assert!(
                refused.is_err_and(|error| error.is_input()),
                "{version}: {end}"
            );
        }
        for place in 0..whole.len() {
            for turned in [1, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[place] ^= turned;
                if let Err(error) = read(&bytes) {
                    assert!(error.is_input(), "{error}");
                }
            }
        }
    }
}
