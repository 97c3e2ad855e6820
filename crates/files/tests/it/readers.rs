//! Every reader of the crate, given any bytes. `fuzz/fuzz_targets/documents.rs` has this file too.

use std::path::Path;

use palpate_files::recording::{ForeignColumns, RecordingHeader};
use palpate_files::{
    Error, Motion, Protocol, Recording, Scene, Session, SessionWriter, StoredResponse, Tissue,
};
use sha2::{Digest, Sha256};

/// What may be taken by a stored response [bytes].
const MEMORY: usize = 1 << 20;

/// The letters that name readers.
pub(crate) const READERS: &[u8] = b"stmpergfci";

/// Gives all but the first byte to the reader that the first byte names.
pub(crate) fn read_as_told(bytes: &[u8], scratch: &Path) {
    if let Some((reader, bytes)) = bytes.split_first()
        && READERS.contains(reader)
    {
        read(*reader, bytes, scratch);
    }
}

/// Gives `bytes` to a reader. An error must say something of itself, and what was read must be the same when it is
/// written and read again. `scratch` is a file that is written over.
pub(crate) fn read(reader: u8, bytes: &[u8], scratch: &Path) {
    let text = &String::from_utf8_lossy(bytes);
    let refused = match reader {
        b's' => Scene::parse(text, "f").map(drop),
        b't' => Tissue::parse(text, "f").map(|tissue| {
            let text = tissue.to_toml();
            // A warning names the line and the number as written.
            let unwarned = |tissue| Tissue {
                warnings: Vec::new(),
                ..tissue
            };
            let again = Tissue::parse(&text, "f").expect(&text);
            assert_eq!(unwarned(again), unwarned(tissue));
        }),
        b'm' => Motion::parse(text, "f").map(|motion| {
            let text = motion.to_csv();
            let again = Motion::parse(&text, "f").expect(&text);
            assert_eq!(again.tools(), motion.tools());
        }),
        b'p' => Protocol::parse(text, "f").map(drop),
        b'e' => Session::parse(text, "f").map(|session| same_session(&session, scratch)),
        b'r' => Recording::parse(text, "f").map(|recording| same_recording(&recording)),
        b'g' => foreign(text, &ForeignColumns::default()),
        b'f' => foreign(
            text,
            &ForeignColumns {
                time: Some("time_ms".to_owned()),
                depth: Some("depth_mm".to_owned()),
                force: Some("force_mn".to_owned()),
                ..ForeignColumns::default()
            },
        ),
        b'i' => Recording::parse_all(
            bytes,
            "f",
            &ForeignColumns::default(),
            &RecordingHeader::default(),
        )
        .map(|all| all.iter().for_each(same_recording)),
        b'c' => return response(bytes, scratch),
        _ => panic!("no reader has the letter {reader}"),
    };
    if let Err(error) = refused {
        assert!(error.is_input());
        let message = error.to_string();
        assert!(
            message.starts_with('f') && !message.contains('\n'),
            "{message}"
        );
    }
}

fn foreign(text: &str, columns: &ForeignColumns) -> Result<(), Error> {
    Recording::parse_foreign(text, "f", columns).map(|recording| same_recording(&recording))
}

fn same_recording(recording: &Recording) {
    let text = recording.to_csv();
    let again = Recording::parse(&text, "f").expect(&text);
    assert_eq!(again.header, recording.header);
    assert_eq!(again.time_s(), recording.time_s());
    assert_eq!(again.depth_m(), recording.depth_m());
    assert_eq!(again.force_n(), recording.force_n());
    assert_eq!(again.extra_columns(), recording.extra_columns());
}

fn same_session(session: &Session, scratch: &Path) {
    let mut writer = SessionWriter::create(scratch, &session.header, &session.tools).unwrap();
    for row in &session.rows {
        writer.write(row).unwrap();
    }
    writer.finish().unwrap();
    let again = Session::read(scratch).unwrap();
    assert_eq!(again.header, session.header);
    assert_eq!(again.tools, session.tools);
    assert_eq!(again.rows, session.rows);
    // It is written with torques, also where it had none.
    let with_torques = Session {
        has_torques: true,
        ..session.clone()
    };
    assert_eq!(again.digest(), with_torques.digest());
}

/// With the digest that belongs to the bytes, which nobody finds by trying.
fn response(bytes: &[u8], scratch: &Path) {
    let digest = Sha256::digest(bytes);
    std::fs::write(scratch, [bytes, &digest[..]].concat()).unwrap();
    if let Ok(found) = StoredResponse::read(scratch, MEMORY) {
        found.write(scratch).unwrap();
        let again = StoredResponse::read(scratch, MEMORY).unwrap();
        let bits = |one: &StoredResponse<'_>| -> Vec<u32> {
            one.displacements
                .iter()
                .map(|value| value.to_bits())
                .collect()
        };
        assert_eq!((&again.key, &again.made_by), (&found.key, &found.made_by));
        assert_eq!(again.touchable, found.touchable);
        assert_eq!(
            (again.triangles, bits(&again)),
            (found.triangles, bits(&found))
        );
    }
}
