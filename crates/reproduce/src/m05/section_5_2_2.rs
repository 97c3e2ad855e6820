use palpate_characterize::analyze;
use palpate_characterize::clean::{CleanSettings, clean};
use palpate_files::protocol::{Stimulus, Sweep};
use palpate_measure::VirtualSpecimen;
use palpate_mechanics::{IndentationCurve, PronySeries};

use super::rig::measured;
use crate::Error;
use crate::row::Rows;
use crate::virtual_rig::RADIUS;
use palpate_jobs::plot::{Series, Style};

/// A spring like the liver [N/m], without relaxation: what is measured of it but its stiffness is the rig's.
const SPRING: f64 = 10.0;
const MIDDLE: f64 = 2e-3;
/// Half of what the source swung [m], less where that would be too fast.
const AMPLITUDE: f64 = 1e-3;
const FASTEST: f64 = 0.05;
/// How often it swings [-], and for how long at least [s].
const CYCLES: f64 = 10.0;
const SHORTEST: f64 = 2.0;
/// [Hz]
const FREQUENCIES: [f64; 10] = [0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 30.0, 35.0];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let depth = 2.0 * MIDDLE;
    let response = IndentationCurve::through(&[depth], &[SPRING * depth]);
    let spring = VirtualSpecimen::of_response(&response, PronySeries::new(&[])?, 1.0, RADIUS);
    let (mut stiffness, mut phases) = (Vec::new(), Vec::new());
    let (mut below, mut is_bound) = (None, true);
    for frequency in FREQUENCIES {
        let amplitude = AMPLITUDE.min(FASTEST / (std::f64::consts::TAU * frequency));
        let stimulus = Stimulus::Swing {
            amplitude_m: amplitude,
            pre_indentation_m: MIDDLE,
            sweep: Sweep::Constant(frequency),
            duration_s: SHORTEST.max(CYCLES / frequency),
        };
        let found = measured(&spring, stimulus, 1, 1)?;
        let clean = clean(&found.recording, &CleanSettings::default())?;
        let name = |word: &str| format!("{word}/{frequency}_hz");
        let Some(swing) = analyze(&clean).sinusoids.first().copied() else {
            rows.row(&name("stiffness"))
                .missing("no swing is seen in the recording");
            continue;
        };
        let ratio = swing.stiffness_n_per_m / SPRING;
        // What was not seen says nothing of the device.
        is_bound &= (20.0 * ratio.log10()).abs() < 1.0;
        if is_bound {
            below = Some(frequency);
        }
        let off = 100.0 * (ratio - 1.0);
        rows.add(&name("stiffness"), off);
        let turned = swing.phase_rad.to_degrees();
        rows.add(&name("phase"), turned);
        stiffness.push((frequency, off));
        phases.push((frequency, turned));
    }
    let row = rows.row("unaffected_below");
    match is_bound {
        true => row.at_least().is(below),
        false => row.is(below),
    }
    rows.figure("").draw(vec![
        Series::new("stiffness", stiffness, Style::LineWithDots, 0),
        Series::new("phase", phases, Style::DashedLineWithSquares, 1),
    ])
}
