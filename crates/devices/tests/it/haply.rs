//! The driver and its service: what is said both ways, and that a wall feels as on a device without a service.

use std::time::Instant;

use nalgebra::UnitQuaternion;
use palpate_device_stand_ins::{
    HaplyStandIn, HaplyStandInSettings, Mechanics, Misbehaviour, StandInGrip,
};
use palpate_devices::haply::{
    Generation, HaplyAddress, HaplyDevice, ServiceInventory, State, force_command, list,
};
use palpate_servo::{
    Command, DeadMan, Device, Disabled, Fault, Histogram, NoDevice, Stage, Trajectory, Vec3,
    VirtualDevice, Waypoint,
};

use crate::hands::{Commanded, PATIENT, Ticked, press, pressing, wall};

/// As version 3.5 has it, in our words.
const FIRST: &str = r#"{"session_id": 3,
 "inverse3": [{"device_id": "A1",
   "config": {"type": "inverse3x", "device_info": {"device_type": 4}, "handedness": "left",
     "basis": {"permutation": "XYZ"}, "filters": {"damping": {"scalar": 0.0}}},
   "state": {"cursor_position": {"x": 0.01, "y": -0.12, "z": 0.195},
     "current_cursor_force": {"x": 0.5, "y": 0, "z": 1}, "transform": {}, "mode": "idle"},
   "status": {"calibrated": true, "ready": true, "power_supply": true}}],
 "wireless_verse_grip": [{"device_id": "g",
   "state": {"buttons": {"a": false, "b": true, "c": false}, "hall": 16,
     "orientation": {"w": 0.0, "x": 0.0, "y": 0.0, "z": 1.0}},
   "status": {"connected": true}}]}"#;

#[test]
fn a_first_message_is_read() {
    let snapshot = ServiceInventory::parse(FIRST).unwrap();
    assert_eq!(snapshot.generation, Generation::Vector);
    assert_eq!(snapshot.robots[0].kind, "inverse3x");
    assert_eq!(snapshot.robots[0].handedness.as_deref(), Some("left"));
    assert_eq!(snapshot.grips, ["g"]);
    let older = FIRST.replace("basis", "base").replace("filters", "other");
    let older = ServiceInventory::parse(&older).unwrap();
    assert_eq!(older.generation, Generation::Values);
}

/// By hand: right stays, what is away from the user is −z, up is y; zero is at (0, −0.11, 0.175) of the device.
#[test]
fn a_state_is_in_our_axes() {
    let state = State::parse(FIRST, "A1", Some("g")).unwrap();
    let place = Vec3::new(0.01, 0.02, 0.01);
    assert!((state.position - place).norm() < 1e-12, "{state:?}");
    assert_eq!(state.displayed, Some(Vec3::new(0.5, 1.0, 0.0)));
    assert_eq!(state.buttons, 0b010);
    // Half a turn about what is up.
    let turn = UnitQuaternion::from_axis_angle(&Vec3::y_axis(), std::f64::consts::PI);
    assert!(state.orientation.unwrap().angle_to(&turn) < 1e-6);
    assert_eq!(State::parse(FIRST, "A2", None), Err(Fault::Vanished));
    assert_eq!(State::parse(FIRST, "A1", None).unwrap().buttons, 0);
    assert_eq!(
        State::parse(FIRST, "A1", Some("h")).unwrap().orientation,
        None
    );
}

