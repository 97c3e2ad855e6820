//! Errors of the hand-over between model and loop, for a force that is known everywhere.
//!
//! A hand goes d(t) = d₀ + d₁ sin(2π f t) below a surface whose force F(d) and stiffness F′(d) are given. A
//! model answers every T; an answer arrives one T after the place that it was made for. At every tick the
//! force made of the answers that have arrived is compared with F at the place of the hand then, and the
//! energy that it generates in a cycle, Σ f_n (z_{n+1} − z_n), with the force held for a tick, is counted:
//! an elastic surface generates none.
//!
//! *How we know*: `tests::errors_of_a_spring_are_those_of_the_closed_form`,
//! `tests::errors_are_those_of_an_independent_program`.
//!
//! *Limits*: the loop sends a force one tick after it was made; `energy_sent` counts it so.

use palpate_servo::latest::{Receiver, channel};
use palpate_servo::{
    AffineForce, Controller, DeviceState, Extrapolator, Fault, HandOver, Sample, ServoLoop,
    ServoSettings, Trajectory, Vec3, VirtualDevice,
};

/// A hand on a sine, and a model that is slower than the loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HandOverStudy {
    /// Method of the hand-over.
    pub(super) hand_over: HandOver,
    /// T, the period of the model [s].
    pub(super) model_period: f64,
    /// The period of the loop [s].
    pub(super) period: f64,
    /// d₀, the depth in the middle [m].
    pub(super) middle: f64,
    /// d₁ [m].
    pub(super) amplitude: f64,
    /// f [Hz].
    pub(super) frequency: f64,
    /// Whole cycles that are counted, after one that is not.
    pub(super) cycles: u32,
}

/// Errors of a hand-over.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HandOverCost {
    /// Root of the mean square of the error [N].
    pub(super) rms: f64,
    /// The largest error [N].
    pub(super) max: f64,
    /// The largest force F(d) [N], to compare with.
    pub(super) peak: f64,
    /// Energy generated per cycle [J].
    pub(super) energy: f64,
    /// The same with the loop's tick between a force and its sending [J].
    pub(super) energy_sent: f64,
    /// Time [s], depth [m], force [N] and F(d) [N] at every tick that was counted.
    pub(super) course: Vec<[f64; 4]>,
}

struct Rendered {
    answers: Receiver<AffineForce>,
    extrapolator: Extrapolator,
}

impl Controller for Rendered {
    fn update(&mut self, state: &DeviceState, _dt: f64) -> Vec3 {
        self.extrapolator.receive(self.answers.latest());
        self.extrapolator.force(state.time, &state.position)
    }
}

impl HandOverStudy {
    /// Runs the study on a virtual clock; `law` gives F [N] and F′ [N/m] at a depth [m] above zero.
    ///
    /// # Errors
    /// When the virtual hand refuses a tick, which it never does.
    pub(super) fn run(&self, law: impl Fn(f64) -> (f64, f64)) -> Result<HandOverCost, Fault> {
        let law = |depth: f64| if depth > 0.0 { law(depth) } else { (0.0, 0.0) };
        let samples = self.samples(law)?;
        let cycle = (1.0 / (self.frequency * self.period)).round() as usize;
        let counted = cycle..cycle * (self.cycles as usize + 1);
        let course: Vec<_> = samples[counted.clone()]
            .iter()
            .map(|sample| {
                let depth = -sample.state.position.z;
                [sample.state.time, depth, sample.commanded.z, law(depth).0]
            })
            .collect();
        let errors = course.iter().map(|[_, _, made, exact]| made - exact);
        let squares: f64 = errors.clone().map(|error| error * error).sum();
        let generated = |lag: usize| -> f64 {
            let at = |tick: usize| samples[tick].state.position.z;
            let work = counted
                .clone()
                .map(|tick| samples[tick].commanded.z * (at(tick + lag + 1) - at(tick + lag)));
            work.sum::<f64>() / f64::from(self.cycles)
        };
        Ok(HandOverCost {
            rms: (squares / course.len() as f64).sqrt(),
            max: errors.map(f64::abs).fold(0.0, f64::max),
            peak: law(self.middle + self.amplitude).0,
            energy: generated(0),
            energy_sent: generated(1),
            course,
        })
    }

