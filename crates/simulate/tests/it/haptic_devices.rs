//! Devices of a scene: palpated through a driver and its stand-in, an organ feels as through a virtual device.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use palpate_device_stand_ins::{
    HaplyStandIn, HaplyStandInSettings, Mechanics, Misbehaviour, StandInClock, StandInLibrary,
};
use palpate_devices::openigtlink::message;
use palpate_devices::publisher::{Protocol, Publisher};
use palpate_devices::{Kind, Places};
use palpate_files::scene::DeviceKind;
use palpate_files::{Scene, SessionRow};
use palpate_geometry::{AabbTree, Vec3};
use palpate_servo::{
    Capabilities, DeviceState, Fault, NoDevice, Sample, ServoSettings, Stage, Trajectory,
    VirtualDevice,
};
use palpate_simulate::Simulation;
use palpate_simulate::interactive::{
    DevicePlacement, Environment, Interaction, PlacedDevice, PreparedModel, SceneDevices,
    VirtualInteraction,
};

use crate::interactive::{POLE, advance};
use crate::scenes::Setting;

/// A machine that is busy elsewhere is no fault here.
const PATIENT: Duration = Duration::from_secs(5);

/// A device in the time of the interaction, however often it is asked.
struct InTime {
    device: VirtualDevice,
    time: Arc<AtomicU64>,
}

impl Mechanics for InTime {
    fn advance(&mut self, _time: f64, force: &Vec3) -> DeviceState {
        let time = f64::from_bits(self.time.load(Ordering::Acquire));
        self.device.advance(time, force)
    }
}

fn scene(device: DeviceKind) -> (Scene, Arc<Simulation>) {
    let mut scene = Setting::default().scene();
    scene.tools[0].device = device;
    let simulation = Simulation::new(&scene).unwrap();
    (scene, Arc::new(simulation))
}

fn service(device: Box<dyn Mechanics>) -> (HaplyStandIn, Places) {
    let service = HaplyStandIn::start(vec![device], HaplyStandInSettings::default()).unwrap();
    let places = Places {
        haply: service.address().clone(),
        timeout: PATIENT,
        ..Places::default()
    };
    (service, places)
}

/// Down to 4 mm into the pole of the hemisphere and 20 mm up again, by a handle that stands so.
fn palpating(placement: &DevicePlacement) -> VirtualDevice {
    let handle = |place: Vec3| placement.rotation.inverse() * (place - placement.origin);
    let [low, high] = [POLE - Vec3::z() * 4e-3, POLE + Vec3::z() * 20e-3].map(handle);
    VirtualDevice::new(Trajectory::Sine {
        center: 0.5 * (low + high),
        // It begins in the middle and goes up.
        amplitude: 0.5 * (high - low),
        frequency: 0.4,
    })
}

fn palpated(simulation: &Arc<Simulation>, device: PlacedDevice) -> (Vec<Sample>, Vec<SessionRow>) {
    palpated_in_time(simulation, device, &AtomicU64::new(0))
}

/// The same, with its time told.
fn palpated_in_time(
    simulation: &Arc<Simulation>,
    device: PlacedDevice,
    time: &AtomicU64,
) -> (Vec<Sample>, Vec<SessionRow>) {
    let settings = ServoSettings {
        log: 10_000,
        ..ServoSettings::default()
    };
    let devices = vec![Some(device)];
    let mut interaction = VirtualInteraction::new(simulation.clone(), devices, settings).unwrap();
    for _ in 0..5000 {
        time.store(interaction.time().to_bits(), Ordering::Release);
        interaction.advance().unwrap();
    }
    let samples = interaction.samples(0).collect();
    (samples, interaction.rows().collect())
}

fn open(scene: &Scene, simulation: &Simulation, places: &Places) -> PlacedDevice {
    let devices = SceneDevices::open(scene, simulation, places).unwrap();
    devices.devices.into_iter().next().unwrap().unwrap()
}

/// Where the device of a scene stands; its capabilities.
fn stands(scene: &Scene, simulation: &Simulation) -> (DevicePlacement, Capabilities) {
    let (_service, places) = service(Box::new(NoDevice::new(Vec3::zeros())));
    let device = open(scene, simulation, &places);
    (device.placement, device.device.capabilities().clone())
}

