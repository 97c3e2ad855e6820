use std::fs;

use palpate_files::scene::ModelKind;
use palpate_files::{
    Event, Events, Incomplete, Session, SessionHeader, SessionRow, SessionWriter, unfinished,
};
use sha2::Digest;

use crate::SESSION;

fn header() -> SessionHeader {
    SessionHeader {
        version: "0.1.0".to_owned(),
        scene_digest: "89ab".to_owned(),
        model: ModelKind::Local,
        step_s: 0.005,
        seed: u64::MAX,
        force_scale: 1.0,
    }
}

fn row(step: u32) -> SessionRow {
    let time_s = f64::from(step) * 0.005;
    SessionRow {
        time_s,
        tool: 0,
        position_m: [0.1 + time_s, -1e-7, 0.0],
        orientation: [0.0, 0.0, 0.0, 1.0],
        grip: 0.25,
        cut: step % 2 == 1,
        force_n: [0.0, 1.0 / 3.0, 1e-12],
        torque_nm: [1e-3, 0.0, -2.0 / 3.0],
        contact: true,
        depth_m: 0.001,
        events: [Event::Contact, Event::Cut].into_iter().collect(),
        grip_force_n: 0.1 * time_s,
        stated_diameter_m: None,
    }
}

#[test]
fn a_session_is_understood() {
    let session = Session::parse(SESSION, "session.csv").unwrap();
    assert_eq!(session.tools, ["right", "left"]);
    assert_eq!((session.header.seed, session.header.step_s), (7, 0.005));
    assert_eq!(session.incomplete, Some(Incomplete::Unmarked));
    let row = session.rows[2];
    assert_eq!(
        (row.tool, row.depth_m, row.contact, row.cut),
        (0, 0.001, true, true)
    );
    assert_eq!(row.force_n, [0.0, 1e-7, 0.023]);
    assert!(row.events.contains(Event::Cut) && !row.events.contains(Event::Grip));
    let motion = session.motion().unwrap();
    assert_eq!(motion.pose("right", 0.0025).unwrap().grip, 0.25);
}

#[test]
fn a_session_before_there_were_jaws_is_read() {
    let now = Session::parse(SESSION, "session.csv").unwrap();
    assert_eq!(now.rows[2].grip_force_n, 0.25);
    let mut before = String::new();
    for line in SESSION.lines() {
        let (kept, _) = match line.starts_with('#') {
            true => (line, ""),
            false => line.rsplit_once(',').unwrap(),
        };
        before += &format!("{kept}\n");
    }
    let before = Session::parse(&before, "session.csv").unwrap();
    assert_eq!(before.rows.len(), now.rows.len());
    assert_eq!(before.rows[2].force_n, now.rows[2].force_n);
    assert!(before.rows.iter().all(|row| row.grip_force_n == 0.0));
}

/// Judge of the name: SHA-256 of the columns and rows as they stand in the file, by the end mark's own.
#[test]
fn a_session_before_there_were_torques_keeps_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("session.csv");
    let tools = ["right".to_owned()];
    let mut writer = SessionWriter::create(&path, &header(), &tools).unwrap();
    writer.write(&row(3)).unwrap();
    writer.finish().unwrap();
    let now = Session::read(&path).unwrap();
    assert!(now.has_torques);
    assert_eq!(now.rows[0].torque_nm, row(3).torque_nm);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(&now.digest()), "{text}");
    let before = Session::parse(SESSION, "session.csv").unwrap();
    assert!(!before.has_torques);
    assert_eq!(before.rows[2].torque_nm, [0.0; 3]);
    let table = SESSION.lines().filter(|line| !line.starts_with('#'));
    let table: String = table.map(|line| format!("{line}\n")).collect();
    let digest = sha2::Sha256::digest(table.as_bytes());
    let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(before.digest(), digest);
}

/// Rows have an orientation all the same; what is played again has none while it was not known.
#[test]
fn poses_have_no_orientation_while_none_was_known() {
    let told = [
        None,
        Some(Event::ShaftUnknown),
        None,
        Some(Event::ShaftKnown),
        None,
    ];
    let mut session = Session::parse(SESSION, "session.csv").unwrap();
    session.rows = told
        .iter()
        .enumerate()
        .map(|(step, event)| SessionRow {
            events: event.iter().copied().collect(),
            ..row(step as u32)
        })
        .collect();
    let known: Vec<bool> = session
        .poses()
        .map(|pose| pose.orientation.is_some())
        .collect();
    assert_eq!(known, [true, false, false, true, true]);
}

