//! The virtual PHANTOM in the loop. Judges: tracking as asked for, the bound of rendered stiffness, friction
//! that holds.

use std::f64::consts::TAU;

use nalgebra::Complex;
use palpate_measure::phantom::{
    FlexibleBody, Imperfections, MECHANICS_STEP, Machine, RigidBody, TwoMass, VirtualPhantom,
};
use palpate_servo::{
    Clock, DeviceState, Limits, Pid, PidGains, Sample, ServoLoop, ServoSettings, Stage, Vec3,
};

/// Limits that nothing here meets.
fn unlimited() -> Limits {
    Limits {
        force: 1e3,
        slew: 1e9,
        speed: 1e3,
        arming_speed: 1e3,
        arming_force: 1e3,
        ramp: 1e-6,
        ..Limits::without_hand()
    }
}

/// All samples of `ticks` under a `law` for the force along x.
fn run(
    device: VirtualPhantom,
    mut law: impl FnMut(&DeviceState, f64) -> f64 + Send + 'static,
    ticks: u64,
) -> Vec<Sample> {
    let settings = ServoSettings {
        limits: Some(unlimited()),
        log: ticks as usize,
        ..ServoSettings::default()
    };
    let controller = move |state: &DeviceState, dt: f64| Vec3::x() * law(state, dt);
    let (mut servo, mut reader) =
        ServoLoop::new(Box::new(device), Box::new(controller), settings).unwrap();
    servo.run(&mut Clock::virtual_time(), |tick| tick < ticks);
    reader.log.drain().collect()
}

/// Sines of 2 mm from end to end, on tissue of 60 N/m, with friction, encoder steps and the loop's own delay:
/// within 3 % and 2°, as asked for.
#[test]
fn the_tuned_preset_tracks_sines() {
    for frequency in [0.5, 1.0, 2.0, 4.0, 8.0] {
        let imperfections = Imperfections {
            encoder_step: 25e-6,
            ..Imperfections::premium()
        };
        let tissue = |_: f64, place: &Vec3, _: &Vec3| place * -60.0;
        let device = VirtualPhantom::with_axes(
            Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP),
            &Vec3::zeros(),
            imperfections,
        )
        .with_contact(Box::new(tissue));
        let omega = TAU * frequency;
        let mut pid = Pid::new(PidGains::tuned());
        let law = move |state: &DeviceState, dt: f64| {
            // What is wanted when the force begins to act, a tick from now.
            let phase = omega * (state.time + 1e-3);
            let wanted = [1e-3 * phase.sin(), 1e-3 * omega * phase.cos()];
            pid.force(state.position.x, wanted, dt)
        };
        // Two seconds to settle, then four whole periods or more.
        let samples = run(device, law, 10_000);
        let mut answer = Complex::new(0.0, 0.0);
        for sample in &samples[2000..] {
            let turned = Complex::from_polar(2.0 / 8000.0, -omega * sample.state.time);
            answer += turned * sample.state.position.x;
        }
        let ratio = answer / Complex::new(0.0, -1e-3);
        assert!(
            (ratio.norm() - 1.0).abs() < 0.03,
            "{frequency} Hz: {}",
            ratio.norm()
        );
        let turned = ratio.arg().to_degrees().abs();
        assert!(turned < 2.0, "{frequency} Hz: {turned} degrees");
    }
}

/// Whether a wall of `stiffness` [N/m] swings less and less, with so many ticks of delay.
fn is_stable(machine: &TwoMass, stiffness: f64, delay: usize) -> bool {
    let imperfections = Imperfections {
        delay,
        ..Imperfections::none()
    };
    let start = Vec3::x() * 1e-6;
    let device = VirtualPhantom::with_axes(
        Machine::of_two_masses(machine, MECHANICS_STEP),
        &start,
        imperfections,
    );
    let samples = run(
        device,
        move |state, _| -stiffness * state.position.x,
        10_000,
    );
    let largest = |from: usize, to: usize| {
        let places = samples[from..to].iter();
        places.map(|s| s.state.position.x.abs()).fold(0.0, f64::max)
    };
    largest(7000, 10_000) < largest(2000, 5000).min(1e-3)
}

