use palpate_mechanics::finite_elements::tube::{TubeProblem, TubePunch, indent};

use super::super::super::problem::{Problem, Tube, TubeIndent};
use super::super::super::table::Table;
use super::super::figures::Figures;
use super::super::{Solution, millimetres, millinewtons, plots, warnings};
use crate::Error;
use crate::plot::Plot;
use crate::solve::solver_progress::ProgressReporter;

/// Adds to the solution of the inflated tube the forces of a punch on its side under the last pressure.
pub(crate) fn with_forces(
    inflated: Solution,
    problem: &Problem,
    mechanical: &TubeProblem,
    tube: &Tube,
    punch: &TubeIndent,
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let Figures::Tube(mut figures) = inflated.figures else {
        return Ok(inflated);
    };
    let depths = &punch.depths;
    figures.depth_m = Some(depths.clone());
    let last = (tube.pressures.last(), figures.inner_displacement_m.last());
    let (Some(&pressure), Some(Some(_))) = last else {
        figures.force_n = Some(vec![None; depths.len()]);
        let figures = Figures::Tube(figures);
        let warning = "the tube was not indented, for its last pressure is past the limit";
        let mut warnings = inflated.warnings;
        warnings.push(warning.to_owned());
        return Ok(Solution {
            figures,
            warnings,
            ..inflated
        });
    };
    let request = TubePunch {
        radius: punch.radius,
        face: punch.contact,
        pressure,
        depths: depths.clone(),
    };
    let found = indent(mechanical, &request, problem.accuracy, &mut |progress| {
        reporter.at(progress);
    })
    .map_err(|error| problem.refused(error))?;
    let forces = found.answer.forces;
    let mut tables = inflated.tables;
    tables.push(
        Table::default()
            .with("depth [mm]", millimetres(depths))
            .with("force [mN]", millinewtons(&forces)),
    );
    let mut warnings = inflated.warnings;
    warnings.extend(warnings::of_depths(problem, punch.radius, depths));
    warnings.extend(found.warnings);
    warnings.extend(found.answer.warnings);
    // The error estimate of the less accurate of the two.
    let (estimated_error, observed_order) = if found.error > inflated.estimated_error {
        (found.error, found.observed_order)
    } else {
        (inflated.estimated_error, inflated.observed_order)
    };
    let pairs = millimetres(depths).zip(millinewtons(&forces));
    let plot = Plot {
        title: format!(
            "Tube under {} Pa, indented by a punch of radius {} mm",
            plots::short(pressure),
            plots::short(1e3 * punch.radius)
        ),
        x_label: "Depth [mm]".to_owned(),
        y_label: "Force on the tissue [mN]".to_owned(),
        series: vec![plots::dotted_line("", pairs)],
        ..Plot::default()
    };
    figures.force_n = Some(forces.into_iter().map(Some).collect());
    Ok(Solution {
        figures: Figures::Tube(figures),
        tables,
        plot,
        warnings,
        unknowns: inflated.unknowns.max(found.answer.unknowns),
        estimated_error,
        observed_order,
        ..inflated
    })
}
