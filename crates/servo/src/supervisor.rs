//! Whether a session may display forces: one state for all of its loops, which read it at every tick.
//!
//! | order | off | armed | running | paused | tripped |
//! |---|---|---|---|---|---|
//! | [`arm`](Supervisor::arm): a person wants forces | armed | armed | running | armed | armed |
//! | a loop begins to raise its force | off | running | running | paused | tripped |
//! | [`pause`](Supervisor::pause) | off | paused | paused | paused | tripped |
//! | [`resume`](Supervisor::resume) | off | armed | running | armed | tripped |
//! | [`trip`](Supervisor::trip), or a fault of a loop | tripped | tripped | tripped | tripped | tripped |
//! | [`switch_off`](Supervisor::switch_off) | off | off | off | off | off |
//!
//! In *off*, *paused* and *tripped* the sent force is exactly zero from the next tick on; in *armed* it is zero until
//! the hand is slow and the force small ([`crate::limits::arming`]). Only a person can end these states.
//!
//! *How we know*: `tests` (every pair), `supervisor::…`.
//!
//! *Limits*: a loop that hangs in its device does not read the state; [`crate::monitor`] detects that, but cannot reach
//! the device.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::Fault;

/// How long a program that has to report may be silent before forces go off [s]: longer than the layout of a window
/// takes, shorter than a person notices.
pub const REPORT_TIMEOUT: f64 = 2.0;

/// How long the thread that watches the loops may be silent before forces go off [s]: it reports a thousand times a
/// second, and a loaded machine can delay it by some tens of milliseconds.
pub const MONITOR_TIMEOUT: f64 = 0.5;

/// Whether forces may be displayed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceState {
    /// No person has asked for forces.
    Off,
    /// A person has armed; forces ramp up once the hand is slow and the force small.
    Armed,
    /// Forces are on.
    Running,
    /// Forces are off until a person resumes.
    Paused,
    /// Forces are off until a person has acknowledged the reason and arms again.
    Tripped,
}

/// The events that change the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Transition {
    Arm,
    Run,
    Pause,
    Resume,
    Trip,
    SwitchOff,
}

/// The reason for a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// A person, at the keyboard or in the window.
    EmergencyStop,
    /// A fault of one of the loops.
    OtherDevice,
    /// The program that shows the touch is silent.
    ProgramSilent,
    /// A person, by the stop button of a device.
    DeviceButton,
    /// The program received a request to end: Ctrl-C, SIGTERM or the end of its terminal.
    Signal,
    /// A device no longer answers: its loop hangs inside a call of the driver.
    HungDevice,
    /// The recording failed.
    Unrecorded,
    /// The thread that watches the loops is silent.
    MonitorSilent,
}

/// A handle to the state of a session: cheap to clone, and safe to use from any thread. No call waits.
#[derive(Debug, Clone)]
pub struct Supervisor {
    /// The count of armings, the reason of a stop and the state, packed.
    word: Arc<AtomicU64>,
    /// When the program reported last [s, as bits]; infinite when it does not have to.
    reported: Arc<AtomicU64>,
    /// When the thread that watches the loops reported last [s, as bits]; infinite when there is none.
    watched: Arc<AtomicU64>,
}

/// The permission that a loop reads at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Permission {
    pub(crate) state: ForceState,
    /// Changes whenever a person arms forces that were off.
    pub(crate) armings: u64,
    /// Why forces are off, if they tripped.
    pub(crate) fault: Option<Fault>,
}

impl ForceState {
    /// Whether the session allows a force other than zero.
    pub fn allows_force(self) -> bool {
        matches!(self, Self::Armed | Self::Running)
    }

    fn after(self, transition: Transition) -> Self {
        match (transition, self) {
            (Transition::Arm, Self::Running) => Self::Running,
            (Transition::Arm, _) => Self::Armed,
            (Transition::Run, Self::Armed) => Self::Running,
            (Transition::Pause, Self::Armed | Self::Running) => Self::Paused,
            (Transition::Resume, Self::Paused) => Self::Armed,
            (Transition::Run | Transition::Pause | Transition::Resume, _) => self,
            (Transition::Trip, _) => Self::Tripped,
            (Transition::SwitchOff, _) => Self::Off,
        }
    }
}

