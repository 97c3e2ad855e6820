//! What a device adds against itself, felt by a hand. Judges: the closed form of the loop by sine injection, the
//! weight of the links, the edge of stability.

use std::f64::consts::TAU;

use nalgebra::Complex;
use palpate_measure::phantom::{
    Imperfections, MECHANICS_STEP, Machine, RigidBody, TwoMass, VirtualPhantom,
};
use palpate_servo::dynamics::{Compensation, Linkage, largest_mass};
use palpate_servo::{
    Clock, Device, DeviceState, HandImpedance, Limits, Sample, ServoLoop, ServoSettings,
    Trajectory, Vec3, VirtualDevice, Waypoint,
};

const PERIOD: f64 = 1e-3;

/// Against the spring and a share of the mass of the machine with one unit for everything.
fn compensation(share: f64) -> Compensation {
    let machine = TwoMass::consistent();
    Compensation {
        weight: None,
        stiffness: machine.stiffness,
        mass: share * (machine.link_mass + machine.rotor_mass),
        cutoff: 30.0,
    }
}

/// Limits that nothing here meets, armed at once.
fn unlimited() -> Limits {
    Limits {
        speed: 1e3,
        arming_speed: 1e3,
        ramp: 1e-6,
        ..Limits::without_hand()
    }
}

fn run(
    device: impl Device + 'static,
    compensation: Option<Compensation>,
    ticks: u64,
) -> Vec<Sample> {
    let settings = ServoSettings {
        limits: Some(unlimited()),
        compensation,
        log: ticks as usize,
        ..ServoSettings::default()
    };
    let nothing = |_: &DeviceState, _: f64| Vec3::zeros();
    let (mut servo, mut reader) =
        ServoLoop::new(Box::new(device), Box::new(nothing), settings).unwrap();
    servo.run(&mut Clock::virtual_time(), |tick| tick < ticks);
    reader.log.drain().collect()
}

/// F/x at the handle [N/m] of a hand that shakes it with 0.1 N: eight seconds, of which the last four count.
fn felt(frequency: f64, compensation: Option<Compensation>) -> Complex<f64> {
    let omega = TAU * frequency;
    let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
    let still = Vec3::zeros();
    let shaken = move |time: f64, _: &Vec3, _: &Vec3| {
        // Held over a step, a sine is late by half of one.
        Vec3::x() * (0.1 * (omega * (time + 0.5 * MECHANICS_STEP)).cos())
    };
    let device = VirtualPhantom::with_axes(machine, &still, Imperfections::none())
        .with_contact(Box::new(shaken));
    let samples = run(device, compensation, 8000);
    let mut answer = Complex::new(0.0, 0.0);
    for sample in &samples[4000..] {
        let turned = Complex::from_polar(2.0 / 4000.0, -omega * sample.state.time);
        answer += turned * sample.state.position.x;
    }
    0.1 / answer
}

/// G₁ [N/m] and G₂ [-] of the two masses at `frequency` [Hz], from their equations of motion: with D the dynamic
/// stiffness of the rotor and C that of the structure, G₁ = m_l s² + C − C²/D and G₂ = C/D.
fn two_port(frequency: f64) -> [Complex<f64>; 2] {
    let machine = TwoMass::consistent();
    let s = Complex::new(0.0, TAU * frequency);
    let structure = s * machine.structure_damping + machine.structure_stiffness;
    let rotor = s * s * machine.rotor_mass + s * machine.damping + machine.stiffness + structure;
    let link = s * s * machine.link_mass + structure;
    [link - structure * structure / rotor, structure / rotor]
}

/// What a hand feels of the device alone, G₁ − G₂ F_c/x [N/m].
fn compensated(compensation: &Compensation, frequency: f64) -> Complex<f64> {
    let [impedance, transmission] = two_port(frequency);
    impedance - transmission * compensation.impedance(frequency, PERIOD)
}

/// The frequency [Hz] up to which `felt` [N/m] is the impedance `tissue` [N/m] within a tenth, in steps of 1 % up to
/// 1 kHz; none where it is not even nearly at rest.
fn transparent_up_to(felt: impl Fn(f64) -> Complex<f64>, tissue: Complex<f64>) -> Option<f64> {
    let is_clear = |frequency: f64| (felt(frequency) / tissue - 1.0).norm() <= 0.1;
    let steps = (0..1157).map(|step| 0.01 * 1.01_f64.powi(step));
    steps.take_while(|frequency| is_clear(*frequency)).last()
}

