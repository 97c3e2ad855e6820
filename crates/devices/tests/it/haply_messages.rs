//! Messages of any kind: an answer or a fault, never a panic, never a number that is none.

use std::time::{Duration, Instant};

use palpate_device_stand_ins::{HaplyStandIn, HaplyStandInSettings, Misbehaviour};
use palpate_devices::haply::{Event, HaplyDevice, ServiceInventory, State};
use palpate_servo::{Command, Device, NoDevice, Vec3};
use proptest::prelude::*;

const STATE: &str = r#"{"inverse3": [{"device_id": "0", "config": {"type": "inverse3", "basis": {}},
 "state": {"cursor_position": {"x": 0.01, "y": -0.12, "z": 0.195}, "current_cursor_force": {"x": 0, "y": 0, "z": 1e-3}},
 "status": {"calibrated": true, "ready": true, "power_supply": true}}],
 "verse_grip": [{"device_id": "g", "state": {"button": true, "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}}, "status": {}}]}"#;

const EVENT: &str = r#"{"name": "device-safety-triggered", "category": "device", "level": "error",
 "data": {"device_id": "0", "safety_type": "stall_detected"}, "message": "text"}"#;

/// All cases on demand.
pub(crate) fn tries() -> ProptestConfig {
    let cases = if std::env::var_os("PALPATE_FULL").is_some() {
        20_000
    } else {
        512
    };
    ProptestConfig::with_cases(cases)
}

fn read_all(text: &str) -> Result<(), TestCaseError> {
    let _ = ServiceInventory::parse(text);
    if let Ok(event) = Event::parse(text) {
        let _ = event.fault("0");
    }
    if let Ok(state) = State::parse(text, "0", Some("g")) {
        prop_assert!(state.position.iter().all(|number| number.is_finite()));
        if let Some(force) = state.displayed {
            prop_assert!(force.iter().all(|number| number.is_finite()));
        }
        if let Some(turn) = state.orientation {
            // Rounding of a length of one.
            prop_assert!((turn.norm() - 1.0).abs() < 1e-9);
        }
    }
    Ok(())
}

/// What damage does to a text.
#[derive(Debug, Clone)]
enum Damage {
    Cut(usize),
    Byte(usize, u8),
    Repeat(usize, usize),
    Drop(usize, usize),
    Number(usize, &'static str),
}

fn damage() -> impl Strategy<Value = Damage> {
    let place = 0..700usize;
    let number = prop::sample::select(vec![
        "1e999",
        "-1e308",
        "NaN",
        "null",
        "1e-400",
        "true",
        "\"\"",
        "[]",
        "{}",
        "00",
        "-",
        "1e308",
        "18446744073709551616",
    ]);
    prop_oneof![
        place.clone().prop_map(Damage::Cut),
        (place.clone(), any::<u8>()).prop_map(|(at, byte)| Damage::Byte(at, byte)),
        (place.clone(), 1..80usize).prop_map(|(at, length)| Damage::Repeat(at, length)),
        (place.clone(), 1..80usize).prop_map(|(at, length)| Damage::Drop(at, length)),
        (place, number).prop_map(|(at, number)| Damage::Number(at, number)),
    ]
}

impl Damage {
    fn done_to(&self, bytes: &mut Vec<u8>) {
        let length = bytes.len();
        let inside = |at: usize| at.min(length);
        match *self {
            Self::Cut(at) => bytes.truncate(at),
            Self::Byte(at, byte) => {
                if let Some(there) = bytes.get_mut(at) {
                    *there = byte;
                }
            }
            Self::Repeat(at, long) => {
                let part = bytes[inside(at)..inside(at + long)].to_vec();
                bytes.splice(inside(at)..inside(at), part);
            }
            Self::Drop(at, long) => drop(bytes.drain(inside(at)..inside(at + long))),
            Self::Number(at, number) => {
                // The first number from there on.
                let is_digit = |byte: &u8| byte.is_ascii_digit() || b".-e".contains(byte);
                let from = (inside(at)..length).find(|at| bytes[*at].is_ascii_digit());
                let Some(from) = from else { return };
                let to = (from..length)
                    .find(|at| !is_digit(&bytes[*at]))
                    .unwrap_or(length);
                bytes.splice(from..to, number.bytes());
            }
        }
    }
}

proptest! {
    #![proptest_config(tries())]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        read_all(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn damaged_messages(
        which in any::<bool>(),
        damages in prop::collection::vec(damage(), 1..5),
    ) {
        let mut bytes = if which { STATE } else { EVENT }.as_bytes().to_vec();
        for damage in &damages {
            damage.done_to(&mut bytes);
        }
        read_all(&String::from_utf8_lossy(&bytes))?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 0, ..ProptestConfig::with_cases(tries().cases / 16) })]

    /// Bytes on the wire, below the messages: as a whole frame of any kind, and as they are.
    #[test]
    fn any_bytes_on_the_wire(
        bytes in prop::collection::vec(any::<u8>(), 1..200),
        is_framed in any::<bool>(),
    ) {
        let wire = match is_framed {
            // The first byte says what kind of frame; its length follows.
            true => [&[bytes[0], (bytes.len() - 1).min(125) as u8], &bytes[1..]].concat(),
            false => bytes,
        };
        let rest: Box<dyn palpate_device_stand_ins::Mechanics> = Box::new(NoDevice::new(Vec3::zeros()));
        let service = HaplyStandIn::start(vec![rest], HaplyStandInSettings::default()).unwrap();
        let mut device = HaplyDevice::open(service.address(), 0).unwrap();
        service.misbehave(Some(Misbehaviour::SendsRaw(wire)));
        let command = Command::without_force(0.0);
        let began = Instant::now();
        let answer = device.exchange(&command);
        prop_assert!(answer.is_err(), "{answer:?}");
        // Far more than it may take, for a machine that is busy elsewhere.
        prop_assert!(began.elapsed() < Duration::from_secs(2));
        // It stays.
        prop_assert_eq!(device.exchange(&command), answer);
    }
}

/// The undamaged ones are read, so that the damaged ones mean something.
#[test]
fn whole_messages() {
    assert!(State::parse(STATE, "0", Some("g")).is_ok());
    assert!(Event::parse(EVENT).unwrap().fault("0").is_some());
}
