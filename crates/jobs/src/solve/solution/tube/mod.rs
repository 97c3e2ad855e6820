mod indented;
mod plot;

use palpate_files::quantity::{plain_quantity, rounded};
use palpate_mechanics::finite_elements::tube::{
    Ends, Inflated, Tube as Shape, TubeProblem, inflate,
};

use super::super::problem::{Problem, Tube};
use super::super::table::Table;
use super::figures::TubeFigures;
use super::{Figures, RequestedOutputs, Solution, plots};
use crate::Error;
use crate::solve::solver_progress::ProgressReporter;

/// Widening of the tube under each pressure.
pub(crate) fn solution(
    problem: &Problem,
    case: &Tube,
    wanted: RequestedOutputs,
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let mechanical = TubeProblem {
        tube: Shape {
            length: case.length,
            inner_radius: case.inner_radius,
            outer_radius: case.outer_radius,
        },
        law: problem.material.law.clone(),
        ends: Ends::Fixed,
    };
    let under = |pressures: &[f64], accuracy: f64| {
        inflate(&mechanical, pressures, accuracy, &mut |progress| {
            reporter.at(progress);
        })
        .map_err(|error| problem.refused(error))
    };
    let found = under(&case.pressures, problem.accuracy)?;
    let inflated = found.answer;
    let mut warnings = found.warnings;
    warnings.extend(inflated.warnings.iter().cloned());
    warnings.extend(warnings_of_tube(problem, case, &inflated));
    let moved = &inflated.inner_displacements;
    let in_words = |moved: &Option<f64>| match moved {
        Some(moved) => rounded(1e3 * moved, 4),
        None => "past the limit".to_owned(),
    };
    let table = Table::default()
        .with("pressure [Pa]", case.pressures.iter().copied())
        .with_texts("inner displacement [mm]", moved.iter().map(in_words));
    // A curve through a few pressures would have corners.
    let drawn = match wanted.plot && case.indent.is_none() {
        true => plot::curve(&case.pressures, &inflated, under)?,
        false => Vec::new(),
    };
    let solution = Solution {
        heading: heading(case, &inflated),
        tables: vec![table],
        plot: plot::over_displacement(problem, case, &inflated, drawn),
        warnings,
        figures: Figures::Tube(TubeFigures {
            pressure_pa: case.pressures.clone(),
            inner_displacement_m: inflated.inner_displacements,
            limit_pressure_pa: inflated.limit_pressure,
            depth_m: None,
            force_n: None,
        }),
        unknowns: inflated.unknowns,
        estimated_error: found.error,
        observed_order: found.observed_order,
        vtu: None,
        recording: None,
    };
    match &case.indent {
        Some(indent) => {
            indented::with_forces(solution, problem, &mechanical, case, indent, reporter)
        }
        None => Ok(solution),
    }
}

fn heading(case: &Tube, inflated: &Inflated) -> String {
    let tube = format!(
        "Tube of length {} mm and radii {} and {} mm, both ends fixed, under pressure",
        plots::short(1e3 * case.length),
        plots::short(1e3 * case.inner_radius),
        plots::short(1e3 * case.outer_radius),
    );
    match inflated.limit_pressure {
        Some(limit) => format!(
            "{tube}; it balloons at {}",
            plain_quantity("_pa", limit, None)
        ),
        None => tube,
    }
}

fn warnings_of_tube(problem: &Problem, case: &Tube, inflated: &Inflated) -> Vec<String> {
    let mut warnings = Vec::new();
    let requested = case.pressures.iter().zip(&inflated.inner_displacements);
    let past: Vec<String> = requested
        .clone()
        .filter(|(_, moved)| moved.is_none())
        .map(|(pressure, _)| format!("{pressure} Pa"))
        .collect();
    if !past.is_empty() {
        let limit = inflated.limit_pressure.map_or(String::new(), |limit| {
            format!(", {}", plain_quantity("_pa", limit, None))
        });
        warnings.push(format!(
            "{}: past the limit{limit}; a tube of this law has no equilibrium there, for it \
             balloons",
            past.join(", ")
        ));
    }
    let widest = requested
        .filter_map(|(_, moved)| *moved)
        .fold(0.0, f64::max);
    if problem.is_small_strain() && widest > 0.1 * case.inner_radius {
        warnings.push(format!(
            "the linear law is for small strain, but the inner wall moves by {:.2} of its radius; \
             a hyperelastic law follows large strain",
            widest / case.inner_radius
        ));
    }
    if let Some(from) = inflated.wrinkles_from
        && case.pressures.iter().any(|pressure| *pressure >= from)
    {
        warnings.push(format!(
            "from {} on the tube could wrinkle along its length; the answers are those of a \
             smooth one",
            plain_quantity("_pa", from, None)
        ));
    }
    warnings
}
