use std::time::{Duration, Instant};

use palpate_servo::{Capabilities, Command, DeadMan, Device, DeviceState, Disabled, Fault, Vec3};

use super::channel::Channel;
use super::message::{Generation, Listed, ServiceInventory, State, force_command};
use super::{Event, HaplyAddress};
use crate::OpenError;
use crate::found::{Found, Origin};
use crate::places::TIMEOUT;

/// Timeout for the first message of the service.
const FIRST_WITHIN: Duration = Duration::from_secs(1);

/// Unrequested messages that are accepted at a tick.
const UNASKED: usize = 8;

/// Messages with zero force until a device has to display zero.
const ZEROS: u32 = 3;

/// A force that the device has to display [N], and the ticks until it does.
const SHOWS: f64 = 0.1;
const SHOWS_WITHIN: u32 = 20;

/// The largest force [N], and the largest continuous force [N]: our assumptions, since the documents state none.
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
    /// A bit mask of its grip's buttons but the first.
    other_buttons: u32,
    /// Answers that are still due.
    pending_answers: u32,
    status: Status,
    /// Ticks in which a force was sent and none was displayed.
    undisplayed: u32,
    /// Why it cannot be used any more.
    broken: Option<Fault>,
}

/// The last reported status of the device, where it reported one.
#[derive(Debug, Clone, Copy, Default)]
struct Status {
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
    let (mut channel, snapshot) = connect(address)?;
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
            forces: Origin::Assumed,
        }
    });
    Ok(found.collect())
}

fn connect(address: &HaplyAddress) -> Result<(Channel, ServiceInventory), OpenError> {
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
        let (channel, snapshot) = connect(address)?;
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
            pending_answers: 0,
            status: Status::default(),
            undisplayed: 0,
            broken: None,
        })
    }

    /// The same with another timeout for an answer.
    #[must_use]
    pub fn with_timeout(mut self, timeout: Duration) -> Self {
        self.timeout = timeout;
        self
    }

    /// The same with a dead-man's switch: one of the buttons of its grip but the first. That button is then no stop
    /// button.
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

    /// Whether the service sends events.
    pub fn receives_events(&self) -> bool {
        self.events.is_some()
    }

    /// The form of forces in messages.
    pub fn generation(&self) -> Generation {
        self.generation
    }

    fn send(&mut self, force: &Vec3) -> Result<(), Fault> {
        force_command(&mut self.message, &self.quoted_id, self.generation, force);
        self.channel.send(&self.message)?;
        self.pending_answers += 1;
        Ok(())
    }

    /// The newest state.
    fn receive(&mut self) -> Result<State, Fault> {
        let until = Instant::now() + self.timeout;
        let mut newest = None;
        while self.pending_answers > 0 {
            newest = Some(self.channel.receive(until)?);
            self.pending_answers -= 1;
        }
        // An answer to an unrequested message would be late from then on.
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
        let reported = self.status.update(&state);
        let undisplayed = self.is_undisplayed(&force, &state);
        let event_fault = self.event_fault();
        let first = state.buttons & 1 != 0;
        Ok(DeviceState {
            orientation: state.orientation,
            grip: if first { 1.0 } else { 0.0 },
            buttons: state.buttons,
            ready: self.status.is_ready(),
            displayed: state.displayed,
            fault: reported.or(event_fault).or(undisplayed),
            ..DeviceState::at(command.time, state.position)
        })
    }

    /// A fault if the device displays no force for a while although one is sent.
    fn is_undisplayed(&mut self, sent: &Vec3, state: &State) -> Option<Fault> {
        let displayed = state.displayed?;
        let is_shown = sent.norm() < SHOWS || displayed.norm() > 0.0;
        self.undisplayed = if is_shown { 0 } else { self.undisplayed + 1 };
        if self.undisplayed < SHOWS_WITHIN {
            return None;
        }
        self.undisplayed = 0;
        Some(Fault::Ignored)
    }

    /// The fault that the events report, if any.
    fn event_fault(&mut self) -> Option<Fault> {
        let mut fault = None;
        for _ in 0..UNASKED {
            let events = self.events.as_mut()?;
            match events.receive_waiting() {
                Ok(None) => break,
                Ok(Some(text)) => {
                    let reported_fault = Event::parse(&text).map(|event| event.fault(&self.id));
                    fault = fault.or(reported_fault.unwrap_or_else(Some));
                }
                // Without events its safety faults would go unnoticed.
                Err(lost) => {
                    self.events = None;
                    fault = fault.or(Some(lost));
                }
            }
        }
        fault
    }
}

impl Status {
    /// Takes over `state`; returns the fault of a device that was ready and no longer is.
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

    /// A status that was never reported counts as not given, except for power.
    fn is_ready(&self) -> bool {
        self.calibrated == Some(true) && self.ready == Some(true) && self.powered != Some(false)
    }
}

impl Device for HaplyDevice {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// A service has nothing to enable: it displays the force that it receives.
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

    /// Sends zero until the service reports zero force. According to its documents, a service that receives nothing any
    /// more takes its force off by itself.
    fn disable(&mut self) -> Disabled {
        for _ in 0..ZEROS {
            if self.broken == Some(Fault::Disconnected) {
                return Disabled::Unknown;
            }
            if self.send(&Vec3::zeros()).is_err() {
                self.broken = self.broken.or(Some(Fault::Disconnected));
                return Disabled::Unknown;
            }
            // No second wait for a service that is silent.
            let waits = self.broken != Some(Fault::Silent);
            let Some(Ok(state)) = waits.then(|| self.receive()) else {
                return Disabled::Unknown;
            };
            self.status.update(&state);
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
