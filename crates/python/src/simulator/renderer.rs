//! Pictures of simulations, without a display.

use std::sync::{Arc, Mutex, PoisonError};

use palpate_simulate::{SimulationState, SimulationWorkspace, show};
use palpate_viewer::{Gpu, Labels, RgbaImage, Studio};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::{Camera, Model, Simulation, SimulationBatch};
use crate::failure::Failure;
use crate::numbers;

/// Sides of a picture [pixels] are no longer.
const MOST: u32 = 8192;

/// What draws pictures of an organ and its tools, without a display, on any graphics adapter that there is: also on
/// the processor, by `mesa-vulkan-drivers`. Drawing changes no simulation.
///
/// Parameters
/// ----------
/// simulation : Simulation
///     Whose scene is drawn.
/// size : (int, int)
///     Width and height of the pictures [pixels], from 1 to 8192.
///
/// Raises
/// ------
/// InputError
///     When a side is zero or too long.
/// PalpateError
///     When there is no graphics adapter.
#[pyclass(frozen, module = "palpate")]
pub(crate) struct Renderer {
    model: Arc<Model>,
    size: (u32, u32),
    drawing: Mutex<Drawing>,
}

struct Drawing {
    studio: Studio,
    /// Scratch for a model.
    workspace: (Arc<Model>, SimulationWorkspace),
}

/// Which pictures.
#[derive(Clone, Copy)]
struct ImageSelection {
    rgb: bool,
    depth: bool,
    segmentation: bool,
}

#[pymethods]
impl Renderer {
    #[new]
    #[pyo3(signature = (simulation, size=(640, 480)), text_signature = "(simulation, size=(640, 480))")]
    fn new(py: Python<'_>, simulation: &Simulation, size: (i64, i64)) -> Result<Self, Failure> {
        let side = |length: i64| {
            u32::try_from(length)
                .ok()
                .filter(|own| (1..=MOST).contains(own))
        };
        let (Some(width), Some(height)) = (side(size.0), side(size.1)) else {
            return Err(Failure::input(format!(
                "a picture of {} x {} pixels cannot be drawn; give a width and a height from 1 to {MOST}",
                size.0, size.1
            )));
        };
        let model = simulation.model.clone();
        let studio = py.detach(|| {
            Studio::with_gpu(Gpu::open()?, &model.scene, &model.prepared, (width, height))
        });
        Ok(Self {
            drawing: Mutex::new(Drawing {
                studio: studio.map_err(refused)?,
                workspace: (model.clone(), SimulationWorkspace::new(&model.prepared)),
            }),
            model,
            size: (width, height),
        })
    }

    /// Width and height of the pictures [pixels].
    #[getter]
    fn size(&self) -> (u32, u32) {
        self.size
    }

    /// Name of the graphics adapter.
    #[getter]
    fn adapter(&self) -> String {
        let drawing = self.drawing.lock().unwrap_or_else(PoisonError::into_inner);
        drawing.studio.gpu.adapter().to_owned()
    }