/// Judge: K < b/(T/2 + t) with the delay t of the loop and of the device [Colgate and Schenkel 1997], at
/// four delays: within 15 %, as asked for.
#[test]
fn a_wall_is_stable_up_to_the_bound_at_four_delays() {
    // Held so lightly that the machine's own spring does not count, and without a mode.
    let machine = TwoMass {
        stiffness: 0.01,
        damping: 0.2,
        structure_stiffness: 1e6,
        ..TwoMass::consistent()
    };
    for delay in [0, 1, 2, 5] {
        let late = (delay as f64 + 1.0) * 1e-3;
        let bound = machine.damping / (0.5e-3 + late);
        let (mut stable, mut unstable) = (0.2 * bound, 5.0 * bound);
        while unstable / stable > 1.02 {
            let middle = (stable * unstable).sqrt();
            if is_stable(&machine, middle, delay) {
                stable = middle;
            } else {
                unstable = middle;
            }
        }
        println!("{delay} ticks: {stable:.1} N/m, bound {bound:.1} N/m");
        assert!(
            (stable / bound - 1.0).abs() < 0.15,
            "{delay}: {stable} {bound}"
        );
    }
}

/// What friction can hold does not move; what it cannot, does. Its 0.04 N are the machine's own.
#[test]
fn friction_sticks_and_slips() {
    for body in [true, false] {
        let moved = |force: f64| {
            let imperfections = Imperfections::premium();
            let device = if body {
                let mut links = RigidBody::premium();
                links.linkage.gravity = 0.0;
                VirtualPhantom::with_links(links, imperfections)
            } else {
                let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
                VirtualPhantom::with_axes(machine, &Vec3::zeros(), imperfections)
            };
            let samples = run(device, move |_, _| force, 200);
            samples[199].state.position.x.abs()
        };
        assert!(moved(0.03) <= 1e-12, "{}", moved(0.03));
        assert!(moved(0.1) > 1e-4, "{}", moved(0.1));
    }
}

/// The largest stiffness of a wall [N/m] under a hand that damps with 5 N s/m, knocked with `knock` [N].
fn largest_stiffness(flexible: bool, friction: f64, knock: f64) -> f64 {
    let mut body = FlexibleBody::premium();
    body.links.linkage.gravity = 0.0;
    let imperfections = Imperfections {
        friction,
        ..Imperfections::none()
    };
    let is_calm = |stiffness: f64| {
        let hand = |_: f64, place: &Vec3, velocity: &Vec3| place * -50.0 - velocity * 5.0;
        let device = if flexible {
            VirtualPhantom::with_flexible_links(body, imperfections)
        } else {
            VirtualPhantom::with_links(body.links, imperfections)
        };
        let law = move |state: &DeviceState, _: f64| {
            let knocked = if state.time < 0.05 { knock } else { 0.0 };
            knocked - stiffness * state.position.x
        };
        let samples = run(device.with_contact(Box::new(hand)), law, 1500);
        let largest = |from: usize, to: usize| {
            let places = samples[from..to].iter();
            places.map(|s| s.state.position.x.abs()).fold(0.0, f64::max)
        };
        // A knock moves it by some micrometres; what swings more and more goes centimetres, or beyond numbers.
        let went_far = largest(0, 1500) > 5e-3 || samples[1499].stage != Stage::Live;
        !went_far && largest(1000, 1500) <= largest(200, 700)
    };
    let (mut stable, mut unstable) = (30.0, 20_000.0);
    while unstable / stable > 1.02 {
        let middle = f64::sqrt(stable * unstable);
        if is_calm(middle) {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    stable
}

/// Vibration, not the damping of a hand, sets the stiffness that can be rendered [Díaz and Gil 2010]. Judge of the
/// stiff links: K < b/(T/2 + T). Rotors behind springs swing where no hand damps them, and far earlier; dry
/// friction in the motors holds small swings.
#[test]
fn a_mode_lowers_the_stiffness_that_can_be_rendered() {
    let stiff = largest_stiffness(false, 0.0, 1e-3);
    let flexible = largest_stiffness(true, 0.0, 1e-3);
    let rubbed = largest_stiffness(true, 0.04, 0.1);
    println!(
        "largest stable wall: {stiff:.0} N/m, with the modes {flexible:.0} N/m, with friction {rubbed:.0} N/m"
    );
    // 15 % as for the walls above; the bound leaves out the mass.
    assert!((stiff / (5.0 / 1.5e-3) - 1.0).abs() < 0.15, "{stiff}");
    assert!(
        flexible < 0.5 * stiff && rubbed > flexible,
        "{flexible} {rubbed}"
    );
}