    fn samples(&self, law: impl Fn(f64) -> (f64, f64)) -> Result<Vec<Sample>, Fault> {
        let (mut answers, received) = channel(&AffineForce::none(f64::NEG_INFINITY));
        let extrapolator = Extrapolator::new(self.hand_over, self.model_period, self.period);
        let controller = Rendered {
            answers: received,
            extrapolator,
        };
        let hand = VirtualDevice::new(Trajectory::Sine {
            center: -Vec3::z() * self.middle,
            amplitude: -Vec3::z() * self.amplitude,
            frequency: self.frequency,
        });
        let settings = ServoSettings {
            period: self.period,
            ..ServoSettings::default()
        };
        let (mut servo, _reader) = ServoLoop::new(Box::new(hand), Box::new(controller), settings)?;
        let cycles = f64::from(self.cycles + 1);
        let ticks = (cycles / (self.frequency * self.period)).round() as u64 + 2;
        let mut samples = Vec::with_capacity(ticks as usize);
        let (mut steps, mut pending) = (0u32, None);
        for tick in 0..ticks {
            let time = tick as f64 * self.period;
            // A millionth of a tick: rounding of the times.
            let due = time >= f64::from(steps) * self.model_period - 1e-6 * self.period;
            if let Some(answer) = pending.take_if(|_| due) {
                answers.send(answer);
            }
            let sample = servo.tick(time, 0.0)?;
            if due {
                pending = Some(answer(&sample, &law));
                steps += 1;
            }
            samples.push(sample);
        }
        Ok(samples)
    }
}

