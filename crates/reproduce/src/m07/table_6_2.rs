use palpate_characterize::inverse::Indentation;
use palpate_characterize::lumped::{SpringsFit, fit_springs};
use palpate_files::tissue::NonlinearSprings;
use palpate_mechanics::finite_elements::indentation::History;

use super::figure_6_3::listed;
use super::springs::{DEPTHS_MM, ORGANS, forces, printed};
use crate::Error;
use crate::row::Rows;
use crate::virtual_rig::{ramp_and_hold, recorded};

/// One of so many samples is enough: the springs take seconds to give way. The ramp ends at one of them.
const EVERY: usize = 5;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for organ in ORGANS {
        let values = printed(organ)?;
        let mut curves = Vec::new();
        for depth_mm in DEPTHS_MM {
            let course = ramp_and_hold(1e-3 * f64::from(depth_mm));
            let forces = forces(values, &course)?;
            curves.push((course, forces));
        }
        for (noisy, word) in [(false, ""), (true, "noisy/")] {
            rows.report_step(format!("{organ}, {word}springs"));
            let found = refitted(organ, &curves, noisy)?;
            add(rows, organ, word, &values, &found);
        }
    }
    Ok(())
}

/// The springs found in the forces of several depths, as they are or as they are recorded.
fn refitted(organ: &str, curves: &[(History, Vec<f64>)], noisy: bool) -> Result<SpringsFit, Error> {
    let mut columns = Vec::new();
    for (place, (course, forces)) in curves.iter().enumerate() {
        let seen = match noisy {
            true => recorded(organ, 0, course, forces, place as u64)?.force,
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

fn add(rows: &mut Rows<'_>, organ: &str, word: &str, values: &[f64; 8], found: &SpringsFit) {
    let mut add = |name: &str, ours: Option<f64>| {
        rows.row(&format!("{organ}/{word}{name}"))
            .with("noise", word)
            .with("warnings", listed(&found.warnings))
            .is(ours);
    };
    add("springs", Some(found.branches as f64));
    for (value, name) in values.iter().zip(NonlinearSprings::NAMES) {
        // A spring that is not there has no numbers.
        if *value != 0.0 {
            add(name, found.fit.value(name));
        }
    }
}
