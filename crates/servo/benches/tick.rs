//! One tick: exchange with a hand that gives way, extrapolation of a new answer, limits, log, report.
//!
//! Budget: 1 ms, the period at 1 kHz, of which a tick shall leave nearly all to the device: 20 µs. Before
//! criterion's times it prints the percentiles of single ticks.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_servo::{
    AffineForce, Controller, DeviceState, Extrapolator, HandImpedance, HandOver, Histogram,
    ServoLoop, ServoReader, ServoSettings, Trajectory, Vec3, VirtualDevice, latest,
};

const PERIOD: f64 = 1e-3;
/// The budget [s].
const BUDGET: f64 = 1e-3;

struct Rendered {
    answers: latest::Receiver<AffineForce>,
    extrapolator: Extrapolator,
}

impl Controller for Rendered {
    fn update(&mut self, state: &DeviceState, _dt: f64) -> Vec3 {
        self.extrapolator.receive(self.answers.latest());
        self.extrapolator.force(state.time, &state.position)
    }

    fn age(&self) -> Option<f64> {
        Some(PERIOD)
    }
}

struct Bench {
    servo: ServoLoop,
    reader: ServoReader,
    answers: latest::Sender<AffineForce>,
    tick: u64,
}

impl Bench {
    fn new(hand_over: HandOver) -> Self {
        let (answers, heard) = latest::channel(&AffineForce::none(0.0));
        let sine = Trajectory::Sine {
            center: Vec3::zeros(),
            amplitude: Vec3::z() * 4e-3,
            frequency: 2.0,
        };
        let device = VirtualDevice::new(sine)
            .with_hand(HandImpedance::default())
            .unwrap();
        let controller = Rendered {
            answers: heard,
            extrapolator: Extrapolator::new(hand_over, 5.0 * PERIOD, PERIOD),
        };
        let (servo, reader) = ServoLoop::new(
            Box::new(device),
            Box::new(controller),
            ServoSettings::default(),
        )
        .unwrap();
        Self {
            servo,
            reader,
            answers,
            tick: 0,
        }
    }

    fn tick(&mut self) -> Vec3 {
        let time = self.tick as f64 * PERIOD;
        self.tick += 1;
        let gradient = -50.0 * nalgebra::Matrix3::identity();
        let answer = AffineForce::new(time, Vec3::zeros(), Vec3::z() * 0.01, gradient);
        self.answers.send(black_box(answer));
        let sample = self.servo.tick(time, 0.0).unwrap();
        self.reader.log.next_value();
        sample.output
    }
}

fn report(name: &str, hand_over: HandOver) {
    let mut bench = Bench::new(hand_over);
    let mut times = Histogram::default();
    for _ in 0..200_000 {
        let start = Instant::now();
        black_box(bench.tick());
        times.add(start.elapsed().as_secs_f64());
    }
    let found = times.percentiles();
    eprintln!(
        "tick/{name}: p50 {:.2} µs, p99.9 {:.2} µs, max {:.1} µs; {:.2} % of the budget of {} µs (p50)",
        1e6 * found.p50,
        1e6 * found.p99_9,
        1e6 * found.max,
        100.0 * found.p50 / BUDGET,
        1e6 * BUDGET,
    );
}

fn tick(c: &mut Criterion) {
    let cases = [
        ("local_model", HandOver::LocalModel),
        ("linear", HandOver::Linear),
        ("hold", HandOver::Hold),
    ];
    for (name, hand_over) in cases {
        report(name, hand_over);
    }
    let mut group = c.benchmark_group("tick");
    for (name, hand_over) in cases {
        let mut bench = Bench::new(hand_over);
        group.bench_function(name, |b| b.iter(|| bench.tick()));
    }
    group.finish();
}

criterion_group!(benches, tick);
criterion_main!(benches);
