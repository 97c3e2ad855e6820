//! An organ that hands touch through devices, on the machine's clock, while Python looks on.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use nalgebra::{Quaternion, UnitQuaternion};
use numpy::{PyArray1, PyArray2};
use palpate_devices::Places;
use palpate_files::scene::DeviceKind;
use palpate_files::{Claim, Overwrite, Scene};
use palpate_servo::{PointerHand, ServoSettings};
use palpate_simulate::SessionFolder;
use palpate_simulate::interactive::{CUTS, Interaction, ModelCommand, SceneDevices, ToolSnapshot};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use super::{Model, Simulation};
use crate::failure::Failure;
use crate::numbers;
use crate::session::Session;

/// An organ that hands touch through devices, on the machine's clock.
///
/// Each tool follows the device that its scene names (``device``: a haptic device, ``"mouse"``, which `move` moves, or
/// ``"virtual"``, a scripted hand). The model runs at the rate of its steps on a thread of its own and a servo loop for
/// each device at 1 kHz, as in the window: what a hand feels does not depend on what Python does meanwhile. The organ is at
/// rest when it begins; the simulation's own state stays as it is. A ``with`` block ends it.
///
/// Parameters
/// ----------
/// simulation : Simulation
///     What is touched.
/// folder : path-like, optional
///     Where the session is recorded.
/// devices : mapping of str to str, optional
///     By the name of a tool another `device` than the scene's.
/// overwrite : bool, default False
///     Whether a session there is replaced.
///
/// Raises
/// ------
/// InputError
///     When no tool has a device, or the folder has a session that may not be replaced.
/// PalpateError
///     When a device is not there, or a thread does not start.
#[pyclass(module = "palpate")]
pub(crate) struct Teleoperation {
    /// None once it has ended.
    touch: Mutex<Option<Interaction>>,
    pointers: Vec<Option<PointerHand>>,
    model: Arc<Model>,
    folder: Option<PathBuf>,
    warnings: Vec<String>,
}

#[pymethods]
impl Teleoperation {
    #[new]
    #[pyo3(signature = (simulation, folder=None, *, devices=BTreeMap::new(), overwrite=false), text_signature = "(simulation, folder=None, *, devices={}, overwrite=False)")]
    fn new(
        py: Python<'_>,
        simulation: &Simulation,
        folder: Option<PathBuf>,
        devices: BTreeMap<String, String>,
        overwrite: bool,
    ) -> Result<Self, Failure> {
        let model = simulation.model.clone();
        let places = Places::from_environment()?;
        let (mut scene, prepared) = (model.scene.clone(), &model.prepared);
        for (tool, device) in &devices {
            set_device(&mut scene, tool, device)?;
        }
        let devices = SceneDevices::open(&scene, prepared, &places)?;
        if devices.devices.iter().all(Option::is_none) {
            return Err(Failure::input(
                "no tool of the scene is moved by a device; set `device` of a tool to a haptic one, \"mouse\" or \"virtual\"",
            ));
        }
        let claim = folder.as_ref().map(|path| {
            std::fs::create_dir_all(path)
                .map_err(|error| Failure::failed(format!("{}: {error}", path.display())))?;
            Ok::<_, Failure>(Claim::of_folder(path, Overwrite::of_option(overwrite))?)
        });
        let claim = claim.transpose()?;
        let writer = claim.map(|claim| SessionFolder::create(claim, &model.scene, prepared));
        let writer = writer.transpose()?;
        let (placed, pointers) = (devices.devices, devices.pointers);
        let touch = py.detach(|| {
            let mut touch = Interaction::start(prepared.clone(), placed, ServoSettings::default())?;
            if let Some(writer) = writer {
                touch.record(writer);
            }
            Ok::<_, Failure>(touch)
        })?;
        Ok(Self {
            touch: Mutex::new(Some(touch)),
            pointers,
            model,
            folder,
            warnings: Vec::new(),
        })
    }

