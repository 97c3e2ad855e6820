//! A writer that is killed at random times. Judge: what it had told to be kept before.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use palpate_record::{Filter, Record};

use crate::attempt;

/// Names the record of the child, what it writes first, and for whom.
const FILE: &str = "PALPATE_KILLED_RECORD";
const FIRST: &str = "PALPATE_KILLED_FIRST";
const WHO: &str = "PALPATE_KILLED_WHO";

/// A writer whose name begins so is a teacher.
const TEACHER: &str = "teacher";

/// Adds attempts of a trainee, or trainees to a teacher's cohort, until it is killed, and tells each that is kept.
#[test]
#[ignore = "helper: the program that the other tests kill; it never ends by itself"]
fn child() {
    let Some(path) = std::env::var_os(FILE) else {
        return;
    };
    let mut record = Record::open(&path).unwrap();
    let first: i64 = std::env::var(FIRST).unwrap().parse().unwrap();
    let who = std::env::var(WHO).unwrap();
    for seed in first.. {
        if who.starts_with(TEACHER) {
            record.join(&who, &[joined(seed)]).unwrap();
        } else {
            record.add(&attempt(&who, "Cut", seed)).unwrap();
        }
        writeln!(std::io::stdout(), "kept {seed}").unwrap();
        // Somebody's attempt takes longer than to write it: without a pause the file is never free for others.
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Whom a teacher lets join at last.
fn joined(seed: i64) -> String {
    format!("trainee {seed:09}")
}

/// Starts a writer for `who`, of `first` and what follows.
fn start(path: &Path, who: &str, first: i64) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["killed::child", "--exact", "--ignored", "--nocapture"])
        .env(FILE, path)
        .env(FIRST, first.to_string())
        .env(WHO, who)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Kills a writer; how much it told to be kept.
fn kill(mut child: Child) -> i64 {
    assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
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
        let child = start(&path, "Anna", there);
        std::thread::sleep(after);
        let kept = kill(child);
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

/// Three trainees and two teachers write to one record at once, each killed at a random time and started again. Judge:
/// what each told to be kept, and in which order.
fn at_once(rounds: usize, seed: u64) -> String {
    let mut random = fastrand::Rng::with_seed(seed);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("training.sqlite");
    let writers = ["Anna", "Béla", "Carla", "teacher 1", "teacher 2"];
    let mut kept = [0i64; 5];
    let mut told = 0;
    for round in 0..rounds {
        let mut ends =
            [0, 1, 2, 3, 4].map(|k| (random.u64(50..600), k, start(&path, writers[k], kept[k])));
        ends.sort_by_key(|(end, ..)| *end);
        let begun = Instant::now();
        let mut counts = [0i64; 5];
        for (end, k, child) in ends {
            let left = Duration::from_millis(end).saturating_sub(begun.elapsed());
            std::thread::sleep(left);
            counts[k] = kill(child);
        }
        let record = Record::open(&path).unwrap();
        assert!(record.warnings().is_empty(), "{:?}", record.warnings());
        let cohorts = record.cohorts().unwrap();
        for (k, who) in writers.iter().enumerate() {
            let all = if who.starts_with(TEACHER) {
                let own = cohorts.iter().find(|cohort| cohort.name == *who);
                let names = own.map_or(&[][..], |cohort| &cohort.trainees);
                assert!((0..).zip(names).all(|(seed, name)| *name == joined(seed)));
                names.len()
            } else {
                let filter = Filter {
                    trainee: Some((*who).to_owned()),
                    ..Filter::default()
                };
                let own = record.attempts(&filter).unwrap();
                let expected = (0..).map(|seed| attempt(who, "Cut", seed));
                assert!(own.iter().zip(expected).all(|(own, is)| *own == is));
                own.len()
            };
            // The last may have been kept and not yet told.
            let least = kept[k] + counts[k];
            assert!(
                [least, least + 1].contains(&(all as i64)),
                "{round}, {who}: {least}, {all}"
            );
            kept[k] = all as i64;
            told += counts[k];
        }
    }
    assert!(kept.iter().all(|own| *own > 0), "{kept:?}");
    format!("{rounds} rounds of five writers: {told} told, {kept:?} kept")
}

#[test]
fn writers_that_are_killed_beside_others_lose_nothing_that_they_told() {
    println!("{}", at_once(5, 3));
}

/// Judge: what each writer reported. Quick form: `writers_that_are_killed_beside_others_lose_nothing_that_they_told`.
#[test]
#[ignore = "slow: 60 rounds, half a minute"]
fn writers_that_are_killed_beside_others_lose_nothing_that_they_told_in_60_rounds() {
    println!("{}", at_once(60, 4));
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
