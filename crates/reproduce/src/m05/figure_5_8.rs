use nalgebra::Complex;
use palpate_files::protocol::{Stimulus, Sweep};

use super::organ::specimen;
use super::rig::{Measured, measured};
use crate::Error;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const FIGURE_5_8: Item = Item {
    name: "figure-5-8",
    title: "the four waveforms, and what the device makes of them",
    seconds: 0.89,
    run,
};

/// 2 mm from peak to peak about 2 mm (section 5.4.3) [m].
const AMPLITUDE: f64 = 1e-3;
const MIDDLE: f64 = 2e-3;
/// From the slowest to the fastest that the source swung [Hz].
const ENDS: [f64; 2] = [0.5, 5.0];
/// Sines whose tracking is told [Hz]: the source's working range.
const TRACKED: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];

const ERROR_NOTE: &str = "depth by the encoders less the wanted one, from first contact on, on a virtual liver at rest; the source \
    prints no error. One step of the encoders is 30 µm";

const TRACKED_NOTE: &str = "the first harmonic of the depth over that of the wanted one, 2 mm from peak to peak; the source prints no \
    tracking. What is asked for is asked for a tick ahead";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
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
        let found = measured(&liver, stimulus, (1, 1))?;
        let name = stimulus.kind().to_string();
        add_errors(rows, &name, &found);
        let note = "depth by the encoders on the wanted one; the source draws its four waveforms without numbers";
        rows.add_figure(Some(&name), &drawn(&name, &found), note)?;
    }
    for frequency in TRACKED {
        let duration = 4.0 / frequency;
        let found = measured(&liver, swing(Sweep::Constant(frequency), duration), (1, 1))?;
        let ratio = tracking(&found, frequency, duration);
        let name = |word: &str| format!("tracking/{frequency}_hz/{word}");
        rows.add(
            &name("amplitude"),
            Value::own(ratio.norm(), "1"),
            TRACKED_NOTE,
        );
        let phase = Value::own(ratio.arg().to_degrees(), "°");
        rows.add(&name("phase"), phase, TRACKED_NOTE);
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
    let root = Value::own(f64::sqrt(squares / count), "µm");
    rows.add(&format!("{name}/error"), root, ERROR_NOTE);
    let largest = Value::own(largest, "µm");
    rows.add(&format!("{name}/largest_error"), largest, ERROR_NOTE);
}

/// Amplitude [-] and phase of the depth over the wanted one, over the last whole periods of `duration` [s].
fn tracking(found: &Measured, frequency: f64, duration: f64) -> Complex<f64> {
    let begun = found.course.duration() - duration;
    let mut sums = [Complex::new(0.0, 0.0); 2];
    let swinging = found.tracked().filter(|[time, ..]| *time > begun + 1e-6);
    for [time, depth, wanted] in swinging {
        let turned = Complex::from_polar(1.0, -std::f64::consts::TAU * frequency * time);
        sums[0] += turned * (depth - MIDDLE);
        sums[1] += turned * (wanted - MIDDLE);
    }
    sums[0] / sums[1]
}

fn drawn(name: &str, found: &Measured) -> Plot {
    let each: Vec<[f64; 3]> = found.tracked().step_by(5).collect();
    let points = |column: usize| each.iter().map(|row| (row[0], 1e3 * row[column])).collect();
    let words = name.replace('_', " ");
    Plot {
        title: format!("Waveform `{words}` on the virtual device"),
        x_label: "time from first contact [s]".to_owned(),
        y_label: "depth [mm]".to_owned(),
        series: vec![
            Series::new("wanted", points(2), Style::BroadLine, 5),
            Series::new("by the encoders", points(1), Style::Line, 0),
        ],
        ..Plot::default()
    }
}
