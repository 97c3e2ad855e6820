#![allow(
    clippy::unwrap_used,
    reason = "clippy.toml allows it in tests, but does not see helpers as tests"
)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::Command;
use std::thread::sleep;

use palpate_files::scene::ModelKind;
use palpate_files::{Claim, Events, Overwrite, Session, SessionHeader};

use super::*;

fn row(step: u32) -> SessionRow {
    SessionRow {
        time_s: 0.005 * f64::from(step),
        tool: 0,
        position_m: [0.1, -1e-7, 1e-3 * f64::from(step)],
        orientation: [0.0, 0.0, 0.0, 1.0],
        grip: 0.25,
        cut: false,
        force_n: [0.0, 1.0 / 3.0, 1e-12],
        torque_nm: [0.0; 3],
        contact: true,
        depth_m: 0.001,
        events: match step {
            0 => [Event::Restart].into_iter().collect(),
            _ => Events::default(),
        },
        grip_force_n: 0.0,
        stated_diameter_m: None,
    }
}

fn writer(folder: &Path) -> SessionFolderWriter {
    let header = SessionHeader {
        version: "0.1.0".to_owned(),
        scene_digest: "89ab".to_owned(),
        model: ModelKind::Local,
        step_s: 0.005,
        seed: 1,
        force_scale: 1.0,
    };
    let claim = Claim::of_folder(folder, Overwrite::Allowed).unwrap();
    SessionFolderWriter::begin(claim, None, &header, &["right".to_owned()]).unwrap()
}

/// A folder whose disk fails after the first `lines` lines: its session goes into a pipe whose reader leaves.
fn breaking(folder: &Path, lines: usize) -> SessionFolderWriter {
    fs::create_dir(folder).unwrap();
    let pipe = folder.join("session.csv.part");
    let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let reader = std::thread::spawn(move || {
        let pipe = BufReader::new(fs::File::open(pipe).unwrap());
        assert_eq!(pipe.lines().take(lines).count(), lines);
    });
    let writer = writer(folder);
    // The header is one flush; the reader leaves after it.
    reader.join().unwrap();
    writer
}

fn header_lines() -> usize {
    let folder = tempfile::tempdir().unwrap();
    drop(writer(&folder.path().join("a")));
    let part = fs::read_to_string(folder.path().join("a/session.csv.part")).unwrap();
    part.lines().count()
}

fn until(mut holds: impl FnMut() -> bool) {
    for _ in 0..200 {
        if holds() {
            return;
        }
        sleep(PERIOD / 4);
    }
    panic!("it does not come true");
}

struct Played {
    recorder: SessionRecorder,
    model: log::Writer<SessionRow>,
    rows: log::Reader<SessionRow>,
}

fn played(most: usize) -> Played {
    let (model, from) = log::ring(ROWS);
    let (recorder, rows) = SessionRecorder::with_memory(from, most, None).unwrap();
    Played {
        recorder,
        model,
        rows,
    }
}

impl Played {
    fn play(&mut self, steps: std::ops::Range<u32>) {
        steps.for_each(|step| self.model.add(row(step)));
    }
}

fn rows_in(folder: &Path) -> Vec<SessionRow> {
    let session = Session::read(folder.join("session.csv")).unwrap();
    assert_eq!(session.incomplete, None);
    session.rows
}

/// A write failure is known at once and loses nothing: a session can continue in another folder, from its first row.
#[test]
fn a_session_on_a_broken_disk_goes_on_elsewhere_whole() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut played = played(1000);
    played
        .recorder
        .record(breaking(&at("broken"), header_lines()));
    played.play(0..30);
    until(|| played.recorder.recording_failure().is_some());
    let unwritten = played.recorder.recording_failure().unwrap();
    assert!(
        unwritten.is_complete && unwritten.cause.contains("broken"),
        "{unwritten:?}"
    );
    played.play(30..60);
    played
        .recorder
        .record_elsewhere(writer(&at("other")))
        .unwrap();
    assert_eq!(played.recorder.recording_failure(), None);
    played.play(60..90);
    played.recorder.end().unwrap();
    let expected: Vec<_> = (0..90).map(row).collect();
    assert_eq!(rows_in(&at("other")), expected);
    // The display gets all rows, too.
    let mut shown = Vec::new();
    until(|| {
        shown.extend(played.rows.drain());
        shown.len() == 90
    });
}

/// Also after the end, which reports that nothing was recorded; the next recording begins normally.
#[test]
fn a_session_that_has_ended_is_still_in_memory() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut played = played(1000);
    played
        .recorder
        .record(breaking(&at("broken"), header_lines()));
    played.play(0..30);
    assert!(!played.recorder.end().unwrap_err().is_input());
    // Rows after the end do not belong to it.
    played.play(30..40);
    assert!(played.recorder.recording_failure().is_some());
    played
        .recorder
        .record_elsewhere(writer(&at("other")))
        .unwrap();
    assert_eq!(rows_in(&at("other")).len(), 30);
    assert_eq!(played.recorder.recording_failure(), None);
    played.recorder.record(writer(&at("next")));
    played.play(0..5);
    played.recorder.end().unwrap();
    assert_eq!(rows_in(&at("next")).len(), 5);
}

/// Memory is bounded; an overflow is reported, and the remaining rows are marked as incomplete.
#[test]
fn more_rows_than_memory_keeps_are_an_incomplete_session() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mut played = played(20);
    played
        .recorder
        .record(breaking(&at("broken"), header_lines()));
    played.play(0..30);
    until(|| played.recorder.recording_failure().is_some());
    until(|| !played.recorder.recording_failure().unwrap().is_complete);
    let said = played.recorder.record_elsewhere(writer(&at("other")));
    assert!(said.unwrap_err().to_string().contains("first 20 rows"));
    let session = Session::read(at("other/session.csv.part")).unwrap();
    assert!(session.incomplete.is_some());
    assert_eq!(session.rows.len(), 20);
}
