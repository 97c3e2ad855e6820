//! From where a picture is taken.

use numpy::PyArray2;
use palpate_geometry::Vec3;
use palpate_viewer::{Camera as Seen, Lamp, scene_camera, scene_endoscope};
use pyo3::prelude::*;

use super::Model;
use crate::failure::Failure;
use crate::numbers;

/// From where a picture is taken, in the scene's frame.
///
/// Parameters
/// ----------
/// eye : array_like, shape (3,)
///     Where it is [m].
/// target : array_like, shape (3,)
///     What it looks at, in the middle of the picture [m].
/// up : array_like, shape (3,)
///     The direction that is up in the picture [-].
/// field_of_view : float
///     The angle from the lower to the upper edge of the picture [rad], between 0 and pi.
/// endoscope : bool
///     Whether it is an endoscope, with a lamp beside its lens, or a camera in the light of a room.
/// brightness : float
///     Brightness of the endoscope's lamp over the usual one [-].
///
/// Raises
/// ------
/// InputError
///     When the eye is at the target, or a number is outside of its range.
#[pyclass(frozen, module = "palpate")]
pub(crate) struct Camera {
    pub(super) seen: Seen,
}

#[pymethods]
impl Camera {
    #[new]
    #[pyo3(
        signature = (eye, target, up=[0.0, 0.0, 1.0], field_of_view=0.785, *, endoscope=true, brightness=1.0),
        text_signature = "(eye, target, up=(0.0, 0.0, 1.0), field_of_view=0.785, *, endoscope=True, brightness=1.0)"
    )]
    fn new(
        eye: [f64; 3],
        target: [f64; 3],
        up: [f64; 3],
        field_of_view: f64,
        endoscope: bool,
        brightness: f64,
    ) -> Result<Self, Failure> {
        let [eye, target, up] = [eye, target, up].map(Vec3::from);
        let distance = (eye - target).norm();
        let refused = if !(1e-6..1e3).contains(&distance) {
            Some(
                "the camera's `eye` is not between a micrometre and a kilometre from its `target`; move one of them",
            )
        } else if !(1e-9..1e9).contains(&up.norm()) {
            Some("the camera's `up` has no direction; give a vector such as (0, 0, 1)")
        } else if !(0.0 < field_of_view && field_of_view < std::f64::consts::PI) {
            Some(
                "the camera's `field_of_view` is no angle between 0 and pi radians; give one, such as 0.8",
            )
        } else if !(0.0..=1e3).contains(&brightness) {
            Some("the camera's `brightness` is no number from 0 to 1000; give one, such as 1")
        } else {
            None
        };
        if let Some(refused) = refused {
            return Err(Failure::input(refused));
        }
        Ok(Self {
            seen: Seen {
                eye,
                target,
                up,
                field_of_view,
                lamp: endoscope.then_some(Lamp {
                    distance,
                    brightness,
                }),
            },
        })
    }

    /// Where it is [m]: shape (3,).
    #[getter]
    fn eye(&self) -> [f64; 3] {
        self.seen.eye.into()
    }

    /// What it looks at [m]: shape (3,).
    #[getter]
    fn target(&self) -> [f64; 3] {
        self.seen.target.into()
    }

    /// The direction that is up in the picture [-]: shape (3,).
    #[getter]
    fn up(&self) -> [f64; 3] {
        self.seen.up.into()
    }

    /// The angle from the lower to the upper edge of the picture [rad].
    #[getter]
    fn field_of_view(&self) -> f64 {
        self.seen.field_of_view
    }

    /// Whether it has a lamp of its own.
    #[getter]
    fn endoscope(&self) -> bool {
        self.seen.lamp.is_some()
    }

    /// Brightness of its lamp over the usual one [-]; 1 without a lamp.
    #[getter]
    fn brightness(&self) -> f64 {
        self.seen.lamp.map_or(1.0, |lamp| lamp.brightness)
    }

    /// The rotation from the scene's frame to the camera's, x to the right, y down and z ahead, as OpenCV and ROS have
    /// it [-]: shape (3, 3). A force in the camera's frame is `rotation @ force`.
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let [right, up, back] = self.seen.axes();
        numbers::rows(py, [right, -up, -back].iter())
    }

    /// Focal lengths and principal point for a picture of a size [pixels], as OpenCV has them: shape (3, 3).
    ///
    /// Parameters
    /// ----------
    /// width, height : int
    ///     The size of the picture [pixels].
    fn intrinsics<'py>(
        &self,
        py: Python<'py>,
        width: u32,
        height: u32,
    ) -> Bound<'py, PyArray2<f64>> {
        let (width, height) = (f64::from(width), f64::from(height));
        let focal = 0.5 * height / (0.5 * self.seen.field_of_view).tan();
        let rows = [
            Vec3::new(focal, 0.0, 0.5 * width),
            Vec3::new(0.0, focal, 0.5 * height),
            Vec3::z(),
        ];
        numbers::rows(py, rows.iter())
    }

    fn __repr__(&self) -> String {
        let (eye, target) = (self.eye(), self.target());
        format!("<palpate.Camera at {eye:?} m, looking at {target:?} m>")
    }
}

impl Camera {
    pub(super) fn of(model: &Model, aspect: f64, endoscope: bool) -> Result<Self, Failure> {
        if !(1e-3..=1e3).contains(&aspect) {
            return Err(Failure::input(
                "`aspect` is no number from 0.001 to 1000; give the width of the picture over its height",
            ));
        }
        let (view, mesh) = (&model.scene.view, model.prepared.surface().mesh());
        Ok(Self {
            seen: match endoscope {
                true => scene_endoscope(view, mesh, aspect),
                false => scene_camera(view, mesh, None, aspect),
            },
        })
    }
}
