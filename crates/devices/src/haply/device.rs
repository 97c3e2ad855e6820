use std::time::{Duration, Instant};

use palpate_servo::{Capabilities, Command, DeadMan, Device, DeviceState, Disabled, Fault, Vec3};

use super::channel::Channel;
use super::message::{Generation, Listed, ServiceInventory, State, force_command};
use super::{Event, HaplyAddress};
use crate::OpenError;
use crate::found::{Found, Origin};
use crate::places::TIMEOUT;

/// How long the service may take for its first message.
const FIRST_WITHIN: Duration = Duration::from_secs(1);

/// Messages that nobody asked for and that are taken at a tick.
const UNASKED: usize = 8;

/// Messages with zero until one has to show.
const ZEROS: u32 = 3;

/// A force that has to show [N], and ticks until it does.
const SHOWS: f64 = 0.1;
const SHOWS_WITHIN: u32 = 20;

/// The largest force [N], and the largest for as long as one likes: ours, for the documents do not say.
const PEAK: f64 = 3.0;
const CONTINUOUS: f64 = 1.5;

/// A device of the Inverse Service.
pub struct HaplyDevice {
    capabilities: Capabilities,
    channel: Channel,
    events: Option<Channel>,
    id: String,
    quoted_id: String,
    grip: Option<String>,
    generation: Generation,
    message: String,
    timeout: Duration,
    /// The buttons of its grip but the first.
    other_buttons: u32,
    /// Answers that are still to come.
    owed: u32,
    known: Known,
    /// Ticks in which a force was sent and none was displayed.
    hidden: u32,
    /// Why it cannot be used any more.
    broken: Option<Fault>,
}

/// What the device last said of itself, where it did.
#[derive(Debug, Clone, Copy, Default)]
struct Known {
    calibrated: Option<bool>,
    ready: Option<bool>,
    powered: Option<bool>,
    was_ready: bool,
}

/// The devices of the service at `address`.
///
/// # Errors
/// When there is no service.
pub fn list(address: &HaplyAddress) -> Result<Vec<Found>, OpenError> {
    let (mut channel, snapshot) = meet(address)?;
    channel.close();
    let robots = snapshot.robots.iter().enumerate();
    let found = robots.map(|(number, robot)| {
        let mut remarks = vec![format!("forces are `{}`", snapshot.generation.key())];
        remarks.extend(
            robot
                .handedness
                .iter()
                .map(|hand| format!("set for the {hand} hand")),
        );
        remarks.push(match snapshot.grips.get(number) {
            Some(grip) => format!("with the grip {grip}"),
            None => "without a grip".to_owned(),
        });
        Found {
            number,
            model: robot.kind.clone(),
            serial: robot.id.clone(),
            remarks,
            capabilities: capabilities(robot),
            forces: Origin::Ours,
        }
    });
    Ok(found.collect())
}

fn meet(address: &HaplyAddress) -> Result<(Channel, ServiceInventory), OpenError> {
    let mut channel = Channel::open(&address.host, address.port)?;
    let first = channel.receive(Instant::now() + FIRST_WITHIN);
    let snapshot = first.and_then(|text| ServiceInventory::parse(&text));
    let snapshot = snapshot.map_err(|fault| OpenError::NotTheService {
        address: address.to_string(),
        what: match fault {
            Fault::BadMessage { what } => format!("it sends {what}"),
            Fault::Silent => "it sends nothing".to_owned(),
            _ => "it closes the connection".to_owned(),
        },
    })?;
    Ok((channel, snapshot))
}

fn capabilities(robot: &Listed) -> Capabilities {
    Capabilities {
        peak_force: PEAK,
        continuous_force: CONTINUOUS,
        displays_force: true,
        ..Capabilities::without_force(&format!("Haply {} {}", robot.kind, robot.id))
    }
}

impl HaplyDevice {
    /// Opens device `number`, from zero on, of the service at `address`, with the grip of that number.
    ///
    /// # Errors
    /// When there is no service, or no such device.
    pub fn open(address: &HaplyAddress, number: usize) -> Result<Self, OpenError> {
        let (channel, snapshot) = meet(address)?;
        let robot = snapshot.robots.get(number).ok_or(OpenError::NoDevice {
            address: address.to_string(),
            there: snapshot.robots.len(),
            wanted: number + 1,
        })?;
        let other_buttons = snapshot.other_buttons.get(number).copied().unwrap_or(0);
        Ok(Self {
            capabilities: Capabilities {
                stop_buttons: other_buttons,
                ..capabilities(robot)
            },
            channel,
            // Services before 3.5 have none.
            events: Channel::open(&address.host, address.events_port).ok(),
            quoted_id: serde_json::Value::from(robot.id.as_str()).to_string(),
            id: robot.id.clone(),
            grip: snapshot.grips.get(number).cloned(),
            generation: snapshot.generation,
            message: String::with_capacity(256),
            timeout: TIMEOUT,
            other_buttons,
            owed: 0,
            known: Known::default(),
            hidden: 0,
            broken: None,
        })
    }

    /// The same with another time that an answer may take.
    #[must_use]
    pub fn with_timeout(mut self, timeout: Duration) -> Self {
        self.timeout = timeout;
        self
    }