    fn __enter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __exit__(
        &mut self,
        py: Python<'_>,
        _kind: &Bound<'_, PyAny>,
        _error: &Bound<'_, PyAny>,
        _trace: &Bound<'_, PyAny>,
    ) -> Result<(), Failure> {
        self.end(py).map(|_| ())
    }

    /// Takes all forces off, stops the devices and ends the recording.
    ///
    /// Returns
    /// -------
    /// Session or None
    ///     What was recorded; None without a folder, or when it had ended before.
    ///
    /// Raises
    /// ------
    /// PalpateError
    ///     When a thread panicked, a device does not return, or the recording could not be written.
    fn end(&mut self, py: Python<'_>) -> Result<Option<Session>, Failure> {
        let Some(mut touch) = self.running().take() else {
            return Ok(None);
        };
        let model = self.model.clone();
        let (warnings, stopped) = py.detach(move || {
            let stopped = touch.stop().map(|_| ());
            (touch.snapshot().warnings(model.prepared.tools()), stopped)
        });
        self.warnings = warnings;
        stopped?;
        let folder = self.folder.as_deref();
        folder.map(Session::of_folder).transpose()
    }

    /// Whether all its threads still run; a device that fails ends its own.
    #[getter]
    fn is_running(&mut self) -> bool {
        self.running().as_ref().is_some_and(Interaction::is_running)
    }

    /// The time of the model's last step [s], the time of the rows of its session.
    #[getter]
    fn time(&mut self) -> Result<f64, Failure> {
        Ok(self.touch()?.snapshot().time)
    }

