use palpate_characterize::online::OnlineSample;
use palpate_files::protocol::Stimulus;
use palpate_files::recording::RecordingHeader;
use palpate_measure::live::{ConsoleEvent, LiveRig, RigCommand};
use palpate_measure::{Phase, RigSample};
use palpate_servo::{ForceTorque, Vec3};

use super::journal::Journal;
use super::online::Online;
use crate::history::History;

/// State of a running rig.
#[derive(Debug, Default)]
pub(super) struct RigState {
    pub(super) now: Option<RigSample>,
    /// Force, and the way down from where the rig began.
    pub(super) history: History,
    /// The running command, and its start on the rig's clock [s].
    pub(super) doing: Option<(RigCommand, f64)>,
    /// Commands that were sent and neither done nor dropped.
    pub(super) waiting: usize,
    pub(super) fault: Option<Shown>,
    /// The last error.
    pub(super) notice: Option<String>,
    /// The largest force that the sensor shows [N].
    pub(super) sensor_range: f64,
    /// Header of recordings on the specimen and the indenter.
    pub(super) specimen: RecordingHeader,
    /// The estimate of the tissue during a press.
    pub(super) online: Online,
    last_forces: [f64; AVERAGED],
    last_axes: [ForceTorque; AVERAGED],
    samples: usize,
}

/// Samples of the force that is shown as a number, which nobody reads a thousand times a second.
const AVERAGED: usize = 20;

/// A fault that is shown.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shown {
    pub(super) sentence: String,
    /// Whether somebody has read it.
    pub(super) seen: bool,
    /// Whether somebody let forces on again since.
    pub(super) arming: bool,
}

impl RigState {
    pub(super) fn new(stops_at: Option<f64>) -> Self {
        let mut watch = Self::default();
        watch.online.stops_at = stops_at;
        watch
    }

    /// Reads samples and events of `live` since the last picture.
    pub(super) fn read(&mut self, live: &mut LiveRig, journal: &mut Journal) {
        for sample in live.samples.drain() {
            self.add_sample(sample);
        }
        for news in live.console_events.try_iter() {
            self.handle(news, journal);
        }
        if self.online.is_enough()
            && let Some((RigCommand::Press(_, number), _)) = self.doing
        {
            live.console.end_press(number);
        }
    }

    fn add_sample(&mut self, sample: RigSample) {
        self.history
            .add(sample.time, [sample.force, -sample.height]);
        self.last_forces[self.samples % AVERAGED] = sample.force;
        self.last_axes[self.samples % AVERAGED] = sample.axes.unwrap_or_default();
        self.samples += 1;
        if let (Phase::Pressing, Some(depth_m)) = (sample.phase, sample.depth) {
            self.online.add(OnlineSample {
                time_s: sample.time,
                depth_m,
                force_n: sample.force,
            });
        }
        self.now = Some(sample);
    }

    /// The direction out of the tissue along which the rig approaches [-].
    pub(super) fn normal(&self) -> Vec3 {
        self.now.map_or(Vec3::z(), |now| now.normal)
    }

    /// Where the indenter is, from where the rig began [mm].
    pub(super) fn place_mm(&self) -> [f64; 3] {
        let place = self.now.map_or(Vec3::zeros(), |now| now.position);
        // Not −0.
        place
            .map(|metres| (1e4 * metres).round() / 10.0 + 0.0)
            .into()
    }

    /// The mean force of the last samples [N].
    pub(super) fn steady_force(&self) -> f64 {
        self.last_forces.iter().sum::<f64>() / AVERAGED as f64
    }

    /// The mean of the last samples on all axes; none for a sensor of one.
    pub(super) fn steady_axes(&self) -> Option<ForceTorque> {
        self.now?.axes?;
        let sum = self
            .last_axes
            .iter()
            .fold(ForceTorque::zero(), |sum, axes| sum + *axes);
        Some(sum.map(|vector| vector / AVERAGED as f64))
    }

    fn handle(&mut self, news: ConsoleEvent, journal: &mut Journal) {
        match news {
            ConsoleEvent::Begun(command) => {
                self.doing = Some((command, self.now.map_or(0.0, |now| now.time)));
                if let RigCommand::Press(trajectory, _) = command {
                    match trajectory.stimulus() {
                        Stimulus::RampAndHold { .. } => {
                            let deepest = trajectory.deepest_expected();
                            self.online.begin(&self.specimen, deepest);
                        }
                        Stimulus::Swing { .. } => self.online.end(),
                    }
                }
            }
            ConsoleEvent::Ended(command, ended) => {
                self.done_with(command, journal);
                if let Err(error) = ended {
                    self.notice = Some(error.to_string());
                }
            }
            ConsoleEvent::Dropped(command) => self.done_with(command, journal),
            ConsoleEvent::Failed(error) => self.notice = Some(error.to_string()),
            ConsoleEvent::Faulted(fault) => {
                self.fault = Some(Shown {
                    sentence: fault.to_string(),
                    seen: false,
                    arming: false,
                });
                // The fault replaces the notice.
                self.notice = None;
            }
            ConsoleEvent::Armed => self.fault = None,
            ConsoleEvent::Recorded(number, recorded, rows) => {
                journal.enter(number, recorded, &rows)
            }
            // It could not even be begun.
            ConsoleEvent::WriteFailed(unwritten) if unwritten.rows.is_empty() => {
                self.notice = Some(unwritten.error.to_string());
            }
            ConsoleEvent::WriteFailed(unwritten) => journal.keep_unsaved(*unwritten),
        }
    }

    fn done_with(&mut self, command: RigCommand, journal: &mut Journal) {
        self.doing = None;
        self.online.end();
        self.waiting = self.waiting.saturating_sub(1);
        if let RigCommand::Press(_, number) = command {
            journal.forget(number);
        }
    }

    /// Whether a command that moves the indenter would be carried out at once.
    pub(super) fn is_free(&self) -> bool {
        self.fault.is_none() && self.waiting == 0 && self.now.is_some()
    }

    /// How deep first contact is below where the rig began [m]; none before there was one.
    pub(super) fn contact(&self) -> Option<f64> {
        let now = self.now?;
        Some(-now.height - now.depth?)
    }

    /// State of the rig, in a word or two.
    pub(super) fn state(&self) -> &'static str {
        let Some(now) = self.now else {
            return "starting";
        };
        match (now.phase, self.doing) {
            (Phase::ForceOff, _) if self.fault.as_ref().is_some_and(|fault| fault.arming) => {
                "arming"
            }
            (Phase::ForceOff, _) => "no force",
            (Phase::Jogging, _) => "by hand",
            (Phase::Approaching, _) | (_, Some((RigCommand::Approach, _))) => "approaching",
            (Phase::Withdrawing, _) => "withdrawing",
            (Phase::Pressing, _) => "pressing",
            (Phase::Waiting, Some((RigCommand::Rest, _))) => "resting",
            (Phase::Waiting, _) => "waiting",
        }
    }
}