    /// The same with a dead-man's switch: one of the buttons of its grip but the first, which then is no stop button.
    ///
    /// # Errors
    /// When it has no grip with such a button.
    pub fn with_dead_man(mut self) -> Result<Self, OpenError> {
        if self.other_buttons == 0 {
            return Err(OpenError::NoDeadMan {
                device: self.capabilities.name.clone(),
            });
        }
        self.capabilities.dead_man = Some(DeadMan::Buttons(self.other_buttons));
        self.capabilities.stop_buttons = 0;
        Ok(self)
    }

    /// Whether the service tells events.
    pub fn hears_events(&self) -> bool {
        self.events.is_some()
    }

    /// How forces are written.
    pub fn generation(&self) -> Generation {
        self.generation
    }

    fn send(&mut self, force: &Vec3) -> Result<(), Fault> {
        force_command(&mut self.message, &self.quoted_id, self.generation, force);
        self.channel.send(&self.message)?;
        self.owed += 1;
        Ok(())
    }

    /// The newest state.
    fn receive(&mut self) -> Result<State, Fault> {
        let until = Instant::now() + self.timeout;
        let mut newest = None;
        while self.owed > 0 {
            newest = Some(self.channel.receive(until)?);
            self.owed -= 1;
        }
        // What nobody asked for would be answered late from then on.
        let mut unasked = 0;
        while let Some(text) = self.channel.receive_waiting()? {
            newest = Some(text);
            unasked += 1;
            if unasked > UNASKED {
                return Err(Fault::BadMessage {
                    what: "more than it was asked for",
                });
            }
        }
        let text = newest.ok_or(Fault::Silent)?;
        State::parse(&text, &self.id, self.grip.as_deref())
    }

    fn try_exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        let force = command.force();
        self.send(&force)?;
        let state = self.receive()?;
        let reported = self.known.update(&state);
        let hidden = self.is_hidden(&force, &state);
        let told = self.told();
        let first = state.buttons & 1 != 0;
        Ok(DeviceState {
            orientation: state.orientation,
            grip: if first { 1.0 } else { 0.0 },
            buttons: state.buttons,
            ready: self.known.is_ready(),
            displayed: state.displayed,
            fault: reported.or(told).or(hidden),
            ..DeviceState::at(command.time, state.position)
        })
    }

    /// A fault once a force was sent and not displayed for a while.
    fn is_hidden(&mut self, sent: &Vec3, state: &State) -> Option<Fault> {
        let displayed = state.displayed?;
        let is_shown = sent.norm() < SHOWS || displayed.norm() > 0.0;
        self.hidden = if is_shown { 0 } else { self.hidden + 1 };
        if self.hidden < SHOWS_WITHIN {
            return None;
        }
        self.hidden = 0;
        Some(Fault::Ignored)
    }

    /// What the events say.
    fn told(&mut self) -> Option<Fault> {
        let mut fault = None;
        for _ in 0..UNASKED {
            let events = self.events.as_mut()?;
            match events.receive_waiting() {
                Ok(None) => break,
                Ok(Some(text)) => {
                    let said = Event::parse(&text).map(|event| event.fault(&self.id));
                    fault = fault.or(said.unwrap_or_else(Some));
                }
                // Without it its safeties would not be heard of.
                Err(lost) => {
                    self.events = None;
                    fault = fault.or(Some(lost));
                }
            }
        }
        fault
    }
}

impl Known {
    /// Takes over what `state` says; the fault of a device that was ready and is not any more.
    fn update(&mut self, state: &State) -> Option<Fault> {
        self.calibrated = state.calibrated.or(self.calibrated);
        self.ready = state.ready.or(self.ready);
        self.powered = state.powered.or(self.powered);
        if self.is_ready() {
            self.was_ready = true;
            return None;
        }
        if !std::mem::take(&mut self.was_ready) {
            return None;
        }
        Some(match (self.powered, self.calibrated) {
            (Some(false), _) => Fault::Unpowered,
            (_, Some(false)) => Fault::Uncalibrated,
            _ => Fault::Safety {
                what: "it is not ready any more",
            },
        })
    }

    /// What it never said is not taken for granted, but for its power.
    fn is_ready(&self) -> bool {
        self.calibrated == Some(true) && self.ready == Some(true) && self.powered != Some(false)
    }
}

impl Device for HaplyDevice {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// A service has nothing to enable: it displays what it is sent.
    fn enable(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if let Some(fault) = self.broken {
            return Err(fault);
        }
        self.try_exchange(command).inspect_err(|fault| {
            self.broken = Some(*fault);
        })
    }

    /// Sends zero until the service says that it displays it. One that hears nothing any more takes its force off by
    /// itself, as its documents say.
    fn disable(&mut self) -> Disabled {
        for _ in 0..ZEROS {
            if self.broken == Some(Fault::Disconnected) {
                return Disabled::Unknown;
            }
            if self.send(&Vec3::zeros()).is_err() {
                self.broken = self.broken.or(Some(Fault::Disconnected));
                return Disabled::Unknown;
            }
            // One that is silent is not waited for once more.
            let waits = self.broken != Some(Fault::Silent);
            let Some(Ok(state)) = waits.then(|| self.receive()) else {
                return Disabled::Unknown;
            };
            self.known.update(&state);
            if state.displayed == Some(Vec3::zeros()) {
                return Disabled::NoForce;
            }
        }
        Disabled::Unknown
    }
}

impl Drop for HaplyDevice {
    fn drop(&mut self) {
        self.disable();
        self.channel.close();
        if let Some(events) = &mut self.events {
            events.close();
        }
    }
}
