use std::path::{Path, PathBuf};

use palpate_files::recording::{RecordingHeader, RecordingRow};
use palpate_files::{Claim, Error, Overwrite, unfinished};
use palpate_measure::live::{RecordingRequest, WriteFailed};
use palpate_measure::{DepthTrajectory, Recorded, RigSettings, recording_name, stimulus_name};

use super::curves::{force_over_depth, relaxation};

/// Finished and pending recordings.
#[derive(Debug, Default)]
pub(super) struct Journal {
    folder: PathBuf,
    last: u64,
    asked: Vec<PendingRecording>,
    pub(super) entries: Vec<Entry>,
    /// The one that is looked at; the newest when there is none.
    chosen: Option<usize>,
    /// A recording that is in memory alone; nothing else is recorded until it is saved or thrown away.
    pub(super) unsaved: Option<Unsaved>,
}

/// A recording that could not be written.
#[derive(Debug)]
pub(super) struct Unsaved {
    pub(super) failed: WriteFailed,
    what: RecordingSubject,
    /// The folder where it shall be written instead, as it is typed.
    pub(super) elsewhere: String,
    /// Why it cannot be written there either.
    pub(super) error: Option<String>,
}

/// A recording that was asked for.
#[derive(Debug)]
struct PendingRecording {
    number: u64,
    file: PathBuf,
    entry: RecordingSubject,
}

/// The subject of a recording.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecordingSubject {
    /// The number of the specimen.
    place: usize,
    trajectory: DepthTrajectory,
    pub(super) stimulus: String,
    pub(super) repeat: u64,
}

/// A recording that was made.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) what: RecordingSubject,
    pub(super) recorded: Recorded,
    /// [mN] over [mm]
    pub(super) force_over_depth: Vec<[f64; 2]>,
    /// [-] over the logarithm of seconds
    pub(super) relaxation: Vec<[f64; 2]>,
}

impl Journal {
    /// Of recordings in `folder`.
    pub(super) fn new(folder: PathBuf) -> Self {
        Self {
            folder,
            ..Self::default()
        }
    }

    /// A recording of `course` on the specimen at a place, under a name that is free: repetitions are counted on.
    pub(super) fn ask(
        &mut self,
        trajectory: &DepthTrajectory,
        settings: &RigSettings,
        specimen: &RecordingHeader,
        place: usize,
    ) -> RecordingRequest {
        let stimulus = stimulus_name(&trajectory.stimulus());
        let mut repeat = 0;
        let file = loop {
            repeat += 1;
            let name = recording_name(specimen, place + 1, &stimulus, repeat);
            let file = self.folder.join(format!("{name}.csv"));
            let asked = self.asked.iter().any(|other| other.file == file);
            if !asked && !file.exists() && !unfinished(&file).exists() {
                break file;
            }
        };
        self.last += 1;
        self.asked.push(PendingRecording {
            number: self.last,
            file: file.clone(),
            entry: RecordingSubject {
                place,
                trajectory: *trajectory,
                stimulus,
                repeat,
            },
        });
        RecordingRequest {
            number: self.last,
            file,
            header: settings.describe(specimen, trajectory, repeat),
        }
    }

    /// A recording was made.
    pub(super) fn enter(&mut self, number: u64, recorded: Recorded, rows: &[RecordingRow]) {
        let Some(place) = self.asked.iter().position(|asked| asked.number == number) else {
            return;
        };
        let what = self.asked.swap_remove(place).entry;
        self.chosen = None;
        self.entries.push(Entry {
            force_over_depth: force_over_depth(rows),
            relaxation: relaxation(rows, &what.trajectory.stimulus()),
            what,
            recorded,
        });
    }

    /// Takes a recording that could not be written; its samples stay in memory.
    pub(super) fn keep_unsaved(&mut self, unwritten: WriteFailed) {
        let number = unwritten.request.number;
        let Some(place) = self.asked.iter().position(|asked| asked.number == number) else {
            return;
        };
        let here = std::env::current_dir().unwrap_or_default();
        self.unsaved = Some(Unsaved {
            failed: unwritten,
            what: self.asked.swap_remove(place).entry,
            elsewhere: here.display().to_string(),
            error: None,
        });
    }

    /// Writes the recording that is in memory into the folder that was typed, where recordings go from then on.
    pub(super) fn save_elsewhere(&mut self) {
        let Some(mut unsaved) = self.unsaved.take() else {
            return;
        };
        let folder = PathBuf::from(unsaved.elsewhere.trim());
        match written(&unsaved.failed, &folder) {
            Ok(recorded) => {
                let rows = &unsaved.failed.rows;
                self.folder = folder;
                self.chosen = None;
                self.entries.push(Entry {
                    force_over_depth: force_over_depth(rows),
                    relaxation: relaxation(rows, &unsaved.what.trajectory.stimulus()),
                    what: unsaved.what,
                    recorded,
                });
            }
            Err(error) => {
                unsaved.error = Some(error.to_string());
                self.unsaved = Some(unsaved);
            }
        }
    }

    /// A recording will not be made; its name is free again.
    pub(super) fn forget(&mut self, number: u64) {
        self.asked.retain(|asked| asked.number != number);
    }