const STATES: [ForceState; 5] = [
    ForceState::Off,
    ForceState::Armed,
    ForceState::Running,
    ForceState::Paused,
    ForceState::Tripped,
];

const REASONS: [StopReason; 8] = [
    StopReason::EmergencyStop,
    StopReason::OtherDevice,
    StopReason::ProgramSilent,
    StopReason::DeviceButton,
    StopReason::Signal,
    StopReason::HungDevice,
    StopReason::Unrecorded,
    StopReason::MonitorSilent,
];

impl StopReason {
    fn fault(self) -> Fault {
        match self {
            Self::EmergencyStop => Fault::EmergencyStop,
            Self::OtherDevice => Fault::OtherDevice,
            Self::ProgramSilent => Fault::ProgramSilent {
                limit: REPORT_TIMEOUT,
            },
            Self::DeviceButton => Fault::DeviceButton,
            Self::Signal => Fault::Interrupted,
            Self::HungDevice => Fault::Hung {
                limit: crate::monitor::HANG_TIMEOUT,
            },
            Self::Unrecorded => Fault::Unrecorded,
            Self::MonitorSilent => Fault::MonitorSilent {
                limit: MONITOR_TIMEOUT,
            },
        }
    }
}

/// A word: the state in the lowest byte, the reason in the next, then the count.
fn packed(state: ForceState, reason: StopReason, armings: u64) -> u64 {
    (armings << 16) | ((reason as u64) << 8) | state as u64
}

fn unpacked(word: u64) -> (ForceState, StopReason, u64) {
    // Nothing else is ever written.
    let state = STATES[(word & 0xff) as usize % STATES.len()];
    let reason = REASONS[(word >> 8 & 0xff) as usize % REASONS.len()];
    (state, reason, word >> 16)
}

impl Default for Supervisor {
    /// Off.
    fn default() -> Self {
        Self {
            word: Arc::new(AtomicU64::new(packed(
                ForceState::Off,
                StopReason::EmergencyStop,
                0,
            ))),
            reported: Arc::new(AtomicU64::new(f64::INFINITY.to_bits())),
            watched: Arc::new(AtomicU64::new(f64::INFINITY.to_bits())),
        }
    }
}

impl Supervisor {
    /// A supervisor whose session is already armed.
    pub fn armed() -> Self {
        let supervisor = Self::default();
        supervisor.arm();
        supervisor
    }

    /// The current state.
    pub fn state(&self) -> ForceState {
        unpacked(self.word.load(Ordering::Acquire)).0
    }

    /// A person wants forces, for the first time or again.
    pub fn arm(&self) {
        self.apply(Transition::Arm, None);
    }

    /// No force until [`resume`](Self::resume).
    pub fn pause(&self) {
        self.apply(Transition::Pause, None);
    }

    /// Ends a pause.
    pub fn resume(&self) {
        self.apply(Transition::Resume, None);
    }

    /// The emergency stop: no force until a person arms again.
    pub fn trip(&self) {
        self.trip_with_reason(StopReason::EmergencyStop);
    }

    /// The same for another `reason`.
    pub fn trip_with_reason(&self, reason: StopReason) {
        self.apply(Transition::Trip, Some(reason));
    }

    /// Ends the session.
    pub fn switch_off(&self) {
        self.apply(Transition::SwitchOff, None);
    }

    /// The program that shows the touch is alive at `time` [s] of the loops' clock. After the first call forces trip
    /// when the next one does not come within [`REPORT_TIMEOUT`].
    pub fn report(&self, time: f64) {
        self.reported.store(time.to_bits(), Ordering::Relaxed);
    }

    /// The thread that watches the loops is alive at `time` [s] of their clock; infinite when it ends with the session.
    pub(crate) fn report_monitor(&self, time: f64) {
        self.watched.store(time.to_bits(), Ordering::Relaxed);
    }

