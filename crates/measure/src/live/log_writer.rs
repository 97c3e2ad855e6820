use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender};

use palpate_files::recording::{RecordingHeader, RecordingRow};
use palpate_servo::{Fault, log};

use super::console::Switches;
use super::{RigCommand, RigEvent};
use crate::{Axes, Ended, Error, Phase, Recorded, Recorder, RigSample};

/// A recording that is to be made.
#[derive(Debug, Clone)]
pub struct RecordingRequest {
    /// Its number in [`RigCommand::Press`].
    pub number: u64,
    /// Its file.
    pub file: PathBuf,
    /// Its header.
    pub header: RecordingHeader,
}

/// An event for the console.
#[derive(Debug)]
pub enum ConsoleEvent {
    /// The rig begins a command.
    Begun(RigCommand),
    /// It has ended a command.
    Ended(RigCommand, Result<Ended, Error>),
    /// It dropped a stale command.
    Dropped(RigCommand),
    /// The rig failed while it waited.
    Failed(Error),
    /// Forces are off.
    Faulted(Fault),
    /// Forces are on again.
    Armed,
    /// A recording is complete: its number, the recording and its samples.
    Recorded(u64, Recorded, Vec<RecordingRow>),
    /// A recording could not be written; the rig was stopped.
    WriteFailed(Box<WriteFailed>),
}

/// A recording that could not be written. Its samples until then are in memory, as are those of every recording, for
/// its plots.
#[derive(Debug)]
pub struct WriteFailed {
    /// The commission of the recording.
    pub request: RecordingRequest,
    /// Its samples.
    pub rows: Vec<RecordingRow>,
    /// Why it could not be written.
    pub error: palpate_files::Error,
}

impl WriteFailed {
    /// Writes it to another file, whose folder must exist.
    ///
    /// # Errors
    /// When the operating system refuses that, too.
    pub fn write_to(&self, file: &Path) -> Result<Recorded, palpate_files::Error> {
        let has_axes = self.rows.first().is_some_and(|row| row.axes.is_some());
        let axes = if has_axes { Axes::Six } else { Axes::One };
        let mut recorder = Recorder::begin(file, &self.request.header, axes)?;
        for row in &self.rows {
            recorder.write(*row)?;
        }
        recorder.end(Some("its file could not be written any further".to_owned()))
    }
}

/// Writes the recordings from the events of the rig, and forwards the events to the console.
pub(super) struct LogWriter {
    pub(super) events: log::Reader<RigEvent>,
    pub(super) requests: Receiver<RecordingRequest>,
    pub(super) samples: log::Writer<RigSample>,
    pub(super) console_events: Sender<ConsoleEvent>,
    pub(super) switches: Switches,
    pub(super) open: Option<Open>,
}

/// The recording that is being made.
pub(super) struct Open {
    commission: RecordingRequest,
    /// None before the first sample: a refused command leaves no file.
    recorder: Option<Recorder>,
    rows: Vec<RecordingRow>,
}

impl LogWriter {
    /// Reads all events so far.
    pub(super) fn read(&mut self) {
        while let Some(event) = self.events.next_value() {
            match event {
                RigEvent::Sample(sample) => self.take(&sample),
                RigEvent::Begun(command) => {
                    self.begin(command);
                    self.pass_on(ConsoleEvent::Begun(command));
                }
                RigEvent::Ended(command, ended) => {
                    self.finish(&ended);
                    self.pass_on(ConsoleEvent::Ended(command, ended));
                }
                RigEvent::Dropped(command) => self.pass_on(ConsoleEvent::Dropped(command)),
                RigEvent::Failed(error) => self.pass_on(ConsoleEvent::Failed(error)),
                RigEvent::Faulted(fault) => self.pass_on(ConsoleEvent::Faulted(fault)),
                RigEvent::Armed => self.pass_on(ConsoleEvent::Armed),
            }
        }
    }

    fn pass_on(&self, event: ConsoleEvent) {
        // Recordings are written even when the window is closed.
        let _ = self.console_events.send(event);
    }

    fn begin(&mut self, command: RigCommand) {
        let RigCommand::Press(_, number) = command else {
            return;
        };
        let own = self
            .requests
            .try_iter()
            .find(|other| other.number == number);
        self.open = own.map(|commission| Open {
            commission,
            recorder: None,
            rows: Vec::new(),
        });
    }

