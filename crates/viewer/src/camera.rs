//! The camera of a picture, and the ray of a pixel.
//!
//! *How we know*: `analytic::a_pixel_and_its_ray_agree`, `analytic::the_whole_organ_is_framed`.

use nalgebra::{Matrix3, Matrix4, Vector3};
use palpate_geometry::Vec3;

/// A camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Where it is [m].
    pub eye: Vec3,
    /// Its target [m].
    pub target: Vec3,
    /// The direction that is up in the picture [-].
    pub up: Vec3,
    /// The angle from the lower to the upper edge of the picture [rad].
    pub field_of_view: f64,
    /// The lamp at the lens of an endoscope; none for a room's light.
    pub lamp: Option<Lamp>,
}

/// The light of an endoscope, next to its lens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamp {
    /// The distance that it is set for [m]: what is nearer is brighter.
    pub distance: f64,
    /// Its brightness over the usual one [-].
    pub brightness: f64,
}

impl Camera {
    /// To the right, up and back to the eye, as unit vectors [-].
    pub fn axes(&self) -> [Vec3; 3] {
        let back = (self.eye - self.target)
            .try_normalize(1e-12)
            .unwrap_or_else(Vec3::z);
        let right = self.up.cross(&back).try_normalize(1e-9).unwrap_or_else(|| {
            // Looking along the up direction, any other will do.
            let other = if back.x.abs() < 0.9 {
                Vec3::x()
            } else {
                Vec3::y()
            };
            other.cross(&back).normalize()
        });
        [right, back.cross(&right), back]
    }

    /// From the target to the eye [m].
    pub fn distance(&self) -> f64 {
        (self.eye - self.target).norm()
    }

    /// The rotation from the scene to the eye's frame: right, up, back.
    pub(crate) fn eye_frame(&self) -> Matrix3<f64> {
        let [right, up, back] = self.axes();
        Matrix3::from_rows(&[right.transpose(), up.transpose(), back.transpose()])
    }

    /// From the scene to clip coordinates of a picture of the given width over height, between the
    /// distances `near` and `far` [m]; depth goes from 0 to 1.
    pub(crate) fn view_projection(&self, aspect: f64, near: f64, far: f64) -> Matrix4<f64> {
        let turn = self.eye_frame();
        let shift = -(turn * self.eye);
        let mut view = turn.to_homogeneous();
        view.fixed_view_mut::<3, 1>(0, 3).copy_from(&shift);
        let scale = 1.0 / (0.5 * self.field_of_view).tan();
        let depth = far / (near - far);
        #[rustfmt::skip]
        let projection = Matrix4::new(
            scale / aspect, 0.0, 0.0, 0.0,
            0.0, scale, 0.0, 0.0,
            0.0, 0.0, depth, near * depth,
            0.0, 0.0, -1.0, 0.0,
        );
        projection * view
    }

    /// Unit direction of sight [-] at a place of the picture: (0, 0) is its upper left corner and (1, 1)
    /// its lower right one.
    pub fn ray(&self, (across, down): (f64, f64), aspect: f64) -> Vec3 {
        let [right, up, back] = self.axes();
        let half = (0.5 * self.field_of_view).tan();
        let x = (2.0 * across - 1.0) * half * aspect;
        let y = (1.0 - 2.0 * down) * half;
        (right * x + up * y - back).normalize()
    }

    /// The place of the picture where `point` [m] is seen, and how far in front of the eye it is [m];
    /// none behind the eye.
    pub fn project(&self, point: &Vec3, aspect: f64) -> Option<((f64, f64), f64)> {
        let seen: Vector3<f64> = self.eye_frame() * (point - self.eye);
        let ahead = -seen.z;
        let half = (0.5 * self.field_of_view).tan();
        let place = |x: f64, wide: f64| 0.5 + 0.5 * x / (ahead * half * wide);
        (ahead > 0.0).then(|| ((place(seen.x, aspect), place(-seen.y, 1.0)), ahead))
    }
}
