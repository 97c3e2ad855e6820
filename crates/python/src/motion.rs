//! How tools move.

use std::path::PathBuf;

use numpy::PyArray3;
use palpate_files::Motion as Document;
use palpate_files::motion::{Cursor, MotionRow, Pose, ToolMotion};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};

use crate::failure::Failure;
use crate::simulator::poses;
use crate::{frames, numbers, written};

/// How one or two tools move: linear between the rows of a table.
///
/// Parameters
/// ----------
/// tools : dict of str to (time, poses)
///     By the tools' names their times [s], shape (n,), and poses, shape (n, 3), (n, 5), (n, 7) or (n, 9) as for
///     `Simulation.step`.
#[pyclass(frozen, module = "palpate")]
#[derive(Debug, Clone)]
pub(crate) struct Motion {
    pub(crate) motion: Document,
}

#[pymethods]
impl Motion {
    #[new]
    fn new(tools: &Bound<'_, PyDict>) -> Result<Self, Failure> {
        let mut made = Vec::new();
        for (name, given) in tools {
            let (name, (time, given)): (String, (Bound<'_, PyAny>, Bound<'_, PyAny>)) =
                (name.extract()?, given.extract()?);
            made.push(ToolMotion::new(&name, rows(&time, &given)?)?);
        }
        let motion = Document::new(made)?;
        Ok(Self { motion })
    }

    /// Reads a motion's file; a session is one too.
    #[classmethod]
    fn read(_class: &Bound<'_, PyType>, path: PathBuf) -> Result<Self, Failure> {
        let motion = Document::read(path)?;
        Ok(Self { motion })
    }

    /// The names of the tools.
    #[getter]
    fn tools(&self) -> Vec<String> {
        let tools = self.motion.tools().iter();
        tools.map(|tool| tool.name().to_owned()).collect()
    }

    /// Why rows may be missing, in words; None for a motion with its end mark, or from no file.
    #[getter]
    fn incomplete(&self) -> Option<String> {
        self.motion.incomplete().map(ToString::to_string)
    }

    /// When it begins [s].
    #[getter]
    fn begin(&self) -> f64 {
        self.motion.first_time_s()
    }

    /// When it ends [s].
    #[getter]
    fn end(&self) -> f64 {
        self.motion.final_time_s()
    }

    /// Where tools are at times: what `Simulation.replay` takes.
    ///
    /// Parameters
    /// ----------
    /// times : array_like, shape (n,)
    ///     The times [s].
    /// tools : list of str, optional
    ///     The names of the tools, such as `scene.tools`; without, the motion's own.
    ///
    /// Returns
    /// -------
    /// ndarray, shape (n, tools, 9) or (n, tools, 5)
    ///     Position [m], quaternion [-] where the motion states one, grip and cut; NaN where a tool is not there.
    #[pyo3(signature = (times, tools=None))]
    fn poses<'py>(
        &self,
        py: Python<'py>,
        times: &Bound<'py, PyAny>,
        tools: Option<Vec<String>>,
    ) -> Result<Bound<'py, PyArray3<f64>>, Failure> {
        let times = numbers::list(times, "times")?;
        let tools = tools.unwrap_or_else(|| self.tools());
        let turned = |row: &MotionRow| row.pose.orientation.is_some();
        let is_turned = self
            .motion
            .tools()
            .iter()
            .any(|tool| tool.rows().iter().any(turned));
        let width = if is_turned { 9 } else { 5 };
        let mut flat = Vec::with_capacity(times.len() * tools.len() * width);
        let mut cursors = vec![Cursor::default(); tools.len()];
        for time in &times {
            for (name, cursor) in tools.iter().zip(&mut cursors) {
                let tool = self.motion.tool(name);
                let pose = tool.and_then(|tool| tool.pose(*time, cursor));
                poses::write(pose.as_ref(), is_turned, &mut flat);
            }
        }
        Ok(numbers::array(py, [times.len(), tools.len(), width], flat))
    }

    /// A pandas.DataFrame with the columns of a motion's file.
    fn to_frame<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyAny>, Failure> {
        let rows = self.motion.tools().iter();
        let rows: Vec<(&str, &MotionRow)> = rows
            .flat_map(|tool| tool.rows().iter().map(|row| (tool.name(), row)))
            .collect();
        let column = |of: &dyn Fn(&Pose) -> f64| -> Vec<f64> {
            rows.iter().map(|(_, row)| of(&row.pose)).collect()
        };
        let columns = PyDict::new(py);
        let times: Vec<f64> = rows.iter().map(|(_, row)| row.time_s).collect();
        columns.set_item("time_s", times)?;
        let names: Vec<&str> = rows.iter().map(|(name, _)| *name).collect();
        columns.set_item("tool", names)?;
        for (axis, name) in ["x_m", "y_m", "z_m"].into_iter().enumerate() {
            columns.set_item(name, column(&|pose| pose.position_m[axis]))?;
        }
        if rows.iter().any(|(_, row)| row.pose.orientation.is_some()) {
            for (axis, name) in ["qx", "qy", "qz", "qw"].into_iter().enumerate() {
                let of = |pose: &Pose| pose.orientation.map_or(f64::NAN, |q| q[axis]);
                columns.set_item(name, column(&of))?;
            }
        }
        columns.set_item("grip", column(&|pose| pose.grip))?;
        let cuts: Vec<bool> = rows.iter().map(|(_, row)| row.pose.cut).collect();
        columns.set_item("cut", cuts)?;
        frames::frame(&columns, PyDict::new(py))
    }

    /// Writes a motion's file, whole or not at all. A file that exists is replaced with
    /// `overwrite=True`, else it is an error.
    #[pyo3(signature = (path, overwrite=false))]
    fn write(&self, path: PathBuf, overwrite: bool) -> Result<(), Failure> {
        written::write(&path, overwrite, |path| self.motion.write(path))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.motion == other.motion
    }

    fn __repr__(&self) -> String {
        let (tools, begin, end) = (self.tools().join(", "), self.begin(), self.end());
        format!("<palpate.Motion of {tools} from {begin:?} s to {end:?} s>")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let py = slf.py();
        let tools = PyDict::new(py);
        for tool in slf.get().motion.tools() {
            let times: Vec<f64> = tool.rows().iter().map(|row| row.time_s).collect();
            let turned = tool.rows().iter().any(|row| row.pose.orientation.is_some());
            let mut flat = Vec::new();
            for row in tool.rows() {
                poses::write(Some(&row.pose), turned, &mut flat);
            }
            let width = if turned { 9 } else { 5 };
            let rows = numbers::array(py, [times.len(), width], flat);
            tools.set_item(
                tool.name(),
                (numbers::array(py, [times.len()], times), rows),
            )?;
        }
        (slf.get_type(), (tools,)).into_pyobject(py)
    }
}

/// The rows of a tool.
fn rows(time: &Bound<'_, PyAny>, given: &Bound<'_, PyAny>) -> Result<Vec<MotionRow>, Failure> {
    let times = numbers::list(time, "time")?;
    let mut there = vec![None; times.len()];
    poses::read(given, &mut there, "time")?;
    let rows = times.iter().zip(there).enumerate();
    rows.map(|(row, (&time_s, pose))| match pose {
        Some(pose) => Ok(MotionRow { time_s, pose }),
        None => Err(Failure::input(format!(
            "row {row} of `poses` is no place; give numbers, or leave the row out"
        ))),
    })
    .collect()
}
