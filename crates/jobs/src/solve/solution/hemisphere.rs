use std::f64::consts::FRAC_2_PI;

use palpate_mechanics::contact::{Friction, half_space_stiffness};
use palpate_mechanics::finite_elements::hemisphere::{HemisphereProblem, Patch, solve};

use super::super::problem::{Hemisphere, Problem};
use super::super::table::Table;
use super::figures::Profile;
use super::{Figures, Solution, plots, warnings};
use crate::Error;
use crate::plot::Plot;
use crate::solve::solver_progress::ProgressReporter;

/// Force on the patch, and displacement of the surface.
pub(crate) fn solution(
    problem: &Problem,
    case: &Hemisphere,
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let mechanical = HemisphereProblem {
        radius: case.radius,
        patch_radius: case.patch_radius,
        patch: match case.patch {
            Friction::Frictionless => Patch::Slip,
            Friction::Bonded => Patch::Bonded,
        },
        law: problem.material.at_rest,
        depth: case.depth,
    };
    let found = solve(&mechanical, problem.accuracy, |progress| {
        reporter.at(progress)
    })
    .map_err(|error| problem.refused(error))?;
    let answer = found.answer;
    let mut warnings = found.warnings;
    warnings.extend(warnings::of_depths(
        problem,
        case.patch_radius,
        &[case.depth],
    ));
    let law = &problem.material.at_rest;
    let closed = case.depth * half_space_stiffness(law, case.patch_radius, case.patch);
    let (arcs, moved): (Vec<f64>, Vec<f64>) = answer.profile.into_iter().unzip();
    let table = Table::default()
        .with("depth [mm]", [1e3 * case.depth])
        .with("force [mN]", [1e3 * answer.force])
        .with("half-space [mN]", [1e3 * closed]);
    Ok(Solution {
        heading: heading(case),
        tables: vec![table],
        plot: profile(case, &arcs, &moved),
        figures: Figures::Hemisphere {
            depth_m: case.depth,
            force_n: answer.force,
            profile: Profile {
                arc_m: arcs,
                normal_displacement_m: moved,
            },
        },
        unknowns: answer.unknowns,
        estimated_error: found.error,
        observed_order: found.observed_order,
        warnings,
        vtu: None,
        recording: None,
    })
}

fn heading(case: &Hemisphere) -> String {
    format!(
        "Hemisphere of radius {} mm, base fixed, pressed at its pole by a patch of radius {} mm that {}",
        plots::short(1e3 * case.radius),
        plots::short(1e3 * case.patch_radius),
        match case.patch {
            Friction::Frictionless => "slips",
            Friction::Bonded => "is bonded",
        }
    )
}

fn profile(case: &Hemisphere, arcs: &[f64], moved: &[f64]) -> Plot {
    let both = |arc: f64, moved: f64| (1e3 * arc, 1e3 * moved);
    let mut series = vec![plots::line(
        "finite elements",
        arcs.iter()
            .zip(moved)
            .map(|(&arc, &moved)| both(arc, moved)),
    )];
    if case.patch == Friction::Frictionless {
        // Under a flat punch without friction the surface around it moves by 2 d/π asin(a/r).
        let along = arcs.iter().map(|&arc| {
            let part = (case.patch_radius / arc).min(1.0);
            both(arc, -case.depth * FRAC_2_PI * part.asin())
        });
        series.push(plots::closed_form("flat half-space, closed form", along));
    }
    Plot {
        title: "How the surface of the hemisphere moves".to_owned(),
        x_label: "Arc from the pole [mm]".to_owned(),
        y_label: "Displacement along the outward normal [mm]".to_owned(),
        series,
        ..Plot::default()
    }
}
