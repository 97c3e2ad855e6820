//! Source of the displayed state: live hands, or a replayed session.

use std::time::{Duration, Instant};

use palpate_files::SessionRow;
use palpate_simulate::interactive::{
    Interaction, ModelCommand, ModelReport, Quality, RecordingFailure, Snapshot,
};
use palpate_simulate::{Replay, SessionFolderWriter, Simulation};

/// Time budget of a picture for replayed steps [ms].
const BUDGET: Duration = Duration::from_millis(12);

/// How far the pictures may lag behind the pace before the pace waits for them [s of the session]: a stored state
/// is never farther away once the session was played ahead.
const MAX_BEHIND: f64 = 2.0;

/// Source of the displayed state.
pub(super) enum Source {
    /// Hands that touch now.
    Live(Box<Interaction>),
    /// A session that is played again.
    Replay(Box<Playback>),
}

/// A session that is replayed forwards and backwards, at a chosen pace.
pub(super) struct Playback {
    replay: Replay,
    snapshot: Snapshot,
    rows: Vec<SessionRow>,
    pub(super) plays: bool,
    /// Seconds of the session per second [-].
    pub(super) pace: f64,
    /// Where it should be [s].
    at: f64,
    /// How many steps shall have been played.
    goal: usize,
}

impl Source {
    /// The latest that there is to see.
    pub(super) fn snapshot(&mut self) -> &Snapshot {
        match self {
            Self::Live(interaction) => interaction.snapshot(),
            Self::Replay(playback) => &playback.snapshot,
        }
    }

    /// The rows that nobody has read yet.
    pub(super) fn rows(&mut self) -> Vec<SessionRow> {
        match self {
            Self::Live(interaction) => interaction.rows().collect(),
            Self::Replay(playback) => std::mem::take(&mut playback.rows),
        }
    }

    /// How good the touch was; a session that is played again has none.
    pub(super) fn quality(&mut self) -> Quality {
        match self {
            Self::Live(interaction) => interaction.quality(),
            Self::Replay(_) => Quality {
                model: ModelReport::default(),
                loops: Vec::new(),
            },
        }
    }

    pub(super) fn is_running(&self) -> bool {
        match self {
            Self::Live(interaction) => interaction.is_running(),
            Self::Replay(_) => true,
        }
    }

    pub(super) fn send(&mut self, command: ModelCommand) {
        match self {
            Self::Live(interaction) => interaction.send(command),
            Self::Replay(playback) => match command {
                ModelCommand::Pause => playback.plays = false,
                ModelCommand::Resume => playback.plays = true,
                ModelCommand::Reset => playback.go_to(0),
                ModelCommand::UndoCut | ModelCommand::Mark | ModelCommand::StateDiameter(_) => {}
            },
        }
    }

    /// Warning about a device that does not answer any more.
    pub(super) fn hung_device(&self) -> Option<String> {
        match self {
            Self::Live(interaction) => interaction.hung_device(),
            Self::Replay(_) => None,
        }
    }

    /// Arms the forces of all devices again after a fault or an emergency stop.
    pub(super) fn arm(&self) {
        if let Self::Live(interaction) = self {
            interaction.arm();
        }
    }

    /// Takes the forces of all devices off until somebody arms them.
    pub(super) fn emergency_stop(&self) {
        if let Self::Live(interaction) = self {
            interaction.emergency_stop();
        }
    }

    /// Reports that the window is alive; without reports, forces are taken off.
    pub(super) fn report_alive(&self) {
        if let Self::Live(interaction) = self {
            interaction.report_alive();
        }
    }

    /// Records what is touched from a new beginning on.
    pub(super) fn record(&mut self, writer: SessionFolderWriter) {
        if let Self::Live(interaction) = self {
            interaction.record(writer);
        }
    }

    /// Why the rows of the recording can no longer be written, if they cannot.
    pub(super) fn recording_failure(&self) -> Option<RecordingFailure> {
        match self {
            Self::Live(interaction) => interaction.recording_failure(),
            Self::Replay(_) => None,
        }
    }

