//! Stored responses come back as they were, or not at all.

use std::fs;

use palpate_files::StoredResponse;

/// What may be taken [bytes].
const MEMORY: usize = 1 << 20;

fn example() -> StoredResponse<'static> {
    let values = (0..72).map(|number| 0.25 * number as f32 - 7.0);
    StoredResponse {
        key: "0f".repeat(32),
        made_by: "palpate 0.1.0, boundary elements".to_owned(),
        touchable: vec![1, 3],
        triangles: 4,
        displacements: values.collect::<Vec<_>>().into(),
    }
}

/// Judge: the value that was written.
#[test]
fn a_response_comes_back_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kidney.response");
    example().write(&path).unwrap();
    assert_eq!(StoredResponse::read(&path, MEMORY).unwrap(), example());
    let found = fs::read(&path).unwrap();
    assert!(found.starts_with(b"palpate response 1\nkey = 0f0f"));
}

/// Judge: SHA-256; whatever byte is another one, the file is refused.
#[test]
fn a_file_with_one_other_byte_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kidney.response");
    example().write(&path).unwrap();
    let whole = fs::read(&path).unwrap();
    for place in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        fs::write(&path, &damaged).unwrap();
        let error = StoredResponse::read(&path, MEMORY).unwrap_err();
        assert!(error.to_string().contains("is damaged"), "{place}: {error}");
    }
}

/// Judge: the length that the header states, with no allocation for what is not there.
#[test]
fn a_file_that_ends_early_or_late_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kidney.response");
    example().write(&path).unwrap();
    let whole = fs::read(&path).unwrap();
    for length in 0..whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        assert!(StoredResponse::read(&path, MEMORY).is_err(), "{length}");
    }
    fs::write(&path, [&whole[..], b"\0"].concat()).unwrap();
    assert!(StoredResponse::read(&path, MEMORY).is_err());
    let absurd = "palpate response 1\nkey = 0\ntouchable = 4000000000\ntriangles = 3000000000\nmade_by = \n\n";
    fs::write(&path, absurd).unwrap();
    let error = StoredResponse::read(&path, MEMORY).unwrap_err();
    assert!(error.to_string().contains("shorter or longer"), "{error}");
    assert!(error.is_input());
}

/// A file with holes is as long as its header says, and takes no room on the disk. On the code before, the header alone
/// decided how much memory was asked for.
#[test]
fn a_file_with_holes_asks_for_no_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("kidney.response");
    let header =
        "palpate response 1\nkey = 0\ntouchable = 100000\ntriangles = 100000\nmade_by = \n\n";
    fs::write(&path, header).unwrap();
    let bytes = header.len() as u64 + 4 * (9 * 100_000 * 100_000 + 100_000) + 32;
    let file = fs::OpenOptions::new().write(true).open(&path).unwrap();
    file.set_len(bytes).unwrap();
    for memory in [MEMORY, 300_000_000_000] {
        let error = StoredResponse::read(&path, memory).unwrap_err();
        let said = error.to_string();
        let named = said.contains("kidney.response") && said.contains("360.00 GB");
        assert!(named && said.contains("delete the file"), "{said}");
        assert!(!error.is_input());
    }
}
