use palpate_characterize::CleanRecording;
use palpate_characterize::inverse::SoughtLaw;
use palpate_characterize::viscoelastic::{
    Course, Relaxation, RelaxationSettings, relaxation, relaxation_of_steps,
};
use palpate_files::Estimate;
use palpate_mechanics::IndentationCurve;

use crate::Error;
use crate::published::{TABLE_6_3 as PUBLISHED, TABLE_6_4, prony};
use crate::row::Value;
use crate::virtual_rig::{elastic, ramp_and_hold, recorded};
use crate::{Item, Rows};

pub(crate) const TABLE_6_3: Item = Item {
    name: "table-6-3",
    title: "how liver and kidney relax, as two terms of a Prony series",
    seconds: 1.9,
    run,
};

/// The rows, by organ and depth [mm].
const ROWS: [(&str, u32); 3] = [("liver", 6), ("kidney", 5), ("kidney", 4)];

const NOTE: &str = "refitted from a virtual recording with the printed terms and C10 of table 6-4, by convolution: a ramp of 0.5 s \
    and a hold until 40 s with noise of 0.225 mN at 50 Hz";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for (organ, depth_mm) in ROWS {
        let Some(c10) = TABLE_6_4.value(organ, "final_c10_pa") else {
            rows.add_missing(organ, "1", "table 6-4 has no C10 for the elastic force");
            continue;
        };
        let curve = elastic(SoughtLaw::NeoHookean, (c10, 0.0))?;
        let course = ramp_and_hold(1e-3 * f64::from(depth_mm));
        let felt = curve.relaxed(&prony(organ, depth_mm)?, &course.times, &course.depths);
        let recording = recorded((organ, 0), &course, &felt, u64::from(depth_mm))?;
        let courses: Vec<Course> = seen(&recording, &curve).into_iter().collect();
        let two = RelaxationSettings { terms: Some(2) };
        let row = (organ, depth_mm);
        let with_ramp = relaxation(&courses, two)?;
        let free = relaxation(&courses, RelaxationSettings::default())?;
        let chosen = Value::beside(Some(2.0), free.terms.len() as f64, "1");
        let note = format!(
            "{NOTE}; ours: the number that the information criterion chooses from one to four"
        );
        rows.add_pipeline_only(&format!("{organ}_{depth_mm}_mm/terms"), chosen, note);
        add(rows, row, ("", "the ramp as recorded"), &with_ramp);
        let steps = relaxation_of_steps(&courses, two)?;
        let how = "the ramp taken for a step, which the source finds negligibly different; what relaxes during the ramp is lost";
        add(rows, row, ("step/", how), &steps);
    }
    Ok(())
}

fn seen(recording: &CleanRecording, curve: &IndentationCurve) -> Option<Course> {
    let columns = (
        &recording.time[..],
        &recording.depth[..],
        &recording.force[..],
    );
    let largest = recording.filtered_force.iter().copied().fold(0.0, f64::max);
    Course::new(columns, largest, |depth| curve.force(depth))
}

fn add(
    rows: &mut Rows<'_>,
    (organ, depth_mm): (&str, u32),
    (prefix, how): (&str, &str),
    found: &Relaxation,
) {
    let cell = |column: &str| PUBLISHED.value_of([organ, &depth_mm.to_string()], column);
    let place = |word: &str| format!("{organ}_{depth_mm}_mm/{prefix}{word}");
    let of_term = |estimate: &Estimate| estimate.standard_error.unwrap_or(0.0) / estimate.value;
    let errors = found.terms.iter().flatten().map(of_term);
    let note = format!(
        "{NOTE}; {how}; standard errors up to {:.1} %",
        100.0 * errors.fold(0.0, f64::max)
    );
    for (number, [g, tau]) in (1..).zip(&found.terms) {
        let each = [
            (format!("tau{number}"), "_s", tau, "s"),
            (format!("g{number}"), "", g, "1"),
        ];
        for (word, ending, estimate, unit) in each {
            let value = Value::beside(cell(&format!("{word}{ending}")), estimate.value, unit);
            rows.add_pipeline_only(&place(&word), value, note.clone());
        }
    }
    let note = format!(
        "{NOTE}; {how}; of forces relative to the largest: it goes with the noise and the number of samples, neither of which \
         the source gives"
    );
    let squares = Value::beside(cell("sum_squared_error"), found.sum_of_squares, "1");
    rows.add(&place("sum_squared_error"), squares, note);
}
