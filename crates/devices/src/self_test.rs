//! A self-test of a device, three seconds long: it answers, it is ready, and it takes a small force.
//!
//! The force goes through the servo loop and its limits like every other. Once they are on it is
//! F(t) = F₀ (1 − cos 2πt/T)/2 along right, up and toward the user in turn, with F₀ = 0.2 N and T = 0.5 s; more than
//! 0.3 N is never sent, and a handle that is faster than 0.3 m/s ends it.
//!
//! *How we know*: `self_test::…` in the tests.
//!
//! *Limits*: only the person at the device can say whether the force points in the right direction.

use palpate_servo::{
    Clock, Controller, Device, DeviceState, Fault, Limits, LoopReport, ServoLoop, ServoSettings,
    ServoThread, Stage, Vec3,
};

/// The largest force of the test [N], and the limit of its guard [N].
const LARGEST: f64 = 0.2;
const LIMIT: f64 = 0.3;

/// Timeout for arming the forces [s], and duration of each of three pushes [s].
const ARMED_BY: f64 = 1.0;
const PUSH: f64 = 0.5;
const WHOLE: f64 = ARMED_BY + 3.0 * PUSH + 0.2;

/// Results of the self-test.
#[derive(Debug, Clone, PartialEq)]
pub struct SelfTest {
    /// First and last position of the handle [m].
    pub ends: Option<[Vec3; 2]>,
    /// The corners of the box that the handle moved through [m].
    pub reached: Option<[Vec3; 2]>,
    /// Whether the device was ready at the start.
    pub ready: bool,
    /// Whether forces were on at the end.
    pub live: bool,
    /// The largest force that was sent [N].
    pub sent: f64,
    /// The largest force that the device reported as displayed [N]; none if it does not report forces.
    pub displayed: Option<f64>,
    /// The loop's report: its work is the round trip.
    pub report: LoopReport,
    /// Why the test ended early.
    pub fault: Option<Fault>,
}

impl SelfTest {
    /// Whether the test passed.
    pub fn passed(&self) -> bool {
        // The displayed force may be filtered: half of it is enough.
        let shows = self.displayed.is_none_or(|force| force > 0.5 * self.sent);
        self.fault.is_none() && self.live && shows && self.sent > 0.5 * LARGEST
    }
}

/// A push along each axis in turn.
struct Push;

impl Controller for Push {
    fn update(&mut self, state: &DeviceState, _dt: f64) -> Vec3 {
        let since = state.time - ARMED_BY;
        if !(0.0..3.0 * PUSH).contains(&since) {
            return Vec3::zeros();
        }
        let axis = (since / PUSH) as usize;
        let phase = std::f64::consts::TAU * since / PUSH;
        let mut force = Vec3::zeros();
        force[axis.min(2)] = LARGEST * (1.0 - phase.cos()) / 2.0;
        force
    }
}

/// Tests `device` on `clock`, at 1 kHz.
///
/// # Errors
/// When the loop cannot be made.
pub fn self_test(device: Box<dyn Device>, clock: Clock) -> Result<SelfTest, Fault> {
    let settings = ServoSettings {
        limits: Some(Limits {
            force: LIMIT,
            speed: 0.3,
            without_dead_man: 1.0,
            ..Limits::of(device.capabilities())
        }),
        log: 8192,
        ..ServoSettings::default()
    };
    let (servo, mut reader) = ServoLoop::new(device, Box::new(Push), settings)?;
    let report = run(servo, clock, settings.period)?;
    let mut test = SelfTest {
        ends: None,
        reached: None,
        ready: false,
        live: false,
        sent: 0.0,
        displayed: None,
        report,
        fault: report.fault,
    };
    for sample in reader.log.drain() {
        let place = sample.state.position;
        if !sample.state.present || !place.iter().all(|number| number.is_finite()) {
            continue;
        }
        if test.ends.is_none() {
            test.ready = sample.state.ready;
        }
        test.ends = Some([test.ends.map_or(place, |[first, _]| first), place]);
        let [least, greatest] = test.reached.unwrap_or([place, place]);
        test.reached = Some([least.inf(&place), greatest.sup(&place)]);
        test.live = sample.stage == Stage::Live;
        test.sent = test.sent.max(sample.output.norm());
        if let Some(force) = sample.state.displayed {
            test.displayed = Some(test.displayed.unwrap_or(0.0).max(force.norm()));
        }
    }
    Ok(test)
}

/// Runs `servo` to the end of the test; on the machine's clock as in every session, in the scheduler of a device that has
/// one.
fn run(mut servo: ServoLoop, mut clock: Clock, period: f64) -> Result<LoopReport, Fault> {
    let last = (WHOLE / period) as u64;
    if let Clock::Virtual(_) = clock {
        return Ok(servo.run(&mut clock, |tick| tick < last));
    }
    let thread = ServoThread::start(servo, clock)?;
    while thread.is_running() && clock.now() < WHOLE {
        clock.sleep_until(clock.now() + 0.01);
    }
    thread.stop()
}
