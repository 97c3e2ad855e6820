//! What a rig does when its device or whoever drives it is lost in contact. Judges: the same run without the loss,
//! 25 ms.

use palpate_files::Recording;
use palpate_files::recording::RecordingWriter;
use palpate_measure::phantom::{Imperfections, MECHANICS_STEP, Machine, TwoMass, VirtualPhantom};
use palpate_measure::{Error, Indenter, Reference, RigSample, RigSettings, VirtualSpecimen};
use palpate_servo::{
    Clock, Fault, Limits, PidGains, Sample, ServoLoop, ServoSettings, Stage, Vec3,
};

use crate::rig::{RADIUS, rig_on, tissue, usual};

/// The samples of a whole run whose device is lost at a time [s], what the rig said, and what it says next.
fn lost_at(time: f64) -> (Vec<RigSample>, Option<Error>, Option<Error>, Recording) {
    let specimen = VirtualSpecimen::of_tissue(&tissue(), RADIUS, 8e-3, &mut |_| ()).unwrap();
    let imperfections = Imperfections {
        disconnect_time: time,
        ..Imperfections::premium()
    };
    let mut rig = rig_on(imperfections, specimen, RigSettings::default(), 1);
    rig.approach(&mut |_| true).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recording.csv");
    let mut writer = RecordingWriter::create(&path, &rig.describe(&usual(), 1)).unwrap();
    let mut samples = Vec::new();
    let said = rig.press(&usual(), &mut |sample| {
        let row = [sample.time, sample.depth.unwrap(), sample.force];
        writer.write(row).unwrap();
        samples.push(*sample);
        true
    });
    writer.finish("the device was lost").unwrap();
    let next = rig.wait(0.1, &mut |_| true).err();
    (samples, said.err(), next, Recording::read(&path).unwrap())
}

/// Every sample up to the loss is there, in the file too; the error is the fault, and stays.
#[test]
fn a_device_lost_in_contact_is_told_and_its_recording_whole() {
    let (whole, none, ..) = lost_at(f64::INFINITY);
    assert_eq!(none, None);
    let deep = whole.iter().position(|s| s.depth > Some(3e-3)).unwrap();
    let lost = whole[deep].time - 1e-9;
    let (samples, said, next, recording) = lost_at(lost);
    assert_eq!(said, Some(Error::Device(Fault::Silent)));
    assert_eq!(next, said);
    // To the tick: the last sample is the last that the device answered.
    assert_eq!(samples, whole[..deep]);
    let forces: Vec<f64> = samples.iter().map(|s| s.force).collect();
    assert_eq!(recording.force_n(), forces);
    assert!(samples[deep - 1].force > 0.05);
}

/// An indenter that holds against a spring of 100 N/m, 5 mm deep.
fn holding(wanted: impl Fn(u64) -> Option<f64>) -> Vec<Sample> {
    let machine = Machine::of_two_masses(&TwoMass::consistent(), MECHANICS_STEP);
    let spring = |_: f64, place: &Vec3, _: &Vec3| Vec3::z() * (-100.0 * place.z).max(0.0);
    let device = VirtualPhantom::with_axes(machine, &Vec3::zeros(), Imperfections::premium())
        .with_contact(Box::new(spring));
    let reference = |height: f64| Reference {
        position: Vec3::z() * height,
        velocity: Vec3::zeros(),
        driven: true,
    };
    let (indenter, mut references) = Indenter::new(PidGains::tuned(), reference(0.0));
    let settings = ServoSettings {
        limits: Some(Limits::without_hand()),
        ..ServoSettings::default()
    };
    let (mut servo, mut reader) =
        ServoLoop::new(Box::new(device), Box::new(indenter), settings).unwrap();
    servo.run(&mut Clock::virtual_time(), |tick| {
        if let Some(height) = wanted(tick) {
            references.send(reference(height));
        }
        tick < 3000
    });
    reader.log.drain().collect()
}

/// From here on nothing sensible comes any more.
const LOST: u64 = 2500;

fn assert_lost_within(samples: &[Sample], milliseconds: u64, is_it: impl Fn(&Fault) -> bool) {
    let before = &samples[LOST as usize - 200..LOST as usize];
    let mean = before.iter().map(|s| s.output.norm()).sum::<f64>() / 200.0;
    // 100 N/m, 5 mm and the device's own 32 N/m; dry friction takes or adds 0.04 N.
    assert!((mean - 0.66).abs() < 0.06, "{mean}");
    let faulted = |sample: &&Sample| matches!(sample.stage, Stage::Faulted(_));
    let first = samples.iter().find(faulted).unwrap();
    println!("{:?}, {} ms later", first.stage, first.tick - LOST);
    assert!(first.tick - LOST <= milliseconds);
    for sample in samples.iter().filter(|s| s.tick >= first.tick) {
        assert_eq!(sample.output, Vec3::zeros());
        let Stage::Faulted(fault) = sample.stage else {
            panic!("{sample:?}");
        };
        assert!(is_it(&fault), "{fault:?}");
    }
}

#[test]
fn a_law_that_falls_silent_in_contact_is_a_fault_within_25_ms() {
    let down = |tick: u64| -5e-3 * (tick as f64 / 1500.0).min(1.0);
    let silent = holding(|tick| (tick < LOST).then(|| down(tick)));
    let stale = |fault: &Fault| matches!(fault, Fault::StaleModel { .. });
    assert_lost_within(&silent, 25, stale);
    let mad = holding(|tick| Some(if tick < LOST { down(tick) } else { f64::NAN }));
    assert_lost_within(&mad, 1, |fault| *fault == Fault::NonFiniteForce);
}
