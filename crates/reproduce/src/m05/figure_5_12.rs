use palpate_characterize::analyze;
use palpate_characterize::clean::{CleanSettings, clean};
use palpate_files::protocol::Stimulus;
use palpate_jobs::plot::{Series, Style};

use super::organ::{STEADY, beating, specimen};
use super::rig::{Measured, measured};
use crate::Error;
use crate::row::Rows;
use crate::virtual_rig::RAMP;

/// Samples of 1 ms that a point of the picture is the mean of: a heart of 1.5 Hz remains.
const AVERAGED: usize = 25;

pub(crate) fn liver(rows: &mut Rows<'_>) -> Result<(), Error> {
    run(rows, "liver", &[8, 6, 4, 2])
}

/// The caption names 5 mm twice.
pub(crate) fn kidney(rows: &mut Rows<'_>) -> Result<(), Error> {
    run(rows, "kidney", &[8, 6, 5, 4, 2, 1])
}

fn run(rows: &mut Rows<'_>, organ: &str, depths: &[u32]) -> Result<(), Error> {
    let alive = beating(specimen(organ, |row| row.mean)?, 1);
    let settings = CleanSettings {
        removes_ripple: true,
        ..CleanSettings::default()
    };
    let mut series = Vec::new();
    for (color, &depth_mm) in depths.iter().enumerate() {
        let stimulus = Stimulus::RampAndHold {
            depth_m: 1e-3 * f64::from(depth_mm),
            ramp_s: RAMP,
            hold_s: STEADY - RAMP,
        };
        let found = measured(&alive, stimulus, 1, u64::from(depth_mm))?;
        series.push(drawn(&found, depth_mm, color));
        let clean = clean(&found.recording, &settings)?;
        let steady = rows.row(&format!("steady/{depth_mm}_mm"));
        let Some(relaxation) = analyze(&clean).relaxation else {
            steady.missing("no hold is seen in the recording");
            continue;
        };
        steady.with("organ", organ).is(relaxation.steady_n);
        rows.add(&format!("settled_after/{depth_mm}_mm"), relaxation.settle_s);
        let row = rows.row(&format!("ripple/{depth_mm}_mm"));
        match clean.handling.ripple {
            Some(ripple) => row.is(1e3 * ripple.amplitude_n),
            None => row.missing("no ripple is seen in the recording"),
        }
    }
    rows.figure("").with("organ", organ).draw(series)
}

/// Forces over time from first contact.
fn drawn(found: &Measured, depth_mm: u32, color: usize) -> Series {
    let times: Vec<f64> = found.times().collect();
    let forces = found.recording.force_n();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let points = times.chunks(AVERAGED).zip(forces.chunks(AVERAGED));
    let points = points.map(|(times, forces)| (mean(times), 1e3 * mean(forces)));
    Series::new(
        format!("{depth_mm} mm"),
        points.collect(),
        Style::FineLine,
        color,
    )
}
