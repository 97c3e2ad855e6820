use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use palpate_servo::{
    Capabilities, Command, DeadMan, Device, DeviceState, Disabled, Fault, Scheduler, Vec3,
};

use super::errors;
use super::functions::{Calibration, Frame, Functions};
use super::scheduler::OpenHapticsScheduler;
use crate::rotation::rotation;
use crate::{Found, Kind, OpenError, Origin};

/// A Touch, if the library does not report its forces: 3.3 N peak and 0.88 N continuous force.
const TOUCH: [f64; 2] = [3.3, 0.88];

/// Every button but the first, which shuts jaws and cuts.
const OTHER_BUTTONS: u32 = 0b1110;

/// The default device of OpenHaptics. Only its scheduler calls it.
pub struct OpenHapticsDevice {
    capabilities: Capabilities,
    functions: Functions,
    handle: u32,
    has_inkwell: bool,
    /// Whether the scheduler is calling.
    inside: Arc<AtomicBool>,
    enabled: bool,
    was_calibrated: bool,
    broken: Option<Fault>,
}

/// The default device of the library, `named` or at its usual place.
///
/// # Errors
/// When there is no library, or it opens no device.
pub fn list(named: Option<&Path>) -> Result<Vec<Found>, OpenError> {
    let functions = Functions::load(named)?;
    let handle = open(&functions)?;
    let [model, serial] = functions.names();
    let (capabilities, forces) = capabilities(&functions);
    let remarks = match functions.calibration() {
        Calibration::Known => Vec::new(),
        _ => vec!["not calibrated: put the stylus into its inkwell".to_owned()],
    };
    functions.close(handle);
    Ok(vec![Found {
        number: 0,
        model,
        serial,
        remarks,
        capabilities,
        forces,
    }])
}

fn open(functions: &Functions) -> Result<u32, OpenError> {
    functions.open().map_err(|code| OpenError::NotOpened {
        kind: Kind::OpenHaptics,
        what: match code {
            errors::NONE => "no reason".to_owned(),
            code => format!("{} ({code:#06x})", errors::meaning(code)),
        },
    })
}

fn capabilities(functions: &Functions) -> (Capabilities, Origin) {
    let [model, serial] = functions.names();
    let reported = functions.largest_forces();
    let is_reported = reported
        .iter()
        .all(|force| force.is_finite() && *force > 0.0);
    let ([peak, continuous], origin) = match is_reported {
        true => (reported, Origin::Device),
        false => (TOUCH, Origin::Assumed),
    };
    let [a, b, c, d, e, f] = functions.workspace().map(|length| 1e-3 * length);
    let corners = [Vec3::new(a, b, c), Vec3::new(d, e, f)];
    let wide = (corners[1] - corners[0])
        .iter()
        .all(|side| *side > 0.0 && side.is_finite());
    let capabilities = Capabilities {
        workspace: wide.then_some(corners),
        peak_force: peak,
        // Motors bear no more than they can.
        continuous_force: continuous.min(peak),
        stop_buttons: OTHER_BUTTONS,
        displays_force: true,
        ..Capabilities::without_force(&format!("{model} {serial}"))
    };
    (capabilities, origin)
}

impl OpenHapticsDevice {
    /// Opens the default device of the library, `named` or where it usually is.
    ///
    /// # Errors
    /// When there is no library, or it opens no device.
    pub fn open(named: Option<&Path>) -> Result<Self, OpenError> {
        Self::of(Functions::load(named)?)
    }

    pub(super) fn of(functions: Functions) -> Result<Self, OpenError> {
        let handle = open(&functions)?;
        let (capabilities, _) = capabilities(&functions);
        let has_inkwell = functions.has_inkwell();
        // Clears errors from before the first force.
        functions.last_error();
        Ok(Self {
            capabilities,
            functions,
            handle,
            has_inkwell,
            inside: Arc::default(),
            enabled: false,
            was_calibrated: false,
            broken: None,
        })
    }

    /// The same with a dead-man's switch: one of the buttons but the first, which then is no stop button.
    #[must_use]
    pub fn with_dead_man(mut self) -> Self {
        self.capabilities.dead_man = Some(DeadMan::Buttons(OTHER_BUTTONS));
        self.capabilities.stop_buttons = 0;
        self
    }

    fn try_exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if !self.inside.load(Ordering::Acquire) {
            return Err(Fault::OutsideScheduler);
        }
        let calibration = self.functions.calibration();
        if calibration == Calibration::NeedsUpdate {
            self.functions.update_calibration();
        }
        let frame = self.functions.frame(self.handle);
        // Where the handle is was not known when the force was made.
        if calibration == Calibration::Known {
            frame.set_force(&command.force());
        }
        let state = state(command.time, &frame);
        let in_inkwell = self.has_inkwell && frame.is_in_inkwell();
        drop(frame);
        let lived_through = errors::fault(self.functions.last_error())?;
        let ready = calibration == Calibration::Known;
        let lost = self.was_calibrated && calibration == Calibration::NeedsHand;
        self.was_calibrated = ready;
        Ok(DeviceState {
            present: !in_inkwell,
            ready,
            fault: lived_through.or(lost.then_some(Fault::Uncalibrated)),
            ..state
        })
    }
}

fn state(time: f64, frame: &Frame<'_>) -> DeviceState {
    let transform = frame.transform();
    let column = |at: usize| Vec3::new(transform[at], transform[at + 1], transform[at + 2]);
    let buttons = frame.buttons() as u32;
    DeviceState {
        orientation: rotation([column(0), column(4), column(8)]),
        grip: if buttons & 1 != 0 { 1.0 } else { 0.0 },
        buttons,
        ..DeviceState::at(time, 1e-3 * frame.position())
    }
}

impl Device for OpenHapticsDevice {
    fn capabilities(&self) -> &Capabilities {
        &self.capabilities
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.functions.enable_forces();
        self.enabled = true;
        errors::fault(self.functions.last_error())?.map_or(Ok(()), Err)
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        if let Some(fault) = self.broken {
            return Err(fault);
        }
        self.try_exchange(command).inspect_err(|fault| {
            self.broken = Some(*fault);
        })
    }

    /// A frame of zero force, which is written to the device when the frame ends; then its motors are off. Outside of
    /// its scheduler the second is all that can be done.
    fn disable(&mut self) -> Disabled {
        let was_enabled = std::mem::take(&mut self.enabled);
        if !was_enabled {
            return Disabled::NoForce;
        }
        let inside = self.inside.load(Ordering::Acquire);
        // Older errors are not about this frame.
        self.functions.last_error();
        if inside {
            self.functions.frame(self.handle).set_force(&Vec3::zeros());
        }
        self.functions.disable_forces();
        match self.functions.last_error() {
            errors::NONE if inside => Disabled::NoForce,
            _ => Disabled::Unknown,
        }
    }

    fn scheduler(&self) -> Option<Box<dyn Scheduler>> {
        let scheduler = OpenHapticsScheduler::new(self.functions, self.inside.clone());
        Some(Box::new(scheduler))
    }
}

impl Drop for OpenHapticsDevice {
    /// After its scheduler ended.
    fn drop(&mut self) {
        self.disable();
        self.functions.close(self.handle);
    }
}