const FREQUENCIES: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];

/// Judge: G₁ − G₂ F_c/x. What a hand feels of the device with nothing compensated, then its spring, then half of
/// its mass too; the table of `docs/theory/haptics.md`.
#[test]
fn what_is_felt_is_that_of_the_closed_form() {
    for share in [None, Some(0.0), Some(0.5)] {
        let compensation = share.map(compensation);
        for frequency in FREQUENCIES {
            let found = felt(frequency, compensation);
            let expected = compensation.map_or_else(
                || two_port(frequency)[0],
                |compensation| compensated(&compensation, frequency),
            );
            let square = (TAU * frequency).powi(2);
            println!(
                "{share:?} {frequency} Hz: |Z| {:.1} N/m, spring and mass {:.2} N/m, as a mass {:.1} g",
                found.norm(),
                found.re,
                1e3 * (if share.is_none() { 32.0 } else { 0.0 } - found.re) / square
            );
            // What had not died away after four seconds, and the square of the machine's step.
            assert!(
                (found / expected - 1.0).norm() < 0.005,
                "{share:?} {frequency} Hz: {found} {expected}"
            );
        }
    }
}

/// Half of the mass is gone at 1 Hz: within 5 %, of which the structure, which gives way by k/k_s, and the lag of the
/// spring's compensation take 3.
#[test]
fn a_compensated_device_is_lighter() {
    let machine = TwoMass::consistent();
    let mass = machine.link_mass + machine.rotor_mass;
    for share in [0.0, 0.5] {
        let found = -felt(1.0, Some(compensation(share))).re / (TAU * TAU);
        let left = (1.0 - share) * mass;
        assert!((found / left - 1.0).abs() < 0.05, "{share}: {found} {left}");
    }
}

/// Where what is felt of tissue of 60 N/m is the tissue within a tenth: nowhere without compensation, not even at
/// rest; with it up to where the damper counts, which nothing compensates.
#[test]
fn compensation_widens_what_is_transparent() {
    let tissue = Complex::new(60.0, 0.0);
    let bare = |f| two_port(f)[0] + two_port(f)[1] * tissue;
    let bare = transparent_up_to(bare, tissue);
    assert_eq!(bare, None);
    let reach = |share: f64| {
        let compensation = compensation(share);
        let whole = |f| compensated(&compensation, f) + two_port(f)[1] * tissue;
        transparent_up_to(whole, tissue).unwrap()
    };
    let reached = [0.0, 0.3, 0.5].map(reach);
    println!("transparent within a tenth on 60 N/m up to {reached:.3?} Hz");
    // By hand: 6 N/m are those of the damper, 2.6 ω, at 0.37 Hz, before the mass counts.
    assert!(
        reached.iter().all(|f| (0.2..0.5).contains(f)),
        "{reached:?}"
    );
}

/// Judge: the weight of the links, and nothing at all. Force on a hand that holds the handle still, over the
/// workspace, with encoders and amplifiers of the machine.
#[test]
fn weight_is_gone_over_the_workspace() {
    let body = Linkage::premium();
    let premium = Imperfections::premium();
    let step = |value: f64, step: f64| (value / step).round() * step;
    let (mut bare, mut held, mut places) = ([0.0_f64; 2], [0.0_f64; 2], 0);
    for (x, y, z) in
        (0..11).flat_map(|x| (0..11).flat_map(move |y| (0..11).map(move |z| (x, y, z))))
    {
        let at = |number: i32, half: f64| half * (f64::from(number) / 5.0 - 1.0);
        let place = Vec3::new(at(x, 0.10), at(y, 0.06), at(z, 0.05));
        let weight = body.holding_force(&place).unwrap();
        let seen = place.map(|x| step(x, premium.encoder_step));
        let sent = body
            .holding_force(&seen)
            .unwrap()
            .map(|f| step(f, premium.force_step));
        let left = (weight - sent).norm();
        bare = [bare[0] + weight.norm_squared(), bare[1].max(weight.norm())];
        held = [held[0] + left * left, held[1].max(left)];
        places += 1;
    }
    let rms = |sum: f64| (sum / f64::from(places)).sqrt();
    println!(
        "weight {:.1} mN, at most {:.1} mN; compensated {:.2} mN, at most {:.2} mN",
        1e3 * rms(bare[0]),
        1e3 * bare[1],
        1e3 * rms(held[0]),
        1e3 * held[1]
    );
    // Half a step of the amplifiers on each axis, 3.6 mN, and what 26 µm change.
    assert!(held[1] < 5e-3 && rms(bare[0]) > 0.1, "{bare:?} {held:?}");
}

