//! Messages from and to the service.
//!
//! Unknown keys are ignored, since every version adds some. A message is invalid if a state lacks a required value (its
//! position, as three finite numbers); nothing of an invalid message is used.

use std::borrow::Cow;
use std::fmt::Write as _;

use nalgebra::UnitQuaternion;
use palpate_servo::{Fault, Vec3};
use serde::Deserialize;

use super::frame::{from_device_axes, position_from_device, rotation_from_device, to_device_axes};

/// The JSON form of forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Generation {
    /// `values`, versions 3.0 and 3.1.
    Values,
    /// `vector`, from version 3.5 on.
    Vector,
}

impl Generation {
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Values => "values",
            Self::Vector => "vector",
        }
    }
}

#[derive(Deserialize)]
struct Frame<'a> {
    #[serde(borrow, default)]
    inverse3: Vec<Robot<'a>>,
    #[serde(borrow, default)]
    verse_grip: Vec<Grip<'a>>,
    #[serde(borrow, default)]
    wireless_verse_grip: Vec<Grip<'a>>,
    #[serde(borrow, default)]
    custom_verse_grip: Vec<Grip<'a>>,
}

#[derive(Deserialize)]
struct Robot<'a> {
    #[serde(borrow)]
    device_id: Cow<'a, str>,
    #[serde(borrow)]
    config: Option<Config<'a>>,
    state: Option<RobotState>,
    #[serde(default)]
    status: Status,
}

#[derive(Deserialize)]
struct Config<'a> {
    #[serde(borrow, rename = "type")]
    kind: Option<Cow<'a, str>>,
    #[serde(borrow)]
    handedness: Option<Cow<'a, str>>,
    basis: Option<serde::de::IgnoredAny>,
    filters: Option<serde::de::IgnoredAny>,
}

#[derive(Deserialize, Clone, Copy)]
struct Triple {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Deserialize, Clone, Copy)]
struct Turn {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Deserialize)]
struct RobotState {
    cursor_position: Option<Triple>,
    current_cursor_force: Option<Triple>,
}

#[derive(Deserialize, Clone, Copy, Default)]
struct Status {
    calibrated: Option<bool>,
    ready: Option<bool>,
    power_supply: Option<bool>,
}

#[derive(Deserialize)]
struct Grip<'a> {
    #[serde(borrow)]
    device_id: Cow<'a, str>,
    state: Option<GripState>,
    #[serde(default)]
    status: GripStatus,
}

#[derive(Deserialize)]
struct GripState {
    orientation: Option<Turn>,
    button: Option<bool>,
    buttons: Option<Buttons>,
}

#[derive(Deserialize, Clone, Copy, Default)]
#[serde(default)]
struct Buttons {
    a: bool,
    b: bool,
    c: bool,
}

#[derive(Deserialize, Clone, Copy, Default)]
struct GripStatus {
    connected: Option<bool>,
}

/// A device of a first message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listed {
    /// Its name among the service's.
    pub id: String,
    /// Its type, such as `inverse3`.
    pub kind: String,
    /// `left` or `right`, where it is set.
    pub handedness: Option<String>,
}

/// The first message: all devices of the service.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ServiceInventory {
    /// Devices with forces.
    pub robots: Vec<Listed>,
    /// Grips, wireless ones first.
    pub grips: Vec<String>,
    /// For each grip, a bit mask of its buttons but the first.
    pub other_buttons: Vec<u32>,
    /// The form in which to write forces.
    pub generation: Generation,
}

impl ServiceInventory {
    /// Reads a first message.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let frame = parse(text)?;
        let is_new = |config: &Config<'_>| config.basis.is_some() || config.filters.is_some();
        let configs = frame
            .inverse3
            .iter()
            .filter_map(|robot| robot.config.as_ref());
        let generation = match configs.map(is_new).next() {
            Some(true) => Generation::Vector,
            _ => Generation::Values,
        };
        let listed = |robot: &Robot<'_>| {
            let config = robot.config.as_ref();
            let kind = config.and_then(|config| config.kind.as_deref());
            let handedness = config.and_then(|config| config.handedness.as_deref());
            Listed {
                id: robot.device_id.clone().into_owned(),
                kind: kind.unwrap_or("inverse3").to_owned(),
                handedness: handedness.map(str::to_owned),
            }
        };
        Ok(Self {
            robots: frame.inverse3.iter().map(listed).collect(),
            grips: frame
                .grips()
                .map(|grip| grip.device_id.clone().into_owned())
                .collect(),
            other_buttons: frame.grips().map(Grip::other_buttons).collect(),
            generation,
        })
    }
}

