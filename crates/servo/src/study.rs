//! What a hand-over costs, for a force that is known everywhere.
//!
//! A hand goes d(t) = d₀ + d₁ sin(2π f t) below a surface whose force F(d) and stiffness F′(d) are given. A
//! model answers every T; an answer arrives one T after the place that it was made for. At every tick the
//! force made of the answers that have arrived is compared with F at the place of the hand then, and the
//! energy that it generates in a cycle, Σ f_n (z_{n+1} − z_n), with the force held for a tick, is counted:
//! an elastic surface generates none.
//!
//! *How we know*: `hand_over::errors_of_a_spring_are_those_of_the_closed_form`,
//! `hand_over::errors_are_those_of_an_independent_program`.
//!
//! *Limits*: the loop sends a force one tick after it was made; `energy_sent` counts it so.

use crate::latest::{Receiver, channel};
use crate::{
    AffineForce, Controller, DeviceState, Extrapolator, Fault, HandOver, Sample, ServoLoop,
    ServoSettings, Trajectory, Vec3, VirtualDevice,
};

/// A hand on a sine, and a model that is slower than the loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandOverStudy {
    /// Which hand-over.
    pub hand_over: HandOver,
    /// T, the period of the model [s].
    pub model_period: f64,
    /// The period of the loop [s].
    pub period: f64,
    /// d₀, the depth in the middle [m].
    pub middle: f64,
    /// d₁ [m].
    pub amplitude: f64,
    /// f [Hz].
    pub frequency: f64,
    /// Whole cycles that are counted, after one that is not.
    pub cycles: u32,
}

/// What a hand-over cost.
#[derive(Debug, Clone, PartialEq)]
pub struct HandOverCost {
    /// Root of the mean square of the error [N].
    pub rms: f64,
    /// The largest error [N].
    pub max: f64,
    /// The largest force F(d) [N], to compare with.
    pub peak: f64,
    /// Energy generated per cycle [J].
    pub energy: f64,
    /// The same with the loop's tick between a force and its sending [J].
    pub energy_sent: f64,
    /// Time [s], depth [m], force [N] and F(d) [N] at every tick that was counted.
    pub course: Vec<[f64; 4]>,
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
    /// When a number is out of range.
    pub fn run(&self, law: impl Fn(f64) -> (f64, f64)) -> Result<HandOverCost, Fault> {
        Fault::unless_finite_and_positive("the period of the model [s]", self.model_period)?;
        Fault::unless_finite_and_positive("the frequency of the hand [Hz]", self.frequency)?;
        let law = |depth: f64| if depth > 0.0 { law(depth) } else { (0.0, 0.0) };
        let samples = self.samples(law)?;
        let cycle = (1.0 / (self.frequency * self.period)).round() as usize;
        let counted = cycle..cycle * (self.cycles as usize + 1);
        let course: Vec<_> = samples[counted.clone()]
            .iter()
            .map(|sample| {
                let depth = -sample.state.position.z;
                [sample.state.time, depth, sample.wanted.z, law(depth).0]
            })
            .collect();
        let errors = course.iter().map(|[_, _, made, exact]| made - exact);
        let squares: f64 = errors.clone().map(|error| error * error).sum();
        let generated = |lag: usize| -> f64 {
            let at = |tick: usize| samples[tick].state.position.z;
            let work = counted
                .clone()
                .map(|tick| samples[tick].wanted.z * (at(tick + lag + 1) - at(tick + lag)));
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
        let (mut answers, heard) = channel(&AffineForce::none(f64::NEG_INFINITY));
        let extrapolator = Extrapolator::new(self.hand_over, self.model_period, self.period);
        let controller = Rendered {
            answers: heard,
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
