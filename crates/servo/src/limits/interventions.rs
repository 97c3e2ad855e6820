/// How often each stage changed a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Interventions {
    /// Releases of the dead-man's switch.
    pub dead_man_released: u64,
    /// Ticks without force, after one that missed its deadline.
    pub deadline_missed: u64,
    /// Ticks with an overdue, fading answer of the model.
    pub faded: u64,
    /// Ticks in which the passivity controller dissipated energy.
    pub damped: u64,
    /// Ticks in a wall of the workspace.
    pub walls: u64,
    /// Ticks in which the force was saturated at the limit.
    pub saturated: u64,
    /// Ticks in which the thermal limit saturated the force.
    pub thermally_limited: u64,
    /// Ticks in which the slew rate limited the force.
    pub rate_limited: u64,
}

impl Interventions {
    /// The sum over all stages.
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
