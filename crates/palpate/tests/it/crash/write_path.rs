use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use palpate_files::{Recording, Session};
use palpate_simulate::SessionFolder;
use tempfile::TempDir;

use super::words;
use crate::stderr;

/// Files of a folder and of those in it, by their path in it.
type Files = BTreeMap<PathBuf, Vec<u8>>;

/// A command that replaces files.
pub(super) struct WritePath {
    name: &'static str,
    line: &'static str,
    /// As it is before each trial.
    before: Files,
    /// Of two undisturbed runs, whose bytes may differ by times that are in them.
    after: [Files; 2],
    /// Of an undisturbed run.
    takes: Duration,
    /// When it changes its first file.
    first_write: Duration,
}

/// What many trials came to.
#[derive(Debug, Default)]
struct Seen {
    finished: u32,
    all_old: u32,
    all_new: u32,
    both: u32,
    /// Trials that left something that was not finished.
    unfinished: u32,
}

pub(super) fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

impl WritePath {
    /// Of a folder with what it reads and replaces.
    pub(super) fn new(name: &'static str, template: &TempDir, line: &'static str) -> Self {
        let mut path = Self {
            name,
            line,
            before: files(template.path()),
            after: Default::default(),
            takes: Duration::ZERO,
            first_write: Duration::ZERO,
        };
        for number in 0..2 {
            let folder = path.copy();
            let began = Instant::now();
            let child = path
                .command(folder.path(), None)
                .stderr(Stdio::piped())
                .spawn();
            let mut child = child.unwrap();
            path.wait_for_write(folder.path(), &mut child);
            path.first_write = began.elapsed();
            done(&child.wait_with_output().unwrap());
            path.takes = began.elapsed();
            path.after[number] = files(folder.path());
        }
        assert!(path.after[0].keys().eq(path.after[1].keys()));
        assert_ne!(path.after[0], path.before, "{name} writes nothing");
        path
    }

    /// The command in a folder, with files of at most so many half kilobytes; `Some(true)` is told of a full disk.
    fn command(&self, folder: &Path, disk: Option<(u32, bool)>) -> Command {
        let program = env!("CARGO_BIN_EXE_palpate");
        let mut command = match disk {
            None => {
                let mut command = Command::new(program);
                command.args(words(self.line));
                command
            }
            Some((size, is_told)) => {
                let trap = if is_told { "trap '' XFSZ; " } else { "" };
                let mut command = Command::new("sh");
                let line = format!("{trap}ulimit -f {size}; exec {program} {}", self.line);
                command.args(["-c", &line]);
                command
            }
        };
        command
            .current_dir(folder)
            .env("PALPATE_CACHE", folder.join("cache"))
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        command
    }

