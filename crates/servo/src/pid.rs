use std::f64::consts::TAU;

/// The gains of a PID controller (5.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PidGains {
    /// K_p [N/m].
    pub proportional: f64,
    /// K_d [N s/m].
    pub derivative: f64,
    /// K_i [N/(m s)].
    pub integral: f64,
    /// The largest force of the integral [N]: it is saturated there, so that it does not wind up.
    pub integral_force: f64,
    /// Corner of the velocity filter [Hz].
    pub cutoff: f64,
}

impl PidGains {
    /// Tuned on the virtual PHANTOM: tracks sines of 2 mm from 0.5 to 8 Hz within 3 % and 2°. The source gives no
    /// gains.
    pub fn tuned() -> Self {
        Self {
            proportional: 3000.0,
            derivative: 20.0,
            integral: 20_000.0,
            integral_force: 1.0,
            cutoff: 150.0,
        }
    }

    /// Half the gains, for devices with more delay.
    pub fn gentle() -> Self {
        Self {
            proportional: 1500.0,
            derivative: 12.0,
            integral: 8000.0,
            ..Self::tuned()
        }
    }
}

/// The PID controller of one axis (5.1).
#[derive(Debug, Clone, Copy)]
pub struct Pid {
    gains: PidGains,
    integral: f64,
    velocity: f64,
    last: Option<f64>,
}

impl Pid {
    /// At rest.
    pub fn new(gains: PidGains) -> Self {
        Self {
            gains,
            integral: 0.0,
            velocity: 0.0,
            last: None,
        }
    }

    /// The force [N] at `place` [m], `dt` [s] after the last call, for the `wanted` position [m] and velocity [m/s].
    pub fn force(&mut self, place: f64, commanded: [f64; 2], dt: f64) -> f64 {
        let gains = self.gains;
        if dt > 0.0 {
            let moved = self.last.map_or(0.0, |last| (place - last) / dt);
            self.velocity += (moved - self.velocity) * (1.0 - (-TAU * gains.cutoff * dt).exp());
        }
        self.last = Some(place);
        let error = commanded[0] - place;
        let most = gains.integral_force;
        self.integral = (self.integral + gains.integral * error * dt).clamp(-most, most);
        gains.proportional * error
            + gains.derivative * (commanded[1] - self.velocity)
            + self.integral
    }
}
