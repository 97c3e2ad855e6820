//! Many organs that are touched at the same time, by one model.

use std::sync::Arc;
use std::thread;

use numpy::{PyArray1, PyArray2, PyArray3, PyArray4, PyArrayMethods, PyUntypedArrayMethods};
use palpate_simulate::ToolState;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::single::check_all;
use super::stepper::Stepper;
use super::steps::Steps;
use super::{Model, Simulation, Snapshot, State, score};
use crate::failure::Failure;
use crate::numbers;
use crate::scene::Scene;

/// Many states of one simulation that go on together, on several threads with the interpreter released. Each of them
/// is to the last bit what `Simulation` would be.
///
/// Parameters
/// ----------
/// simulation : Simulation
///     What was prepared; its own state stays apart.
/// count : int
///     How many states there shall be.
/// threads : int, optional
///     At most so many; without, as many as there are cores.
#[pyclass(module = "palpate")]
pub(crate) struct SimulationBatch {
    /// Of each state.
    pub(super) models: Vec<Arc<Model>>,
    show_every: f64,
    pub(super) steppers: Vec<Stepper>,
    threads: usize,
}

#[pymethods]
impl SimulationBatch {
    #[new]
    #[pyo3(signature = (simulation, count, threads=None))]
    fn new(simulation: &Simulation, count: usize, threads: Option<usize>) -> Result<Self, Failure> {
        let cores = || thread::available_parallelism().map_or(1, usize::from);
        let threads = threads.unwrap_or_else(cores);
        if count == 0 || threads == 0 {
            return Err(Failure::input(
                "a batch of no states, or on no threads, does nothing; give numbers from 1 on",
            ));
        }
        let model = simulation.model.clone();
        let made = (0..count).map(|_| {
            let mut stepper = Stepper::new(&model);
            stepper.show_every(simulation.show_every);
            stepper
        });
        Ok(Self {
            steppers: made.collect(),
            models: vec![model; count],
            show_every: simulation.show_every,
            threads,
        })
    }

    fn __len__(&self) -> usize {
        self.steppers.len()
    }

    /// On how many threads it runs at most.
    #[getter]
    fn threads(&self) -> usize {
        self.threads
    }

    /// One step of every state.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, shape (count, tools, n)
    ///     Where the tools are, with n = 3, 5, 7 or 9 as for `Simulation.step`.
    /// marks : array_like of bool, shape (count, tools), optional
    ///     Which hands say: here.
    /// which : int, list of int, or list of bool for every state, optional
    ///     Which states go on, as for `reset`; the others stay as they are. Without, all.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (count, tools, 3)
    ///     The forces on the tools [N].
    #[pyo3(signature = (poses, marks=None, which=None))]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        marks: Option<&Bound<'py, PyAny>>,
        which: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyArray3<f64>>, Failure> {
        let given = numbers::floats(poses, "poses")?;
        let width = self.width(given.shape(), 1)?;
        let forces = self.run(py, &given, 1, width, marks, which)?;
        Ok(numbers::array(
            py,
            [self.steppers.len(), self.tools(), 3],
            forces,
        ))
    }

