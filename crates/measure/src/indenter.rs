use palpate_servo::{Controller, DeviceState, Pid, PidGains, Vec3, latest};

/// Commanded state of the indenter when its next force begins to act.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// Position [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Whether the indenter is driven there, or has no force.
    pub driven: bool,
}

impl Reference {
    /// At zero, where it stays.
    pub(crate) fn at_rest() -> Self {
        Self {
            position: Vec3::zeros(),
            velocity: Vec3::zeros(),
            driven: true,
        }
    }
}

/// Drives a device along a reference (5.1), each axis for itself.
pub struct Indenter {
    gains: PidGains,
    axes: [Pid; 3],
    reference: latest::Receiver<Reference>,
    /// Time since the last reference [s].
    silent: f64,
}

/// How long a reference is followed [s]: a rig sends one with every tick.
const FOLLOWED: f64 = 0.010;

impl Indenter {
    /// With `gains`, and where to send references.
    pub fn new(gains: PidGains, first: Reference) -> (Self, latest::Sender<Reference>) {
        let (sender, reference) = latest::channel(&first);
        let axes = [Pid::new(gains); 3];
        let own = Self {
            gains,
            axes,
            reference,
            silent: 0.0,
        };
        (own, sender)
    }
}

impl Controller for Indenter {
    fn update(&mut self, state: &DeviceState, dt: f64) -> Vec3 {
        let is_updated = self.reference.has_update();
        self.silent = if is_updated { 0.0 } else { self.silent + dt };
        let commanded = *self.reference.latest();
        if !commanded.driven {
            // Forgets the integral, which it would have to undo later.
            self.axes = [Pid::new(self.gains); 3];
            return Vec3::zeros();
        }
        Vec3::from_fn(|axis, _| {
            let aim = [commanded.position[axis], commanded.velocity[axis]];
            self.axes[axis].force(state.position[axis], aim, dt)
        })
    }

    fn age(&self) -> Option<f64> {
        Some(self.silent)
    }

    fn overdue(&self) -> Option<f64> {
        Some(self.silent - FOLLOWED)
    }
}
