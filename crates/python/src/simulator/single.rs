//! One organ that is touched.

use std::sync::Arc;

use numpy::{PyArray2, PyArray3, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use palpate_simulate::{Flow, play};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::resources::Cache;
use super::stepper::Stepper;
use super::{Camera, Model, Snapshot, State, poses, resources, score};
use crate::failure::Failure;
use crate::mesh::{self, Mesh};
use crate::motion::Motion;
use crate::numbers;
use crate::scene::Scene;
use crate::session::Session;
use crate::waiting::waiting;

/// An organ and the tools that may touch it.
///
/// Of the whole organ of a hybrid scene the preparation takes from seconds to minutes, and is kept; Ctrl-C breaks
/// it off.
///
/// Parameters
/// ----------
/// scene : Scene
///     What stands there.
/// progress : callable, False or None
///     Hears (part, words) of a long preparation; False for silence, None for a bar once it takes a second.
/// memory : int, optional
///     Memory that may be taken [byte]; without, four fifths of what is free and limits leave.
/// cache : bool or path-like
///     Whether responses of whole organs are kept, and looked for first: where the command keeps them, or in a
///     folder.
/// show_every : float
///     The surface follows no more often than this [s]; forces are those of every step.
#[pyclass(module = "palpate")]
pub(crate) struct Simulation {
    pub(super) model: Arc<Model>,
    pub(super) show_every: f64,
    pub(super) stepper: Stepper,
    marks: Vec<bool>,
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(
        signature = (scene, *, progress=None, memory=None, cache=Cache::Whether(true), show_every=0.0),
        text_signature = "(scene, *, progress=None, memory=None, cache=True, show_every=0.0)"
    )]
    fn new(
        py: Python<'_>,
        scene: &Scene,
        progress: Option<Py<PyAny>>,
        memory: Option<usize>,
        cache: Cache,
        show_every: f64,
    ) -> PyResult<Self> {
        let period = checked_duration(show_every, "show_every")?;
        let resources = resources::resources(memory, cache);
        let model = Model::prepare(py, &scene.scene, resources, progress)?;
        let mut stepper = Stepper::new(&model);
        stepper.show_every(period);
        Ok(Self {
            marks: vec![false; stepper.poses.len()],
            model,
            show_every,
            stepper,
        })
    }

    /// What it was made of.
    #[getter]
    fn scene(&self) -> Scene {
        Scene {
            scene: self.model.scene.clone(),
        }
    }

    /// The names of the tools, in the order of the scene.
    #[getter]
    fn tools(&self) -> Vec<String> {
        let tools = self.model.prepared.tools().iter();
        tools.map(|tool| tool.name.clone()).collect()
    }

    /// The organ at rest and whole.
    #[getter]
    fn surface(&self) -> Mesh {
        Mesh::with_warnings(self.model.prepared.surface().mesh().clone(), Vec::new())
    }

    /// Length of a step [s].
    #[getter]
    fn step_length(&self) -> f64 {
        self.model.prepared.step()
    }

    /// Plain sentences on warnings: of the scene, then bounds of the models that acted in the steps so far.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        let prepared = &self.model.prepared;
        let mut warnings = prepared.warnings().to_vec();
        warnings.extend(self.stepper.course.state.warnings(prepared));
        warnings
    }

    /// One step: tools go to their poses, and feel forces.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, shape (tools, 3), (tools, 5), (tools, 7) or (tools, 9)
    ///     For each tool the place of its tip [m]; with 5 numbers also its grip from 0 to 1 and whether it cuts, 0
    ///     or 1; with 7 also the quaternion (qx, qy, qz, qw) that maps tool to scene; with 9 the quaternion, then
    ///     grip and cut. A row of NaN, or None in a list, is a tool that is not there. Of a single tool the row
    ///     alone will do.
    /// elapsed : float, optional
    ///     Time since the last step [s]; without, `step_length`, and none for the first step: whatever depth there
    ///     is then comes as a jump.
    /// mark : bool or str
    ///     Whether the hand says: here. A name says which tool's; True is the first's.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (tools, 3)
    ///     The forces on the tools [N].
    ///
    /// Raises
    /// ------
    /// InputError
    ///     When there are NaN among numbers, or other rows than tools; nothing has changed then.
    #[pyo3(signature = (poses, elapsed=None, *, mark=None))]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        elapsed: Option<f64>,
        mark: Option<Mark>,
    ) -> Result<Bound<'py, PyArray2<f64>>, Failure> {
        let elapsed = elapsed.map(|time| checked_duration(time, "elapsed"));
        let elapsed = elapsed.transpose()?;
        self.marks.fill(false);
        if let Some(mark) = mark {
            mark.set(&self.model, &mut self.marks)?;
        }
        poses::read(poses, &mut self.stepper.poses, "tool")?;
        let (stepper, model, marks) = (&mut self.stepper, &*self.model, &*self.marks);
        // To release the interpreter takes a tenth of a microsecond, a step in contact a thousand times that.
        py.detach(|| stepper.step(model, elapsed, marks));
        let forces = self.stepper.course.state.tools.iter();
        Ok(numbers::rows(py, forces.map(|tool| &tool.force)))
    }

    /// Many steps of the usual length, in one call: what `step` does for each of the poses, with the interpreter
    /// released.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, shape (steps, tools, 3), (steps, tools, 5), (steps, tools, 7) or (steps, tools, 9)
    ///     Where the tools are, as for `step`.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (steps, tools, 3)
    ///     The forces on the tools [N].
    fn replay<'py>(
        &mut self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
    ) -> Result<Bound<'py, PyArray3<f64>>, Failure> {
        let given = numbers::floats(poses, "poses")?;
        let tools = self.stepper.poses.len();
        let (steps, width) = match *given.shape() {
            [steps, count, width] if count == tools => (steps, width),
            ref shape => {
                return Err(Failure::input(format!(
                    "`poses` has the shape {}; give (steps, tools, n) for {tools} tools, with n = 3, 5, 7 or 9",
                    numbers::shape_words(shape)
                )));
            }
        };
        let borrowed: PyReadonlyArrayDyn<'_, f64> = given.try_readonly().map_err(Failure::input)?;
        let flat = borrowed.as_slice().map_err(Failure::input)?;
        check_all(flat, tools, width)?;
        let mut forces = vec![0.0; 3 * tools * steps];
        let (stepper, model) = (&mut self.stepper, &*self.model);
        let done: Result<(), Failure> = py.detach(|| {
            let rows = flat.chunks_exact(tools * width);
            for (row, forces) in rows.zip(forces.chunks_exact_mut(3 * tools)) {
                poses::of_flat(row, width, &mut stepper.poses, "tool")?;
                stepper.step(model, None, &[]);
                stepper.write_forces(forces);
            }
            Ok(())
        });
        done?;
        Ok(numbers::array(py, [steps, tools, 3], forces))
    }

    /// Plays a whole motion as the command `palpate simulate --headless` does, beside the state that is here, which
    /// stays as it is.
    ///
    /// Parameters
    /// ----------
    /// motion : Motion
    ///     How the tools move.
    /// progress : callable, False or None
    ///     Hears (part, words); False for silence, None for a bar once it takes a second.
    #[pyo3(signature = (motion, *, progress=None))]
    fn play(
        &self,
        py: Python<'_>,
        motion: &Motion,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Session> {
        let model = &*self.model;
        let (rows, summary) = waiting(py, progress, |told| {
            told.say("playing the motion");
            let mut rows = Vec::new();
            let summary = play(&model.prepared, &motion.motion, |frame| {
                rows.extend(frame.rows().copied());
                told.at(frame.number as f64 / frame.steps as f64);
                Ok::<_, Failure>(match told.should_stop() {
                    true => Flow::Stop,
                    false => Flow::Continue,
                })
            })?;
            Ok((rows, summary))
        })?;
        Ok(Session::played(model, rows, &summary))
    }

    /// What there is to know after the last step.
    #[getter]
    fn state(&self) -> State {
        State::of(&self.stepper.course)
    }

    /// The time of the last step [s].
    #[getter]
    fn time(&self) -> f64 {
        self.stepper.course.clock.time
    }

    /// Places of the vertices of the visible surface as it is now [m], a copy: shape (n, 3). Where the organ is
    /// cut, the surface has more vertices and triangles.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let state = &self.stepper.course.state;
        match state.cuts.as_ref().filter(|cuts| cuts.has_openings()) {
            Some(cuts) => numbers::rows(py, cuts.places().iter()),
            None => numbers::rows(py, state.deformed.vertices().iter()),
        }
    }

    /// Numbers of the vertices of its triangles, a copy: uint32, shape (m, 3).
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        let state = &self.stepper.course.state;
        match state.cuts.as_ref().filter(|cuts| cuts.has_openings()) {
            Some(cuts) => mesh::corners(py, cuts.triangles()),
            None => mesh::corners(py, state.deformed.triangles()),
        }
    }

    /// The organ at rest and whole, as if nothing had been touched yet.
    ///
    /// Parameters
    /// ----------
    /// scene : Scene, optional
    ///     Whose stiff balls and task are taken; all else stays as it was prepared. Without, those of `scene`.
    #[pyo3(signature = (scene=None))]
    fn reset(&mut self, scene: Option<&Scene>) -> Result<(), Failure> {
        let scene = scene.map(|scene| &scene.scene);
        self.stepper.reset(&self.model, scene, self.show_every)
    }

    /// The camera that the scene asks for; what it does not say frames the organ.
    ///
    /// Parameters
    /// ----------
    /// aspect : float
    ///     Width of the picture over its height [-].
    /// endoscope : bool
    ///     Whether it is an endoscope, near the organ and lit by its own lamp, or a camera in the room.
    #[pyo3(signature = (aspect=4.0 / 3.0, endoscope=true), text_signature = "($self, aspect=1.3333333333333333, endoscope=True)")]
    fn camera(&self, aspect: f64, endoscope: bool) -> Result<Camera, Failure> {
        Camera::of(&self.model, aspect, endoscope)
    }

    /// Keeps the state.
    fn snapshot(&self) -> Snapshot {
        Snapshot::of(&self.model, &self.stepper)
    }

    /// Goes on from a state that was kept, to the same bit.
    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Failure> {
        snapshot.restore(&self.model, &mut self.stepper)
    }

    /// Closes the last cut again; whether there was one.
    fn undo_cut(&mut self) -> bool {
        self.stepper.course.state.undo_cut()
    }

    /// How well the scene's task was done so far, as `palpate score` tells it: a dict with `kind`, `title`, `passed`,
    /// `part` and `measures`; None where the scene has no task.
    fn score<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let judge = self.stepper.course.judge.as_ref();
        let score = judge.map(|judge| score::dict(py, &judge.performance.score(), &judge.task));
        score.transpose()
    }

    /// Another simulation of the same model, in the same state.
    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        let mut stepper = Stepper::new(&self.model);
        stepper.restore(&self.model, self.stepper.course.clone());
        Self {
            model: self.model.clone(),
            show_every: self.show_every,
            stepper,
            marks: self.marks.clone(),
        }
    }

    fn __repr__(&self) -> String {
        let (tools, time) = (self.tools().join(", "), self.time());
        format!("<palpate.Simulation with the tools {tools} at {time:?} s>")
    }
}