    /// Many steps of every state in one call.
    ///
    /// Parameters
    /// ----------
    /// poses : array_like, shape (steps, count, tools, n)
    ///     Where the tools are, with n = 3, 5, 7 or 9 as for `Simulation.step`.
    /// marks : array_like of bool, shape (count, tools), optional
    ///     Which hands say at the last of the steps: here.
    /// which : int, list of int, or list of bool for every state, optional
    ///     Which states go on, as for `reset`; the others stay as they are. Without, all.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (steps, count, tools, 3)
    ///     The forces on the tools [N].
    #[pyo3(signature = (poses, marks=None, which=None))]
    fn replay<'py>(
        &mut self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        marks: Option<&Bound<'py, PyAny>>,
        which: Option<&Bound<'py, PyAny>>,
    ) -> Result<Bound<'py, PyArray4<f64>>, Failure> {
        let given = numbers::floats(poses, "poses")?;
        let width = self.width(given.shape(), 2)?;
        let steps = given.shape()[0];
        let forces = self.run(py, &given, steps, width, marks, which)?;
        // State by state as they were made, step by step as they are wanted.
        let (count, row) = (self.steppers.len(), 3 * self.tools());
        let mut turned = vec![0.0; forces.len()];
        for (state, own) in forces.chunks_exact((steps * row).max(1)).enumerate() {
            for (step, force) in own.chunks_exact(row).enumerate() {
                let at = (step * count + state) * row;
                turned[at..at + row].copy_from_slice(force);
            }
        }
        Ok(numbers::array(py, [steps, count, self.tools(), 3], turned))
    }

    /// States at rest and whole again.
    ///
    /// Parameters
    /// ----------
    /// which : int, list of int, or list of bool for every state, optional
    ///     Which; without, all.
    /// scene : Scene, optional
    ///     Whose stiff balls and task are taken; all else stays as it was prepared.
    #[pyo3(signature = (which=None, scene=None))]
    fn reset(
        &mut self,
        py: Python<'_>,
        which: Option<&Bound<'_, PyAny>>,
        scene: Option<&Scene>,
    ) -> Result<(), Failure> {
        let chosen = self.chosen(which)?;
        let (models, scene) = (&self.models, scene.map(|scene| &scene.scene));
        let (steppers, period) = (&mut self.steppers, self.show_every);
        py.detach(|| {
            for number in chosen {
                steppers[number].reset(&models[number], scene, period)?;
            }
            Ok(())
        })
    }

    /// Puts another simulation in the place of a state, at rest and whole: each state may have its own tissue.
    ///
    /// Parameters
    /// ----------
    /// index : int
    ///     Which state.
    /// simulation : Simulation
    ///     What was prepared, with tools of the same names.
    fn replace(&mut self, index: isize, simulation: &Simulation) -> Result<(), Failure> {
        let index = self.index(index)?;
        let names = |model: &Model| -> Vec<String> {
            let tools = model.prepared.tools().iter();
            tools.map(|tool| tool.name.clone()).collect()
        };
        let (own, new) = (names(&self.models[0]), names(&simulation.model));
        if own != new {
            return Err(Failure::input(format!(
                "the simulation has the tools {}, the batch has {}; give it the same ones",
                new.join(", "),
                own.join(", ")
            )));
        }
        let mut stepper = Stepper::new(&simulation.model);
        stepper.show_every(self.show_every);
        self.steppers[index] = stepper;
        self.models[index] = simulation.model.clone();
        Ok(())
    }

    /// Keeps a state; it may be taken back to any of the batch, or to the simulation.
    fn snapshot(&self, index: isize) -> Result<Snapshot, Failure> {
        let index = self.index(index)?;
        Ok(Snapshot::of(&self.models[index], &self.steppers[index]))
    }

    /// Takes a state back to one that was kept, to the same bit.
    fn restore(&mut self, index: isize, snapshot: &Snapshot) -> Result<(), Failure> {
        let index = self.index(index)?;
        snapshot.restore(&self.models[index], &mut self.steppers[index])
    }

    /// What there is to know of a state after its last step.
    fn state(&self, index: isize) -> Result<State, Failure> {
        Ok(State::of(&self.steppers[self.index(index)?].course))
    }

    /// How well a state's task was done so far, as `Simulation.score` tells it.
    fn score<'py>(
        &self,
        py: Python<'py>,
        index: isize,
    ) -> Result<Option<Bound<'py, PyDict>>, Failure> {
        let judge = self.steppers[self.index(index)?].course.judge.as_ref();
        let score = judge.map(|judge| score::dict(py, &judge.performance.score(), &judge.task));
        Ok(score.transpose()?)
    }

    /// Times of the last steps [s]: shape (count,).
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.of_states(py, |stepper| stepper.course.clock.time)
    }

    /// How far the tips are below the rest surface [m]; 0 without contact: shape (count, tools).
    #[getter]
    fn depths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.of_tools(py, |tool| tool.pose.map_or(0.0, |_| tool.row.depth_m))
    }

    /// Quaternions (qx, qy, qz, qw) that map tool to scene [-]; NaN for a tool that is not there: shape
    /// (count, tools, 4).
    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f64>> {
        let tools = self.steppers.iter();
        let tools = tools.flat_map(|stepper| &stepper.course.state.tools);
        let flat = tools.flat_map(|tool| match tool.pose {
            Some(_) => tool.row.orientation,
            None => [f64::NAN; 4],
        });
        numbers::array(py, [self.steppers.len(), self.tools(), 4], flat.collect())
    }

    /// Which tools touch the organ: bool, shape (count, tools).
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<bool>> {
        self.of_tools(py, |tool| tool.pose.is_some() && tool.row.contact)
    }

    /// Which tools' jaws hold tissue: bool, shape (count, tools).
    #[getter]
    fn holds<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<bool>> {
        self.of_tools(py, ToolState::is_grasping)
    }

    /// Forces on the tools [N]: shape (count, tools, 3).
    #[getter]
    fn forces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f64>> {
        let row = 3 * self.tools();
        let mut flat = vec![0.0; self.steppers.len() * row];
        for (stepper, forces) in self.steppers.iter().zip(flat.chunks_exact_mut(row)) {
            stepper.write_forces(forces);
        }
        numbers::array(py, [self.steppers.len(), self.tools(), 3], flat)
    }

    /// Torques on the tools about their tips [N m]: shape (count, tools, 3).
    #[getter]
    fn torques<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f64>> {
        let tools = self.steppers.iter().flat_map(|own| &own.course.state.tools);
        let flat = tools.flat_map(|tool| <[f64; 3]>::from(tool.torque));
        let shape = [self.steppers.len(), self.tools(), 3];
        numbers::array(py, shape, flat.collect())
    }

    /// Parts of the tasks that are done [-]; NaN where that cannot be told: shape (count,).
    #[getter]
    fn progress<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.of_states(py, |stepper| score::status(stepper.course.judge.as_ref()).0)
    }

    /// Which tasks are over: bool, shape (count,).
    #[getter]
    fn over<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.of_states(py, |stepper| score::status(stepper.course.judge.as_ref()).1)
    }

    /// Which tasks are over because their time is: bool, shape (count,).
    #[getter]
    fn late<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.of_states(py, |stepper| score::status(stepper.course.judge.as_ref()).2)
    }

    /// What should not have happened so far, counted: forces that rose above their limit, perforations, tissue that
    /// was lost from jaws, shafts that touched the organ: int, shape (count, 4).
    #[getter]
    fn errors<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u64>> {
        let errors = |stepper: &Stepper| {
            let judge = stepper.course.judge.as_ref();
            let errors = judge.map(|judge| judge.performance.errors());
            let errors = errors.unwrap_or_default();
            [
                errors.force_limit,
                errors.perforations,
                errors.drops,
                errors.shaft_contacts,
            ]
        };
        let flat = self.steppers.iter().flat_map(errors).collect();
        numbers::array(py, [self.steppers.len(), 4], flat)
    }

    fn __repr__(&self) -> String {
        let (count, threads) = (self.steppers.len(), self.threads);
        format!("<palpate.SimulationBatch of {count} states on {threads} threads>")
    }
}