    /// For each tool the place of its tip [m], NaN while nobody holds it: shape (tools, 3).
    #[getter]
    fn positions<'py>(&mut self, py: Python<'py>) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        let nowhere = [f64::NAN; 3];
        let place = |tool: &ToolSnapshot| tool.pose.map_or(nowhere, |pose| pose.position_m).into();
        let places: Vec<nalgebra::Vector3<f64>> = self.tools()?.iter().map(place).collect();
        Ok(numbers::rows(py, places.iter()))
    }

    /// For each tool the force on it [N], as the session has it: shape (tools, 3).
    #[getter]
    fn forces<'py>(&mut self, py: Python<'py>) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        Ok(numbers::rows(
            py,
            self.tools()?.iter().map(|tool| &tool.force),
        ))
    }

    /// For each tool the force that its device is commanded [N]: scaled, extrapolated and limited; a mouse displays none
    /// of it. Shape (tools, 3).
    #[getter]
    fn felt_forces<'py>(&mut self, py: Python<'py>) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        Ok(numbers::rows(
            py,
            self.tools()?.iter().map(|tool| &tool.rendered_force),
        ))
    }

    /// For each tool how far its grip is closed, from 0 to 1 [-], NaN while nobody holds it: shape (tools,).
    #[getter]
    fn grips<'py>(&mut self, py: Python<'py>) -> Result<Bound<'py, PyArray1<f64>>, Failure> {
        let grip = |tool: &ToolSnapshot| tool.pose.map_or(f64::NAN, |pose| pose.grip);
        let grips = self.tools()?.iter().map(grip).collect();
        Ok(PyArray1::from_vec(py, grips))
    }

    /// For each tool why its device has no force; None where it has, or has none to display.
    #[getter]
    fn faults(&mut self) -> Result<Vec<Option<String>>, Failure> {
        let fault = |tool: &ToolSnapshot| tool.fault.map(|fault| fault.to_string());
        Ok(self.tools()?.iter().map(fault).collect())
    }

    /// Bounds of the models that acted, in sentences; known when it has ended.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// Moves the tool of a mouse, as a gamepad or another program does.
    ///
    /// Parameters
    /// ----------
    /// tool : str
    ///     Its name; `device` of the tool is "mouse".
    /// position : array_like, shape (3,), or None
    ///     Where its handle goes [m]; a tool that was absent appears there. None takes the tool away.
    /// orientation : array_like, shape (4,), optional
    ///     Quaternion (qx, qy, qz, qw) that maps tool to scene [-]; without, the scene decides.
    /// grip : float
    ///     How far the grip is closed, from 0 to 1 [-].
    /// cut : bool
    ///     Whether the blade cuts.
    #[pyo3(name = "move", signature = (tool, position, *, orientation=None, grip=0.0, cut=false))]
    fn move_to(
        &mut self,
        tool: &str,
        position: Option<[f64; 3]>,
        orientation: Option<[f64; 4]>,
        grip: f64,
        cut: bool,
    ) -> Result<(), Failure> {
        let tools = self.model.prepared.tools().iter();
        let number = tools.map(|own| &own.name).position(|name| name == tool);
        let pointer = number.and_then(|number| self.pointers[number].as_mut());
        let Some(pointer) = pointer else {
            return Err(Failure::input(format!(
                "no mouse moves a tool `{tool}`; the scene says `device = \"mouse\"` of such a tool"
            )));
        };
        let given = position
            .iter()
            .flatten()
            .chain(orientation.iter().flatten());
        if !given.chain([&grip]).all(|value| value.is_finite()) || !(0.0..=1.0).contains(&grip) {
            return Err(Failure::input(
                "a position or quaternion is not finite, or `grip` is not from 0 to 1; nothing has moved",
            ));
        }
        let Some(position) = position else {
            pointer.leave();
            return Ok(());
        };
        let turned = orientation.map(|[x, y, z, w]| {
            UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-6).ok_or_else(|| {
                Failure::input("the quaternion has no length; give (0, 0, 0, 1) for no turn")
            })
        });
        pointer.turn_to(turned.transpose()?);
        pointer.press(grip, if cut { CUTS } else { 0 });
        pointer.move_to(position.into());
        Ok(())
    }

    /// Adds a mark to the session: "here", or "done", as the task defines it.
    fn mark(&mut self) -> Result<(), Failure> {
        self.touch()?.send(ModelCommand::Mark);
        Ok(())
    }

    /// Takes the forces of all devices off at their next tick, until `arm`.
    fn emergency_stop(&mut self) -> Result<(), Failure> {
        self.touch()?.emergency_stop();
        Ok(())
    }

    /// Arms the forces of all devices after a fault or an emergency stop.
    fn arm(&mut self) -> Result<(), Failure> {
        self.touch()?.arm();
        Ok(())
    }
}

/// Lets `device` move the tool that is called `tool`.
fn set_device(scene: &mut Scene, tool: &str, device: &str) -> Result<(), Failure> {
    let Some(own) = scene.tools.iter_mut().find(|own| own.name == tool) else {
        let names: Vec<_> = scene.tools.iter().map(|own| own.name.as_str()).collect();
        return Err(Failure::input(format!(
            "the scene has no tool `{tool}`; it has {}",
            names.join(", ")
        )));
    };
    let Some((_, kind)) = DeviceKind::WORDS.iter().find(|(word, _)| *word == device) else {
        let words: Vec<_> = DeviceKind::WORDS.iter().map(|(word, _)| *word).collect();
        return Err(Failure::input(format!(
            "there is no device `{device}` for the tool `{tool}`; there are {}",
            words.join(", ")
        )));
    };
    own.device = *kind;
    Ok(())
}

impl Teleoperation {
    fn running(&mut self) -> &mut Option<Interaction> {
        // Exclusive access: the mutex only makes the class `Sync`.
        self.touch
            .get_mut()
            .unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    fn touch(&mut self) -> Result<&mut Interaction, Failure> {
        let running = self.running().as_mut();
        running.ok_or_else(|| Failure::input("the teleoperation has ended; begin another one"))
    }

    fn tools(&mut self) -> Result<&[ToolSnapshot], Failure> {
        Ok(&self.touch()?.snapshot().tools)
    }
}