/// The judge is the same handle in the same place without a driver. What a message loses are the last bits of a number
/// and millionths of a newton.
#[test]
fn an_organ_feels_the_same_through_a_service() {
    let (scene, simulation) = scene(DeviceKind::Haply);
    let (placement, capabilities) = stands(&scene, &simulation);
    let direct = PlacedDevice {
        device: Box::new(palpating(&placement).with_capabilities(capabilities)),
        placement,
    };
    let (expected, expected_rows) = palpated(&simulation, direct);
    let (service, places) = service(Box::new(palpating(&placement)));
    let (found, rows) = palpated(&simulation, open(&scene, &simulation, &places));
    assert_eq!(found.len(), expected.len());
    let largest = expected.iter().map(|sample| sample.output.norm());
    let largest = largest.fold(0.0, f64::max);
    assert!(largest > 0.05, "{largest}");
    let mut apart: f64 = 0.0;
    for (found, expected) in found.iter().zip(&expected) {
        apart = apart.max((found.output - expected.output).norm());
    }
    println!("{apart} N apart of {largest} N");
    assert!(apart < 1e-6 * largest, "{apart}");
    for (row, expected) in rows.iter().zip(&expected_rows) {
        let apart = Vec3::from(row.force_n) - Vec3::from(expected.force_n);
        assert!(apart.norm() < 1e-6 * largest, "{apart}");
    }
    assert_eq!(service.force(0), Vec3::zeros());
}

/// The same through a library that is asked at every tick. One with a scheduler has its own clock: how it feels is tested
/// beside its driver.
#[test]
fn an_organ_feels_the_same_through_a_library() {
    let (scene, simulation) = scene(DeviceKind::ForceDimension);
    let library = StandInLibrary::build(Kind::ForceDimension).unwrap();
    let places = Places {
        force_dimension: Some(library.path().to_owned()),
        ..Places::default()
    };
    let device = open(&scene, &simulation, &places);
    let (placement, capabilities) = (device.placement, device.device.capabilities().clone());
    drop(device);
    let time = Arc::new(AtomicU64::new(0));
    let hand = InTime {
        device: palpating(&placement),
        time: time.clone(),
    };
    library.carry(Box::new(hand), StandInClock::PerCommand(1e-3), 0);
    let device = open(&scene, &simulation, &places);
    let (found, _) = palpated_in_time(&simulation, device, &time);
    let direct = PlacedDevice {
        device: Box::new(palpating(&placement).with_capabilities(capabilities)),
        placement,
    };
    let (expected, _) = palpated(&simulation, direct);
    let largest = expected.iter().map(|sample| sample.output.norm());
    let largest = largest.fold(0.0, f64::max);
    let apart = found.iter().zip(&expected);
    let apart = apart.map(|(found, expected)| (found.output - expected.output).norm());
    let apart = apart.fold(0.0, f64::max);
    println!("{apart} N apart of {largest} N");
    assert!(
        largest > 0.05 && apart < 1e-6 * largest,
        "{apart} of {largest}"
    );
}

/// Right, up and toward the user are so in the picture; the tip begins clear of the organ.
#[test]
fn a_device_stands_as_its_picture_is_seen() {
    let (mut scene, simulation) = scene(DeviceKind::Haply);
    let (placement, _) = stands(&scene, &simulation);
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| placement.rotation * axis);
    for (axis, expected) in axes.iter().zip([Vec3::x(), Vec3::z(), -Vec3::y()]) {
        assert!((axis - expected).norm() < 1e-12, "{axis}");
    }
    // From the left and above: what is toward the user is toward the eye.
    (scene.view.eye_m, scene.view.target_m) = (Some([-0.3, 0.0, 0.3]), Some([0.0, 0.0, 0.04]));
    let (placement, _) = stands(&scene, &simulation);
    let toward = placement.rotation * Vec3::z();
    assert!((toward - Vec3::new(-0.3, 0.0, 0.26).normalize()).norm() < 1e-12);
    assert!((placement.rotation * Vec3::x() + Vec3::y()).norm() < 1e-12);
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let clear = surface
        .signed_distance(&tree, &placement.tip(&Vec3::zeros()))
        .1;
    assert!(clear > 0.010 && clear < 0.030, "{clear}");
}

