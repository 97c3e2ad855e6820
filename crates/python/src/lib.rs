//! The Python package `palpate`: meshes, tissues, scenes, recordings and the simulator, in the words of Rust.
//!
//! ```text
//! palpate/*.py ──▶ _palpate (this crate) ──▶ characterize, devices, files, geometry, servo, simulate, viewer
//!                     │ waiting: long work on a thread of its own, the interpreter free, Ctrl-C heard
//! ```
//!
//! A class here holds a type of the libraries and converts; it decides nothing. What a library refuses becomes
//! `palpate.InputError` or `palpate.PalpateError` with the same sentence as the command's (`failure.rs`).
//! The annotations of all this stand in `python/palpate/_palpate.pyi`.
//!
//! *How we know*: `crates/python/tests`.
//!
//! *Limits*: for CPython from 3.10 on, with its global lock.

mod design;
mod documents;
mod failure;
mod fits;
mod frames;
mod isosurface;
mod jobs;
mod mesh;
mod motion;
mod numbers;
mod online;
mod recording;
mod scene;
mod session;
mod simulator;
mod tissue;
mod waiting;
mod written;

use pyo3::prelude::*;

/// What `palpate` is made of; import `palpate` instead.
#[pymodule]
fn _palpate(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<simulator::Camera>()?;
    module.add_class::<mesh::Mesh>()?;
    module.add_class::<motion::Motion>()?;
    module.add_class::<online::OnlineEstimate>()?;
    module.add_class::<recording::Recording>()?;
    module.add_class::<simulator::Renderer>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<session::Session>()?;
    module.add_class::<simulator::Simulation>()?;
    module.add_class::<simulator::SimulationBatch>()?;
    module.add_class::<simulator::Snapshot>()?;
    module.add_class::<simulator::State>()?;
    module.add_class::<simulator::Teleoperation>()?;
    module.add_class::<tissue::Tissue>()?;
    module.add_function(wrap_pyfunction!(isosurface::isosurface, module)?)?;
    module.add_function(wrap_pyfunction!(waiting::_wait, module)?)?;
    jobs::register(module)?;
    Ok(())
}
