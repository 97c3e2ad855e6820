use nalgebra::Complex;
use palpate_files::protocol::{Stimulus, Sweep};

use super::organ::specimen;
use super::rig::{Measured, measured};
use crate::Error;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

/// 2 mm from peak to peak about 2 mm (section 5.4.3) [m].
const AMPLITUDE: f64 = 1e-3;
const MIDDLE: f64 = 2e-3;
/// From the slowest to the fastest that the source swung [Hz].
const ENDS: [f64; 2] = [0.5, 5.0];
/// Sines whose tracking is reported [Hz]: the source's working range.
const TRACKED: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let liver = specimen("liver", |row| row.mean)?;
    let swing = |sweep, duration_s| Stimulus::Swing {
        amplitude_m: AMPLITUDE,
        pre_indentation_m: MIDDLE,
        sweep,
        duration_s,
    };
    let ramp = Stimulus::RampAndHold {
        depth_m: 4e-3,
        ramp_s: 0.5,
        hold_s: 2.0,
    };
    let waveforms = [
        ramp,
        swing(Sweep::Constant(2.0), 3.0),
        swing(Sweep::Linear(ENDS), 4.0),
        swing(Sweep::Exponential(ENDS), 4.0),
    ];
    for stimulus in waveforms {
        let found = measured(&liver, stimulus, 1, 1)?;
        let name = stimulus.kind().to_string();
        add_errors(rows, &name, &found);
        let words = name.replace('_', " ");
        rows.figure(&name)
            .with("words", words)
            .draw(drawn(&found))?;
    }
    for frequency in TRACKED {
        let duration = 4.0 / frequency;
        let found = measured(&liver, swing(Sweep::Constant(frequency), duration), 1, 1)?;
        let ratio = tracking(&found, frequency, duration);
        let name = |word: &str| format!("tracking/{frequency}_hz/{word}");
        rows.add(&name("amplitude"), ratio.norm());
        rows.add(&name("phase"), ratio.arg().to_degrees());
    }
    Ok(())
}

fn add_errors(rows: &mut Rows<'_>, name: &str, found: &Measured) {
    let (mut squares, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
    for [_, depth, wanted] in found.tracked() {
        let error = 1e6 * (depth - wanted);
        squares += error * error;
        count += 1.0;
        largest = largest.max(error.abs());
    }
    rows.add(&format!("{name}/error"), f64::sqrt(squares / count));
    rows.add(&format!("{name}/largest_error"), largest);
}

/// Amplitude [-] and phase of the depth over the wanted one, over the last whole periods of `duration` [s].
fn tracking(found: &Measured, frequency: f64, duration: f64) -> Complex<f64> {
    let begun = found.trajectory.duration() - duration;
    let mut sums = [Complex::new(0.0, 0.0); 2];
    let swinging = found.tracked().filter(|[time, ..]| *time > begun + 1e-6);
    for [time, depth, wanted] in swinging {
        let turned = Complex::from_polar(1.0, -std::f64::consts::TAU * frequency * time);
        sums[0] += turned * (depth - MIDDLE);
        sums[1] += turned * (wanted - MIDDLE);
    }
    sums[0] / sums[1]
}

fn drawn(found: &Measured) -> Vec<Series> {
    let each: Vec<[f64; 3]> = found.tracked().step_by(5).collect();
    let points = |column: usize| each.iter().map(|row| (row[0], 1e3 * row[column])).collect();
    vec![
        Series::new("wanted", points(2), Style::BroadLine, 5),
        Series::new("by the encoders", points(1), Style::Line, 0),
    ]
}
