use palpate_servo::{Fault, Vec3, log};

use super::console::{StampedCommand, Switches};
use super::{Console, RigCommand};
use crate::{Ended, Error, Rig, RigSample};

/// An event of a rig.
#[derive(Debug, Clone, PartialEq)]
pub enum RigEvent {
    /// The sample of a tick.
    Sample(RigSample),
    /// The rig begins a command.
    Begun(RigCommand),
    /// The rig has ended a command.
    Ended(RigCommand, Result<Ended, Error>),
    /// The rig dropped a command from before a stop.
    Dropped(RigCommand),
    /// The rig failed while it waited.
    Failed(Error),
    /// Forces are off.
    Faulted(Fault),
    /// Forces are on again.
    Armed,
}

/// A rig that carries out commands.
pub struct CommandedRig {
    rig: Rig,
    commands: log::Reader<StampedCommand>,
    /// A command that was read while another was carried out.
    next: Option<StampedCommand>,
    events: log::Writer<RigEvent>,
    switches: Switches,
    fault: Option<Fault>,
    is_force_off: bool,
}

/// Capacity of the event ring: half a minute.
const EVENTS: usize = 1 << 15;

/// Time after which a drive stops unless its command is repeated [s].
const DRIVE_TIMEOUT: f64 = 0.16;

impl CommandedRig {
    /// `rig` as an operated rig, its console and the reader of its events.
    pub fn new(rig: Rig) -> (Self, Console, log::Reader<RigEvent>) {
        let (console, commands, switches) = Console::new(rig.supervisor(), rig.is_real());
        let (events, reader) = log::ring(EVENTS);
        let operated = Self {
            rig,
            commands,
            next: None,
            events,
            switches,
            fault: None,
            is_force_off: false,
        };
        (operated, console, reader)
    }

    /// The rig.
    pub fn rig(&mut self) -> &mut Rig {
        &mut self.rig
    }

    /// Carries out the next command, or waits for a tick; false when that was the last. `watch` receives every sample
    /// first.
    pub fn process_next(&mut self, watch: &mut dyn FnMut(&RigSample)) -> bool {
        if self.switches.is_ending() {
            // A real device has no force any more and cannot move the indenter.
            if !self.is_force_off && !self.rig.is_real() {
                // Nobody reads a failure any more.
                let _ = self.rig.withdraw(&mut |_| true);
            }
            return false;
        }
        if self.is_force_off {
            self.wait_without_force(watch);
        } else if let Some(given) = self.next_command() {
            self.carry_out(given, watch);
        } else {
            self.wait(watch);
        }
        true
    }

    fn next_command(&mut self) -> Option<StampedCommand> {
        loop {
            let given = self.next.take().or_else(|| self.commands.next_value())?;
            if given.stops == self.switches.stops() {
                return Some(given);
            }
            self.events.add(RigEvent::Dropped(given.command));
        }
    }

    fn carry_out(&mut self, given: StampedCommand, watch: &mut dyn FnMut(&RigSample)) {
        let command = given.command;
        self.events.add(RigEvent::Begun(command));
        let Self {
            rig,
            events,
            switches,
            commands,
            next,
            ..
        } = self;
        let mut on_sample = |sample: &RigSample| {
            events.add(RigEvent::Sample(*sample));
            watch(sample);
            switches.stops() == given.stops && !switches.is_ending()
        };
        let ended = match command {
            RigCommand::Jog(way) => rig.jog(&way, &mut on_sample),
            RigCommand::GoTo(place) => rig.go_to(&place, &mut on_sample),
            RigCommand::Face(normal) => rig.face(&normal).map(|()| Ended::Complete),
            RigCommand::MeasureNormal => rig.measure_normal(&mut on_sample),
            RigCommand::Drive(direction) => {
                let mut repeated_at = None;
                rig.drive(&mut |sample| {
                    let goes_on = on_sample(sample);
                    let mut since = *repeated_at.get_or_insert(sample.time);
                    if next.is_none()
                        && let Some(more) = commands.next_value()
                    {
                        match more.command == command && more.stops == given.stops {
                            true => since = sample.time,
                            false => *next = Some(more),
                        }
                    }
                    repeated_at = Some(since);
                    let continues =
                        goes_on && next.is_none() && sample.time < since + DRIVE_TIMEOUT;
                    match continues {
                        true => direction,
                        false => Vec3::zeros(),
                    }
                })
            }
            RigCommand::Approach => rig.approach(&mut on_sample),
            RigCommand::Press(trajectory, number) => {
                let mut is_enough = false;
                let ended = rig.press_with_listener(&trajectory, &mut |sample| {
                    let goes_on = on_sample(sample);
                    is_enough = goes_on && switches.is_enough(number);
                    goes_on && !is_enough
                });
                ended.map(|ended| match ended {
                    Ended::Stopped if is_enough => Ended::Enough,
                    ended => ended,
                })
            }
            RigCommand::Withdraw => rig.withdraw(&mut on_sample),
            RigCommand::Rest => rig.recover(&mut on_sample),
        };
        let failed = ended.is_err();
        self.events.add(RigEvent::Ended(command, ended));
        if failed {
            self.fail();
        }
    }

    fn wait(&mut self, watch: &mut dyn FnMut(&RigSample)) {
        let Self { rig, events, .. } = self;
        let waited = rig.wait_one_tick(&mut |sample| {
            events.add(RigEvent::Sample(*sample));
            watch(sample);
            true
        });
        if let Err(error) = waited {
            self.events.add(RigEvent::Failed(error));
            self.fail();
        }
    }

    /// Stops, which drops the queued commands: they were planned for a rig that did not fail.
    fn fail(&mut self) {
        self.switches.stop();
        self.notice_fault();
        self.is_force_off = self.fault.is_some();
    }

    fn notice_fault(&mut self) {
        let fault = self.rig.fault();
        if let Some(fault) = fault.filter(|_| fault != self.fault) {
            // The operator asked to arm before this fault.
            self.switches.take_arming();
            self.events.add(RigEvent::Faulted(fault));
        }
        self.fault = fault;
    }

    fn wait_without_force(&mut self, watch: &mut dyn FnMut(&RigSample)) {
        if self.switches.take_arming() {
            self.rig.arm();
        }
        let Self { rig, events, .. } = self;
        let live = rig.tick_without_force(&mut |sample| {
            events.add(RigEvent::Sample(*sample));
            watch(sample);
            true
        });
        if live == Ok(true) {
            self.is_force_off = false;
            self.events.add(RigEvent::Armed);
        }
        self.notice_fault();
        while let Some(given) = self.commands.next_value() {
            self.events.add(RigEvent::Dropped(given.command));
        }
    }
}