/// Judge: nothing moves. A handle that nobody holds stays where it is; uncompensated, it falls.
#[test]
fn a_handle_whose_weight_is_held_does_not_fall() {
    let body = RigidBody::premium();
    let moved = |compensation| {
        let device = VirtualPhantom::with_links(body, Imperfections::none());
        let samples = run(device, compensation, 300);
        samples[299].state.position.norm()
    };
    let weight = Compensation {
        weight: Some(body.linkage),
        stiffness: 0.0,
        mass: 0.0,
        cutoff: 30.0,
    };
    let (held, fallen) = (moved(Some(weight)), moved(None));
    println!(
        "in 0.3 s: {:.3} mm, uncompensated {:.1} mm",
        1e3 * held,
        1e3 * fallen
    );
    // It falls during the ticks before forces are on: three ms at 1.5 m/s², and drifts on.
    assert!(held < 2e-3 && fallen > 20e-3, "{held} {fallen}");
}

/// Judge: the joints themselves.
#[test]
fn joints_are_found_from_the_place_of_the_handle() {
    let body = Linkage::premium();
    for angles in [
        [0.0, 0.0, 0.0],
        [0.5, -0.3, 0.4],
        [-0.7, 0.6, 0.9],
        [0.2, 0.4, -0.2],
    ] {
        let angles = Vec3::from(angles);
        let found = body.angles(&body.position(&angles)).unwrap();
        // Rounding.
        assert!((found - angles).norm() < 1e-12, "{found} {angles}");
    }
    assert_eq!(body.angles(&(Vec3::z() * 0.5)), None);
    assert_eq!(body.angles(&(Vec3::z() * f64::NAN)), None);
}

/// Whether a hand that is pushed once comes to rest when `mass` [kg] of it is compensated.
fn comes_to_rest(hand: HandImpedance, cutoff: f64, mass: f64) -> bool {
    let places = [(0.0, 0.0), (0.1, 0.0), (0.11, 1e-5)];
    let places = places.map(|(time, x)| Waypoint::new(time, Vec3::x() * x));
    let device = VirtualDevice::new(Trajectory::waypoints(places.to_vec()).unwrap())
        .with_hand(hand)
        .unwrap();
    let compensation = Compensation {
        weight: None,
        stiffness: 0.0,
        mass,
        cutoff,
    };
    let samples = run(device, Some(compensation), 6000);
    let largest = |from: usize, to: usize| {
        let places = samples[from..to].iter();
        places
            .map(|s| (s.state.position.x - 1e-5).abs())
            .fold(0.0, f64::max)
    };
    largest(4500, 6000) < largest(1000, 2500).clamp(1e-12, 1e-4)
}

/// Judge: the root on the imaginary axis. A light and a firm grasp, three corners; within 5 %, for the filters are
/// those of a tick, not of a continuum.
#[test]
fn inertia_is_compensated_up_to_the_stated_limit() {
    for (damping, stiffness) in [(5.0, 500.0), (3.0, 1500.0)] {
        for cutoff in [10.0, 30.0, 100.0] {
            let hand = HandImpedance {
                mass: 0.18,
                damping,
                stiffness,
            };
            let bound = largest_mass(&hand, cutoff, 1.5 * PERIOD);
            let (mut stable, mut unstable) = (0.3 * bound, 3.0 * bound);
            while unstable / stable > 1.01 {
                let middle = (stable * unstable).sqrt();
                if comes_to_rest(hand, cutoff, middle) {
                    stable = middle;
                } else {
                    unstable = middle;
                }
            }
            let lag = 2.0 / (TAU * cutoff) + 1.5 * PERIOD;
            println!(
                "{damping} N s/m, {stiffness} N/m, {cutoff} Hz: {:.1} % of the mass, stated {:.1} %, first order {:.1} %",
                100.0 * stable / hand.mass,
                100.0 * bound / hand.mass,
                100.0 / (1.0 + stiffness * lag / damping)
            );
            assert!((stable / bound - 1.0).abs() < 0.05, "{stable} {bound}");
        }
    }
}
