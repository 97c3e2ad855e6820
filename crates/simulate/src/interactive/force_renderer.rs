use palpate_files::scene;
use palpate_geometry::Vec3;
use palpate_servo::latest::Receiver;
use palpate_servo::watch::Pulse;
use palpate_servo::{
    AffineForce, Controller, DeviceState, Extrapolator, ForceState, HandOver, StopReason,
    Supervisor,
};

use super::Mount;
use crate::ShaftFriction;

/// What makes a force of the model's answers at every tick of the servo loop.
pub struct ForceRenderer {
    answers: Receiver<AffineForce>,
    extrapolator: Extrapolator,
    mount: Mount,
    force_scale: f64,
    friction: ShaftFriction,
    /// What the abdominal wall did last, in the device's frame [N].
    of_wall: Vec3,
    time: f64,
    pulse: Pulse,
    stop_button: Option<StopButton>,
}

/// Buttons of a device that take all forces of a session off for as long as one of them is pressed.
pub(super) struct StopButton {
    /// Bit by bit.
    pub(super) buttons: u32,
    pub(super) supervisor: Supervisor,
}

impl StopButton {
    fn look(&self, pressed: u32) {
        if pressed & self.buttons != 0 && self.supervisor.state() != ForceState::Off {
            self.supervisor.trip_because(StopReason::DeviceButton);
        }
    }
}

impl ForceRenderer {
    /// From the model's `answers`, with the force times `force_scale` [-].
    pub fn new(
        answers: Receiver<AffineForce>,
        extrapolator: Extrapolator,
        mount: Mount,
        force_scale: f64,
    ) -> Self {
        Self {
            answers,
            extrapolator,
            mount,
            force_scale,
            friction: ShaftFriction::default(),
            of_wall: Vec3::zeros(),
            time: f64::NEG_INFINITY,
            pulse: Pulse::default(),
            stop_button: None,
        }
    }

    /// The same with a `pulse` that beats at every tick.
    pub(super) fn watched_by(mut self, pulse: Pulse) -> Self {
        self.pulse = pulse;
        self
    }

    /// The same with a stop button on its device.
    pub(super) fn stopped_by(mut self, button: StopButton) -> Self {
        self.stop_button = Some(button);
        self
    }
}

impl Drop for ForceRenderer {
    /// A loop that has ended does not hang.
    fn drop(&mut self) {
        self.pulse.end();
    }
}

impl Controller for ForceRenderer {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        self.time = state.time;
        self.pulse.beat(state.time);
        if let Some(button) = &self.stop_button {
            button.look(state.buttons);
        }
        self.extrapolator.receive(self.answers.latest());
        if !state.present {
            self.friction = ShaftFriction::default();
            self.of_wall = Vec3::zeros();
            return Vec3::zeros();
        }
        let velocity = state.velocity.unwrap_or_else(Vec3::zeros);
        let tip = self.mount.tip(&state.position);
        let of_tip = self.mount.velocity_of_tip(&state.position, &velocity);
        let force = self.extrapolator.force(state.time, &tip, &of_tip);
        let wall = self
            .mount
            .wall_force(&state.position, &mut self.friction, dt);
        self.of_wall = wall * self.force_scale;
        self.mount.force_on_handle(&state.position, &force) * self.force_scale + self.of_wall
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

/// The scene's word as the servo loop has it.
pub(super) fn hand_over(word: scene::HandOver) -> HandOver {
    match word {
        scene::HandOver::LocalModel => HandOver::LocalModel,
        scene::HandOver::Linear => HandOver::Linear,
        scene::HandOver::Hold => HandOver::Hold,
    }
}