    /// Writes the recording elsewhere, from its beginning on.
    pub(super) fn record_elsewhere(
        &mut self,
        writer: SessionFolderWriter,
    ) -> Result<(), palpate_simulate::Error> {
        match self {
            Self::Live(interaction) => interaction.record_elsewhere(writer),
            Self::Replay(_) => Ok(()),
        }
    }

    /// Ends the recording.
    pub(super) fn end_recording(&mut self) -> Result<(), palpate_simulate::Error> {
        match self {
            Self::Live(interaction) => interaction.end_recording(),
            Self::Replay(_) => Ok(()),
        }
    }

    /// The session that is played again, if one is.
    pub(super) fn playback(&mut self) -> Option<&mut Playback> {
        match self {
            Self::Live(_) => None,
            Self::Replay(playback) => Some(playback),
        }
    }
}

impl Playback {
    /// At its beginning, playing.
    pub(super) fn new(simulation: &Simulation, mut replay: Replay) -> Self {
        replay.look_ahead();
        let mut snapshot = Snapshot::new(simulation);
        snapshot.show(replay.time(0), replay.state());
        Self {
            at: replay.time(0),
            replay,
            snapshot,
            rows: Vec::new(),
            plays: true,
            pace: 1.0,
            goal: 0,
        }
    }

    /// Steps that there are, and that were played.
    pub(super) fn steps(&self) -> [usize; 2] {
        [self.replay.steps(), self.replay.played()]
    }

    /// The time of a step since the first one [s].
    pub(super) fn time(&self, step: usize) -> f64 {
        self.replay.time(step) - self.replay.time(0)
    }

    /// Whether there is something to wait for: it plays, or goes to another step.
    pub(super) fn moves(&self) -> bool {
        self.plays || self.replay.played() != self.goal
    }

    /// Goes to where so many steps were played.
    pub(super) fn go_to(&mut self, step: usize) {
        self.goal = step.min(self.replay.steps());
        self.at = self.replay.time(self.goal);
        self.rows.clear();
    }

    /// How long the session is [s].
    pub(super) fn duration(&self) -> f64 {
        self.time(self.replay.steps())
    }

    /// The time of what is seen since the beginning of the session [s].
    pub(super) fn seen_at(&self) -> f64 {
        self.time(self.replay.played().saturating_sub(1))
    }

    /// Goes to a time since the beginning of the session [s], as far as there is time; its end lasts.
    pub(super) fn follow(&mut self, time: f64, plays: bool) {
        while self.goal < self.replay.steps() && self.time(self.goal) <= time {
            self.goal += 1;
        }
        while self.goal > 0 && self.time(self.goal - 1) > time {
            self.goal -= 1;
        }
        self.at = self.replay.time(self.goal);
        self.plays = plays;
        self.catch_up();
    }

    /// Plays on by so many seconds of the clock, as far as there is time.
    pub(super) fn go_on(&mut self, elapsed: f64) {
        let behind = self.replay.time(self.goal) - self.replay.time(self.replay.played());
        if self.plays && behind < MAX_BEHIND {
            self.at += elapsed.min(0.1) * self.pace;
            while self.goal < self.replay.steps() && self.replay.time(self.goal) <= self.at {
                self.goal += 1;
            }
        }
        self.catch_up();
        if self.plays && self.replay.played() == self.replay.steps() {
            self.plays = false;
            self.snapshot.paused = true;
        }
    }

    /// Plays the steps that are missing, as far as there is time.
    fn catch_up(&mut self) {
        let start = Instant::now();
        let before = self.replay.played();
        self.replay.jump(self.goal);
        let from = before.min(self.replay.played());
        while self.replay.played() < self.goal && start.elapsed() < BUDGET {
            self.replay.advance();
        }
        let now = self.replay.played();
        self.rows
            .extend_from_slice(self.replay.recorded_in(from..now));
        if now != before || self.snapshot.paused == self.plays {
            let time = self.replay.time(self.replay.played().saturating_sub(1));
            self.snapshot.show(time, self.replay.state());
            self.snapshot.paused = !self.plays;
        }
    }
}