    /// The folder as it is before.
    fn copy(&self) -> TempDir {
        let folder = tempfile::tempdir().unwrap();
        for (name, bytes) in &self.before {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        folder
    }

    /// Waits until a command that was begun just now changes its first file, or ends.
    fn wait_for_write(&self, folder: &Path, child: &mut Child) {
        let first = names(folder);
        // The processor is the command's until shortly before.
        sleep(self.first_write.mul_f64(0.8));
        while names(folder) == first && child.try_wait().unwrap().is_none() {
            std::hint::spin_loop();
        }
    }

    /// Kills it so many times, and gives it so many disks that are too small, at moments and of sizes of a seed.
    pub(super) fn crash(&self, kills: u32, disks: u32, seed: u64) -> String {
        let mut random = fastrand::Rng::with_seed(seed);
        let mut seen = Seen::default();
        for trial in 0..kills {
            let folder = self.copy();
            let mut child = self.command(folder.path(), None).spawn().unwrap();
            let wait = match trial % 2 {
                0 => self.takes.mul_f64(1.1 * random.f64()),
                _ => {
                    self.wait_for_write(folder.path(), &mut child);
                    // As often within a microsecond of the first write as within 50 ms.
                    Duration::from_secs_f64(1e-6 * 5e4_f64.powf(random.f64()))
                }
            };
            sleep(wait);
            // SIGKILL where there is such.
            child.kill().unwrap();
            let is_done = child.wait().unwrap().success();
            self.judge(folder.path(), is_done, &mut seen);
        }
        let largest = self.after[0].values().map(Vec::len).max().unwrap_or(0) as f64;
        for trial in 0..if cfg!(unix) { disks } else { 0 } {
            let folder = self.copy();
            let size = (1.2 * random.f64() * largest / 512.0) as u32;
            let mut command = self.command(folder.path(), Some((size, trial % 2 == 0)));
            let status = command.stderr(Stdio::piped()).output().unwrap();
            assert!(
                status.status.code().is_none_or(|code| code < 2),
                "{}: a full disk is no mistake in the input: {}",
                self.name,
                stderr(&status)
            );
            self.judge(folder.path(), status.status.success(), &mut seen);
        }
        format!(
            "{}: {kills} kills, {disks} small disks, {seen:?}",
            self.name
        )
    }

    fn judge(&self, folder: &Path, is_done: bool, seen: &mut Seen) {
        let found = files(folder);
        let (mut old, mut new, mut unfinished) = (0, 0, 0);
        for (name, bytes) in &found {
            if is_unfinished(name) {
                unfinished += 1;
                continue;
            }
            let is_old = self.before.get(name) == Some(bytes);
            let is_new = self.is_new(folder, name, bytes);
            assert!(
                is_old || is_new,
                "{} left {} that is neither the old nor the new one",
                self.name,
                name.display()
            );
            if self.after[0].get(name) != self.before.get(name) {
                old += u32::from(!is_new);
                new += u32::from(is_new);
            }
        }
        // A session and all that was made of it give way at once to one that is whole and has not its name yet.
        let session = Path::new("out/session.csv");
        let gives_way = self.name == "simulate" && found.get(session) != self.before.get(session);
        for name in self.before.keys() {
            let is_of_session = gives_way && name.starts_with("out");
            assert!(
                is_in(&found, name) || is_of_session,
                "{} lost {}",
                self.name,
                name.display()
            );
        }
        self.judge_session(folder);
        let is_whole = self.after[0].keys().all(|name| is_in(&found, name)) && old == 0;
        assert!(is_whole || !is_done, "{} says that it is done", self.name);
        seen.finished += u32::from(is_done);
        seen.unfinished += u32::from(unfinished > 0);
        match (old > 0, new > 0) {
            (true, true) => seen.both += 1,
            (false, true) => seen.all_new += 1,
            _ => seen.all_old += 1,
        }
    }

    /// Whether a file is the one of an undisturbed run; where two of those differ, a whole one of its kind.
    fn is_new(&self, folder: &Path, name: &Path, bytes: &[u8]) -> bool {
        let [first, second] = [0, 1].map(|run| self.after[run].get(name));
        if first == second {
            return first.map(Vec::as_slice) == Some(bytes);
        }
        let text = String::from_utf8_lossy(bytes);
        match name.extension().and_then(|ending| ending.to_str()) {
            Some("json") => {
                let without_times = |bytes: &[u8]| {
                    let mut read: serde_json::Value = serde_json::from_slice(bytes).ok()?;
                    read.as_object_mut()?.remove("step_times_s");
                    Some(read)
                };
                let own = without_times(bytes);
                own.is_some() && own == first.and_then(|bytes| without_times(bytes))
            }
            Some("html") => text.trim_end().ends_with("</html>"),
            Some("feb") => text.trim_end().ends_with("</febio_spec>"),
            Some("csv") => {
                let recording = Recording::read(folder.join(name));
                recording.is_ok_and(|recording| recording.incomplete().is_none())
            }
            Some("toml") => palpate_files::Tissue::read(folder.join(name)).is_ok(),
            _ => false,
        }
    }

    /// A session is shown with its own scene, old or new, or says that it is incomplete.
    fn judge_session(&self, folder: &Path) {
        let out = folder.join("out");
        if self.name != "simulate" {
            return;
        }
        let shown = SessionFolder::read(&out).unwrap();
        let session = |run: &Files| {
            let text = String::from_utf8(run[Path::new("out/session.csv")].clone()).unwrap();
            Session::parse(&text, "session.csv").unwrap().rows
        };
        let title = shown.task().title;
        if shown.session.incomplete.is_some() {
            assert!(!shown.warnings().is_empty());
        } else if shown.session.rows == session(&self.before) {
            assert_eq!(title.as_deref(), Some("Press"));
        } else {
            assert!(shown.session.rows == session(&self.after[0]));
            assert_eq!(title.as_deref(), Some("Press harder"));
        }
    }
}

fn is_in(files: &Files, name: &Path) -> bool {
    files.contains_key(name)
}

/// What is not finished, or holds a folder, by its name.
fn is_unfinished(name: &Path) -> bool {
    let name = name.file_name().unwrap().to_string_lossy();
    name.ends_with(".part") || name.starts_with('.')
}

fn walk(folder: &Path, see: &mut dyn FnMut(PathBuf)) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let path = entry.path();
        match path.is_dir() {
            true => walk(&path, see),
            false => see(path),
        }
    }
}

fn files(folder: &Path) -> Files {
    let mut files = Files::new();
    walk(folder, &mut |path| {
        let name = path.strip_prefix(folder).unwrap().to_owned();
        files.insert(name, fs::read(&path).unwrap());
    });
    files
}

/// The names in a folder, but for those that only claim it.
fn names(folder: &Path) -> Vec<PathBuf> {
    let mut names = Vec::new();
    walk(folder, &mut |path| {
        if !path.to_string_lossy().ends_with("palpate-lock") {
            names.push(path);
        }
    });
    names
}