    /// The permission of a loop at `time` [s].
    pub(crate) fn permission(&self, time: f64) -> Permission {
        let since = |last: &AtomicU64| time - f64::from_bits(last.load(Ordering::Relaxed));
        if self.state().allows_force() {
            if since(&self.reported) > REPORT_TIMEOUT {
                self.trip_with_reason(StopReason::ProgramSilent);
            }
            if since(&self.watched) > MONITOR_TIMEOUT {
                self.trip_with_reason(StopReason::MonitorSilent);
            }
        }
        let (state, reason, armings) = unpacked(self.word.load(Ordering::Acquire));
        Permission {
            state,
            armings,
            fault: (state == ForceState::Tripped).then(|| reason.fault()),
        }
    }

    /// A loop raises its force.
    pub(crate) fn run(&self) {
        self.apply(Transition::Run, None);
    }

    /// A loop took its force off; all others do the same.
    pub(crate) fn trip_others(&self) {
        self.trip_with_reason(StopReason::OtherDevice);
    }

    fn apply(&self, transition: Transition, why: Option<StopReason>) {
        let next = |word| {
            let (state, reason, armings) = unpacked(word);
            let next = state.after(transition);
            // A loop that reads another count restarts, even if forces were off only between two of its ticks.
            let armed = next == ForceState::Armed
                && matches!(transition, Transition::Arm | Transition::Resume);
            let armed =
                u64::from(armed && (transition == Transition::Arm || state == ForceState::Paused));
            // The first reason is the one reported.
            let reason = match state {
                ForceState::Tripped => reason,
                _ => why.unwrap_or(reason),
            };
            Some(packed(next, reason, armings + armed))
        };
        // It always answers a word.
        let _ = self
            .word
            .fetch_update(Ordering::AcqRel, Ordering::Acquire, next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: the table above, typed once more.
    #[test]
    fn every_order_in_every_state_leads_where_the_table_says() {
        use ForceState::{Armed, Off, Paused, Running, Tripped};
        let table = [
            (Transition::Arm, [Armed, Armed, Running, Armed, Armed]),
            (Transition::Run, [Off, Running, Running, Paused, Tripped]),
            (Transition::Pause, [Off, Paused, Paused, Paused, Tripped]),
            (Transition::Resume, [Off, Armed, Running, Armed, Tripped]),
            (Transition::Trip, [Tripped; 5]),
            (Transition::SwitchOff, [Off; 5]),
        ];
        for (transition, expected) in table {
            for (state, expected) in STATES.into_iter().zip(expected) {
                assert_eq!(
                    state.after(transition),
                    expected,
                    "{transition:?} in {state:?}"
                );
            }
        }
    }

    #[test]
    fn a_word_holds_what_was_packed() {
        for state in STATES {
            for reason in REASONS {
                let word = packed(state, reason, 70_000);
                assert_eq!(unpacked(word), (state, reason, 70_000));
            }
        }
    }

    #[test]
    fn a_watch_that_is_silent_takes_the_force_off() {
        let supervisor = Supervisor::armed();
        supervisor.report_monitor(1.0);
        assert_eq!(supervisor.permission(1.0 + MONITOR_TIMEOUT).fault, None);
        let limit = MONITOR_TIMEOUT;
        let unwatched = supervisor.permission(1.1 + MONITOR_TIMEOUT).fault;
        assert_eq!(unwatched, Some(Fault::MonitorSilent { limit }));
        // A thread that ended in good order does not have to report.
        supervisor.report_monitor(f64::INFINITY);
        supervisor.arm();
        assert_eq!(supervisor.permission(1e9).fault, None);
    }

    #[test]
    fn the_first_cause_is_told_and_a_silent_program_is_one() {
        let supervisor = Supervisor::armed();
        assert_eq!(supervisor.permission(1e9).fault, None);
        supervisor.report(1.0);
        assert_eq!(supervisor.permission(1.0 + REPORT_TIMEOUT).fault, None);
        let silent = supervisor.permission(1.1 + REPORT_TIMEOUT);
        assert_eq!(
            silent.fault,
            Some(Fault::ProgramSilent {
                limit: REPORT_TIMEOUT
            })
        );
        supervisor.trip();
        assert_eq!(supervisor.permission(1.2 + REPORT_TIMEOUT), silent);
        supervisor.report(5.0);
        supervisor.arm();
        let armed = supervisor.permission(5.0);
        assert_eq!((armed.state, armed.fault), (ForceState::Armed, None));
        assert!(armed.armings > silent.armings);
    }
}
