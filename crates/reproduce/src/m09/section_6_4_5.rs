use std::sync::Arc;

use palpate_characterize::lumped::{Contact, mean_modulus};
use palpate_characterize::viscoelastic::{
    RelaxationRecord, RelaxationSettings, relaxation, relaxation_of_steps,
};
use palpate_mechanics::finite_elements::estimate::Estimated;
use palpate_mechanics::finite_elements::tube::{Ends, Inflated, TubeProblem, inflate};
use palpate_mechanics::{IndentationCurve, NeoHookean};

use super::organ::{Printed, printed};

use crate::Error;
use crate::published::cell;
use crate::row::Rows;
use crate::virtual_rig::{RADIUS, ramp_and_hold, recorded};
use palpate_jobs::plot::{Series, Style};

/// The depth at which (6.1) gives the source's modulus [m].
const DEPTH: f64 = 8e-3;
const PASCAL_PER_MMHG: f64 = 133.322_387_415;
const ACCURACY: f64 = 0.01;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let printed = printed()?;
    // The source's modulus is that of a half-space, not of a tube.
    let steady = cell("table-5-1 esophagus 8 mean_n")?;
    let half_space = mean_modulus(Contact::Flat(RADIUS), false, DEPTH, steady)?;
    rows.add("youngs_modulus", 1e-3 * half_space);
    add_relaxation(rows, &printed)?;
    let law = NeoHookean::incompressible(1e3 * printed.modulus_kpa / 6.0)?;
    let problem = TubeProblem {
        tube: printed.tube,
        law: Arc::new(law),
        ends: Ends::Fixed,
    };
    let found = solve(rows, &problem, &[])?;
    let limit = found.answer.limit_pressure;
    rows.row("limit_pressure")
        .with("error", format!("{:.4}", found.error))
        .is(limit.map(|p| p / PASCAL_PER_MMHG));
    if let Some(limit) = limit {
        let pressures: Vec<f64> = (0..=40)
            .map(|i| 0.999 * limit * f64::from(i) / 40.0)
            .collect();
        let path = solve(rows, &problem, &pressures)?;
        rows.figure("")
            .draw(vec![drawn(&pressures, &path.answer)])?;
    }
    Ok(())
}

/// The one term, found again.
fn add_relaxation(rows: &mut Rows<'_>, printed: &Printed) -> Result<(), Error> {
    let course = ramp_and_hold(DEPTH);
    let force = cell("table-5-1 esophagus 8 mean_n")?;
    let series = printed.series()?;
    let elastic = force / series.relaxation(f64::INFINITY);
    let curve = IndentationCurve::through(&[DEPTH], &[elastic]);
    let forces = curve.relaxed(&series, &course.times, &course.depths);
    let recording = recorded("esophagus", 0, &course, &forces, 1)?;
    let largest = recording.filtered_force.iter().copied().fold(0.0, f64::max);
    let seen = RelaxationRecord::new(
        &recording.time,
        &recording.depth,
        &recording.force,
        largest,
        |depth| depth,
    );
    let seen: Vec<RelaxationRecord> = seen.into_iter().collect();
    let one = RelaxationSettings { terms: Some(1) };
    let found = [
        ("", relaxation(&seen, one)?),
        ("step/", relaxation_of_steps(&seen, one)?),
    ];
    for (ramp, found) in found {
        if let Some([g, tau]) = found.terms.first() {
            rows.row(&format!("{ramp}tau")).is(tau.value);
            rows.row(&format!("{ramp}g")).is(g.value);
        }
    }
    Ok(())
}

fn solve(
    rows: &Rows<'_>,
    problem: &TubeProblem,
    pressures: &[f64],
) -> Result<Estimated<Inflated>, Error> {
    let mut say = rows.meshes("");
    Ok(inflate(problem, pressures, ACCURACY, &mut say)?)
}

fn drawn(pressures: &[f64], answer: &Inflated) -> Series {
    let each = pressures.iter().zip(&answer.inner_displacements);
    let points = each.filter_map(|(p, u)| u.map(|u| (1e3 * u, p / PASCAL_PER_MMHG)));
    Series::new("", points.collect(), Style::Line, 0)
}
