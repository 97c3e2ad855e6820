use palpate_servo::{Controller, DeviceState, Pid, PidGains, Vec3, latest};

/// Where the indenter shall be when its next force begins to act.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// [m]
    pub position: Vec3,
    /// [m/s]
    pub velocity: Vec3,
}

/// Drives a device along a reference (5.1), each axis for itself.
pub struct Indenter {
    axes: [Pid; 3],
    reference: latest::Receiver<Reference>,
}

impl Indenter {
    /// With `gains`, and where to send references.
    pub fn new(gains: PidGains, first: Reference) -> (Self, latest::Sender<Reference>) {
        let (sender, reference) = latest::channel(&first);
        let axes = [Pid::new(gains); 3];
        (Self { axes, reference }, sender)
    }
}

impl Controller for Indenter {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let wanted = *self.reference.latest();
        Vec3::from_fn(|axis, _| {
            let aim = [wanted.position[axis], wanted.velocity[axis]];
            self.axes[axis].force(state.position[axis], aim, dt)
        })
    }
}