#[test]
fn the_same_rows_give_the_same_bytes_and_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let tools = ["a, b".to_owned()];
    let write = |name: &str| {
        let path = folder.path().join(name);
        let mut writer = SessionWriter::create(&path, &header(), &tools).unwrap();
        (0..500).for_each(|step| writer.write(&row(step)).unwrap());
        writer.finish().unwrap();
        path
    };
    let (one, two) = (write("one.csv"), write("two.csv"));
    assert_eq!(fs::read(&one).unwrap(), fs::read(two).unwrap());
    let session = Session::read(one).unwrap();
    assert_eq!(session.incomplete, None);
    assert_eq!(session.header, header());
    assert_eq!(session.tools, tools);
    assert_eq!(session.rows, (0..500).map(row).collect::<Vec<_>>());
}

#[test]
fn whole_lines_are_on_the_disk_every_200_rows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("session.csv");
    let mut writer = SessionWriter::create(&path, &header(), &["right".to_owned()]).unwrap();
    let rows = || Session::read(unfinished(&path)).unwrap().rows.len();
    assert_eq!(rows(), 0, "the header is there from the first moment");
    for step in 0..650 {
        writer.write(&row(step)).unwrap();
        let behind = step as usize + 1 - rows();
        assert!(behind < 200, "{behind} rows are not in the file");
    }
    // A program that ends in an error drops the writer.
    drop(writer);
    assert_eq!(rows(), 650);
}

#[test]
fn a_killed_program_loses_only_its_last_line() {
    let full = Session::parse(SESSION, "session.csv").unwrap();
    let first = SESSION.find("0.0,right").unwrap();
    for end in first..SESSION.len() {
        let cut = &SESSION[..end];
        let session = Session::parse(cut, "session.csv").unwrap();
        let whole = cut[first..].matches('\n').count();
        assert_eq!(session.rows[..], full.rows[..whole]);
        let expected = match cut.ends_with('\n') {
            true => Incomplete::Unmarked,
            false => Incomplete::CutLine { line: 9 + whole },
        };
        assert_eq!(session.incomplete, Some(expected));
    }
}

#[test]
fn rows_that_no_session_can_hold_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("session.csv");
    let mut writer = SessionWriter::create(&path, &header(), &["right".to_owned()]).unwrap();
    let mut bad = row(1);
    bad.force_n[1] = f64::NAN;
    let error = writer.write(&bad).unwrap_err();
    let expected = "fy_n of the session's row at 0.005 s is NaN; give a finite number";
    assert_eq!(error.to_string(), expected);
    assert!(!error.is_input());
    let stranger = SessionRow {
        tool: 1,
        events: Events::NONE,
        ..row(1)
    };
    assert!(writer.write(&stranger).is_err());
}

/// A stated diameter stands after the events; a row without one is as it was before there were any.
#[test]
fn a_stated_diameter_is_read_as_it_was_written() {
    let plain = row(0);
    let text = plain.event_text();
    assert_eq!(text, plain.events.to_string());
    let stated = SessionRow {
        events: Events::NONE,
        stated_diameter_m: Some(0.0165),
        ..plain
    };
    assert_eq!(stated.event_text(), "stated_diameter_m=0.0165");
    let both = SessionRow {
        events: Event::Mark.into(),
        ..stated
    };
    assert_eq!(both.event_text(), "mark;stated_diameter_m=0.0165");
    let with = |event: &str| {
        let text = SESSION.replace("contact;cut", event);
        assert_ne!(text, SESSION);
        Session::parse(&text, "session.csv")
    };
    let read = with("mark;stated_diameter_m=0.0165").unwrap();
    let found: Vec<_> = read
        .rows
        .iter()
        .filter_map(|row| row.stated_diameter_m)
        .collect();
    assert_eq!(found, [0.0165]);
    assert!(read.rows.iter().any(|row| row.events.contains(Event::Mark)));
    for wrong in ["-1", "nan", "", "0"] {
        let told = with(&format!("mark;stated_diameter_m={wrong}")).unwrap_err();
        let told = told.to_string();
        assert!(
            told.contains("session.csv") && told.contains("stated_diameter_m"),
            "{told}"
        );
    }
}
