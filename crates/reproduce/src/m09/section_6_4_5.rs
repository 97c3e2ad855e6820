use std::sync::Arc;

use palpate_characterize::lumped::{Contact, mean_modulus};
use palpate_characterize::viscoelastic::{
    Course, RelaxationSettings, relaxation, relaxation_of_steps,
};
use palpate_mechanics::finite_elements::estimate::{Estimated, Progress};
use palpate_mechanics::finite_elements::tube::{Ends, Inflated, TubeProblem, inflate};
use palpate_mechanics::{IndentationCurve, NeoHookean};

use super::organ::{Printed, printed};

use crate::Error;
use crate::published::TABLE_5_1;
use crate::row::Value;
use crate::virtual_rig::{RADIUS, ramp_and_hold, recorded};
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const SECTION_6_4_5: Item = Item {
    name: "section-6-4-5",
    title: "the esophagus as a tube under pressure",
    seconds: 2.9,
    run,
};

/// The depth at which (6.1) gives the source's modulus [m].
const DEPTH: f64 = 8e-3;
const PASCAL_PER_MMHG: f64 = 133.322_387_415;
const ACCURACY: f64 = 0.01;

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let printed = printed()?;
    add_modulus(rows, printed.modulus_kpa);
    add_relaxation(rows, &printed)?;
    let law = NeoHookean::incompressible(1e3 * printed.modulus_kpa / 6.0)?;
    let problem = TubeProblem {
        tube: printed.tube,
        law: Arc::new(law),
        ends: Ends::Held,
    };
    let found = solve(rows, &problem, &[])?;
    let limit = found.answer.limit_pressure;
    let value = Value {
        published: Some(printed.pressure_mmhg),
        ours: limit.map(|p| p / PASCAL_PER_MMHG),
        unit: "mmHg",
    };
    let note = format!(
        "published: pressure in the source's model; ours: greatest pressure of a neo-Hookean tube with \
         the source's modulus, radii of 5 and 7.5 mm and held ends (relative error {:.4}); a linear \
         solver gives a displacement at 30 mmHg without complaint",
        found.error
    );
    rows.add("limit_pressure", value, note);
    if let Some(limit) = limit {
        let pressures: Vec<f64> = (0..=40)
            .map(|i| 0.999 * limit * f64::from(i) / 40.0)
            .collect();
        let path = solve(rows, &problem, &pressures)?;
        rows.add_figure(None, &plot(&pressures, &path.answer), "up to the limit")?;
    }
    Ok(())
}

/// The source's modulus is that of a half-space, not of a tube.
fn add_modulus(rows: &mut Rows<'_>, modulus_kpa: f64) {
    // As if it were no hollow organ.
    let half_space = TABLE_5_1
        .value_of(["esophagus", "8"], "mean_n")
        .and_then(|force| mean_modulus(Contact::Flat(RADIUS), false, DEPTH, force).ok())
        .map(|modulus| 1e-3 * modulus);
    let value = Value {
        published: Some(modulus_kpa),
        ours: half_space,
        unit: "kPa",
    };
    let note = "published as the result of inverse finite elements on the tube; ours: the half-space \
                formula (6.1) with the mean of table 5-1 at 8 mm, which is the same number to four digits; what the tube gives is figure-6-15/tube_modulus";
    rows.add("youngs_modulus", value, note);
}

/// The one term, found again.
fn add_relaxation(rows: &mut Rows<'_>, printed: &Printed) -> Result<(), Error> {
    let course = ramp_and_hold(DEPTH);
    let force = TABLE_5_1.value_of(["esophagus", "8"], "mean_n");
    let series = printed.series()?;
    let elastic = force.unwrap_or(0.0) / series.relaxation(f64::INFINITY);
    let curve = IndentationCurve::through(&[DEPTH], &[elastic]);
    let felt = curve.relaxed(&series, &course.times, &course.depths);
    let recording = recorded(("esophagus", 0), &course, &felt, 1)?;
    let largest = recording.filtered_force.iter().copied().fold(0.0, f64::max);
    let columns = (
        &recording.time[..],
        &recording.depth[..],
        &recording.force[..],
    );
    let seen: Vec<Course> = Course::new(columns, largest, |depth| depth)
        .into_iter()
        .collect();
    let one = RelaxationSettings { terms: Some(1) };
    let note = "refitted from a virtual recording with the printed term that ends at the mean of table 5-1 at 8 mm, ramp of 0.5 s, hold \
                until 40 s, noise of 0.225 mN";
    for ([g, tau], (prefix, how)) in relaxation(&seen, one)?
        .terms
        .into_iter()
        .zip([("", "the ramp as recorded")])
        .chain(
            relaxation_of_steps(&seen, one)?
                .terms
                .into_iter()
                .zip([("step/", "the ramp taken for a step")]),
        )
    {
        let note = format!("{note}; {how}; the source prints the second on g instead of tau");
        let tau = Value::beside(Some(printed.tau), tau.value, "s");
        rows.add_pipeline_only(&format!("{prefix}tau"), tau, note.clone());
        rows.add_pipeline_only(
            &format!("{prefix}g"),
            Value::beside(Some(printed.g), g.value, "1"),
            note,
        );
    }
    Ok(())
}

fn solve(
    rows: &Rows<'_>,
    problem: &TubeProblem,
    pressures: &[f64],
) -> Result<Estimated<Inflated>, Error> {
    let mut say = |progress: Progress| {
        let (mesh, part) = (progress.mesh + 1, 100.0 * progress.part);
        rows.say(format!("mesh {mesh}, {part:.0} %"));
    };
    Ok(inflate(problem, pressures, ACCURACY, &mut say)?)
}

fn plot(pressures: &[f64], answer: &Inflated) -> Plot {
    let each = pressures.iter().zip(&answer.inner_displacements);
    let points = each.filter_map(|(p, u)| u.map(|u| (1e3 * u, p / PASCAL_PER_MMHG)));
    Plot {
        title: "Esophagus of section 6.4.5 under inner pressure".to_owned(),
        x_label: "widening of the inner radius at mid-length [mm]".to_owned(),
        y_label: "pressure [mmHg]".to_owned(),
        series: vec![Series {
            name: String::new(),
            points: points.collect(),
            style: Style::Line,
            color: 0,
        }],
        ..Plot::default()
    }
}