    /// Pictures of a state as it is now.
    ///
    /// Parameters
    /// ----------
    /// simulation : Simulation or SimulationBatch
    ///     The one that the renderer was made for, or a batch of it. Another one of the same scene may differ in its
    ///     tissue and in nothing that is seen.
    /// index : int
    ///     Which state of a batch.
    /// camera : Camera, optional
    ///     From where; without, the scene's endoscope.
    /// images : list of str
    ///     Which of "rgb", "depth" and "segmentation".
    ///
    /// Returns
    /// -------
    /// dict of ndarray
    ///     By the names in `images`: "rgb" in uint8 (height, width, 3); "depth", the distance ahead of the eye along
    ///     the line of sight to the middle of the picture, in float32 [m] (height, width), 0 where nothing is;
    ///     "segmentation" in uint8 (height, width): 0 background, 1 organ, 2 neighbour, 3 and 4 the first and the second
    ///     tool.
    #[pyo3(
        signature = (simulation, index=0, *, camera=None, images=vec!["rgb".to_owned()]),
        text_signature = "($self, simulation, index=0, *, camera=None, images=('rgb',))"
    )]
    fn draw<'py>(
        &self,
        py: Python<'py>,
        simulation: &Bound<'py, PyAny>,
        index: isize,
        camera: Option<&Camera>,
        images: Vec<String>,
    ) -> Result<Bound<'py, PyDict>, Failure> {
        let wanted = ImageSelection::of(&images)?;
        let (model, state) = state_of(simulation, index)?;
        if model.scene.organ.shape != self.model.scene.organ.shape
            || model.scene.tools.len() != self.model.scene.tools.len()
        {
            return Err(Failure::input(
                "the renderer was made for another organ; make one of this simulation",
            ));
        }
        let seen = match camera {
            Some(camera) => camera.seen,
            None => {
                let aspect = f64::from(self.size.0) / f64::from(self.size.1);
                Camera::of(&self.model, aspect, true)?.seen
            }
        };
        let (picture, labels) = py.detach(|| {
            let mut drawing = self.drawing.lock().unwrap_or_else(PoisonError::into_inner);
            drawing.studio.view.camera = seen;
            drawing.draw(&model, state, wanted)
        })?;
        let (width, height) = (self.size.0 as usize, self.size.1 as usize);
        let drawn = PyDict::new(py);
        if let Some(picture) = picture {
            let opaque = picture
                .pixels()
                .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]);
            drawn.set_item(
                "rgb",
                numbers::array(py, [height, width, 3], opaque.collect()),
            )?;
        }
        if let Some(labels) = labels {
            if wanted.depth {
                drawn.set_item("depth", numbers::array(py, [height, width], labels.depths))?;
            }
            if wanted.segmentation {
                let labels = numbers::array(py, [height, width], labels.labels);
                drawn.set_item("segmentation", labels)?;
            }
        }
        Ok(drawn)
    }

    fn __repr__(&self) -> String {
        format!(
            "<palpate.Renderer of {} x {} pixels>",
            self.size.0, self.size.1
        )
    }
}

impl ImageSelection {
    fn of(images: &[String]) -> Result<Self, Failure> {
        let mut wanted = Self {
            rgb: false,
            depth: false,
            segmentation: false,
        };
        for image in images {
            match image.as_str() {
                "rgb" => wanted.rgb = true,
                "depth" => wanted.depth = true,
                "segmentation" => wanted.segmentation = true,
                other => {
                    return Err(Failure::input(format!(
                        "there is no image {other:?}; give some of \"rgb\", \"depth\" and \"segmentation\""
                    )));
                }
            }
        }
        Ok(wanted)
    }
}

impl Drawing {
    fn draw(
        &mut self,
        model: &Arc<Model>,
        mut state: SimulationState,
        wanted: ImageSelection,
    ) -> Result<(Option<RgbaImage>, Option<Labels>), Failure> {
        // Scratch and openings follow cuts by their number, which each state counts for itself.
        if state.cuts.is_some() || !Arc::ptr_eq(model, &self.workspace.0) {
            self.workspace = (model.clone(), SimulationWorkspace::new(&model.prepared));
            self.studio.forget_cuts();
        }
        show(&model.prepared, &mut state, &mut self.workspace.1);
        let studio = &mut self.studio;
        let picture = wanted.rgb.then(|| studio.picture(&state)).transpose();
        let labels = (wanted.depth || wanted.segmentation)
            .then(|| studio.labels(&state))
            .transpose();
        Ok((picture.map_err(refused)?, labels.map_err(refused)?))
    }
}

/// A copy of what is drawn: that a surface is shown must not change when a shaft touches it.
fn state_of(
    simulation: &Bound<'_, PyAny>,
    index: isize,
) -> Result<(Arc<Model>, SimulationState), Failure> {
    if let Ok(single) = simulation.cast::<Simulation>() {
        let single = single.try_borrow().map_err(PyErr::from)?;
        return Ok((single.model.clone(), single.stepper.course.state.clone()));
    }
    let Ok(batch) = simulation.cast::<SimulationBatch>() else {
        return Err(Failure::input(
            "`simulation` is neither a Simulation nor a SimulationBatch; give one of them",
        ));
    };
    let batch = batch.try_borrow().map_err(PyErr::from)?;
    let index = batch.index(index)?;
    let state = batch.steppers[index].course.state.clone();
    Ok((batch.models[index].clone(), state))
}

fn refused(error: palpate_viewer::Error) -> Failure {
    match error.is_input() {
        true => Failure::input(error),
        false => Failure::failed(error),
    }
}
