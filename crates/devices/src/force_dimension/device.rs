use std::path::Path;

use nalgebra::UnitQuaternion;
use palpate_servo::{Capabilities, Command, DeadMan, Device, DeviceState, Disabled, Fault, Vec3};

use super::functions::{Functions, Opened, Status};
use crate::rotation::rotation;
use crate::{Found, OpenError, Origin};

/// The largest force [N], and the largest continuous force [N]: below those of all models, since the library does not
/// report them.
const PEAK: f64 = 8.0;
const CONTINUOUS: f64 = 4.0;

/// Timeout of a displayed force without a new one, for a device with a watchdog [s].
const FRESH: f64 = 0.020;

/// Every button but the first, which shuts jaws and cuts.
const OTHER_BUTTONS: u32 = !1;

/// A device of Force Dimension. The thread of its loop calls it.
pub struct ForceDimensionDevice {
    capabilities: Capabilities,
    device: Opened,
    enabled: bool,
    was_ready: bool,
    broken: Option<Fault>,
}

/// The devices of the library, `named` or at its usual place.
///
/// # Errors
/// When there is no library.
pub fn list(named: Option<&Path>) -> Result<Vec<Found>, OpenError> {
    let functions = Functions::load(named)?;
    let mut found = Vec::new();
    for number in 0..functions.count() {
        let device = functions.open(number)?;
        found.push(Found {
            number,
            model: device.name(),
            serial: number.to_string(),
            remarks: match device.status() {
                Ok(status) if !is_ready(&status) => vec!["it is not ready".to_owned()],
                _ => Vec::new(),
            },
            capabilities: capabilities(&device),
            forces: Origin::Assumed,
        });
    }
    Ok(found)
}

fn capabilities(device: &Opened) -> Capabilities {
    Capabilities {
        peak_force: PEAK,
        continuous_force: CONTINUOUS,
        stop_buttons: OTHER_BUTTONS,
        displays_force: true,
        ..Capabilities::without_force(&format!("Force Dimension {}", device.name()))
    }
}

fn is_ready(status: &Status) -> bool {
    status.powered && status.connected && status.started
}

/// The reason why the device took its forces off.
fn cause(cause: i32) -> Option<Fault> {
    let what = match cause {
        0 => return None,
        1 => "its button was pressed",
        2 => "its handle was too fast",
        3 => "its watchdog tripped",
        4 => "a program did it",
        5 => return Some(Fault::Vanished),
        6 => "its dead-man's switch was released",
        _ => "for a reason of its own",
    };
    Some(Fault::Safety { what })
}

fn library_error(code: i32) -> Fault {
    Fault::Library {
        code: code.unsigned_abs(),
        what: "an error",
    }
}

impl ForceDimensionDevice {
    /// Opens device `number`, counted from zero, of the library, `named` or at its usual place.
    ///
    /// # Errors
    /// When there is no library, or no such device.
    pub fn open(named: Option<&Path>, number: usize) -> Result<Self, OpenError> {
        let device = Functions::load(named)?.open(number)?;
        Ok(Self::of(device))
    }

    pub(super) fn of(device: Opened) -> Self {
        Self {
            capabilities: capabilities(&device),
            device,
            enabled: false,
            was_ready: false,
            broken: None,
        }
    }

    /// The same with a dead-man's switch: one of the buttons but the first. That button is then no stop button.
    #[must_use]
    pub fn with_dead_man(mut self) -> Self {
        self.capabilities.dead_man = Some(DeadMan::Buttons(OTHER_BUTTONS));
        self.capabilities.stop_buttons = 0;
        self
    }

    fn try_exchange(&mut self, command: &Command) -> Result<DeviceState, i32> {
        self.device.set_force(&theirs(&command.force()))?;
        let position = ours(&self.device.position()?);
        let frame = self.device.frame()?;
        let buttons = self.device.buttons();
        let status = self.device.status()?;
        Ok(DeviceState {
            orientation: orientation(&frame),
            grip: if buttons & 1 != 0 { 1.0 } else { 0.0 },
            buttons,
            ready: is_ready(&status) && !(self.enabled && status.force_off_cause != 0),
            fault: self.fault_of(&status),
            ..DeviceState::at(command.time, position)
        })
    }

    fn fault_of(&mut self, status: &Status) -> Option<Fault> {
        let ready = is_ready(status);
        let lost = (self.was_ready && !ready).then(|| lost(status));
        self.was_ready = ready;
        // Until a person arms, the driver itself keeps them off.
        let safety_fault = cause(status.force_off_cause).filter(|_| self.enabled);
        let error = status.error.then_some(Fault::Safety {
            what: "it reports an error of its own",
        });
        lost.or(safety_fault).or(error)
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

/// The same rotation in our axes.
fn orientation(frame: &[[f64; 3]; 3]) -> Option<UnitQuaternion<f64>> {
    let column = |at: usize| ours(&Vec3::from_fn(|row, _| frame[row][at]));
    // Right, up and toward the user are y, z and x of the library.
    rotation([column(1), column(2), column(0)])
}

impl Device for ForceDimensionDevice {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    /// A device that took its forces off keeps them off until then.
    fn enable(&mut self) -> Result<(), Fault> {
        // Without the force from before it was disabled.
        let cleared = self.device.set_force(&Vec3::zeros());
        let enabled = cleared.and_then(|()| self.device.enable_forces(PEAK, FRESH));
        self.enabled = enabled.is_ok();
        enabled.map_err(library_error)
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if let Some(fault) = self.broken {
            return Err(fault);
        }
        let exchanged = self.try_exchange(command).map_err(library_error);
        exchanged.inspect_err(|fault| {
            self.broken = Some(*fault);
        })
    }

    fn disable(&mut self) -> Disabled {
        self.enabled = false;
        // The second call also for a library that does not accept zero.
        let zero = self.device.set_force(&Vec3::zeros());
        let disabled = self.device.disable_forces();
        match zero.and(disabled) {
            Ok(()) => Disabled::NoForce,
            Err(_) => Disabled::Unknown,
        }
    }
}

impl Drop for ForceDimensionDevice {
    fn drop(&mut self) {
        self.disable();
    }
}