#[test]
fn a_device_that_is_not_there_is_one_sentence() {
    let (scene, simulation) = scene(DeviceKind::Haply);
    let port = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = port.local_addr().unwrap().to_string();
    drop(port);
    let places = Places {
        haply: address.parse().unwrap(),
        ..Places::default()
    };
    let error = SceneDevices::check(&scene, &places).unwrap_err();
    let said = error.to_string();
    let begins = "the tool \"right\" has no device: no Haply Inverse Service answers at ";
    assert!(said.starts_with(begins) && !said.contains('\n'), "{said}");
    assert!(!error.is_input());
    assert!(SceneDevices::open(&scene, &simulation, &places).is_err());
}

/// In contact, through the same chain as every other force.
#[test]
fn a_fault_of_the_device_ends_the_touch() {
    let (scene, simulation) = scene(DeviceKind::Haply);
    let (placement, _) = stands(&scene, &simulation);
    let (service, places) = service(Box::new(palpating(&placement)));
    let device = open(&scene, &simulation, &places);
    let devices = vec![Some(device)];
    let settings = ServoSettings::default();
    let mut interaction = VirtualInteraction::new(simulation, devices, settings).unwrap();
    // Three quarters of a swing, where it is deepest.
    advance(&mut interaction, 1875);
    let last = interaction.samples(0).last().unwrap();
    assert!(
        last.stage == Stage::Live && last.output.norm() > 0.01,
        "{last:?}"
    );
    service.misbehave(Some(Misbehaviour::NoPower));
    advance(&mut interaction, 1);
    let last = interaction.samples(0).last().unwrap();
    assert_eq!(last.output, Vec3::zeros());
    assert_eq!(last.stage, Stage::Faulted(Fault::Unpowered));
    service.misbehave(Some(Misbehaviour::Disconnects));
    assert_eq!(interaction.advance(), Err(Fault::Disconnected));
}

/// The organ that is palpated by a thread's hand is seen by whoever connects: the tool where the snapshot has it, the
/// force on it, and the surface with as many vertices.
#[test]
fn a_touch_is_shown_in_an_operating_room() {
    use std::io::{Read, Write};
    let (_, simulation) = scene(DeviceKind::Virtual);
    let anywhere = "127.0.0.1:0".parse().unwrap();
    let room = Publisher::open(anywhere, Protocol::OpenIgtLink).unwrap();
    let device = PlacedDevice::palpating(&simulation, &simulation.tools()[0]);
    let settings = ServoSettings::default();
    let devices = vec![Some(device)];
    let environment = Environment {
        publishers: std::slice::from_ref(&room),
        ..Environment::default()
    };
    let prepared = PreparedModel::new(simulation.clone());
    let touch = Interaction::start_in(&environment, prepared, devices, settings).unwrap();
    let mut stream = std::net::TcpStream::connect(room.address()).unwrap();
    let mut request = Vec::new();
    let now = std::time::SystemTime::now();
    message::append(&mut request, "GET_POLYDATA", "", now, |_| ());
    stream.write_all(&request).unwrap();
    let (mut heights, mut vertices, mut largest) = (Vec::new(), None, 0.0_f64);
    // Two seconds of a hand that goes 4 mm up and down in each.
    for _ in 0..300 {
        let mut header = [0; message::HEADER];
        stream.read_exact(&mut header).unwrap();
        let size = u64::from_be_bytes(header[42..50].try_into().unwrap());
        let mut body = vec![0; size as usize];
        stream.read_exact(&mut body).unwrap();
        let kind = &header[2..14];
        if kind.starts_with(b"TRANSFORM") {
            heights.push(f32::from_be_bytes(body[44..48].try_into().unwrap()));
        } else if kind.starts_with(b"SENSOR") {
            largest = largest.max(f64::from_be_bytes(body[26..34].try_into().unwrap()));
        } else if kind.starts_with(b"POLYDATA") {
            vertices = Some(u32::from_be_bytes(body[..4].try_into().unwrap()));
        }
        touch.arm();
    }
    let expected = simulation.surface().mesh().vertices().len();
    assert_eq!(vertices, Some(expected as u32));
    let low = heights.iter().copied().fold(f32::INFINITY, f32::min);
    let high = heights.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    // Of the pole at 50 mm, as far as 50 pictures a second catch its ends.
    assert!(
        (low - 46.0).abs() < 0.5 && (high - 54.0).abs() < 0.5,
        "{low} to {high} mm"
    );
    assert!(largest > 0.01, "{largest} N");
}
