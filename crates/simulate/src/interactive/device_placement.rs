use nalgebra::UnitQuaternion;
use palpate_geometry::Vec3;

use crate::{ShaftFriction, Trocar};

/// The placement of a device in the scene: x_scene = origin + scale · rotation x_device. With a trocar its handle is
/// the hand, else the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DevicePlacement {
    /// Position of the device's origin in the scene [m].
    pub origin: Vec3,
    /// The rotation from the device's frame to the scene's.
    pub rotation: UnitQuaternion<f64>,
    /// Motion in the scene over motion of the hand [-].
    pub scale: f64,
    /// The trocar through which the handle moves the tip; none for a device that moves the tip itself.
    pub trocar: Option<Trocar>,
}

impl Default for DevicePlacement {
    /// The device's frame is the scene's.
    fn default() -> Self {
        Self {
            origin: Vec3::zeros(),
            rotation: UnitQuaternion::identity(),
            scale: 1.0,
            trocar: None,
        }
    }
}

impl DevicePlacement {
    /// Maps a position of the device [m] to the scene [m].
    pub fn place_in_scene(&self, position: &Vec3) -> Vec3 {
        self.origin + self.vector_in_scene(position)
    }

    /// Maps a displacement [m] or velocity [m/s] of the device to the scene.
    pub fn vector_in_scene(&self, vector: &Vec3) -> Vec3 {
        self.rotation * (vector * self.scale)
    }

    /// The tip [m] of a handle at `position` of the device [m].
    pub fn tip(&self, position: &Vec3) -> Vec3 {
        let hand = self.place_in_scene(position);
        self.trocar.map_or(hand, |trocar| trocar.tip(&hand))
    }

    /// The force on a handle at `position` of the device [m], in the device's frame, due to a `force` on the tip [N].
    pub fn force_on_handle(&self, position: &Vec3, force: &Vec3) -> Vec3 {
        let hand = self.place_in_scene(position);
        let felt = self
            .trocar
            .map_or(*force, |trocar| trocar.force_on_hand(&hand, force));
        self.force_in_device(&felt)
    }

    /// The force on the tip [N] that gives `force` in the device's frame on such a handle [N].
    pub fn force_on_tip(&self, position: &Vec3, force: &Vec3) -> Vec3 {
        let force = self.force_in_scene(force);
        let hand = self.place_in_scene(position);
        self.trocar
            .map_or(force, |trocar| trocar.force_on_tip(&hand, &force))
    }

    /// The force of the abdominal wall on such a handle, in the device's frame [N], `dt` [s] after the last.
    pub fn wall_force(&self, position: &Vec3, friction: &mut ShaftFriction, dt: f64) -> Vec3 {
        let Some(trocar) = &self.trocar else {
            return Vec3::zeros();
        };
        let hand = self.place_in_scene(position);
        self.force_in_device(&trocar.wall_force(&hand, friction, dt))
    }

    /// Maps a force from the scene's frame to the device's [N]. Displacements are scaled, forces are not.
    pub fn force_in_device(&self, force: &Vec3) -> Vec3 {
        self.rotation.inverse() * force
    }

    /// Maps a force from the device's frame to the scene's [N].
    pub fn force_in_scene(&self, force: &Vec3) -> Vec3 {
        self.rotation * force
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_and_a_force_go_there_and_back() {
        let placement = DevicePlacement {
            origin: Vec3::x(),
            rotation: UnitQuaternion::from_axis_angle(&Vec3::z_axis(), std::f64::consts::FRAC_PI_2),
            scale: 2.0,
            trocar: None,
        };
        let place = placement.place_in_scene(&Vec3::x());
        // A quarter turn takes x to y; rounding of the cosine.
        assert!((place - Vec3::new(1.0, 2.0, 0.0)).norm() < 1e-12);
        let force = placement.force_in_device(&Vec3::y());
        assert!((force - Vec3::x()).norm() < 1e-12);
        assert!((placement.force_in_scene(&force) - Vec3::y()).norm() < 1e-12);
    }
}