    /// Where recordings go.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Looks at an entry by its number in the list.
    pub(super) fn choose(&mut self, entry: usize) {
        self.chosen = Some(entry);
    }

    /// Which entry is looked at.
    pub(super) fn shown(&self) -> Option<usize> {
        self.chosen.or(self.entries.len().checked_sub(1))
    }

    /// The entry that is looked at, and others of the same stimulus on the same specimen.
    pub(super) fn compared(&self) -> Option<(&Entry, impl Iterator<Item = &Entry>)> {
        let shown = self.shown()?;
        let entry = &self.entries[shown];
        let same = |other: &RecordingSubject| {
            (other.place, other.trajectory) == (entry.what.place, entry.what.trajectory)
        };
        let others = self.entries.iter().enumerate();
        let others = others.filter(move |(place, other)| *place != shown && same(&other.what));
        Some((entry, others.map(|(_, other)| other)))
    }
}

/// Writes a recording into another folder, over nothing that is there.
fn written(unwritten: &WriteFailed, folder: &Path) -> Result<Recorded, Error> {
    let claim = Claim::of_folder(folder, Overwrite::Refused)?;
    let name = unwritten.request.file.file_name().unwrap_or_default();
    claim.check([Path::new(name)])?;
    unwritten.write_to(&folder.join(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_files::protocol::Stimulus;

    fn recorded(file: PathBuf) -> Recorded {
        Recorded {
            file,
            samples: 1,
            peak: 0.1,
            cut_short: None,
        }
    }

    /// A recording that the disk did not take is written into another folder, over nothing, and so are those after it.
    #[test]
    fn a_recording_in_memory_is_saved_into_another_folder() {
        let folder = tempfile::tempdir().unwrap();
        let full = folder.path().join("full");
        let mut journal = Journal::new(full.clone());
        let trajectory = DepthTrajectory::of(Stimulus::RampAndHold {
            depth_m: 4e-3,
            ramp_s: 0.5,
            hold_s: 1.0,
        });
        let trajectory = trajectory.unwrap();
        let header = RecordingHeader::default();
        let settings = RigSettings::default();
        let commission = journal.ask(&trajectory, &settings, &header, 0);
        let number = commission.number;
        let name = commission.file.file_name().unwrap().to_owned();
        journal.keep_unsaved(WriteFailed {
            request: commission,
            rows: [[0.0, 0.0, 0.1], [0.001, 1e-4, 0.2]]
                .map(RecordingRow::from)
                .into(),
            error: Error::Exists { path: full },
        });
        // What the rig says in the end takes nothing away.
        journal.forget(number);
        let other = folder.path().join("other");
        std::fs::create_dir(&other).unwrap();
        std::fs::write(other.join(&name), "mine").unwrap();
        let put = |journal: &mut Journal, folder: &Path| {
            let unsaved = journal.unsaved.as_mut().unwrap();
            unsaved.elsewhere = folder.display().to_string();
            journal.save_elsewhere();
        };
        put(&mut journal, &other);
        let error = journal.unsaved.as_ref().unwrap().error.clone();
        assert!(error.unwrap().contains("is there already"));
        std::fs::remove_file(other.join(&name)).unwrap();
        put(&mut journal, &other);
        assert!(journal.unsaved.is_none());
        assert_eq!(journal.folder(), other);
        assert_eq!(journal.entries[0].recorded.samples, 2);
        assert!(other.join(&name).exists());
    }

    /// A window writes over nothing: names on the disk and names that were promised are passed over.
    #[test]
    fn repetitions_are_counted_on() {
        let folder = tempfile::tempdir().unwrap();
        let there = folder.path().join("liver-1-ramp-and-hold-4mm-1.csv");
        std::fs::write(there, "").unwrap();
        let left = folder.path().join("liver-1-ramp-and-hold-4mm-2.csv.part");
        std::fs::write(left, "").unwrap();
        let mut journal = Journal::new(folder.path().to_owned());
        let trajectory = DepthTrajectory::of(Stimulus::RampAndHold {
            depth_m: 4e-3,
            ramp_s: 0.5,
            hold_s: 1.0,
        });
        let trajectory = trajectory.unwrap();
        let header = RecordingHeader {
            organ: Some("liver".to_owned()),
            ..RecordingHeader::default()
        };
        let settings = RigSettings::default();
        let ask = |journal: &mut Journal| {
            let asked = journal.ask(&trajectory, &settings, &header, 0);
            (asked.number, asked.header.repeat, asked.file)
        };
        let (first, repeat, file) = ask(&mut journal);
        assert_eq!(repeat, Some(3));
        assert_eq!(ask(&mut journal).1, Some(4));
        journal.forget(first);
        let (again, repeat, _) = ask(&mut journal);
        assert_eq!(repeat, Some(3));
        journal.enter(
            again,
            recorded(file),
            &[RecordingRow::from([0.0, 0.0, 0.1])],
        );
        assert!(journal.compared().is_some_and(|(entry, mut others)| {
            entry.what.repeat == 3 && others.next().is_none()
        }));
    }
}