impl SimulationBatch {
    fn tools(&self) -> usize {
        self.models[0].prepared.tools().len()
    }

    /// How many numbers a pose has, in an array with `before` lengths before those of a pose.
    fn width(&self, shape: &[usize], before: usize) -> Result<usize, Failure> {
        let (count, tools) = (self.steppers.len(), self.tools());
        match shape.get(before - 1..) {
            Some(&[states, several, width])
                if shape.len() == before + 2 && states == count && several == tools =>
            {
                Ok(width)
            }
            _ => Err(Failure::input(format!(
                "`poses` has the shape {}; give {}({count}, {tools}, n), with n = 3, 5, 7 or 9",
                numbers::shape_words(shape),
                if before == 2 {
                    "(steps, count, tools, n): for this batch steps of "
                } else {
                    ""
                }
            ))),
        }
    }

    /// Which of the states `which` means.
    fn chosen(&self, which: Option<&Bound<'_, PyAny>>) -> Result<Vec<usize>, Failure> {
        let Some(which) = which else {
            return Ok((0..self.steppers.len()).collect());
        };
        // An array of truths is no list of numbers.
        let which = match which.hasattr("tolist")? {
            true => which.call_method0("tolist")?,
            false => which.clone(),
        };
        if let Ok(mask) = which.extract::<Vec<bool>>() {
            if mask.len() != self.steppers.len() {
                return Err(Failure::input(format!(
                    "`which` is a list of {} truths; give one for each of the {} states",
                    mask.len(),
                    self.steppers.len()
                )));
            }
            let chosen = mask.iter().enumerate().filter(|(_, is)| **is);
            return Ok(chosen.map(|(number, _)| number).collect());
        }
        if let Ok(index) = which.extract::<isize>() {
            return Ok(vec![self.index(index)?]);
        }
        let numbers: Vec<isize> = which.extract().map_err(|_| {
            Failure::input("`which` is no number of a state; give a number, a list of numbers, or a truth for each state")
        })?;
        numbers
            .into_iter()
            .map(|number| self.index(number))
            .collect()
    }

