//! A rig with a sensor of its own over tissue that is its own. Judge: the rig whose virtual sensor feels the same
//! specimen, and what a rig without its sensor may do: go out, and nothing else.

use std::sync::{Arc, Mutex};

use nalgebra::Matrix3;
use palpate_files::Recording;
use palpate_files::recording::RecordingHeader;
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass, VirtualPhantom};
use palpate_measure::{
    Axes, Ended, Error, MountedSensor, Phase, Recorder, Rig, RigSample, RigSettings,
};
use palpate_servo::{
    Capabilities, Clock, Command, Device, DeviceState, Disabled, Fault, ForceSensor,
    ForceSensorSpec, ForceTorque, SensorFault, Vec3,
};

use crate::rig::{rig, soft, usual};

/// What the tissue does to the tip, and what is wrong with the sensor.
type Wire = Arc<Mutex<(ForceTorque, Option<SensorFault>)>>;

/// A sensor on a wire, with a zero that is somewhere and its z toward the tip.
struct OnWire {
    wire: Wire,
    spec: ForceSensorSpec,
}

const ZERO: [f64; 6] = [0.3, -0.2, 1.5, 1e-3, 2e-3, -1e-3];

impl ForceSensor for OnWire {
    fn spec(&self) -> &ForceSensorSpec {
        &self.spec
    }

    fn read(&mut self) -> Result<ForceTorque, SensorFault> {
        let (felt, fault) = *self.wire.lock().unwrap();
        match fault {
            Some(fault) => Err(fault),
            None => {
                let turned = |v: &Vec3| Vec3::new(v.x, -v.y, -v.z);
                Ok(felt.map(turned) + ForceTorque::from_components(ZERO))
            }
        }
    }
}

/// A device whose up is y, over tissue that nobody told the rig of.
struct OverTissue(VirtualPhantom);

impl Device for OverTissue {
    fn capabilities(&self) -> &Capabilities {
        self.0.capabilities()
    }

    fn enable(&mut self) -> Result<(), Fault> {
        self.0.enable()
    }

    fn exchange(&mut self, command: &Command) -> Result<DeviceState, Fault> {
        self.0.exchange(command)
    }

    fn disable(&mut self) -> Disabled {
        self.0.disable()
    }
}

fn over_tissue() -> (Rig, Wire) {
    let wire: Wire = Arc::default();
    let (mut tissue, felt) = (soft(), wire.clone());
    let touch = move |time: f64, place: &Vec3, _: &Vec3| {
        // The rig's axes from those of a device, and back.
        let place = Vec3::new(place.x, -place.z, place.y);
        let on_tip = tissue.touch(time, &place, MECHANICS_STEP);
        felt.lock().unwrap().0 = on_tip;
        let [x, y, z] = on_tip.force.into();
        Vec3::new(x, z, -y)
    };
    let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
    let device = VirtualPhantom::with_axes(machine, &Vec3::zeros(), Imperfections::premium())
        .with_contact(Box::new(touch));
    let sensor = OnWire {
        wire: wire.clone(),
        spec: ForceSensorSpec {
            name: "on a wire".to_owned(),
            range: ForceTorque::from_components([12.0, 12.0, 17.0, 0.12, 0.12, 0.12]),
            has_six_axes: true,
        },
    };
    let mounted = MountedSensor {
        sensor: Box::new(sensor),
        indenter_from_sensor: Matrix3::from_diagonal(&Vec3::new(1.0, -1.0, -1.0)),
        tip_distance: Some(0.05),
    };
    let device = Box::new(OverTissue(device));
    let (header, clock) = (RecordingHeader::default(), Clock::virtual_time());
    let rig = Rig::with_sensor(device, mounted, header, RigSettings::default(), clock);
    (rig.unwrap(), wire)
}

fn peak(rig: &mut Rig) -> f64 {
    assert_eq!(rig.approach(&mut |_| true).unwrap(), Ended::Complete);
    let mut peak = 0.0_f64;
    rig.press(&usual(), &mut |sample| {
        peak = peak.max(sample.force);
        true
    })
    .unwrap();
    peak
}

/// The zero is taken and the axes are turned: what is left is the contact (0.1 mm of 4) and the virtual sensor's steps.
#[test]
fn a_real_sensor_measures_what_a_virtual_one_does() {
    let expected = peak(&mut rig(soft(), RigSettings::default(), 1));
    let found = peak(&mut over_tissue().0);
    assert!((found / expected - 1.0).abs() < 0.05, "{found} {expected}");
}

/// A fault in the middle of a hold: the recording ends with the last sample that the sensor gave and says why, the tip
/// goes out without a stop, and does not go in again before the sensor answers.
#[test]
fn a_fault_of_the_sensor_withdraws_and_is_recorded() {
    let faults = [
        SensorFault::Silent {
            age: 0.021,
            limit: 0.02,
        },
        SensorFault::BadReading {
            what: "a packet of 35 bytes",
        },
        SensorFault::Saturated { axis: "fz" },
        SensorFault::Lost { lost: 12 },
    ];
    for fault in faults {
        let (mut rig, wire) = over_tissue();
        rig.approach(&mut |_| true).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("one.csv");
        let mut recorder = Recorder::begin(&file, &rig.describe(&usual(), 1), Axes::Six).unwrap();
        let (mut pressed, mut all) = (0, Vec::<RigSample>::new());
        let ended = rig.press_with_listener(&usual(), &mut |sample| {
            all.push(*sample);
            if sample.phase == Phase::Pressing {
                pressed += 1;
                recorder.take(sample).unwrap();
                if sample.depth.unwrap() > 3.5e-3 {
                    wire.lock().unwrap().1 = Some(fault);
                }
            }
            true
        });
        assert_eq!(ended, Err(Error::Sensor(fault)));
        recorder.finish(&ended).unwrap();
        let read = Recording::read(&file).unwrap();
        assert_eq!(read.time_s().len(), pressed);
        let cause = fault.to_string();
        let cause = cause.split("; ").next().unwrap();
        assert_eq!(read.header.cut_short(), Some(cause));
        // Out: every tick after it is one of the withdrawal, and the last is above the tissue.
        let after = &all[all
            .iter()
            .rposition(|s| s.phase == Phase::Pressing)
            .unwrap()
            + 1..];
        assert!(
            after
                .iter()
                .all(|s| s.phase == Phase::Withdrawing && s.sensor_fault == Some(fault))
        );
        assert!(after.last().unwrap().depth.unwrap() < -1.8e-3);
        // Idle it stays, and nothing moves it down.
        let mut heights = Vec::new();
        for _ in 0..50 {
            let waited = rig.wait_one_tick(&mut |sample| {
                heights.push(sample.height);
                true
            });
            assert_eq!(waited, Ok(Ended::Complete));
        }
        let high = heights.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(rig.approach(&mut |_| true), Err(Error::Sensor(fault)));
        assert!(high > after[0].height, "{fault:?}");
        wire.lock().unwrap().1 = None;
        assert_eq!(rig.approach(&mut |_| true), Ok(Ended::Complete));
    }
}
