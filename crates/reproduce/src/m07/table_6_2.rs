use palpate_characterize::inverse::Indentation;
use palpate_characterize::lumped::{SpringsFit, fit_springs};
use palpate_files::tissue::NonlinearSprings;
use palpate_mechanics::finite_elements::indentation::History;

use super::springs::{DEPTHS_MM, ORGANS, forces, printed};
use crate::Error;
use crate::row::Value;
use crate::virtual_rig::{ramp_and_hold, recorded};
use crate::{Item, Rows};

pub(crate) const TABLE_6_2: Item = Item {
    name: "table-6-2",
    title: "nonlinear springs of liver and esophagus",
    seconds: 6.0,
    run,
};

/// One of so many samples is enough: the springs take seconds to give way. The ramp ends at one of them.
const EVERY: usize = 5;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for organ in ORGANS {
        let Some(values) = printed(organ) else {
            rows.add_missing(organ, "1", "the row of table 6-2 cannot be read");
            continue;
        };
        let mut felt = Vec::new();
        for depth_mm in DEPTHS_MM {
            let course = ramp_and_hold(1e-3 * f64::from(depth_mm));
            let Some(forces) = forces(values, &course) else {
                rows.add_missing(organ, "1", "a spring is faster than 1 kHz");
                return Ok(());
            };
            felt.push((course, forces));
        }
        for (noisy, word) in [(false, ""), (true, "noisy/")] {
            rows.say(format!("{organ}, {word}springs"));
            let found = refitted(organ, &felt, noisy)?;
            add(rows, (organ, word), &values, &found);
        }
    }
    Ok(())
}

/// The springs found in the forces of several depths, as they are or as they are recorded.
fn refitted(organ: &str, felt: &[(History, Vec<f64>)], noisy: bool) -> Result<SpringsFit, Error> {
    let mut columns = Vec::new();
    for (place, (course, forces)) in felt.iter().enumerate() {
        let seen = match noisy {
            true => recorded((organ, 0), course, forces, place as u64)?.force,
            false => forces.clone(),
        };
        let some = |values: &[f64]| -> Vec<f64> { values.iter().copied().step_by(EVERY).collect() };
        columns.push([some(&course.times), some(&course.depths), some(&seen)]);
    }
    let all = columns
        .iter()
        .map(|[time, depth, force]| Indentation::new(time, depth, force));
    Ok(fit_springs(&all.collect::<Vec<_>>())?)
}

fn add(rows: &mut Rows<'_>, (organ, word): (&str, &str), values: &[f64; 8], found: &SpringsFit) {
    let how = match word {
        "" => "refitted from forces of (6.4) with the printed parameters",
        _ => "the same with noise of 0.225 mN",
    };
    let doubts = match found.doubts.as_slice() {
        [] => String::new(),
        doubts => format!("; {}", doubts.join("; ")),
    };
    let note = format!(
        "{how}, ramps of 0.5 s to 2, 4, 6 and 8 mm held until 40 s, in one fit, signs of (6.4) mended (sign(e)|e|^k, F2(t)); \
         in newtons, millimetres and seconds{doubts}"
    );
    let springs = if values[7] > 0.0 { 2.0 } else { 1.0 };
    let count = Value::beside(Some(springs), found.branches as f64, "1");
    rows.add_pipeline_only(&format!("{organ}/{word}springs"), count, note.clone());
    for (place, name) in NonlinearSprings::NAMES.into_iter().enumerate() {
        // A spring that is not there has no numbers.
        if values[place] == 0.0 {
            continue;
        }
        let value = Value {
            published: Some(values[place]),
            ours: found.fit.value(name),
            unit: "N, mm, s",
        };
        rows.add_pipeline_only(&format!("{organ}/{word}{name}"), value, note.clone());
    }
}
