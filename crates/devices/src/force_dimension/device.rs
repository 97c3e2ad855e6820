use std::path::Path;
use std::time::Duration;

use nalgebra::UnitQuaternion;
use palpate_servo::{Command, Device, DeviceSpec, DeviceState, Fault, Vec3};

use super::calls::{Calls, Said};
use super::functions::{Functions, Opened, Status};
use crate::rotation::rotation;
use crate::{Found, Kind, OpenError, Origin};

/// The largest force [N], and the largest for as long as one likes: below what any of them can; the library does not
/// say.
const PEAK: f64 = 8.0;
const CONTINUOUS: f64 = 4.0;

/// A device of Force Dimension.
pub struct ForceDimensionDevice {
    spec: DeviceSpec,
    calls: Calls,
    was_ready: bool,
    broken: Option<Fault>,
}

/// The devices of the library, `named` or where it usually is.
///
/// # Errors
/// When there is no library.
pub fn list(named: Option<&Path>) -> Result<Vec<Found>, OpenError> {
    let functions = Functions::load(named)?;
    let mut found = Vec::new();
    for number in 0..functions.count() {
        let device = functions.open(number)?;
        let spec = spec(&device);
        found.push(Found {
            number,
            model: device.name(),
            serial: number.to_string(),
            remarks: match device.status() {
                Ok(status) if !is_ready(&status) => vec!["it is not ready".to_owned()],
                _ => Vec::new(),
            },
            spec,
            forces: Origin::Ours,
        });
        device.close();
    }
    Ok(found)
}

fn spec(device: &Opened) -> DeviceSpec {
    DeviceSpec {
        peak_force: PEAK,
        continuous_force: CONTINUOUS,
        displays_force: true,
        ..DeviceSpec::without_force(&format!("Force Dimension {}", device.name()))
    }
}

fn is_ready(status: &Status) -> bool {
    status.powered && status.connected && status.started
}

/// Why the device took its forces off.
fn cause(cause: i32) -> Option<Fault> {
    let what = match cause {
        0 => return None,
        1 => "its button was pressed",
        2 => "its handle was too fast",
        3 => "its watchdog bit",
        4 => "a program did it",
        5 => return Some(Fault::Vanished),
        6 => "its dead-man's switch was let go of",
        _ => "for a reason of its own",
    };
    Some(Fault::Safety { what })
}

impl ForceDimensionDevice {
    /// Opens device `number`, from zero on, of the library, `named` or where it usually is.
    ///
    /// # Errors
    /// When there is no library, or no such device.
    pub fn open(named: Option<&Path>, number: usize) -> Result<Self, OpenError> {
        let device = Functions::load(named)?.open(number)?;
        let spec = spec(&device);
        let not_opened = |what: String| OpenError::NotOpened {
            kind: Kind::ForceDimension,
            what,
        };
        let enabled = device.enable_forces(PEAK);
        let calls = enabled
            .map_err(|code| format!("error {code}"))
            .and_then(|()| Calls::start(device).map_err(|fault| fault.to_string()));
        let calls = calls.inspect_err(|_| device.close()).map_err(not_opened)?;
        Ok(Self {
            spec,
            calls,
            was_ready: false,
            broken: None,
        })
    }

    /// The same with another time that an answer may take.
    #[must_use]
    pub fn with_patience(mut self, patience: Duration) -> Self {
        self.calls.patience = patience;
        self
    }

    fn try_exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if !command.force.iter().all(|component| component.is_finite()) {
            return Err(Fault::NonFiniteForce);
        }
        let said = self.calls.exchange(theirs(&command.force))?;
        let said = said.map_err(|code| Fault::Library {
            code: code.unsigned_abs(),
            what: "an error",
        })?;
        let status = said.status;
        let ready = is_ready(&status);
        let lost = (self.was_ready && !ready).then(|| lost(&status));
        self.was_ready = ready;
        let error = status.error.then_some(Fault::Safety {
            what: "it reports an error of its own",
        });
        let buttons = said.buttons;
        Ok(DeviceState {
            orientation: orientation(&said),
            grip: if buttons & 1 != 0 { 1.0 } else { 0.0 },
            buttons,
            ready: ready && status.force_off_cause == 0,
            fault: lost.or(cause(status.force_off_cause)).or(error),
            ..DeviceState::at(command.time, ours(&said.position))
        })
    }
}

fn lost(status: &Status) -> Fault {
    match (status.connected, status.powered) {
        (false, _) => Fault::Vanished,
        (_, false) => Fault::Unpowered,
        _ => Fault::Safety {
            what: "it is not ready any more",
        },
    }
}

/// A vector of the library in our axes.
fn ours(vector: &Vec3) -> Vec3 {
    Vec3::new(vector.y, vector.z, vector.x)
}

/// A vector of ours in the axes of the library.
fn theirs(vector: &Vec3) -> Vec3 {
    Vec3::new(vector.z, vector.x, vector.y)
}

/// The same turn about an axis in our axes.
fn orientation(said: &Said) -> Option<UnitQuaternion<f64>> {
    let column = |at: usize| ours(&Vec3::from_fn(|row, _| said.frame[row][at]));
    // Right, up and toward the user are y, z and x of the library.
    rotation([column(1), column(2), column(0)])
}

impl Device for ForceDimensionDevice {
    fn spec(&self) -> &DeviceSpec {
        &self.spec
    }

    fn exchange(&mut self, command: &Command, _patience: Duration) -> Result<DeviceState, Fault> {
        if let Some(fault) = self.broken {
            return Err(fault);
        }
        self.try_exchange(command).inspect_err(|fault| {
            self.broken = Some(*fault);
        })
    }

    fn stop(&mut self) {
        // A thread that is stuck takes the force off when it is free again.
        let _ = self.calls.send(Vec3::zeros());
    }
}
