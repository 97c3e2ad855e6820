use palpate_servo::{Supervisor, log};

/// What a window asks of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModelCommand {
    /// Stands still, without a force, until it shall go on.
    Pause,
    /// Goes on.
    Resume,
    /// Begins anew with the organ at rest and whole.
    Reset,
    /// Closes the last cut again.
    UndoCut,
    /// Says in the session that a hand means this place, or that it is done.
    Mark,
    /// Says in the session which diameter was felt [m].
    StateDiameter(f64),
}

impl ModelCommand {
    /// What it means for the forces of the devices.
    pub(super) fn supervise(self, supervisor: &Supervisor) {
        match self {
            Self::Pause => supervisor.pause(),
            Self::Resume => supervisor.resume(),
            Self::Reset | Self::UndoCut | Self::Mark | Self::StateDiameter(_) => {}
        }
    }
}

/// Orders that have room until the model's next step.
const ROOM: usize = 64;

/// The two ends of the channel of commands.
pub(super) fn commands() -> (log::Writer<ModelCommand>, log::Reader<ModelCommand>) {
    log::ring(ROOM)
}
