//! What there is to know after a step.

use numpy::{PyArray1, PyArray2, PyArray3};
use palpate_geometry::Vec3;
use palpate_simulate::ToolState;
use pyo3::prelude::*;

use super::stepper::SavedState;
use crate::numbers;

/// What a simulation was after a step. Arrays have a row for each tool, in the order of the scene.
#[pyclass(frozen, module = "palpate")]
pub(crate) struct State {
    tools: Vec<Tool>,
    time: f64,
    cuts: Option<(usize, f64)>,
}

/// What is told of a tool.
#[derive(Debug, Clone)]
struct Tool {
    position: Option<[f64; 3]>,
    orientation: [f64; 4],
    force: Vec3,
    torque: Vec3,
    stiffness: nalgebra::Matrix3<f64>,
    depth: f64,
    contact: bool,
    /// Where it touches [m], and the normal there [-].
    touched: Option<(Vec3, Vec3)>,
    holds: bool,
    grip_force: f64,
    events: Vec<&'static str>,
}

impl State {
    pub(super) fn of(course: &SavedState) -> Self {
        let state = &course.state;
        Self {
            tools: state.tools.iter().map(Tool::of).collect(),
            time: course.clock.time,
            cuts: state
                .cuts
                .as_ref()
                .map(|cuts| (cuts.count(), cuts.length())),
        }
    }
}

impl Tool {
    fn of(tool: &ToolState) -> Self {
        let is_there = tool.pose.is_some();
        Self {
            position: tool.pose.map(|pose| pose.position_m),
            orientation: match is_there {
                true => tool.row.orientation,
                false => [f64::NAN; 4],
            },
            force: tool.force,
            torque: tool.torque,
            stiffness: tool.stiffness,
            depth: if is_there { tool.row.depth_m } else { 0.0 },
            contact: is_there && tool.row.contact,
            touched: tool
                .contact
                .map(|contact| (contact.point(), contact.normal())),
            holds: tool.is_grasping(),
            grip_force: tool.grip_force,
            events: tool.row.events.iter().map(|event| event.word()).collect(),
        }
    }
}

#[pymethods]
impl State {
    /// The time [s].
    #[getter]
    fn time(&self) -> f64 {
        self.time
    }

    /// Where the tips are [m]; NaN for a tool that is not there: shape (tools, 3).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let flat = |tool: &Tool| tool.position.unwrap_or([f64::NAN; 3]);
        let flat = self.tools.iter().flat_map(flat).collect();
        numbers::array(py, [self.tools.len(), 3], flat)
    }

    /// Quaternions (qx, qy, qz, qw) that map tool to scene [-]; NaN for a tool that is not there: shape (tools, 4).
    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let flat = self
            .tools
            .iter()
            .flat_map(|tool| tool.orientation)
            .collect();
        numbers::array(py, [self.tools.len(), 4], flat)
    }

    /// Forces on the tools [N]: shape (tools, 3).
    #[getter]
    fn forces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        numbers::rows(py, self.tools.iter().map(|tool| &tool.force))
    }

    /// Torques on the tools about their tips [N m]: shape (tools, 3). Tissue that bears on the shaft of a tool without a
    /// trocar makes them.
    #[getter]
    fn torques<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        numbers::rows(py, self.tools.iter().map(|tool| &tool.torque))
    }

    /// Stiffnesses of the contacts or of held tissue, in the scene's frame [N/m]; zero without either: shape
    /// (tools, 3, 3).
    #[getter]
    fn stiffnesses<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<f64>> {
        let flat = |tool: &Tool| tool.stiffness.transpose().as_slice().to_vec();
        let flat = self.tools.iter().flat_map(flat).collect();
        numbers::array(py, [self.tools.len(), 3, 3], flat)
    }

    /// How far the tips are below the rest surface [m]; 0 without contact: shape (tools,).
    #[getter]
    fn depths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let depths = self.tools.iter().map(|tool| tool.depth).collect();
        PyArray1::from_vec(py, depths)
    }

    /// Which tools touch the organ: bool, shape (tools,).
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let contacts = self.tools.iter().map(|tool| tool.contact).collect();
        PyArray1::from_vec(py, contacts)
    }

    /// Touched points of the rest surface [m]; NaN without contact: shape (tools, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.of_contact(py, |(point, _)| point)
    }

    /// Outward unit normals of the rest surface there [-]; NaN without contact: shape (tools, 3).
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.of_contact(py, |(_, normal)| normal)
    }

    /// Which tools' jaws hold tissue: bool, shape (tools,).
    #[getter]
    fn holds<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let holds = self.tools.iter().map(|tool| tool.holds).collect();
        PyArray1::from_vec(py, holds)
    }

    /// With how much each jaw presses on the tissue that it holds [N]; 0 without: shape (tools,).
    #[getter]
    fn grip_forces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let forces = self.tools.iter().map(|tool| tool.grip_force).collect();
        PyArray1::from_vec(py, forces)
    }

    /// What happened to each tool in the step, by the words of a session: a list for each tool.
    #[getter]
    fn events(&self) -> Vec<Vec<&'static str>> {
        self.tools.iter().map(|tool| tool.events.clone()).collect()
    }

    /// How many cuts there are; 0 where nothing cuts.
    #[getter]
    fn cuts(&self) -> usize {
        self.cuts.map_or(0, |(count, _)| count)
    }

    /// Length of all cuts over the resting surface [m].
    #[getter]
    fn cut_length(&self) -> f64 {
        self.cuts.map_or(0.0, |(_, length)| length)
    }

    fn __repr__(&self) -> String {
        let forces = self
            .tools
            .iter()
            .map(|tool| format!("{:.4} N", tool.force.norm()));
        let forces: Vec<String> = forces.collect();
        format!(
            "<palpate.State at {:?} s, {}>",
            self.time,
            forces.join(", ")
        )
    }
}

impl State {
    fn of_contact<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn((Vec3, Vec3)) -> Vec3,
    ) -> Bound<'py, PyArray2<f64>> {
        let none = Vec3::repeat(f64::NAN);
        let all: Vec<Vec3> = self
            .tools
            .iter()
            .map(|tool| tool.touched.map_or(none, &of))
            .collect();
        numbers::rows(py, all.iter())
    }
}
