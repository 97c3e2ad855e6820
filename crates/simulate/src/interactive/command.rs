use palpate_servo::{Supervisor, log};

/// A command from a window to the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModelCommand {
    /// Pauses, without a force, until it resumes.
    Pause,
    /// Resumes.
    Resume,
    /// Restarts with the organ at rest and intact.
    Reset,
    /// Undoes the last cut.
    UndoCut,
    /// Records in the session that a hand means this place, or that it is done.
    Mark,
    /// Records the estimated diameter in the session [m].
    StateDiameter(f64),
}

impl ModelCommand {
    /// Its consequence for the forces of the devices.
    pub(super) fn supervise(self, supervisor: &Supervisor) {
        match self {
            Self::Pause => supervisor.pause(),
            Self::Resume => supervisor.resume(),
            Self::Reset | Self::UndoCut | Self::Mark | Self::StateDiameter(_) => {}
        }
    }
}

/// Capacity for commands until the model's next step.
const CAPACITY: usize = 64;

/// The two ends of the channel of commands.
pub(super) fn commands() -> (log::Writer<ModelCommand>, log::Reader<ModelCommand>) {
    log::ring(CAPACITY)
}
