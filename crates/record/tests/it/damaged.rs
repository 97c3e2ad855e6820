//! Damaged records are kept aside, never written over. Judge: their bytes before.

use std::fs;
use std::path::{Path, PathBuf};

use palpate_record::{Error, Filter, Record};

use crate::attempt;

/// A record of some attempts, and its bytes.
fn record(folder: &Path, attempts: i64) -> (PathBuf, Vec<u8>) {
    let path = folder.join("training.sqlite");
    let _ = fs::remove_file(&path);
    let mut record = Record::open(&path).unwrap();
    for seed in 0..attempts {
        record.add(&attempt("Anna", "Cut", seed)).unwrap();
    }
    drop(record);
    let bytes = fs::read(&path).unwrap();
    (path, bytes)
}

#[test]
fn a_damaged_record_is_kept_aside_and_a_new_one_begun() {
    let folder = tempfile::tempdir().unwrap();
    let (path, sound) = record(folder.path(), 30);
    let mut header = sound.clone();
    header[..16].copy_from_slice(b"not a database\0\0");
    let mut middle = sound.clone();
    middle[8192..12288].fill(0x5a);
    let cases = [
        sound[..sound.len() / 2].to_vec(),
        sound[..700].to_vec(),
        header,
        middle,
        vec![0; 20_000],
        b"x".to_vec(),
        b"this is text\n".repeat(1000),
    ];
    for (number, bytes) in (1..).zip(cases) {
        fs::write(&path, &bytes).unwrap();
        let Err(error) = Record::read(&path) else {
            panic!("case {number} is read");
        };
        assert!(matches!(error, Error::Damaged { .. }), "{number}: {error}");
        assert_eq!(fs::read(&path).unwrap(), bytes, "{number}: as it was");
        let mut begun = Record::open(&path).unwrap();
        let aside = folder
            .path()
            .join(format!("training.sqlite.damaged-{number}"));
        assert_eq!(fs::read(&aside).unwrap(), bytes, "{number}: kept");
        let warnings = begun.warnings().join(" ");
        assert!(
            warnings.contains(&format!("damaged-{number}")),
            "{warnings}"
        );
        begun.add(&attempt("Anna", "Cut", 99)).unwrap();
        drop(begun);
        // From then on all is well.
        let again = Record::open(&path).unwrap();
        assert!(again.warnings().is_empty());
        assert_eq!(again.attempts(&Filter::default()).unwrap().len(), 1);
    }
}

/// Files damaged at random are answered by attempts that were added, or set aside byte by byte; nothing panics.
/// Judge: the attempts that were added. A number changed within a page cannot be noticed, so only cuts, holes and
/// foreign pages are tried.
#[test]
fn random_damage_is_noticed_or_harmless() {
    let folder = tempfile::tempdir().unwrap();
    let (path, sound) = record(folder.path(), 12);
    let whole = Record::read(&path)
        .unwrap()
        .attempts(&Filter::default())
        .unwrap();
    let mut random = fastrand::Rng::with_seed(9);
    let mut noticed = 0;
    for trial in 0..200 {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("training.sqlite");
        let mut bytes = sound.clone();
        let at = random.usize(1..sound.len());
        match trial % 3 {
            0 => bytes.truncate(at),
            1 => bytes[at..(at + 512).min(sound.len())].fill(0),
            _ => {
                let page = at / 4096 * 4096;
                let other = random.usize(0..sound.len() / 4096) * 4096;
                bytes.copy_within(other..other + 4096, page);
            }
        }
        fs::write(&path, &bytes).unwrap();
        let mut record = Record::open(&path).unwrap_or_else(|error| panic!("{trial}: {error}"));
        if record.warnings().is_empty() {
            assert_eq!(fs::read(&path).unwrap(), bytes, "{trial}");
            let found = record.attempts(&Filter::default()).unwrap();
            assert!(found.iter().all(|own| whole.contains(own)), "{trial}");
        } else {
            noticed += 1;
            let aside = folder.path().join("training.sqlite.damaged-1");
            assert_eq!(fs::read(aside).unwrap(), bytes, "{trial}");
            record.add(&whole[0]).unwrap();
        }
    }
    assert!(noticed > 100, "{noticed}");
}
