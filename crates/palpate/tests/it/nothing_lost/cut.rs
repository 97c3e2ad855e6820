//! What was cut off says so: sessions, recordings, motions.

use super::*;

/// A session that was killed, and one that was cut between two rows, are shown, said to be incomplete, and kept in
/// the record only when that is asked for.
#[test]
fn an_incomplete_session_is_shown_and_not_kept() {
    let folder = folder();
    let folder = folder.path();
    let mut killed = begun(folder, "killed");
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert!(!folder.join("killed/session.csv").exists());
    done(&simulate(folder, "motion.csv", "whole", &[]));
    let session = fs::read_to_string(folder.join("whole/session.csv")).unwrap();
    let half: Vec<&str> = session.lines().take(210).collect();
    fs::create_dir(folder.join("cut")).unwrap();
    fs::copy(
        folder.join("whole/scene.toml"),
        folder.join("cut/scene.toml"),
    )
    .unwrap();
    fs::write(folder.join("cut/session.csv"), half.join("\n") + "\n").unwrap();
    let record = folder.join("r.sqlite");
    let keep = |session: &str, more: &[&str]| {
        let all = [
            "score",
            session,
            "--trainee",
            "Anna",
            "--record",
            "r.sqlite",
            "--json",
        ];
        palpate_in(folder, &[&all[..], more].concat())
    };
    for session in ["killed", "cut"] {
        let shown = json(&palpate_in(folder, &["score", session, "--json"]));
        assert!(
            shown["warnings"].to_string().contains("incomplete"),
            "{shown}"
        );
        let output = keep(session, &[]);
        refused(&output, 2, &["incomplete", "--incomplete"]);
        let shown: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(shown["measures"]["time_s"].as_f64().unwrap() > 0.5);
        assert!(attempts(&record).is_empty());
        let again = json(&palpate_in(folder, &["replay", session, "--json"]));
        assert!(
            again["warnings"].to_string().contains("incomplete"),
            "{again}"
        );
        assert_eq!(again["largest_difference_n"], 0.0);
    }
    done(&keep("cut", &["--incomplete"]));
    done(&keep("whole", &[]));
    assert_eq!(attempts(&record).len(), 2);
}

/// While a session is replaced the older one stays readable, with its own scene.
#[test]
fn a_killed_replacement_leaves_the_older_session() {
    let folder = folder();
    let folder = folder.path();
    done(&simulate(folder, "motion.csv", "out", &[]));
    let session = fs::read(folder.join("out/session.csv")).unwrap();
    fs::write(folder.join("scene.toml"), SCENE.replace("Press", "Other")).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_palpate"))
        .args(arguments("long.csv", "out", &["--overwrite"]))
        .current_dir(folder)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while !folder.join("out/session.csv.part").exists() {
        assert!(patience.elapsed() < Duration::from_secs(60), "no session");
        sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(fs::read(folder.join("out/session.csv")).unwrap() == session);
    let shown = json(&palpate_in(folder, &["score", "out", "--json"]));
    assert_eq!(shown["task"]["title"], "Press");
    assert!(
        shown["warnings"].to_string().contains("not finished"),
        "{shown}"
    );
}

/// A recording that is cut anywhere is said to be incomplete, whatever its top says.
#[test]
fn a_cut_recording_is_incomplete() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(
        at("protocol.toml"),
        "format = 1\n[[specimen]]\npublished = \"liver\"\n[[stimulus]]\nkind = \"ramp_and_hold\"\n\
         depth_m = 0.002\nramp_s = 0.5\nhold_s = 2.0\n",
    )
    .unwrap();
    let measure = [
        "measure",
        "protocol.toml",
        "--headless",
        "--out",
        "whole.csv",
    ];
    done(&palpate_in(folder.path(), &measure));
    let text = fs::read_to_string(at("whole.csv")).unwrap();
    let incomplete = |name: &str| {
        let output = palpate_in(folder.path(), &["analyze", name, "--json"]);
        json(&output)["warnings"].to_string().contains("incomplete")
    };
    assert!(!incomplete("whole.csv"));
    // Between two rows, and in one.
    let at_row = text[..text.len() * 65 / 100].rfind('\n').unwrap() + 1;
    for end in [at_row, at_row + 9] {
        fs::write(at("cut.csv"), &text[..end]).unwrap();
        assert!(text[..end].contains("# ended = \"whole\""));
        assert!(incomplete("cut.csv"), "{end}");
    }
    // Another row in the middle is another recording; a key above the table is not.
    let named = text.replacen("# format = 1\n", "# format = 1\n# thickness_m = 0.02\n", 1);
    fs::write(at("named.csv"), &named).unwrap();
    assert!(!incomplete("named.csv"));
    let line = text[..at_row].trim_end().rfind('\n').unwrap();
    fs::write(
        at("less.csv"),
        text[..line].to_owned() + &text[at_row - 1..],
    )
    .unwrap();
    assert!(incomplete("less.csv"));
}

/// A motion that is cut in its last number is refused; it would press anywhere.
#[test]
fn a_cut_motion_is_not_played() {
    let folder = folder();
    let folder = folder.path();
    let text = motion(2.0);
    let last = text.trim_end().rfind('\n').unwrap() + 1;
    for end in [last + 4, text.len() - 4] {
        fs::write(folder.join("cut.csv"), &text[..end]).unwrap();
        refused(
            &simulate(folder, "cut.csv", "out", &[]),
            2,
            &["cut.csv line 5", "cut"],
        );
    }
    // One that only lacks its line end is played, and says so.
    fs::write(folder.join("open.csv"), text.trim_end()).unwrap();
    let open = json(&simulate(folder, "open.csv", "open", &["--json"]));
    assert!(
        open["incomplete"].to_string().contains("no line end"),
        "{open}"
    );
    // Cut between two rows it can be told only by its mark; without one that is said.
    let marked = format!("{text}# end = {{ rows = 3 }}\n");
    fs::write(folder.join("marked.csv"), &marked).unwrap();
    let whole = json(&simulate(folder, "marked.csv", "a", &["--json"]));
    assert!(whole["incomplete"].is_null() && whole["warnings"] == serde_json::json!([]));
    let unmarked = json(&simulate(folder, "motion.csv", "b", &["--json"]));
    assert!(
        unmarked["incomplete"].to_string().contains("no end mark"),
        "{unmarked}"
    );
    fs::write(
        folder.join("less.csv"),
        marked.replacen("1.0,right,0.0,0.0,0.047\n", "", 1),
    )
    .unwrap();
    let less = json(&simulate(folder, "less.csv", "c", &["--json"]));
    assert!(
        less["warnings"]
            .to_string()
            .contains("3 rows, and there are 2"),
        "{less}"
    );
}
