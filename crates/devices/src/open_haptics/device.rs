use std::path::Path;
use std::time::{Duration, Instant};

use palpate_servo::{Command, Device, DeviceSpec, DeviceState, Fault, Vec3};

use super::errors;
use super::frames::{Frames, Told};
use super::functions::{Functions, Read};
use crate::places::PATIENCE;
use crate::rotation::rotation;
use crate::{Found, Kind, OpenError, Origin};

/// How long a waiting loop sleeps.
const NAP: Duration = Duration::from_micros(50);

/// A Touch, where the library does not say: 3.3 N, and 0.88 N for as long as one likes.
const TOUCH: [f64; 2] = [3.3, 0.88];

/// The default device of OpenHaptics.
pub struct OpenHapticsDevice {
    spec: DeviceSpec,
    functions: Functions,
    handle: u32,
    /// None once it is dropped.
    frames: Option<Frames>,
    was_calibrated: bool,
    patience: Duration,
    broken: Option<Fault>,
}

/// The default device of the library, `named` or where it usually is.
///
/// # Errors
/// When there is no library, or it opens no device.
pub fn list(named: Option<&Path>) -> Result<Vec<Found>, OpenError> {
    let functions = Functions::load(named)?;
    let handle = open(&functions)?;
    let [model, serial] = functions.names();
    let (spec, forces) = spec(&functions);
    let remarks = match functions.is_calibrated() {
        true => Vec::new(),
        false => vec!["not calibrated: put the stylus into its inkwell".to_owned()],
    };
    functions.close(handle);
    Ok(vec![Found {
        number: 0,
        model,
        serial,
        remarks,
        spec,
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

fn spec(functions: &Functions) -> (DeviceSpec, Origin) {
    let [model, serial] = functions.names();
    let said = functions.largest_forces();
    let is_said = said.iter().all(|force| force.is_finite() && *force > 0.0);
    let ([peak, continuous], origin) = match is_said {
        true => (said, Origin::Device),
        false => (TOUCH, Origin::Ours),
    };
    let [a, b, c, d, e, f] = functions.workspace().map(|length| 1e-3 * length);
    let corners = [Vec3::new(a, b, c), Vec3::new(d, e, f)];
    let wide = (corners[1] - corners[0])
        .iter()
        .all(|side| *side > 0.0 && side.is_finite());
    let spec = DeviceSpec {
        workspace: wide.then_some(corners),
        peak_force: peak,
        // Motors bear no more than they can.
        continuous_force: continuous.min(peak),
        displays_force: true,
        ..DeviceSpec::without_force(&format!("{model} {serial}"))
    };
    (spec, origin)
}

impl OpenHapticsDevice {
    /// Opens the default device of the library, `named` or where it usually is.
    ///
    /// # Errors
    /// When there is no library, or it opens no device.
    pub fn open(named: Option<&Path>) -> Result<Self, OpenError> {
        let functions = Functions::load(named)?;
        let handle = open(&functions)?;
        functions.calibrate();
        functions.enable_forces();
        let (spec, _) = spec(&functions);
        // What came up until now belongs to nobody's force.
        functions.last_error();
        Ok(Self {
            spec,
            functions,
            handle,
            frames: Some(Frames::start(functions, handle)),
            was_calibrated: false,
            patience: PATIENCE,
            broken: None,
        })
    }

    /// The same with another time that a state may take.
    #[must_use]
    pub fn with_patience(mut self, patience: Duration) -> Self {
        self.patience = patience;
        self
    }

    fn try_exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        let frames = self.frames.as_mut().ok_or(Fault::Disconnected)?;
        frames.send(command.force);
        let told = newest(frames, self.patience)?;
        let lived_through = errors::fault(frames.error())?;
        let state = state(command.time, &told);
        let lost = self.was_calibrated && !told.calibrated;
        self.was_calibrated = told.calibrated;
        Ok(DeviceState {
            fault: lived_through.or(lost.then_some(Fault::Uncalibrated)),
            ..state
        })
    }
}

/// What a frame told that was not read before.
fn newest(frames: &mut Frames, patience: Duration) -> Result<Told, Fault> {
    let until = Instant::now() + patience;
    while !frames.told.has_news() {
        if Instant::now() >= until {
            return Err(Fault::Silent);
        }
        std::thread::sleep(NAP);
    }
    frames.told.latest().ok_or(Fault::Silent)
}

fn state(time: f64, told: &Told) -> DeviceState {
    let Read {
        position,
        transform,
        buttons,
    } = told.read;
    let column = |at: usize| Vec3::new(transform[at], transform[at + 1], transform[at + 2]);
    let buttons = buttons as u32;
    DeviceState {
        orientation: rotation([column(0), column(4), column(8)]),
        grip: if buttons & 1 != 0 { 1.0 } else { 0.0 },
        buttons,
        ready: told.calibrated,
        ..DeviceState::at(time, 1e-3 * position)
    }
}

impl Device for OpenHapticsDevice {
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
        if let Some(frames) = &mut self.frames {
            frames.send(Vec3::zeros());
        }
    }
}

impl Drop for OpenHapticsDevice {
    fn drop(&mut self) {
        self.stop();
        // The scheduler ends before its device.
        self.frames = None;
        self.functions.close(self.handle);
    }
}
