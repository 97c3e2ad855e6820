use palpate_characterize::inverse::{
    Body, Curves, Indentation, LawDescription, SoughtLaw, law_fit,
};
use palpate_characterize::viscoelastic::{Course, RelaxationSettings, relaxation};
use palpate_characterize::{CharacterizeSettings, characterize};
use palpate_files::Estimate;
use palpate_mechanics::finite_elements::indentation::History;

use super::equation_6_17::Column;
use super::full_run::felt;
use crate::Error;
use crate::published::{
    TABLE_5_1, TABLE_6_4 as NEO_HOOKEAN, TABLE_6_5 as MOONEY_RIVLIN, Table, prony,
};
use crate::row::Value;
use crate::virtual_rig::{RADIUS, elastic, without_noise};
use crate::{Item, Rows};

pub(crate) const TABLE_6_4: Item = Item {
    name: "table-6-4",
    title: "neo-Hookean law found again from full viscoelastic runs",
    seconds: 20.0,
    run: |rows| run(rows, SoughtLaw::NeoHookean, NEO_HOOKEAN),
};

pub(crate) const TABLE_6_5: Item = Item {
    name: "table-6-5",
    title: "Mooney-Rivlin law found again from full viscoelastic runs",
    seconds: 30.0,
    run: |rows| run(rows, SoughtLaw::MooneyRivlin, MOONEY_RIVLIN),
};

const NOTE: &str = "from the force of the full viscoelastic run of finite elements with the printed parameters and terms, ramp of 0.5 s, hold \
    until 40 s, without noise: relaxation first, then the law by convolution; a full run is up to 5 % stiffer at the end of the ramp \
    than a convolution at these depths, for at finite strain stress of an earlier depth does less work at a later one, which the stated \
    error contains, and its coarsest mesh up to 1.5 % too stiff";

const LOOP_NOTE: &str =
    "the same force, with full runs in the loop of the fit (`palpate characterize --in-loop`)";

fn run(rows: &mut Rows<'_>, law: SoughtLaw, table: Table) -> Result<(), Error> {
    for (organ, depth_mm) in super::block::ORGANS {
        let cells = names(law)
            .iter()
            .map(|name| table.value(organ, &format!("final_{name}")));
        let truth: Vec<f64> = cells.flatten().collect();
        let series = prony(organ, depth_mm)?;
        let depth = 1e-3 * f64::from(depth_mm);
        let (course, forces) = felt(rows, (law, &truth), &series, depth)?;
        let assumed = elastic(SoughtLaw::NeoHookean, (1.0, 0.0))?;
        let largest = forces.iter().copied().fold(0.0, f64::max);
        let columns = (&course.times[..], &course.depths[..], &forces[..]);
        let seen = Course::new(columns, largest, |depth| assumed.force(depth));
        let seen: Vec<Course> = seen.into_iter().collect();
        let relaxing = relaxation(&seen, RelaxationSettings { terms: Some(2) })?;
        let indentation = Indentation::new(&course.times, &course.depths, &forces);
        let mut curves = Curves::new(Body::under_punch(RADIUS), law, depth);
        let found = law_fit(&mut curves, &[indentation], &relaxing.series)?;
        let found = LawDescription::of(found, &[indentation]);
        add(rows, (organ, table), &truth, &found);
        add_in_loop(rows, (organ, law), &truth, (&course, &forces))?;
        let cell = |column| TABLE_5_1.value_of([organ, &depth_mm.to_string()], column);
        let note = "published: mean of table 5-1 at this depth; ours: force of the full run at 40 s, moduli read as instantaneous; the \
                    source fitted them to such recordings, and no reading of them returns the means (see figure-6-8)";
        let steady = Value {
            published: cell("mean_n"),
            ours: forces.last().copied(),
            unit: "N",
        };
        rows.add(&format!("{organ}/steady"), steady, note);
        add_initial(rows, (organ, table), law);
    }
    Ok(())
}

/// The standard error that a fit states.
fn stated(estimate: &Estimate) -> String {
    match estimate.standard_error {
        Some(error) => format!("stated standard error {error:.1} Pa"),
        None => "no standard error is stated".to_owned(),
    }
}

