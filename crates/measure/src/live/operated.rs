use palpate_servo::{Fault, Vec3, log};

use super::console::{StampedCommand, Switches};
use super::{Console, RigCommand};
use crate::{Ended, Error, Rig, RigSample};

/// What a rig says.
#[derive(Debug, Clone, PartialEq)]
pub enum RigEvent {
    /// What is seen, at every tick.
    Sample(RigSample),
    /// It begins a command.
    Begun(RigCommand),
    /// It has ended a command.
    Ended(RigCommand, Result<Ended, Error>),
    /// It dropped a command from before a stop.
    Dropped(RigCommand),
    /// Something happened while it waited.
    Disturbed(Error),
    /// Forces are off.
    Faulted(Fault),
    /// Forces are on again.
    Armed,
}

/// A rig that carries out commands.
pub struct Operated {
    rig: Rig,
    commands: log::Reader<StampedCommand>,
    /// A command that was read while another was carried out.
    next: Option<StampedCommand>,
    told: log::Writer<RigEvent>,
    switches: Switches,
    fault: Option<Fault>,
    limp: bool,
}

/// What may be told before somebody reads it: half a minute.
const TOLD: usize = 1 << 15;

/// How long it drives on without being told so again [s].
const DRIVEN: f64 = 0.16;

impl Operated {
    /// `rig`, from where it is operated, and what it says.
    pub fn new(rig: Rig) -> (Self, Console, log::Reader<RigEvent>) {
        let (console, commands, switches) = Console::new(rig.supervisor(), rig.is_real());
        let (told, reader) = log::ring(TOLD);
        let operated = Self {
            rig,
            commands,
            next: None,
            told,
            switches,
            fault: None,
            limp: false,
        };
        (operated, console, reader)
    }

    /// The rig.
    pub fn rig(&mut self) -> &mut Rig {
        &mut self.rig
    }

    /// Carries out the next command, or waits for a tick; false when that was the last. `watch` hears every sample
    /// before anybody else.
    pub fn turn(&mut self, watch: &mut dyn FnMut(&RigSample)) -> bool {
        if self.switches.is_ending() {
            // One on a device that is there has no force any more, which moves nothing.
            if !self.limp && !self.rig.is_real() {
                // Nobody is there any more who could be told that this failed.
                let _ = self.rig.withdraw(&mut |_| true);
            }
            return false;
        }
        if self.limp {
            self.rest_limp(watch);
        } else if let Some(given) = self.next_order() {
            self.carry_out(given, watch);
        } else {
            self.wait(watch);
        }
        true
    }

    fn next_order(&mut self) -> Option<StampedCommand> {
        loop {
            let given = self.next.take().or_else(|| self.commands.next_value())?;
            if given.stops == self.switches.stops() {
                return Some(given);
            }
            self.told.add(RigEvent::Dropped(given.command));
        }
    }

    fn carry_out(&mut self, given: StampedCommand, watch: &mut dyn FnMut(&RigSample)) {
        let command = given.command;
        self.told.add(RigEvent::Begun(command));
        let Self {
            rig,
            told,
            switches,
            commands,
            next,
            ..
        } = self;
        let mut heard = |sample: &RigSample| {
            told.add(RigEvent::Sample(*sample));
            watch(sample);
            switches.stops() == given.stops && !switches.is_ending()
        };
        let ended = match command {
            RigCommand::Jog(way) => rig.jog(&way, &mut heard),
            RigCommand::GoTo(place) => rig.go_to(&place, &mut heard),
            RigCommand::Face(normal) => rig.face(&normal).map(|()| Ended::Whole),
            RigCommand::MeasureNormal => rig.measure_normal(&mut heard),
            RigCommand::Drive(direction) => {
                let mut told_at = None;
                rig.drive(&mut |sample| {
                    let goes_on = heard(sample);
                    let mut since = *told_at.get_or_insert(sample.time);
                    if next.is_none()
                        && let Some(more) = commands.next_value()
                    {
                        match more.command == command && more.stops == given.stops {
                            true => since = sample.time,
                            false => *next = Some(more),
                        }
                    }
                    told_at = Some(since);
                    let held = goes_on && next.is_none() && sample.time < since + DRIVEN;
                    match held {
                        true => direction,
                        false => Vec3::zeros(),
                    }
                })
            }
            RigCommand::Approach => rig.approach(&mut heard),
            RigCommand::Press(trajectory, number) => {
                let mut is_enough = false;
                let ended = rig.press_and_tell(&trajectory, &mut |sample| {
                    let goes_on = heard(sample);
                    is_enough = goes_on && switches.is_enough(number);
                    goes_on && !is_enough
                });
                ended.map(|ended| match ended {
                    Ended::Stopped if is_enough => Ended::Enough,
                    ended => ended,
                })
            }
            RigCommand::Withdraw => rig.withdraw(&mut heard),
            RigCommand::Rest => rig.recover(&mut heard),
        };
        let failed = ended.is_err();
        self.told.add(RigEvent::Ended(command, ended));
        if failed {
            self.fail();
        }
    }

    fn wait(&mut self, watch: &mut dyn FnMut(&RigSample)) {
        let Self { rig, told, .. } = self;
        let waited = rig.wait_one_tick(&mut |sample| {
            told.add(RigEvent::Sample(*sample));
            watch(sample);
            true
        });
        if let Err(error) = waited {
            self.told.add(RigEvent::Disturbed(error));
            self.fail();
        }
    }

    /// What waits was planned for a rig that did not fail.
    fn fail(&mut self) {
        self.switches.stop();
        self.notice_fault();
        self.limp = self.fault.is_some();
    }

    fn notice_fault(&mut self) {
        let fault = self.rig.fault();
        if let Some(fault) = fault.filter(|_| fault != self.fault) {
            // Whoever asked to arm did not know of this one.
            self.switches.take_arming();
            self.told.add(RigEvent::Faulted(fault));
        }
        self.fault = fault;
    }

    fn rest_limp(&mut self, watch: &mut dyn FnMut(&RigSample)) {
        if self.switches.take_arming() {
            self.rig.arm();
        }
        let Self { rig, told, .. } = self;
        let live = rig.limp(&mut |sample| {
            told.add(RigEvent::Sample(*sample));
            watch(sample);
            true
        });
        if live == Ok(true) {
            self.limp = false;
            self.told.add(RigEvent::Armed);
        }
        self.notice_fault();
        while let Some(given) = self.commands.next_value() {
            self.told.add(RigEvent::Dropped(given.command));
        }
    }
}
