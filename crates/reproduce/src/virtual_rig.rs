//! The source's rig over a tissue of known law: recordings where the source printed none.
//!
//! *Assumed*: a ramp of 0.5 s, for the source gives no speed, and a hold until 40 s; white noise as large
//! as the steps of the source's sensor leave; a device that tracks its reference exactly.

use palpate_characterize::CleanRecording;
use palpate_characterize::clean::{CleanSettings, clean};
use palpate_characterize::fit::Random;
use palpate_characterize::inverse::{Body, CandidateLaw, Curves};
use palpate_files::Recording;
use palpate_files::recording::{Condition, IndenterShape, RecordingHeader, Samples};
use palpate_mechanics::IndentationCurve;
use palpate_mechanics::finite_elements::indentation::History;

use crate::Error;

/// The source's probe is 2 mm in diameter.
pub(super) const RADIUS: f64 = 1e-3;

/// Duration of a ramp [s].
pub(super) const RAMP: f64 = 0.5;

/// How long a ramp and its hold last [s]: the source waits for about 40 s.
pub(super) const END: f64 = 40.0;

/// Samples per second of a ramp and its hold [Hz]: means of twenty of the source's.
const RATE: f64 = 50.0;

/// Standard deviation of the recorded noise [N]: the source's steps of 0.781 mN, over √12.
const NOISE: f64 = 0.225e-3;

/// A ramp to `depth` [m] and a hold.
pub(super) fn ramp_and_hold(depth: f64) -> History {
    let count = (RATE * END) as usize;
    let times: Vec<f64> = (0..=count).map(|i| i as f64 / RATE).collect();
    History {
        depths: times.iter().map(|t| depth * (t / RAMP).min(1.0)).collect(),
        times,
    }
}

/// The cleaned recording of `forces` [N] over `course`, with the noise of `seed`.
pub(super) fn recorded(
    organ: &str,
    subject: usize,
    course: &History,
    forces: &[f64],
    seed: u64,
) -> Result<CleanRecording, Error> {
    let mut random = Random::new(seed);
    let noisy: Vec<f64> = forces.iter().map(|f| f + NOISE * random.normal()).collect();
    let header = RecordingHeader {
        subject: Some(subject.to_string()),
        ..header(organ)
    };
    cleaned(header, course, noisy)
}

/// The same without noise.
pub(super) fn without_noise(
    organ: &str,
    course: &History,
    forces: &[f64],
) -> Result<CleanRecording, Error> {
    cleaned(header(organ), course, forces.to_vec())
}

fn header(organ: &str) -> RecordingHeader {
    RecordingHeader {
        organ: Some(organ.to_owned()),
        condition: Some(Condition::InVivo),
        indenter_shape: Some(IndenterShape::Flat),
        indenter_radius_m: Some(RADIUS),
        ..RecordingHeader::default()
    }
}

fn cleaned(
    header: RecordingHeader,
    course: &History,
    force_n: Vec<f64>,
) -> Result<CleanRecording, Error> {
    let samples = Samples {
        time_s: course.times.clone(),
        depth_m: course.depths.clone(),
        force_n,
    };
    let recording = Recording::new(header, samples)?;
    Ok(clean(&recording, &CleanSettings::default())?)
}

/// Elastic force [N] over depth [m] under the probe, of `law` with this `modulus` [Pa] and these shapes [-].
pub(super) fn elastic(
    law: CandidateLaw,
    modulus: f64,
    shape: &[f64],
) -> Result<IndentationCurve, Error> {
    let mut curves = Curves::new(Body::under_punch(RADIUS), law, 8.0 * RADIUS);
    let unit = curves.of(f64::INFINITY, shape)?;
    Ok(unit.force.scaled(1.0, modulus))
}
