use palpate_files::scene;
use palpate_geometry::Vec3;
use palpate_servo::latest::Receiver;
use palpate_servo::{AffineForce, Controller, DeviceState, Extrapolator, HandOver};

use super::DevicePlacement;
use crate::ShaftFriction;

/// Renders a force from the model's answers at every tick of the servo loop.
pub struct ForceRenderer {
    answers: Receiver<AffineForce>,
    extrapolator: Extrapolator,
    placement: DevicePlacement,
    force_scale: f64,
    friction: ShaftFriction,
    /// Last force of the abdominal wall, in the device's frame [N].
    of_wall: Vec3,
    time: f64,
}

impl ForceRenderer {
    /// From the model's `answers`, with the force times `force_scale` [-].
    pub fn new(
        answers: Receiver<AffineForce>,
        extrapolator: Extrapolator,
        placement: DevicePlacement,
        force_scale: f64,
    ) -> Self {
        Self {
            answers,
            extrapolator,
            placement,
            force_scale,
            friction: ShaftFriction::default(),
            of_wall: Vec3::zeros(),
            time: f64::NEG_INFINITY,
        }
    }
}

impl Controller for ForceRenderer {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        self.time = state.time;
        self.extrapolator.receive(self.answers.latest());
        if !state.present {
            self.friction = ShaftFriction::default();
            self.of_wall = Vec3::zeros();
            return Vec3::zeros();
        }
        let tip = self.placement.tip(&state.position);
        let force = self.extrapolator.force(state.time, &tip);
        let wall = self
            .placement
            .wall_force(&state.position, &mut self.friction, dt);
        self.of_wall = wall * self.force_scale;
        self.placement.force_on_handle(&state.position, &force) * self.force_scale + self.of_wall
    }

    fn added(&self) -> Vec3 {
        self.of_wall
    }

    fn age(&self) -> Option<f64> {
        Some(self.extrapolator.age(self.time))
    }

    fn overdue(&self) -> Option<f64> {
        Some(self.extrapolator.overdue(self.time))
    }
}

/// The servo loop's value for a scene's word.
pub(super) fn hand_over(word: scene::HandOver) -> HandOver {
    match word {
        scene::HandOver::LocalModel => HandOver::LocalModel,
        scene::HandOver::Linear => HandOver::Linear,
        scene::HandOver::Hold => HandOver::Hold,
    }
}
