use palpate_characterize::inverse::{
    Body, CandidateLaw, Curves, Indentation, LawDescription, law_fit,
};
use palpate_characterize::viscoelastic::{RelaxationRecord, RelaxationSettings, relaxation};
use palpate_characterize::{CharacterizeSettings, characterize};
use palpate_files::Estimate;
use palpate_mechanics::finite_elements::indentation::History;

use super::block::{ORGANS, moduli, printed};
use super::equation_6_17::Column;
use super::full_run::full_run;
use crate::Error;
use crate::published::prony;
use crate::row::Rows;
use crate::virtual_rig::{RADIUS, elastic, without_noise};

pub(crate) fn neo_hookean(rows: &mut Rows<'_>) -> Result<(), Error> {
    run(rows, CandidateLaw::NeoHookean)
}

pub(crate) fn mooney_rivlin(rows: &mut Rows<'_>) -> Result<(), Error> {
    run(rows, CandidateLaw::MooneyRivlin)
}

fn run(rows: &mut Rows<'_>, law: CandidateLaw) -> Result<(), Error> {
    for (organ, depth_mm) in ORGANS {
        let truth = printed(law, organ, "final")?;
        let series = prony(organ, depth_mm)?;
        let depth = 1e-3 * f64::from(depth_mm);
        let (course, forces) = full_run(rows, law, &truth, &series, depth)?;
        let assumed = elastic(CandidateLaw::NeoHookean, 1.0, &[])?;
        let largest = forces.iter().copied().fold(0.0, f64::max);
        let seen =
            RelaxationRecord::new(&course.times, &course.depths, &forces, largest, |depth| {
                assumed.force(depth)
            });
        let seen: Vec<RelaxationRecord> = seen.into_iter().collect();
        let relaxing = relaxation(&seen, RelaxationSettings { terms: Some(2) })?;
        let indentation = Indentation::new(&course.times, &course.depths, &forces);
        let mut curves = Curves::new(Body::under_punch(RADIUS), law, depth);
        let found = law_fit(&mut curves, &[indentation], &relaxing.series)?;
        let found = LawDescription::of(found, &[indentation]);
        add(rows, organ, &truth, &found);
        add_in_loop(rows, organ, law, &course, &forces)?;
        rows.row(&format!("{organ}/steady"))
            .with("depth", depth_mm)
            .is(forces.last().copied());
        add_initial(rows, organ, law);
    }
    Ok(())
}

/// A modulus that was found, with the standard error that its fit states.
fn add_modulus(rows: &mut Rows<'_>, name: &str, estimate: &Estimate) {
    let error = estimate.standard_error;
    rows.row(name)
        .with("stated", error.is_some())
        .with("error", format!("{:.1}", error.unwrap_or(0.0)))
        .is(estimate.value);
}

/// The same with finite elements in the loop.
fn add_in_loop(
    rows: &mut Rows<'_>,
    organ: &str,
    law: CandidateLaw,
    course: &History,
    forces: &[f64],
) -> Result<(), Error> {
    let recording = without_noise(organ, course, forces)?;
    let settings = CharacterizeSettings {
        relaxation: RelaxationSettings { terms: Some(2) },
        laws: vec![law],
        draws: None,
        in_loop: true,
        closed_forms: false,
    };
    rows.report_step(format!("{organ}, finite elements in the loop"));
    let answer = characterize(&[recording], &settings, &mut |_| ());
    let Some((_, found)) = answer.laws.into_iter().next() else {
        return Ok(());
    };
    let found = found?;
    for (name, estimate) in &found.parameters {
        let word = name.trim_end_matches("_pa");
        add_modulus(rows, &format!("{organ}/{word}_in_loop"), estimate);
    }
    let solves = found.found.solves as f64;
    rows.add(&format!("{organ}/solves_in_loop"), solves);
    Ok(())
}

/// (6.17) and (6.18), which have their own items.
fn add_initial(rows: &mut Rows<'_>, organ: &str, law: CandidateLaw) {
    let column = Column::of(organ);
    let own: Option<Vec<f64>> = match law {
        CandidateLaw::NeoHookean => Some(vec![column.neo_hookean()]),
        _ => column
            .mooney_rivlin()
            .map(|found| found.as_slice().to_vec()),
    };
    for (place, word) in moduli(law).iter().enumerate() {
        let ours = own.as_ref().map(|own| own[place]);
        column
            .in_note_of(rows.row(&format!("{organ}/initial_{word}")))
            .is(ours);
    }
}

fn add(rows: &mut Rows<'_>, organ: &str, truth: &[f64], found: &LawDescription) {
    for (name, estimate) in &found.parameters {
        let word = name.trim_end_matches("_pa");
        add_modulus(rows, &format!("{organ}/{word}"), estimate);
    }
    if truth.len() > 1 {
        let each = found.parameters.iter().map(|(_, estimate)| estimate.value);
        let sum: f64 = each.sum();
        let correlation = found.correlation.unwrap_or(0.0);
        rows.row(&format!("{organ}/sum"))
            .with("correlation", format!("{correlation:.4}"))
            .published(truth.iter().sum::<f64>())
            .is(sum);
    }
    let steps = found.found.fit.iterations.len().saturating_sub(1);
    rows.row(&format!("{organ}/iterations"))
        .with("solves", found.found.solves)
        .is(steps as f64);
    rows.add(&format!("{organ}/misfit"), found.misfit);
    let squares = found.sum_of_squares;
    rows.add(&format!("{organ}/sum_squared_error"), squares);
}