/// A hand that says: here.
#[derive(Debug, FromPyObject)]
enum Mark {
    Whether(bool),
    Tool(String),
}

impl Mark {
    fn set(&self, model: &Model, marks: &mut [bool]) -> Result<(), Failure> {
        let tools = model.prepared.tools();
        let number = match self {
            Self::Whether(false) => return Ok(()),
            Self::Whether(true) => Some(0),
            Self::Tool(name) => tools.iter().position(|tool| tool.name == *name),
        };
        match number.and_then(|number| marks.get_mut(number)) {
            Some(mark) => *mark = true,
            None => {
                let known: Vec<_> = tools
                    .iter()
                    .map(|tool| format!("{:?}", tool.name))
                    .collect();
                return Err(Failure::input(format!(
                    "`mark` names no tool, but the scene has {}; name one of these",
                    known.join(" and ")
                )));
            }
        }
        Ok(())
    }
}

/// A time that is one [s].
fn checked_duration(time: f64, name: &str) -> Result<f64, Failure> {
    match time.is_finite() && time >= 0.0 {
        true => Ok(time),
        false => Err(Failure::input(format!(
            "`{name}` is {time}; give a number from 0 on, in seconds"
        ))),
    }
}

/// Refuses what cannot be played before anything has moved.
pub(super) fn check_all(flat: &[f64], tools: usize, width: usize) -> Result<(), Failure> {
    let mut slots = vec![None; tools];
    for row in flat.chunks_exact((tools * width).max(1)) {
        poses::of_flat(row, width, &mut slots, "tool")?;
    }
    Ok(())
}
