//! What is ended by a signal ends in good order.

use super::*;

/// The signals of `all` that a program started here receives: under `nohup` it ignores SIGHUP, as it should.
#[cfg(unix)]
fn received(all: &[&'static str]) -> Vec<&'static str> {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.map_or(0, |mask| u64::from_str_radix(mask.trim(), 16).unwrap());
    let hangs_up = ignored & 1 == 0;
    let all = all.iter().copied();
    all.filter(|signal| hangs_up || *signal != "-HUP").collect()
}

/// Ends a motion that is being played by a signal; what is left is whole, and says that it was interrupted.
#[cfg(unix)]
fn ended_by(signal: &str) {
    let folder = folder();
    let child = begun(folder.path(), "out");
    let id = child.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    refused(&output, 1, &["interrupted"]);
    let session = Session::read(folder.path().join("out/session.csv")).unwrap();
    assert_eq!(session.incomplete, None, "{signal}");
    let summary = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["interrupted"], true);
    assert_eq!(summary["steps"], session.rows.len() as u64);
}

#[test]
#[cfg(unix)]
fn sigterm_and_sighup_end_a_motion_as_ctrl_c_does() {
    for signal in received(&["-INT", "-TERM", "-HUP"]) {
        ended_by(signal);
    }
}

/// A rig withdraws its indenter and keeps what was recorded.
#[test]
#[cfg(unix)]
fn sigterm_withdraws_the_indenter() {
    for signal in received(&["-TERM", "-HUP"]) {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(
            at("protocol.toml"),
            "format = 1\n[rig]\nrecovery_s = 1\n[[specimen]]\npublished = \"liver\"\n[[stimulus]]\n\
             kind = \"ramp_and_hold\"\ndepth_m = 0.001\nramp_s = 0.5\nhold_s = 14000\n",
        )
        .unwrap();
        let child = Command::new(env!("CARGO_BIN_EXE_palpate"))
            .args(["measure", "protocol.toml", "--headless", "--out", "one.csv"])
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let patience = Instant::now();
        while fs::metadata(at("one.csv.part")).map_or(0, |data| data.len()) < 30_000 {
            assert!(patience.elapsed() < Duration::from_secs(60), "no recording");
            sleep(Duration::from_millis(5));
        }
        let sent = Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status();
        assert!(sent.unwrap().success());
        let output = child.wait_with_output().unwrap();
        refused(&output, 1, &["the indenter was withdrawn"]);
        let recording = palpate_files::Recording::read(at("one.csv")).unwrap();
        assert_eq!(recording.header.cut_short(), Some("stopped by hand"));
        assert_eq!(recording.incomplete(), None);
    }
}

/// What is told to go on after the terminal is closed goes on (`nohup`).
#[test]
#[ignore = "long"]
#[cfg(target_os = "linux")]
fn nohup_keeps_its_meaning() {
    let folder = folder();
    fs::write(folder.path().join("long.csv"), motion(60.0)).unwrap();
    let line = format!(
        "trap '' HUP; exec {} {}",
        env!("CARGO_BIN_EXE_palpate"),
        arguments("long.csv", "out", &[]).join(" ")
    );
    let child = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while !folder.path().join("out/session.csv.part").exists() {
        assert!(patience.elapsed() < Duration::from_secs(60), "no session");
        sleep(Duration::from_millis(1));
    }
    let sent = Command::new("kill")
        .args(["-HUP", &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    done(&child.wait_with_output().unwrap());
    let session = Session::read(folder.path().join("out/session.csv")).unwrap();
    assert_eq!(session.rows.len(), 12_001);
}
