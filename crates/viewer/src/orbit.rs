use palpate_files::scene;
use palpate_geometry::{AabbTree, TriangleMesh, Vec3};

use crate::{Camera, Lamp};

/// Part of the picture that an organ fills when it is framed.
const FILLED: f64 = 0.86;

/// Steepest look from above or below [rad]; beyond it up and sight would be one.
const STEEPEST: f64 = 1.5;

/// Azimuth of a view of a place, from the direction outwards [rad], and its least and largest elevation [rad]: not
/// along a tool that stands there.
const AZIMUTH_OFFSET: f64 = 0.5;
const LOWEST: f64 = 0.4;
const HIGHEST: f64 = 0.9;

/// Angle of an endoscope [rad], and its way to the organ over that of the camera in the room [-].
const WIDE: f64 = 1.25;
const NEARER: f64 = 0.66;

/// A camera that orbits its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// Center of the orbit [m].
    pub target: Vec3,
    /// From there to the eye [m].
    pub distance: f64,
    /// Around the vertical, from the front (-y) towards the patient's left (+x) [rad].
    pub azimuth: f64,
    /// Above the horizontal [rad].
    pub elevation: f64,
    /// From the lower to the upper edge of the picture [rad].
    pub field_of_view: f64,
}

impl Orbit {
    /// From in front, a little above and to the side, so that `mesh` fills a picture of the given width
    /// over height.
    pub fn framing(mesh: &TriangleMesh, field_of_view: f64, aspect: f64) -> Self {
        let (low, high) = mesh.bounds();
        let orbit = Self {
            target: 0.5 * (low + high),
            distance: (high - low).norm(),
            azimuth: 0.30,
            elevation: 0.38,
            field_of_view,
        };
        orbit.filled_by(mesh, aspect)
    }

    /// From the same direction, as far away as `mesh` needs.
    fn filled_by(mut self, mesh: &TriangleMesh, aspect: f64) -> Self {
        let camera = self.camera();
        let to_eye = camera.eye_frame();
        let half = FILLED * (0.5 * self.field_of_view).tan();
        let needed = mesh.vertices().iter().map(|vertex| {
            let seen = to_eye * (vertex - self.target);
            seen.z + (seen.x.abs() / (half * aspect)).max(seen.y.abs() / half)
        });
        self.distance = needed.fold(0.0, f64::max);
        self
    }

    /// The same organ with `place` [m] before it: from there if it would be hidden, and else as it is.
    fn before_place(self, place: &Vec3, mesh: &TriangleMesh, aspect: f64) -> Self {
        let out = place - self.target;
        let [_, _, back] = self.camera().axes();
        if out.dot(&back) >= 0.0 {
            return self;
        }
        let turned = Self {
            azimuth: out.x.atan2(-out.y) + AZIMUTH_OFFSET,
            elevation: (out.z / out.norm()).asin().clamp(-LOWEST, HIGHEST),
            ..self
        };
        turned.filled_by(mesh, aspect)
    }

    /// The same organ from where `camera` is, upright.
    #[must_use]
    pub fn from_the_side_of(self, camera: &Camera) -> Self {
        let out = camera.eye - camera.target;
        let distance = out.norm().max(1e-6);
        Self {
            target: camera.target,
            distance,
            azimuth: out.x.atan2(-out.y),
            elevation: (out.z / distance).asin().clamp(-STEEPEST, STEEPEST),
            field_of_view: self.field_of_view,
        }
    }

    /// The camera there.
    pub fn camera(&self) -> Camera {
        let (sin, cos) = self.elevation.sin_cos();
        let out = Vec3::new(cos * self.azimuth.sin(), -cos * self.azimuth.cos(), sin);
        Camera {
            eye: self.target + self.distance * out,
            target: self.target,
            up: Vec3::z(),
            field_of_view: self.field_of_view,
            lamp: None,
        }
    }