    fn take(&mut self, sample: &RigSample) {
        self.samples.add(*sample);
        if sample.phase != Phase::Pressing {
            return;
        }
        let Some(mut open) = self.open.take() else {
            return;
        };
        match open.take(sample) {
            Ok(()) => self.open = Some(open),
            Err(error) => self.give_up(open, error),
        }
    }

    fn finish(&mut self, ended: &Result<Ended, Error>) {
        let Some(mut open) = self.open.take() else {
            return;
        };
        let Some(recorder) = open.recorder.take() else {
            return;
        };
        match recorder.finish(ended) {
            Ok(recorded) => {
                self.pass_on(ConsoleEvent::Recorded(
                    open.commission.number,
                    recorded,
                    open.rows,
                ));
            }
            Err(error) => self.give_up(open, error),
        }
    }

    /// Nothing is pressed that is not recorded.
    fn give_up(&mut self, open: Open, error: palpate_files::Error) {
        self.switches.stop();
        self.pass_on(ConsoleEvent::WriteFailed(Box::new(WriteFailed {
            request: open.commission,
            rows: open.rows,
            error,
        })));
    }
}

impl Open {
    fn take(&mut self, sample: &RigSample) -> Result<(), palpate_files::Error> {
        let recorder = match &mut self.recorder {
            Some(recorder) => recorder,
            None => {
                let RecordingRequest { file, header, .. } = &mut self.commission;
                // A normal may have been measured since it was asked for.
                header.approach_normal = Some(sample.normal.into());
                let begun = Recorder::begin(file, header, Axes::of(sample))?;
                self.recorder.insert(begun)
            }
        };
        let row = recorder.row(sample);
        // Before it is written: it is not lost when that fails.
        self.rows.push(row);
        recorder.write(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DepthTrajectory;
    use palpate_files::Recording;
    use palpate_files::protocol::Stimulus;
    use palpate_servo::Vec3;
    use palpate_servo::log::Writer;
    use std::sync::mpsc::channel;

    struct TestBench {
        log_writer: LogWriter,
        events: Writer<RigEvent>,
        console_events: Receiver<ConsoleEvent>,
        commissions: Sender<RecordingRequest>,
        samples: log::Reader<RigSample>,
        trajectory: DepthTrajectory,
    }

    fn test_bench() -> TestBench {
        let (events, events_reader) = log::ring(100);
        let (samples, samples_reader) = log::ring(4);
        let (console_events, console_events_reader) = channel();
        let (commissions, commissioned) = channel();
        let log_writer = LogWriter {
            events: events_reader,
            requests: commissioned,
            samples,
            console_events,
            switches: Switches::default(),
            open: None,
        };
        let trajectory = DepthTrajectory::of(Stimulus::RampAndHold {
            depth_m: 4e-3,
            ramp_s: 0.5,
            hold_s: 1.0,
        });
        TestBench {
            log_writer,
            events,
            console_events: console_events_reader,
            commissions,
            samples: samples_reader,
            trajectory: trajectory.unwrap(),
        }
    }

    fn sample(tick: u32, phase: Phase) -> RigSample {
        RigSample {
            time: 7.0 + 1e-3 * f64::from(tick),
            phase,
            height: -5e-3,
            depth: Some(1e-6 * f64::from(tick)),
            force: 1e-3,
            position: Vec3::z() * -5e-3,
            normal: Vec3::z(),
            axes: Some(palpate_servo::ForceTorque::zero()),
            sensor_fault: None,
            breath: None,
            waited: 0.0,
        }
    }

    impl TestBench {
        fn ask(&self, number: u64, file: PathBuf) -> RigCommand {
            let header = RecordingHeader::default();
            let commission = RecordingRequest {
                number,
                file,
                header,
            };
            self.commissions.send(commission).unwrap();
            RigCommand::Press(self.trajectory, number)
        }

        /// Thirty samples on the way and thirty of a stimulus, which then `ended`.
        fn press(&mut self, command: RigCommand, ended: Result<Ended, Error>) {
            self.events.add(RigEvent::Begun(command));
            for tick in 0..60 {
                let phase = [Phase::Waiting, Phase::Pressing][usize::from(tick >= 30)];
                self.events.add(RigEvent::Sample(sample(tick, phase)));
            }
            self.events.add(RigEvent::Ended(command, ended));
            self.log_writer.read();
        }
    }

    /// What is pressed is written, from time zero, and a fault stands at its top. A window that does not read
    /// loses samples of its own and none of the recording.
    #[test]
    fn a_fault_is_recorded() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("one.csv");
        let mut test_bench = test_bench();
        let command = test_bench.ask(3, file.clone());
        test_bench.press(command, Err(Error::Device(Fault::EmergencyStop)));
        let read = Recording::read(&file).unwrap();
        assert_eq!(read.time_s().len(), 30);
        assert_eq!(read.time_s()[0], 0.0);
        let why = read.header.cut_short().unwrap();
        assert_eq!(why, "the emergency stop was pressed");
        assert_eq!(test_bench.samples.lost(), 56);
        let console_events: Vec<ConsoleEvent> = test_bench.console_events.try_iter().collect();
        let [
            ConsoleEvent::Begun(_),
            ConsoleEvent::Recorded(3, recorded, rows),
            ConsoleEvent::Ended(..),
        ] = &console_events[..]
        else {
            panic!("{console_events:?}");
        };
        assert_eq!(rows.len(), 30);
        assert_eq!(recorded.cut_short.as_deref(), Some(why));
    }

    /// A disk that breaks while it is recorded stops the rig; what was pressed until then can be written elsewhere, and
    /// says that it is not whole.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_recording_on_a_broken_disk_is_kept_in_memory() {
        use std::io::{BufRead, BufReader};
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("one.csv");
        // A pipe whose reader leaves after the names of the columns.
        let pipe = palpate_files::unfinished(&file);
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        let reader = std::thread::spawn(move || {
            let lines = BufReader::new(std::fs::File::open(pipe).unwrap()).lines();
            let is_last = |line: &String| line.starts_with("time_s");
            assert!(lines.map_while(Result::ok).any(|line| is_last(&line)));
        });
        let mut test_bench = test_bench();
        let command = test_bench.ask(1, file);
        test_bench.events.add(RigEvent::Begun(command));
        test_bench
            .events
            .add(RigEvent::Sample(sample(0, Phase::Pressing)));
        test_bench.log_writer.read();
        reader.join().unwrap();
        // Rows are brought to the disk at least every 200.
        for tick in 1..300 {
            test_bench
                .events
                .add(RigEvent::Sample(sample(tick, Phase::Pressing)));
            test_bench.log_writer.read();
        }
        assert_eq!(test_bench.log_writer.switches.stops(), 1);
        let unwritten = test_bench
            .console_events
            .try_iter()
            .find_map(|event| match event {
                ConsoleEvent::WriteFailed(unwritten) => Some(unwritten),
                _ => None,
            });
        let unwritten = unwritten.unwrap();
        assert!(unwritten.error.to_string().contains("one.csv"));
        let other = folder.path().join("other.csv");
        let recorded = unwritten.write_to(&other).unwrap();
        let read = Recording::read(&other).unwrap();
        assert_eq!(read.time_s().len(), 200);
        assert_eq!(read.time_s().len(), recorded.samples);
        assert_eq!(read.header.cut_short(), recorded.cut_short.as_deref());
        assert!(recorded.cut_short.is_some());
    }

    /// What cannot be written stops the rig and says so; what is refused leaves no file.
    #[test]
    fn nothing_is_pressed_that_is_not_recorded() {
        let folder = tempfile::tempdir().unwrap();
        let mut test_bench = test_bench();
        let command = test_bench.ask(1, folder.path().join("missing").join("one.csv"));
        test_bench.press(command, Ok(Ended::Stopped));
        assert_eq!(test_bench.log_writer.switches.stops(), 1);
        let said = |event: ConsoleEvent| match event {
            ConsoleEvent::WriteFailed(unwritten) => Some(unwritten),
            _ => None,
        };
        let unwritten = test_bench.console_events.try_iter().find_map(said).unwrap();
        assert!(unwritten.error.to_string().contains("missing"));
        let refused = test_bench.ask(2, folder.path().join("two.csv"));
        test_bench.events.add(RigEvent::Begun(refused));
        let event = RigEvent::Ended(refused, Err(Error::NotApproached));
        test_bench.events.add(event);
        test_bench.log_writer.read();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
