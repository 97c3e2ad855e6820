//! Thermal model of a motor: beyond its continuous force it warms up.

/// Thermal load of the motors: the mean square of the force, with a time constant τ. τ d(q²)/dt = F² − q².
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ThermalModel {
    square: f64,
}

/// The part of the continuous force from which on the limit of the force decreases [-].
const FOLDING: f64 = 0.8;

impl ThermalModel {
    /// Applies a `force` [N] for `dt` [s], with the time constant `time` [s].
    pub fn add(&mut self, force: f64, dt: f64, time: f64) {
        let part = -(-dt / time).exp_m1();
        self.square += (force * force - self.square) * part;
    }

    /// q, the constant force with the same thermal load [N].
    pub fn load(&self) -> f64 {
        self.square.sqrt()
    }

    /// The current limit of the force [N]: `most` [N] until q reaches 0.8 of the `continuous` force [N], then linear
    /// down to the continuous force itself, at which q stays.
    pub fn most(&self, most: f64, continuous: f64) -> f64 {
        let part = (self.load() / continuous - FOLDING) / (1.0 - FOLDING);
        if part <= 0.0 || most <= continuous {
            return most;
        }
        most + (continuous - most) * part.min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIME: f64 = 30.0;

    /// Judge: q² = F² (1 − e^(−t/τ)), so that folding begins at −τ ln(1 − (0.8 c/F)²).
    #[test]
    fn a_peak_lasts_for_its_time_and_ends_at_the_continuous_force() {
        for (peak, continuous) in [(8.5, 1.4), (3.0, 1.4)] {
            let mut thermal = ThermalModel::default();
            let (mut began, mut force) = (None, peak);
            for tick in 0..300_000 {
                force = thermal.most(peak, continuous);
                if force < peak {
                    began.get_or_insert(f64::from(tick) * 1e-3);
                }
                thermal.add(force, 1e-3, TIME);
            }
            let expected = -TIME * (1.0 - (FOLDING * continuous / peak).powi(2)).ln();
            // To the tick.
            assert!(
                (began.unwrap() - expected).abs() < 2e-3,
                "{began:?} {expected}"
            );
            // Ten τ later.
            assert!((force / continuous - 1.0).abs() < 1e-3, "{force}");
        }
    }

    #[test]
    fn rest_cools_and_a_motor_without_bounds_has_none() {
        let mut thermal = ThermalModel::default();
        thermal.add(10.0, 60.0, TIME);
        // Rounding.
        assert!((thermal.most(8.5, 1.4) - 1.4).abs() < 1e-12);
        thermal.add(0.0, 300.0, TIME);
        assert_eq!(thermal.most(8.5, 1.4), 8.5);
        assert_eq!(thermal.most(3.0, f64::INFINITY), 3.0);
        assert_eq!(thermal.most(1.0, 1.4), 1.0);
    }
}