/// A state of one device and its grip, in our axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Position of the handle [m].
    pub position: Vec3,
    /// The force that it displays [N].
    pub displayed: Option<Vec3>,
    /// Whether it is calibrated; none if the message does not say.
    pub calibrated: Option<bool>,
    /// Whether it is ready.
    pub ready: Option<bool>,
    /// Whether it has power.
    pub powered: Option<bool>,
    /// Orientation of the grip.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// Its buttons, bit by bit: a (or the only one), b, c.
    pub buttons: u32,
}

impl State {
    /// Reads the state of the device `id` and of the grip `grip` from `text`.
    ///
    /// # Errors
    /// [`Fault::BadMessage`] when it is no message of the service, [`Fault::Vanished`] when the device is not in it.
    pub fn parse(text: &str, id: &str, grip: Option<&str>) -> Result<Self, Fault> {
        let frame = parse(text)?;
        let robot = frame.inverse3.iter().find(|robot| robot.device_id == id);
        let robot = robot.ok_or(Fault::Vanished)?;
        let state = robot.state.as_ref().ok_or(Fault::BadMessage {
            what: "a device without a state",
        })?;
        let place = state.cursor_position.ok_or(Fault::BadMessage {
            what: "a state without a position",
        })?;
        let held = grip.and_then(|name| frame.grips().find(|grip| grip.device_id == name));
        let held = held.filter(|grip| grip.status.connected != Some(false));
        let held = held.and_then(|grip| grip.state.as_ref());
        let orientation = held.and_then(|state| state.orientation);
        Ok(Self {
            position: position_from_device(&place.vector()),
            displayed: state
                .current_cursor_force
                .map(|force| from_device_axes(&force.vector())),
            calibrated: robot.status.calibrated,
            ready: robot.status.ready,
            powered: robot.status.power_supply,
            orientation: orientation
                .and_then(|turn| rotation_from_device([turn.w, turn.x, turn.y, turn.z])),
            buttons: held.map_or(0, GripState::pressed),
        })
    }
}

/// Writes the command to `message` that the device `id`, quoted as in JSON, displays `force` [N], given in our axes; to
/// a millionth of a newton.
pub fn force_command(message: &mut String, quoted_id: &str, generation: Generation, force: &Vec3) {
    let force = to_device_axes(force);
    message.clear();
    // Writing to a string cannot fail.
    let _ = write!(
        message,
        "{{\"inverse3\":[{{\"device_id\":{quoted_id},\"commands\":{{\"set_cursor_force\":{{\"{}\":\
         {{\"x\":{:.6},\"y\":{:.6},\"z\":{:.6}}}}}}}}}]}}",
        generation.key(),
        force.x,
        force.y,
        force.z
    );
}

fn parse(text: &str) -> Result<Frame<'_>, Fault> {
    serde_json::from_str(text).map_err(|_| Fault::BadMessage {
        what: "a message that is not as its documents have it",
    })
}

impl<'a> Frame<'a> {
    fn grips(&self) -> impl Iterator<Item = &Grip<'a>> {
        let wired = self.verse_grip.iter().chain(&self.custom_verse_grip);
        self.wireless_verse_grip.iter().chain(wired)
    }
}

impl Triple {
    fn vector(self) -> Vec3 {
        Vec3::new(self.x, self.y, self.z)
    }
}

impl Grip<'_> {
    fn other_buttons(&self) -> u32 {
        let buttons = self.state.as_ref().and_then(|state| state.buttons);
        if buttons.is_some() { 0b110 } else { 0 }
    }
}

impl GripState {
    fn pressed(&self) -> u32 {
        let buttons = self.buttons.unwrap_or_default();
        let first = buttons.a || self.button.unwrap_or(false);
        u32::from(first) | u32::from(buttons.b) << 1 | u32::from(buttons.c) << 2
    }
}