/// The same with finite elements in the loop.
fn add_in_loop(
    rows: &mut Rows<'_>,
    (organ, law): (&str, SoughtLaw),
    truth: &[f64],
    (course, forces): (&History, &[f64]),
) -> Result<(), Error> {
    let recording = without_noise(organ, course, forces)?;
    let settings = CharacterizeSettings {
        relaxation: RelaxationSettings { terms: Some(2) },
        laws: vec![law],
        draws: None,
        in_loop: true,
    };
    rows.say(format!("{organ}, finite elements in the loop"));
    let answer = characterize(&[recording], &settings, &mut |_| ());
    let Some((_, found)) = answer.laws.into_iter().next() else {
        return Ok(());
    };
    let found = found?;
    for ((name, estimate), truth) in found.parameters.iter().zip(truth) {
        let value = Value::beside(Some(*truth), estimate.value, "Pa");
        let word = name.trim_end_matches("_pa");
        let note = format!("{}; {LOOP_NOTE}", stated(estimate));
        rows.add_pipeline_only(&format!("{organ}/{word}_in_loop"), value, note);
    }
    let note = "runs of finite elements that these took";
    let solves = Value::own(found.found.solves as f64, "1");
    rows.add(&format!("{organ}/solves_in_loop"), solves, note);
    Ok(())
}

/// (6.17) and (6.18), which have their own items.
fn add_initial(rows: &mut Rows<'_>, (organ, table): (&str, Table), law: SoughtLaw) {
    let column = Column::of(organ);
    let own: Option<Vec<f64>> = match law {
        SoughtLaw::NeoHookean => Some(vec![column.neo_hookean()]),
        _ => column
            .mooney_rivlin()
            .map(|found| found.as_slice().to_vec()),
    };
    let note = format!("initial value; ours: {}", column.note());
    for (place, name) in names(law).iter().enumerate() {
        let value = Value {
            published: table.value(organ, &format!("initial_{name}")),
            ours: own.as_ref().map(|own| own[place]),
            unit: "Pa",
        };
        let word = name.trim_end_matches("_pa");
        rows.add(&format!("{organ}/initial_{word}"), value, note.clone());
    }
}

/// The parameters, by the names of the tables' columns.
fn names(law: SoughtLaw) -> &'static [&'static str] {
    match law {
        SoughtLaw::NeoHookean => &["c10_pa"],
        _ => &["c10_pa", "c01_pa"],
    }
}

fn add(rows: &mut Rows<'_>, (organ, table): (&str, Table), truth: &[f64], found: &LawDescription) {
    for (place, (name, estimate)) in found.parameters.iter().enumerate() {
        let value = Value::beside(truth.get(place).copied(), estimate.value, "Pa");
        let word = name.trim_end_matches("_pa");
        let note = format!("{}; {NOTE}", stated(estimate));
        rows.add_pipeline_only(&format!("{organ}/{word}"), value, note);
    }
    if truth.len() > 1 {
        let sum: f64 = found
            .parameters
            .iter()
            .map(|(_, estimate)| estimate.value)
            .sum();
        let value = Value::beside(Some(truth.iter().sum()), sum, "Pa");
        let note = format!(
            "C10 + C01, which is all that such a recording knows well: their correlation is {:.4}; {NOTE}",
            found.correlation.unwrap_or(0.0)
        );
        rows.add_pipeline_only(&format!("{organ}/sum"), value, note);
    }
    let steps = found.found.fit.iterations.len().saturating_sub(1);
    let note = format!(
        "ours: steps of the fit from its own start, which with one modulus is the answer; runs of finite elements: {}; from the printed start: \
         figure-6-9 and figure-6-10",
        found.found.solves
    );
    let iterations = Value::beside(table.value(organ, "iterations"), steps as f64, "1");
    rows.add(&format!("{organ}/iterations"), iterations, note);
    let note = "root mean square of what the fitted law leaves of the full run's force, over the largest force";
    let misfit = Value::own(found.misfit, "1");
    rows.add(&format!("{organ}/misfit"), misfit, note);
    let note = "ours: what the convolution leaves of the full run, in N² over its 81 samples; the source gives neither unit nor number of \
                samples";
    let squares = Value::beside(
        table.value(organ, "sum_squared_error"),
        found.sum_of_squares,
        "N²",
    );
    rows.add(&format!("{organ}/sum_squared_error"), squares, note);
}
