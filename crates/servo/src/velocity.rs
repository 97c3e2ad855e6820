use crate::Vec3;

/// Time window of a velocity [s]. A difference over one tick of 1 ms would show the step of an encoder, 0.03 mm, as 30
/// mm/s; over ten it is 3 mm/s.
const WINDOW: f64 = 0.010;

/// Most ticks in a window: 10 ms at 12 kHz.
const MOST: usize = 128;

/// A velocity from positions: their difference over the last 10 ms.
#[derive(Debug, Clone)]
pub(crate) struct Velocity {
    positions: [Vec3; MOST],
    times: [f64; MOST],
    window: usize,
    seen: usize,
}

impl Velocity {
    /// For ticks of `period` [s].
    pub(crate) fn new(period: f64) -> Self {
        Self {
            positions: [Vec3::zeros(); MOST],
            times: [0.0; MOST],
            window: ((WINDOW / period).round() as usize).clamp(1, MOST - 1),
            seen: 0,
        }
    }

    /// Restarts: the next position is not reached by a motion.
    pub(crate) fn reset(&mut self) {
        self.seen = 0;
    }

    /// The velocity [m/s] with the next `position` [m] at `time` [s].
    pub(crate) fn update(&mut self, time: f64, position: &Vec3) -> Vec3 {
        let now = self.seen % MOST;
        self.positions[now] = *position;
        self.times[now] = time;
        let then = (self.seen - self.window.min(self.seen)) % MOST;
        self.seen += 1;
        let elapsed = time - self.times[then];
        if elapsed > 0.0 {
            (position - self.positions[then]) / elapsed
        } else {
            Vec3::zeros()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_hand_has_its_velocity_also_over_skipped_ticks() {
        let mut velocity = Velocity::new(1e-3);
        assert_eq!(velocity.update(0.0, &Vec3::x()), Vec3::zeros());
        for number in (1..1000).filter(|number| number % 7 != 0) {
            let time = f64::from(number) * 1e-3;
            let found = velocity.update(time, &(Vec3::x() + Vec3::y() * (0.2 * time)));
            // Rounding of positions of 1 m over 1 ms.
            assert!(
                (found - Vec3::y() * 0.2).norm() < 1e-11,
                "{number}: {found}"
            );
        }
    }
}
