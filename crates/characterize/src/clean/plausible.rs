//! Implausible numbers: wrong units, a sensor at the end of its range.

use palpate_files::Recording;

use super::{CleanRecording, noise};

/// Depth [m] beyond which nobody indents tissue.
const TOO_DEEP: f64 = 0.2;
/// Depth [m] below which only forces below [`NANOSCALE`] [N] occur.
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
/// Half a step of the depth that is worth a word, over the deepest press [-].
const COARSE: f64 = 0.01;
/// Distances between samples from which steps can be recognized [-].
const FEW: usize = 20;
/// Least noise, over the largest force, that shows a sensor to be awake [-].
const AWAKE: f64 = 1e-4;

pub(super) fn add_warnings(
    clean: &CleanRecording,
    recording: &Recording,
    warnings: &mut Vec<String>,
) {
    let deepest = clean.depth.iter().copied().fold(0.0, f64::max);
    let strongest = clean.force.iter().copied().fold(0.0, f64::max);
    if let Some(wrong) = wrong_unit(clean, deepest, strongest) {
        warnings.push(format!("{wrong}; check the units"));
    }
    let resolution = steps(recording.depth_m()).filter(|_| deepest > 0.0);
    warnings.extend(resolution.and_then(|step| of_steps(step, deepest)));
    if let Some((from, to)) = stuck(recording) {
        warnings.push(format!(
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

/// The warning about a depth with the resolution `steps` [m] that goes to `deepest` [m], where that matters.
fn of_steps(steps: f64, deepest: f64) -> Option<String> {
    let part = 0.5 * steps / deepest;
    (part > COARSE).then(|| {
        format!(
            "the depth is told in steps of {:.0} µm: half a step is {:.1} % of the deepest press, by which a \
             modulus may be off beyond its stated error; press deeper or measure finer",
            1e6 * steps,
            100.0 * part
        )
    })
}

/// The resolution [m] of a depth; none where each sample has its own value.
fn steps(depth: &[f64]) -> Option<f64> {
    let ways = || depth.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let step = ways()
        .filter(|way| *way > 0.0)
        .fold(f64::INFINITY, f64::min);
    let first = ways().position(|way| way > 0.0)?;
    let last = depth.len() - 2 - ways().rev().position(|way| way > 0.0)?;
    let moving = ways().skip(first).take(last + 1 - first);
    let (mut none, mut one, mut more, mut between) = (0, 0, 0, 0);
    for way in moving {
        let steps = way / step;
        match steps.round() {
            whole if (steps - whole).abs() > 0.05 => between += 1,
            0.0 => none += 1,
            1.0 => one += 1,
            _ => more += 1,
        }
    }
    // A motion in equal samples has one kind of way only.
    let all = none + one + more;
    let kinds = [none, one, more].into_iter().filter(|kind| 20 * kind > all);
    (between == 0 && all >= FEW && kinds.count() > 1).then_some(step)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: rounding to 30 µm, which was put in.
    #[test]
    fn steps_of_an_encoder_are_seen() {
        let ramp: Vec<f64> = (0..400).map(|i| 1e-3 * f64::from(i) / 399.0).collect();
        let rounded: Vec<f64> = ramp.iter().map(|x| (x / 3e-5).round() * 3e-5).collect();
        let found = steps(&rounded).unwrap();
        assert!((found - 3e-5).abs() < 1e-9, "{found}");
        let words = of_steps(found, 1e-3).unwrap();
        assert!(
            words.contains("steps of 30 µm") && words.contains("1.5 %"),
            "{words}"
        );
        assert_eq!(of_steps(found, 8e-3), None);
        // Even samples of a smooth ramp, and a hold after it, are no steps.
        let mut smooth = ramp;
        smooth.extend([1e-3; 100]);
        assert_eq!(steps(&smooth), None);
        assert_eq!(steps(&[1e-3; 50]), None);
        assert_eq!(steps(&[]), None);
    }
}
