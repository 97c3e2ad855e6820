//! Extrapolation: from the model's last answers to a force at every tick.
//!
//! `hold`: f = f₀. `linear`: f = f₀ + (f₀ − f₋₁)(t − t₀)/(t₀ − t₋₁), a line in time through the last two
//! forces. `local_model`: f = f₀ + K (x − x₀), which follows the hand.
//!
//! An answer is valid for two of the model's periods and a tick: it is one period old when it arrives, the next one
//! follows one period later, and its input state may be a tick older. Then it fades, slowly at first: f (1 − ((age −
//! used)/10 ms)²). A force never pulls past the loss of contact.
//!
//! *How we know*: `hand_over::a_stale_model_fades_to_zero`; against a closed form and an independent program by
//! `palpate reproduce section-3-4`.
//!
//! *Limits*: contact that begins between two answers acts only from the next one on.

use crate::{AffineForce, Vec3};

/// The method of extrapolation between two answers of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HandOver {
    /// The last force with its local stiffness.
    #[default]
    LocalModel,
    /// A line in time through the last two forces.
    Linear,
    /// The last force.
    Hold,
}

/// Time in which an overdue force fades to zero [s].
pub(crate) const FADE_TIME: f64 = 0.010;

/// The extrapolated force at any time and position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolator {
    hand_over: HandOver,
    /// How long an answer is valid [s].
    used: f64,
    last: AffineForce,
    /// Time [s] and force [N] of the previous answer.
    before: Option<(f64, Vec3)>,
}

impl Extrapolator {
    /// For a model that answers every `period` [s], in a loop with ticks of `tick` [s]; initially there is no contact.
    pub fn new(hand_over: HandOver, period: f64, tick: f64) -> Self {
        Self {
            hand_over,
            used: 2.0 * period + tick,
            last: AffineForce::none(f64::NEG_INFINITY),
            before: None,
        }
    }

    /// Takes in an answer; a repeated one changes nothing.
    pub fn receive(&mut self, answer: &AffineForce) {
        if answer.time > self.last.time {
            let known = self.last.time.is_finite();
            self.before = known.then_some((self.last.time, self.last.force));
            self.last = *answer;
        }
    }

    /// Age of the last answer at `time` [s]; infinite before the first.
    pub fn age(&self, time: f64) -> f64 {
        time - self.last.time
    }

    /// How far the age of the last answer exceeds its validity at `time` [s]; negative before.
    pub fn overdue(&self, time: f64) -> f64 {
        self.age(time) - self.used
    }

    /// The force [N] at `time` [s], for a hand at `position` [m].
    pub fn force(&self, time: f64, position: &Vec3) -> Vec3 {
        if !self.last.contact {
            return Vec3::zeros();
        }
        let age = self.age(time);
        let force = match self.hand_over {
            HandOver::LocalModel => self.last.at(position),
            HandOver::Hold => self.last.force,
            HandOver::Linear => self.last.without_pull(self.line(age.min(self.used))),
        };
        let faded = (self.overdue(time) / FADE_TIME).clamp(0.0, 1.0);
        force * (1.0 - faded * faded)
    }

    fn line(&self, ahead: f64) -> Vec3 {
        let last = &self.last;
        self.before.map_or(last.force, |(time, force)| {
            last.force + (last.force - force) * (ahead / (last.time - time))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(time: f64, force: f64) -> AffineForce {
        AffineForce {
            time,
            contact: true,
            force: Vec3::z() * force,
            normal: Vec3::z(),
            ..AffineForce::none(time)
        }
    }

    fn after(hand_over: HandOver, answers: &[AffineForce]) -> Extrapolator {
        let mut extrapolator = Extrapolator::new(hand_over, 0.005, 0.001);
        for answer in answers {
            extrapolator.receive(answer);
        }
        extrapolator
    }

    fn force(extrapolator: &Extrapolator, time: f64) -> f64 {
        extrapolator.force(time, &Vec3::zeros()).z
    }

    #[test]
    fn a_line_goes_on_and_does_not_pull() {
        let rising = after(HandOver::Linear, &[answer(0.0, 1.0), answer(0.005, 1.5)]);
        // 100 N/s.
        assert!((force(&rising, 0.012) - 2.2).abs() < 1e-12);
        let falling = after(HandOver::Linear, &[answer(0.0, 1.5), answer(0.005, 0.5)]);
        assert_eq!(force(&falling, 0.010), 0.0);
        // The same answer twice is no second point of the line.
        let twice = after(HandOver::Linear, &[answer(0.0, 1.0), answer(0.0, 1.0)]);
        assert_eq!(force(&twice, 0.005), 1.0);
    }

    #[test]
    fn an_old_answer_fades_and_a_first_one_is_awaited() {
        let held = after(HandOver::Hold, &[answer(0.0, 1.0)]);
        assert_eq!(force(&held, 0.011), 1.0);
        // After the 11 ms of use, by definition.
        assert!((force(&held, 0.016) - 0.75).abs() < 1e-12);
        assert!(force(&held, 0.0205) > 0.0);
        assert_eq!(force(&held, 0.021 + 1e-9), 0.0);
        let silent = after(HandOver::LocalModel, &[]);
        assert_eq!(force(&silent, 0.0), 0.0);
        assert!(silent.age(0.0).is_infinite());
    }
}