#[test]
fn a_force_is_written_in_the_words_of_its_generation() {
    let mut message = "something before".to_owned();
    let force = Vec3::new(0.25, 1.5, -0.125);
    force_command(&mut message, "\"A1\"", Generation::Vector, &force);
    assert_eq!(
        message,
        r#"{"inverse3":[{"device_id":"A1","commands":{"set_cursor_force":{"vector":{"x":0.250000,"y":0.125000,"z":1.500000}}}}]}"#
    );
    force_command(&mut message, "\"A1\"", Generation::Values, &Vec3::zeros());
    assert!(message.contains(r#""values":{"x":0.000000,"#), "{message}");
}

fn stand_in(device: impl Mechanics + 'static, settings: HaplyStandInSettings) -> HaplyStandIn {
    HaplyStandIn::start(vec![Box::new(device)], settings).unwrap()
}

fn open(service: &HaplyStandIn, number: usize) -> HaplyDevice {
    let device = HaplyDevice::open(service.address(), number).unwrap();
    device.with_timeout(PATIENT)
}

#[test]
fn both_generations_take_a_force() {
    for generation in [Generation::Vector, Generation::Values] {
        let service = stand_in(
            NoDevice::new(Vec3::new(0.01, 0.02, 0.03)),
            HaplyStandInSettings {
                generation,
                ..HaplyStandInSettings::default()
            },
        );
        let device = open(&service, 0);
        assert_eq!(device.generation(), generation);
        assert!(device.receives_events());
        let mut commanded = Commanded::new(Box::new(device), None);
        let force = Vec3::new(0.1, 0.2, -0.3);
        let state = commanded.exchange(force);
        assert!((state.position - Vec3::new(0.01, 0.02, 0.03)).norm() < 1e-15);
        assert!(state.ready && state.present);
        assert_eq!(state.displayed, Some(force));
        assert_eq!(service.force(0), force);
        let supervisor = commanded.servo.reader.supervisor.clone();
        supervisor.trip();
        commanded.servo.tick().unwrap();
        assert_eq!(service.force(0), Vec3::zeros());
        // The answers to what disabled it are not taken for those of the next commands.
        supervisor.arm();
        let state = commanded.exchange(force * 2.0);
        assert_eq!(state.displayed, Some(force * 2.0));
        drop(commanded);
        assert_eq!(service.force(0), Vec3::zeros());
    }
}

/// When it returns, zero is displayed, or it says that it cannot know.
#[test]
fn disabling_waits_for_the_zero() {
    let service = stand_in(
        NoDevice::new(Vec3::zeros()),
        HaplyStandInSettings::default(),
    );
    let device = HaplyDevice::open(service.address(), 0).unwrap();
    let mut device = device.with_timeout(std::time::Duration::from_millis(20));
    assert_eq!(device.disable(), Disabled::NoForce);
    assert_eq!(service.forces(0), [Vec3::zeros()]);
    service.misbehave(Some(Misbehaviour::NoReply));
    assert_eq!(device.disable(), Disabled::Unknown);
    service.misbehave(Some(Misbehaviour::Disconnects));
    assert_eq!(device.disable(), Disabled::Unknown);
}

/// What a service cannot do with a force must not go unnoticed.
#[test]
fn a_force_in_other_words_is_a_fault() {
    let service = stand_in(
        NoDevice::new(Vec3::zeros()),
        HaplyStandInSettings {
            generation: Generation::Values,
            ..HaplyStandInSettings::default()
        },
    );
    let mut commanded = Commanded::new(Box::new(open(&service, 0)), None);
    service.misbehave(Some(Misbehaviour::NoForce));
    commanded.exchange(Vec3::y());
    let faults: Vec<_> = (0..100)
        .filter_map(|_| commanded.servo.tick().unwrap().state.fault)
        .collect();
    // After twenty ticks; then there is no force that could be hidden.
    assert_eq!(faults, [Fault::Ignored]);
}

/// The button of a grip without a cable that is held, and what becomes of the force of a hand that holds none.
#[test]
fn a_grip_with_other_buttons_has_a_dead_mans_switch() {
    for (buttons, most) in [(0b010, 3.0), (0b100, 3.0), (0b001, 0.0), (0b000, 0.0)] {
        let hand = VirtualDevice::new(Trajectory::Waypoints(vec![Waypoint {
            buttons,
            ..Waypoint::new(0.0, Vec3::zeros())
        }]));
        let service = stand_in(hand, HaplyStandInSettings::default());
        let device = open(&service, 0).with_dead_man().unwrap();
        assert_eq!(
            device.capabilities().dead_man,
            Some(DeadMan::Buttons(0b110))
        );
        let push = |state: &palpate_servo::DeviceState, _: f64| {
            Vec3::y() * if state.time < 0.7 { 0.0 } else { 5.0 }
        };
        let mut servo = Ticked::new(Box::new(device), None, push);
        let last = (0..800).map(|_| servo.tick().unwrap()).last().unwrap();
        assert_eq!(last.output.norm(), most, "{buttons:#b}");
        assert_eq!(last.stage == Stage::Live, most > 0.0);
    }
    for grip in [StandInGrip::None, StandInGrip::Wired] {
        let settings = HaplyStandInSettings {
            grip,
            ..HaplyStandInSettings::default()
        };
        let service = stand_in(NoDevice::new(Vec3::zeros()), settings);
        let said = open(&service, 0).with_dead_man().err().unwrap().to_string();
        assert!(said.contains("has no button besides the first"), "{said}");
    }
}

#[test]
fn a_grip_turns_shuts_and_cuts() {
    let turned = UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9);
    for grip in [StandInGrip::Wired, StandInGrip::Wireless, StandInGrip::None] {
        let hand = VirtualDevice::new(Trajectory::Waypoints(vec![Waypoint {
            orientation: Some(turned),
            buttons: 0b101,
            ..Waypoint::new(0.0, Vec3::zeros())
        }]));
        let settings = HaplyStandInSettings {
            grip,
            ..HaplyStandInSettings::default()
        };
        let service = stand_in(hand, settings);
        let mut device = open(&service, 0);
        let state = device.exchange(&Command::without_force(0.0)).unwrap();
        let expected = match grip {
            StandInGrip::None => (0, 0.0),
            StandInGrip::Wired => (0b001, 1.0),
            StandInGrip::Wireless => (0b101, 1.0),
        };
        assert_eq!((state.buttons, state.grip), expected);
        match state.orientation {
            None => assert_eq!(grip, StandInGrip::None),
            // Rounding of a product of turns.
            Some(seen) => assert!(seen.angle_to(&turned) < 1e-7),
        }
    }
}

#[test]
fn two_hands_have_a_device_each() {
    let places = [Vec3::x() * 0.05, Vec3::x() * -0.05];
    let devices = places.map(|place| Box::new(NoDevice::new(place)) as Box<dyn Mechanics>);
    let service = HaplyStandIn::start(devices.into(), HaplyStandInSettings::default()).unwrap();
    assert_eq!(list(service.address()).unwrap().len(), 2);
    let hands = [0, 1].map(|number| open(&service, number));
    let mut hands = hands.map(|hand| Commanded::new(Box::new(hand), None));
    for (number, hand) in hands.iter_mut().enumerate() {
        let force = Vec3::y() * (0.1 + number as f64);
        let state = hand.exchange(force);
        assert!((state.position - places[number]).norm() < 1e-15);
        assert_eq!(service.force(number), force);
    }
    let third = HaplyDevice::open(service.address(), 2).err().unwrap();
    assert!(
        third
            .to_string()
            .contains("has 2 of its devices, and number 3"),
        "{third}"
    );
}

/// The judge is the same hand on the same wall without a service between: the same places to the last bits of a
/// number in text, the same forces but for the millionth of a newton to which they are written.
#[test]
fn a_wall_feels_as_without_a_service() {
    let expected = press(&mut Ticked::new(Box::new(pressing()), None, wall)).unwrap();
    let service = stand_in(pressing(), HaplyStandInSettings::default());
    let device = open(&service, 0);
    let mut by_service = Ticked::new(Box::new(device), None, wall);
    let found = press(&mut by_service).unwrap();
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found.state.position - expected.state.position).norm() < 1e-12);
        assert!((found.output - expected.output).norm() < 1e-9);
    }
    let forces = service.forces(0);
    for (force, expected) in forces[1..].iter().zip(&expected) {
        assert!((force - expected.output).norm() < 1e-6, "{force}");
    }
}

