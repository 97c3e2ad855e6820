/// Deviations of a machine from its equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imperfections {
    /// Step of the encoders, at the handle [m]; zero for none.
    pub encoder_step: f64,
    /// The largest force of the amplifiers [N].
    pub peak_force: f64,
    /// Step of their digital converter [N]; zero for none.
    pub force_step: f64,
    /// Dry friction at the handle [N].
    pub friction: f64,
    /// Ticks from a command to its force.
    pub delay: usize,
    /// When it is lost: from then on it does not answer [s]; infinite for one that stays.
    pub disconnect_time: f64,
}

/// Most ticks of delay.
pub(crate) const LONGEST_DELAY: usize = 16;

impl Imperfections {
    /// None at all.
    pub fn none() -> Self {
        Self {
            encoder_step: 0.0,
            peak_force: f64::INFINITY,
            force_step: 0.0,
            friction: 0.0,
            delay: 0,
            disconnect_time: f64::INFINITY,
        }
    }

    /// Those of a PHANTOM Premium 1.5: 30 µm (section 5.2.1) and 8.5 N with twelve bits; the friction is what
    /// its maker states.
    pub fn premium() -> Self {
        let peak_force = 8.5;
        Self {
            encoder_step: 30e-6,
            peak_force,
            force_step: 2.0 * peak_force / 4096.0,
            friction: 0.04,
            delay: 0,
            disconnect_time: f64::INFINITY,
        }
    }

    /// Force of the amplifiers for a commanded `force` [N].
    pub(crate) fn amplified(&self, force: f64) -> f64 {
        let within = force.clamp(-self.peak_force, self.peak_force);
        to_steps(within, self.force_step)
    }

    /// Encoder reading of a `place` [m].
    pub(crate) fn encoder_reading(&self, place: f64) -> f64 {
        to_steps(place, self.encoder_step)
    }
}

fn to_steps(value: f64, step: f64) -> f64 {
    if step > 0.0 {
        (value / step).round() * step
    } else {
        value
    }
}
