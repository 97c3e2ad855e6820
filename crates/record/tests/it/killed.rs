//! A writer that is killed at random times. Judge: what it had told to be kept before.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use palpate_record::{Filter, Record};

use crate::attempt;

/// Names the record of the child, and its first attempt.
const FILE: &str = "PALPATE_KILLED_RECORD";
const FIRST: &str = "PALPATE_KILLED_FIRST";

/// Adds attempts until it is killed, and tells each that is kept.
#[test]
#[ignore = "helper: the program that the other tests kill; it never ends by itself"]
fn child() {
    let Some(path) = std::env::var_os(FILE) else {
        return;
    };
    let mut record = Record::open(&path).unwrap();
    let first: i64 = std::env::var(FIRST).unwrap().parse().unwrap();
    for seed in first.. {
        record.add(&attempt("Anna", "Cut", seed)).unwrap();
        writeln!(std::io::stdout(), "kept {seed}").unwrap();
    }
}

/// Kills a writer after a time; how many attempts from `first` on it told to be kept.
fn kill(path: &Path, first: i64, after: Duration) -> i64 {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["killed::child", "--exact", "--ignored", "--nocapture"])
        .env(FILE, path)
        .env(FIRST, first.to_string())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(after);
    // SIGKILL where there is such.
    child.kill().unwrap();
    child.wait().unwrap();
    let told = BufReader::new(child.stdout.take().unwrap()).lines();
    let kept = told.filter(|line| line.as_ref().unwrap().starts_with("kept "));
    kept.count() as i64
}

/// Trials in pairs: the first may be killed while it begins the record, the second goes on with what is there.
fn trials(count: usize, seed: u64) -> String {
    let mut random = fastrand::Rng::with_seed(seed);
    let (mut told, mut untold, mut interrupted, mut before_all) = (0, 0, 0, 0);
    let folder = tempfile::tempdir().unwrap();
    for trial in 0..count {
        let path = folder.path().join(format!("{}.sqlite", trial / 2));
        let mut there = 0;
        if trial % 2 == 1 {
            there = Record::open(&path)
                .unwrap()
                .attempts(&Filter::default())
                .unwrap()
                .len() as i64;
        }
        let after =
            Duration::from_micros(random.u64(0..if trial % 2 == 0 { 150_000 } else { 400_000 }));
        let kept = kill(&path, there, after);
        let mut journal = path.clone().into_os_string();
        journal.push("-journal");
        interrupted += usize::from(Path::new(&journal).exists());
        let record = Record::open(&path).unwrap();
        assert!(
            record.warnings().is_empty(),
            "{trial}: {:?}",
            record.warnings()
        );
        let found = record.attempts(&Filter::default()).unwrap();
        let all = found.len() as i64;
        // The last may have been kept and not yet told.
        assert!(
            [there + kept, there + kept + 1].contains(&all),
            "{trial}: {there} + {kept}, {all}"
        );
        for (seed, own) in (0..).zip(&found) {
            assert_eq!(
                *own,
                attempt("Anna", "Cut", seed),
                "{trial}: attempt {seed} of {all}"
            );
        }
        told += kept;
        untold += all - there - kept;
        before_all += usize::from(all == 0);
    }
    assert!(told > 0);
    format!(
        "{count} trials: {told} attempts told and kept, {untold} kept and not told, killed {interrupted} times \
         within a transaction and {before_all} times before the first"
    )
}

#[test]
fn a_killed_writer_loses_nothing_that_it_told() {
    println!("{}", trials(6, 1));
}

/// Judge: what the writer reported before it was killed. Quick form: `a_killed_writer_loses_nothing_that_it_told`.
#[test]
#[ignore = "slow: 100 trials, a quarter of a minute"]
fn a_killed_writer_loses_nothing_that_it_told_in_100_trials() {
    println!("{}", trials(100, 2));
}
