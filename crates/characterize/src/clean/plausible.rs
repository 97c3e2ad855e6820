//! Numbers that no touch of tissue gives: units gone wrong, a sensor at its end.

use palpate_files::Recording;

use super::{CleanRecording, noise};

/// Depth [m] beyond which nobody indents tissue.
const TOO_DEEP: f64 = 0.2;
/// Depth [m] below which only forces below [`NANOSCALE`] [N] are felt.
const TOO_SHALLOW: f64 = 2e-5;
const NANOSCALE: f64 = 1e-3;
/// Force [N] beyond which nobody presses tissue.
const TOO_STRONG: f64 = 5e3;
/// Depth over the radius of the indenter [-].
const REACH: [f64; 2] = [1e-3, 100.0];
/// Moduli of soft matter [Pa], from mucus to hard rubber.
const SOFT: [f64; 2] = [1.0, 1e8];
/// Equal samples at the largest force that make a sensor at its end.
const STUCK: usize = 5;
/// How many times longer than elsewhere a force rests at its largest value there [-].
const TELLING: usize = 3;
/// Least noise, over the largest force, that shows a sensor to be awake [-].
const AWAKE: f64 = 1e-4;

pub(super) fn tell(clean: &CleanRecording, recording: &Recording, doubts: &mut Vec<String>) {
    let deepest = clean.depth.iter().copied().fold(0.0, f64::max);
    let strongest = clean.force.iter().copied().fold(0.0, f64::max);
    if let Some(wrong) = wrong_unit(clean, deepest, strongest) {
        doubts.push(format!("{wrong}; check the units"));
    }
    if let Some((from, to)) = stuck(recording) {
        doubts.push(format!(
            "the force stays at exactly {} N from {from} to {to} s, as a sensor does at its end; \
             measure with a larger range",
            clean.handling.signs[1] * largest(recording)
        ));
    }
}

fn wrong_unit(clean: &CleanRecording, deepest: f64, strongest: f64) -> Option<String> {
    let millimetres = 1e3 * deepest;
    if let Some(height) = clean.header.height_m {
        return (deepest >= height).then(|| {
            format!(
                "the piece is {:.2} mm high and pressed by {millimetres:.2} mm",
                1e3 * height
            )
        });
    }
    if deepest > TOO_DEEP {
        return Some(format!(
            "the depth goes to {millimetres:.0} mm, more than tissue is thick"
        ));
    }
    if strongest > TOO_STRONG {
        return Some(format!(
            "the force goes to {strongest:.0} N, more than tissue bears"
        ));
    }
    if deepest > 0.0 && deepest < TOO_SHALLOW && strongest > NANOSCALE {
        return Some(format!(
            "the depth goes only to {millimetres:.1e} mm with a force of {strongest:.1e} N"
        ));
    }
    let radius = clean.header.indenter_radius_m?;
    let reach = deepest / radius;
    if reach > 0.0 && !(REACH[0]..=REACH[1]).contains(&reach) {
        return Some(format!(
            "the depth goes to {millimetres:.1e} mm with an indenter of {:.1e} mm radius",
            1e3 * radius
        ));
    }
    // (6.1) with a flat face: the order of the modulus, whatever the shape.
    let modulus = 0.75 * strongest / (2.0 * radius * deepest);
    (strongest > 0.0 && !(SOFT[0]..=SOFT[1]).contains(&modulus))
        .then(|| format!("depth and force make a modulus of {modulus:.0e} Pa, which no tissue has"))
}

/// The largest force [N] as recorded, by size.
fn largest(recording: &Recording) -> f64 {
    let larger = |a: f64, b: &f64| if b.abs() > a.abs() { *b } else { a };
    recording.force_n().iter().fold(0.0, larger)
}

/// Times [s] between which the force rests at its largest value although it trembles elsewhere.
fn stuck(recording: &Recording) -> Option<(f64, f64)> {
    let (time, force) = (recording.time_s(), recording.force_n());
    let largest = largest(recording);
    let first = force
        .windows(STUCK)
        .position(|run| run.iter().all(|f| *f == largest))?;
    if noise::deviation(&force[..first]) < AWAKE * largest.abs() {
        return None;
    }
    let length = force[first..].iter().take_while(|f| **f == largest).count();
    // A sensor with coarse steps shows the same number for as long at other large forces too.
    let elsewhere = force.chunk_by(|a, b| a == b);
    let large = elsewhere.filter(|run| run[0] != largest && run[0].abs() > 0.5 * largest.abs());
    let longest = large.map(<[f64]>::len).max().unwrap_or(0);
    (length > TELLING * longest).then(|| (time[first], time[first + length - 1]))
}
