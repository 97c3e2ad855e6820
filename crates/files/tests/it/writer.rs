//! Recordings that are written while they are made. Judge: the reader.

use palpate_files::recording::{RecordingHeader, RecordingWriter};
use palpate_files::{Incomplete, Recording, unfinished};

/// What is in the file after some samples, before the end and after it.
#[test]
fn a_recording_says_at_its_top_how_it_ended() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("one.csv");
    let header = RecordingHeader {
        organ: Some("liver".to_owned()),
        // Belongs to another recording.
        ended: Some("whole".to_owned()),
        ..RecordingHeader::default()
    };
    let mut writer = RecordingWriter::create(&file, &header).unwrap();
    for sample in 0..650 {
        let time = 1e-3 * f64::from(sample);
        writer.write([time, 1e-6, 2e-3]).unwrap();
    }
    // As if the program was killed: what is in the file is a recording, and says that it is not finished.
    let killed = Recording::read(unfinished(&file)).unwrap();
    assert_eq!(killed.header.cut_short(), Some("unfinished"));
    assert_eq!(killed.time_s().len(), 600);
    assert_eq!(killed.incomplete(), Some(&Incomplete::Unmarked));
    let why = format!("the \"force\" reached {}", "1 N, ".repeat(100));
    writer.finish(&why).unwrap();
    let ended = Recording::read(&file).unwrap();
    assert_eq!(ended.time_s().len(), 650);
    assert_eq!(ended.incomplete(), None);
    assert_eq!(ended.header.organ.as_deref(), Some("liver"));
    let said = ended.header.cut_short().unwrap();
    assert!(said.starts_with("the 'force' reached 1 N, 1 N") && said.len() < why.len());
    assert!(!unfinished(&file).exists());
}

#[test]
fn a_whole_recording_is_not_cut_short() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("one.csv");
    let mut writer = RecordingWriter::create(&file, &RecordingHeader::default()).unwrap();
    writer.write([0.0, 0.0, 0.0]).unwrap();
    writer.finish(RecordingHeader::COMPLETE).unwrap();
    let read = Recording::read(&file).unwrap();
    assert_eq!(read.header.ended.as_deref(), Some("whole"));
    assert_eq!(read.header.cut_short(), None);
}
