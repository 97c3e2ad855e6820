use palpate_characterize::CleanRecording;
use palpate_characterize::inverse::CandidateLaw;
use palpate_characterize::viscoelastic::{
    Relaxation, RelaxationRecord, RelaxationSettings, relaxation, relaxation_of_steps,
};
use palpate_files::Estimate;
use palpate_mechanics::IndentationCurve;

use crate::Error;
use crate::published::{cell, prony};
use crate::row::Rows;
use crate::virtual_rig::{elastic, ramp_and_hold, recorded};

/// The rows, by organ and depth [mm].
const ROWS: [(&str, u32); 3] = [("liver", 6), ("kidney", 5), ("kidney", 4)];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, depth_mm) in ROWS {
        let c10 = cell(&format!("table-6-4 {organ} final_c10_pa"))?;
        let curve = elastic(CandidateLaw::NeoHookean, c10, &[])?;
        let course = ramp_and_hold(1e-3 * f64::from(depth_mm));
        let forces = curve.relaxed(&prony(organ, depth_mm)?, &course.times, &course.depths);
        let recording = recorded(organ, 0, &course, &forces, u64::from(depth_mm))?;
        let records: Vec<RelaxationRecord> = seen(&recording, &curve).into_iter().collect();
        let two = RelaxationSettings { terms: Some(2) };
        let name = format!("{organ}_{depth_mm}_mm");
        let with_ramp = relaxation(&records, two)?;
        let free = relaxation(&records, RelaxationSettings::default())?;
        rows.add(&format!("{name}/terms"), free.terms.len() as f64);
        add(rows, &name, "", &with_ramp);
        let steps = relaxation_of_steps(&records, two)?;
        add(rows, &name, "step/", &steps);
    }
    Ok(())
}

fn seen(recording: &CleanRecording, curve: &IndentationCurve) -> Option<RelaxationRecord> {
    let largest = recording.filtered_force.iter().copied().fold(0.0, f64::max);
    RelaxationRecord::new(
        &recording.time,
        &recording.depth,
        &recording.force,
        largest,
        |depth| curve.force(depth),
    )
}

fn add(rows: &mut Rows<'_>, name: &str, ramp: &str, found: &Relaxation) {
    let of_term = |estimate: &Estimate| estimate.standard_error.unwrap_or(0.0) / estimate.value;
    let errors = found.terms.iter().flatten().map(of_term);
    let error = 100.0 * errors.fold(0.0, f64::max);
    for (number, [g, tau]) in (1..).zip(&found.terms) {
        for (word, estimate) in [("tau", tau), ("g", g)] {
            rows.row(&format!("{name}/{ramp}{word}{number}"))
                .with("error", format!("{error:.1}"))
                .is(estimate.value);
        }
    }
    let name = format!("{name}/{ramp}sum_squared_error");
    rows.add(&name, found.sum_of_squares);
}
