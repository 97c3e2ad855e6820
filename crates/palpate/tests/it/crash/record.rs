//! The training record: what was acknowledged is in it.

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use palpate_record::{Filter, Record};

use super::write_path::done;
use super::{SCENE, motion, with, words};
use crate::palpate_in;

/// Scores a session for one trainee after another, each time killed or without room; what came of it.
pub(super) fn crash(kills: u32, disks: u32) -> String {
    let folder = with(&[
        ("scene.toml", SCENE.as_bytes()),
        ("motion.csv", motion(2).as_bytes()),
    ]);
    let folder = folder.path();
    let line = "simulate scene.toml --headless --motion motion.csv --out session";
    done(&palpate_in(folder, &words(line)));
    let program = env!("CARGO_BIN_EXE_palpate");
    let score = |trainee: u32| format!("score session --record record.sqlite --trainee T{trainee}");
    let began = Instant::now();
    done(&palpate_in(folder, &words(&score(0))));
    let takes = began.elapsed();
    let mut acknowledged = vec![0];
    let mut random = fastrand::Rng::with_seed(11);
    let disks = if cfg!(unix) { disks } else { 0 };
    for trial in 1..=kills + disks {
        let line = score(trial);
        let mut command = Command::new("sh");
        if trial <= kills {
            command = Command::new(program);
            command.args(words(&line));
        } else {
            let trap = if trial % 2 == 0 { "trap '' XFSZ; " } else { "" };
            // A record of some attempts has some tens of kilobytes.
            let size = random.u32(0..120);
            command.args([
                "-c",
                &format!("{trap}ulimit -f {size}; exec {program} {line}"),
            ]);
        }
        let command = command.current_dir(folder);
        let mut child = command
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        if trial <= kills {
            // Most of its time goes before the record is opened.
            sleep(
                takes
                    .mul_f64(random.f64().sqrt())
                    .min(Duration::from_secs(60)),
            );
            child.kill().unwrap();
        }
        if child.wait().unwrap().success() {
            acknowledged.push(trial);
        }
        let record = Record::open(folder.join("record.sqlite")).unwrap();
        assert!(
            record.warnings().is_empty(),
            "{trial}: {:?}",
            record.warnings()
        );
        let kept = record.attempts(&Filter::default()).unwrap();
        for trainee in &acknowledged {
            let name = format!("T{trainee}");
            assert!(
                kept.iter().any(|own| own.trainee == name),
                "{trial}: {name} is lost"
            );
        }
        assert!(
            kept.iter()
                .all(|own| own.session_digest == kept[0].session_digest)
        );
    }
    let kept = Record::open(folder.join("record.sqlite")).unwrap();
    let kept = kept.attempts(&Filter::default()).unwrap().len();
    assert!(kept >= acknowledged.len() && kept as u32 <= 1 + kills + disks);
    format!(
        "training record: {kills} kills, {disks} small disks, {} acknowledged, {kept} kept",
        acknowledged.len()
    )
}