    /// The number of a state, counted from the end where it is below zero.
    pub(super) fn index(&self, index: isize) -> Result<usize, Failure> {
        let count = self.steppers.len();
        let from_begin = match index < 0 {
            true => count.checked_add_signed(index),
            false => Some(index.unsigned_abs()),
        };
        from_begin.filter(|index| *index < count).ok_or_else(|| {
            Failure::input(format!(
                "there is no state {index}; give a number from 0 to {}",
                count - 1
            ))
        })
    }

    /// All states through all steps: their forces [N], state by state.
    fn run(
        &mut self,
        py: Python<'_>,
        given: &Bound<'_, numpy::PyArrayDyn<f64>>,
        steps: usize,
        width: usize,
        marks: Option<&Bound<'_, PyAny>>,
        which: Option<&Bound<'_, PyAny>>,
    ) -> Result<Vec<f64>, Failure> {
        let (count, tools) = (self.steppers.len(), self.tools());
        let borrowed = given.try_readonly().map_err(Failure::input)?;
        let flat = borrowed.as_slice().map_err(Failure::input)?;
        check_all(flat, count * tools, width)?;
        let all = Steps {
            flat,
            width,
            steps,
            marks: self.marks(marks)?,
            goes_on: self.goes_on(which)?,
        };
        let mut forces = vec![0.0; count * steps * 3 * tools];
        let (models, steppers, threads) = (&*self.models, &mut *self.steppers, self.threads);
        py.detach(|| all.run(models, steppers, threads, &mut forces))?;
        Ok(forces)
    }

    fn marks(&self, given: Option<&Bound<'_, PyAny>>) -> Result<Vec<bool>, Failure> {
        let (count, tools) = (self.steppers.len(), self.tools());
        let Some(given) = given else {
            return Ok(vec![false; count * tools]);
        };
        let array = numbers::floats(given, "marks")?;
        if array.shape() != [count, tools] {
            return Err(Failure::input(format!(
                "`marks` has the shape {}; give a truth for each tool of each state, ({count}, {tools})",
                numbers::shape_words(array.shape())
            )));
        }
        let numbers = numbers::copied(&array)?;
        Ok(numbers.into_iter().map(|number| number != 0.0).collect())
    }

    /// Of each state, whether `which` means it.
    fn goes_on(&self, which: Option<&Bound<'_, PyAny>>) -> Result<Vec<bool>, Failure> {
        let mut goes_on = vec![false; self.steppers.len()];
        for number in self.chosen(which)? {
            goes_on[number] = true;
        }
        Ok(goes_on)
    }

    fn of_states<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Stepper) -> T,
    ) -> Bound<'py, PyArray1<T>> {
        PyArray1::from_vec(py, self.steppers.iter().map(of).collect())
    }

    fn of_tools<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        of: impl Fn(&ToolState) -> T,
    ) -> Bound<'py, PyArray2<T>> {
        let tools = self.steppers.iter();
        let tools = tools.flat_map(|stepper| &stepper.course.state.tools);
        let flat = tools.map(of).collect();
        numbers::array(py, [self.steppers.len(), self.tools()], flat)
    }
}
