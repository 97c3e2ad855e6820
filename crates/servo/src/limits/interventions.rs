/// How often the stages changed a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Interventions {
    /// Times that a hand let go of its dead-man's switch.
    pub dead_man_released: u64,
    /// Ticks without force, after one that was too late.
    pub deadline_missed: u64,
    /// Ticks with an answer of the model beyond its time, which fades.
    pub faded: u64,
    /// Ticks in which energy was kept from the hand.
    pub damped: u64,
    /// Ticks in a wall of the workspace.
    pub walls: u64,
    /// Ticks in which a force was shortened to the largest that is allowed.
    pub saturated: u64,
    /// Ticks in which motors that were warm had less than that.
    pub thermally_limited: u64,
    /// Ticks in which a force rose as fast as it may.
    pub rate_limited: u64,
}

impl Interventions {
    /// All of them, whichever stage it was.
    pub fn count(&self) -> u64 {
        let Self {
            dead_man_released,
            deadline_missed,
            faded,
            damped,
            walls,
            saturated,
            thermally_limited,
            rate_limited,
        } = *self;
        dead_man_released
            + deadline_missed
            + faded
            + damped
            + walls
            + saturated
            + thermally_limited
            + rate_limited
    }
}