fn answer(sample: &Sample, law: impl Fn(f64) -> (f64, f64)) -> AffineForce {
    let (time, position) = (sample.state.time, sample.state.position);
    let (force, stiffness) = law(-position.z);
    if force == 0.0 {
        return AffineForce::none(time);
    }
    let gradient = nalgebra::Matrix3::from_diagonal(&(-Vec3::z() * stiffness));
    AffineForce {
        normal: Vec3::z(),
        ..AffineForce::new(time, position, Vec3::z() * force, gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [HandOver; 3] = [HandOver::Hold, HandOver::Linear, HandOver::LocalModel];

    /// A fit to the published kidney, F = 0.020 d + 0.0046 d² with N and mm, and its stiffness.
    fn kidney(depth: f64) -> (f64, f64) {
        (20.0 * depth + 4600.0 * depth * depth, 20.0 + 9200.0 * depth)
    }

    /// 3 mm ± 4 mm: contact is made and lost in every cycle.
    fn study(hand_over: HandOver, rate: f64, frequency: f64) -> HandOverStudy {
        HandOverStudy {
            hand_over,
            model_period: 1.0 / rate,
            period: 1e-3,
            middle: 3e-3,
            amplitude: 4e-3,
            frequency,
            cycles: 20,
        }
    }

    fn percent(cost: &HandOverCost) -> [f64; 2] {
        [cost.rms, cost.max].map(|error| 100.0 * error / cost.peak)
    }

    /// RMS and largest error in percent of the peak for hold, line and local model, at a rate of the model and
    /// a frequency of the hand: an independent program's.
    const REFERENCE: [(f64, f64, [[f64; 2]; 3]); 5] = [
        (200.0, 1.0, [[1.74, 3.5], [0.11, 0.9], [0.06, 0.9]]),
        (200.0, 2.0, [[3.48, 7.1], [0.37, 1.4], [0.14, 1.3]]),
        (200.0, 5.0, [[8.7, 17.6], [2.2, 5.7], [0.74, 3.4]]),
        (60.0, 2.0, [[12.3, 25.6], [4.3, 11.3], [1.3, 3.8]]),
        (60.0, 5.0, [[29.7, 59.8], [23.6, 64.3], [7.9, 26.0]]),
    ];

    /// Within 20 %, which leaves room for how the two programs place ticks that do not divide a period.
    #[test]
    fn errors_are_those_of_an_independent_program() {
        for (rate, frequency, expected) in REFERENCE {
            for (kind, expected) in KINDS.into_iter().zip(expected) {
                let cost = study(kind, rate, frequency).run(kidney).unwrap();
                let found = percent(&cost);
                println!("{rate} Hz, {frequency} Hz, {kind:?}: {found:.2?}, there {expected:?}");
                for (found, expected) in found.into_iter().zip(expected) {
                    // Half of the last digit that is given.
                    let room = 0.2 * expected + if expected < 0.1 { 0.005 } else { 0.05 };
                    assert!(
                        (found - expected).abs() <= room,
                        "{rate} Hz, {frequency} Hz, {kind:?}: {found:.3} %, there {expected} %"
                    );
                }
            }
        }
    }

    /// Energy per cycle over the energy stored at the deepest place, in percent.
    const GENERATED: [(f64, f64, [f64; 3]); 2] = [
        (200.0, 2.0, [21.6, 1.6, 1.5]),
        (60.0, 5.0, [162.0, 81.0, 16.0]),
    ];

    #[test]
    fn generated_energy_is_that_of_an_independent_program() {
        // ∫ F from 0 to 7 mm.
        let stored = 10.0 * 49e-6 + 4600.0 / 3.0 * 343e-9;
        for (rate, frequency, expected) in GENERATED {
            for (kind, expected) in KINDS.into_iter().zip(expected) {
                let cost = study(kind, rate, frequency).run(kidney).unwrap();
                let [found, sent] = [cost.energy, cost.energy_sent].map(|e| 100.0 * e / stored);
                println!("{rate} Hz, {frequency} Hz, {kind:?}: {found:.2} %, sent {sent:.2} %");
                assert!(
                    (found / expected - 1.0).abs() <= 0.2,
                    "{rate} Hz, {frequency} Hz, {kind:?}: {found:.2} %, there {expected} %"
                );
            }
        }
    }

    /// In contact throughout, the errors have closed forms: an age that is evenly spread over 5 to 9 ms, times
    /// the largest rate of the force over √2 for a hold; half the curvature of F along the way for the local
    /// model.
    #[test]
    fn errors_of_a_spring_are_those_of_the_closed_form() {
        let spring = |depth: f64| (50.0 * depth, 50.0);
        let study = |hand_over| HandOverStudy {
            middle: 3e-3,
            amplitude: 1e-3,
            ..self::study(hand_over, 200.0, 0.5)
        };
        let hold = study(HandOver::Hold).run(spring).unwrap();
        let omega = std::f64::consts::TAU * 0.5;
        let square: f64 = [5.0, 6.0, 7.0, 8.0, 9.0f64]
            .map(|age| (age * 1e-3).powi(2))
            .iter()
            .sum();
        let expected = 50.0 * 1e-3 * omega * (square / 5.0).sqrt() / 2.0f64.sqrt();
        // The next term of the sine over an age: (ω t)²/24 = 3·10⁻⁵.
        assert!(
            (hold.rms / expected - 1.0).abs() < 1e-4,
            "{} {expected}",
            hold.rms
        );
        let local = study(HandOver::LocalModel).run(spring).unwrap();
        // A spring is its own local model: rounding.
        assert!(local.max < 1e-12, "{}", local.max);
        // The line: its error is ω² A (age² + age T)/2.
        let linear = study(HandOver::Linear).run(spring).unwrap();
        let error = |age: f64| 0.5 * omega * omega * 0.05 * (age * age + age * 5.0) * 1e-6;
        let square: f64 = [5.0, 6.0, 7.0, 8.0, 9.0]
            .map(|age: f64| error(age).powi(2))
            .iter()
            .sum();
        let expected = (square / 5.0).sqrt() / 2.0f64.sqrt();
        // The next term: ω (age + T) of the size of the last.
        assert!(
            (linear.rms / expected - 1.0).abs() < 0.05,
            "{} {expected}",
            linear.rms
        );
    }
}