#[test]
fn a_service_that_is_not_there_is_one_sentence() {
    // A port that was free a moment ago.
    let port = std::net::TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap()
        .port();
    let address: HaplyAddress = format!("127.0.0.1:{port}").parse().unwrap();
    let said = HaplyDevice::open(&address, 0).err().unwrap().to_string();
    assert!(
        said.starts_with("no Haply Inverse Service answers at 127.0.0.1:"),
        "{said}"
    );
    assert!(
        said.contains("; start it") && !said.contains('\n'),
        "{said}"
    );
    for bad in [
        "",
        "localhost",
        "localhost:",
        "a b:1",
        ":1",
        "h:70000",
        "h:1,x",
    ] {
        assert!(bad.parse::<HaplyAddress>().is_err(), "{bad}");
    }
    let both: HaplyAddress = "box:1,2".parse().unwrap();
    assert_eq!((both.port, both.events_port), (1, 2));
}

/// Who accepts and says nothing, or speaks otherwise, is told from the service, in a second or two.
#[test]
fn who_is_no_service_is_found_out() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let address: HaplyAddress = address.parse().unwrap();
    let said = HaplyDevice::open(&address, 0).err().unwrap().to_string();
    assert!(said.contains("it accepts, and is silent"), "{said}");
    let speaks = std::thread::spawn(move || {
        use std::io::{Read, Write};
        // The first is the one from above.
        for stream in listener.incoming().take(2) {
            let mut stream = stream.unwrap();
            let _ = stream.read(&mut [0; 1024]);
            let _ = stream.write_all(b"HTTP/1.1 404 Not Found\r\n\r\n");
        }
    });
    let said = HaplyDevice::open(&address, 0).err().unwrap().to_string();
    assert!(said.contains("is no Haply Inverse Service"), "{said}");
    speaks.join().unwrap();
}

/// Printed, for it is the machine's; the bound is a tick.
#[test]
fn a_round_trip_fits_into_a_tick() {
    let service = stand_in(
        NoDevice::new(Vec3::zeros()),
        HaplyStandInSettings::default(),
    );
    let mut device = open(&service, 0);
    let mut times = Histogram::default();
    for tick in 0..5000 {
        let began = Instant::now();
        let command = Command::without_force(f64::from(tick) * 1e-3);
        device.exchange(&command).unwrap();
        times.add(began.elapsed().as_secs_f64());
    }
    let found = times.percentiles();
    println!("round trip: {found:?}");
    assert!(found.p50 < 1e-3, "{found:?}");
}