    /// Goes around by the given angles [rad]: to the right of the picture, and up.
    pub fn turn(&mut self, right: f64, up: f64) {
        self.azimuth = (self.azimuth + right) % std::f64::consts::TAU;
        self.elevation = (self.elevation + up).clamp(-STEEPEST, STEEPEST);
    }

    /// Comes nearer by `factor` [-]: 0.5 halves the distance, within `limits` [m].
    pub fn approach(&mut self, factor: f64, limits: (f64, f64)) {
        self.distance = (self.distance * factor).clamp(limits.0, limits.1);
    }

    /// Where the line of sight meets the organ, from the target towards the eye [m]; zero where it does not.
    pub fn before(&self, mesh: &TriangleMesh, tree: &AabbTree) -> f64 {
        let [_, _, back] = self.camera().axes();
        let (low, high) = mesh.bounds();
        let far = self.distance + (high - low).norm();
        let from = self.target + far * back;
        tree.cast(mesh, &from, &-back, far)
            .map_or(0.0, |hit| far - hit.distance)
    }

    /// An endoscope that looks from the same side, nearer and with a wide angle, lit by its own lamp. The
    /// organ begins `before` [m] the target.
    pub fn endoscope(&self, before: f64) -> Camera {
        let narrow = self.camera();
        let [_, _, back] = narrow.axes();
        let distance = NEARER * (self.distance - before).max(1e-3);
        Camera {
            eye: self.target + (before + distance) * back,
            field_of_view: WIDE,
            lamp: Some(Lamp {
                distance,
                brightness: 1.0,
            }),
            ..narrow
        }
    }
}

/// The camera that a scene asks for; what it does not say frames `mesh`, from the side of `place` [m].
pub fn scene_camera(
    view: &scene::View,
    mesh: &TriangleMesh,
    place: Option<&Vec3>,
    aspect: f64,
) -> Camera {
    let orbit = Orbit::framing(mesh, view.field_of_view_rad, aspect);
    let framing = match place {
        Some(place) => orbit.before_place(place, mesh, aspect).camera(),
        None => orbit.camera(),
    };
    let target = view.target_m.map_or(framing.target, Vec3::from);
    Camera {
        // A target alone is looked at from where the whole organ would be.
        eye: view
            .eye_m
            .map_or(framing.eye - framing.target + target, Vec3::from),
        target,
        up: view.up.map_or(framing.up, Vec3::from),
        ..framing
    }
}

/// The endoscope that a scene asks for: from its eye if it says where that is, else before the organ.
pub fn scene_endoscope(view: &scene::View, mesh: &TriangleMesh, aspect: f64) -> Camera {
    let camera = scene_camera(view, mesh, None, aspect);
    if view.eye_m.is_some() {
        let distance = camera.distance();
        return Camera {
            lamp: Some(Lamp {
                distance,
                brightness: 1.0,
            }),
            ..camera
        };
    }
    let orbit = Orbit {
        target: camera.target,
        ..Orbit::framing(mesh, view.field_of_view_rad, aspect)
    };
    orbit.endoscope(orbit.before(mesh, &AabbTree::new(mesh)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_geometry::Organ;

    /// Judge: the line of sight. What is hidden behind the organ comes before it, all of it in the picture.
    #[test]
    fn a_place_behind_the_organ_is_looked_at_from_there() {
        let mesh = Organ::Kidney.surface_mesh(400).unwrap();
        let first = Orbit::framing(&mesh, 0.785, 1.6);
        for vertex in mesh.vertices() {
            let orbit = first.before_place(vertex, &mesh, 1.6);
            let [_, _, back] = orbit.camera().axes();
            assert!((vertex - orbit.target).dot(&back) >= 0.0, "{vertex}");
            let camera = orbit.camera();
            for other in mesh.vertices() {
                let seen = camera.eye_frame() * (other - camera.eye);
                assert!((seen.y / seen.z).abs() < (0.5_f64 * 0.785).tan());
            }
        }
    }
}
