use std::sync::Arc;

use palpate_mechanics::Law;
use palpate_mechanics::finite_elements::uniaxial::{Stretched, nominal_stress, stretched};

use super::super::problem::{Problem, Uniaxial};
use super::super::table::Table;
use super::{Figures, Solution, plots};
use crate::Error;
use crate::plot::{Plot, Series, Style};

/// Stretches beyond which the linear law is inaccurate [-].
const SMALL: std::ops::RangeInclusive<f64> = 0.9..=1.1;

/// Nominal stress at each stretch. The deformation is homogeneous, so the result does not depend on a mesh.
pub(crate) fn solution(problem: &Problem, case: &Uniaxial) -> Result<Solution, Error> {
    let law = problem.material.law.in_frame(&case.frame);
    let has_fibres = law.is_some();
    let law = law.unwrap_or_else(|| Arc::clone(&problem.material.law));
    let bars = case
        .stretches
        .iter()
        .map(|&stretch| stretched(law.as_ref(), stretch))
        .collect::<Result<Vec<Stretched>, _>>()
        .map_err(|error| problem.refused(error))?;
    let stresses: Vec<f64> = bars.iter().map(|bar| bar.nominal_stress).collect();
    let lateral: Vec<[f64; 2]> = bars.iter().map(|bar| bar.lateral).collect();
    let mut table = Table::default()
        .with("stretch [-]", case.stretches.iter().copied())
        .with("nominal stress [Pa]", stresses.iter().copied());
    if has_fibres {
        for (side, name) in case.sides.into_iter().enumerate() {
            let stretches = lateral.iter().map(|sides| sides[side]);
            table = table.with(name, stretches);
        }
    }
    let mut warnings = Vec::new();
    if problem.is_small_strain()
        && case
            .stretches
            .iter()
            .any(|stretch| !SMALL.contains(stretch))
    {
        warnings.push(
            "the linear law is for small strain, but a stretch is beyond 0.9 to 1.1; \
             a hyperelastic law follows large strain"
                .to_owned(),
        );
    }
    Ok(Solution {
        heading: "Bar, pulled or pressed along its axis, free to widen".to_owned(),
        tables: vec![table],
        plot: over_stretch(problem, law.as_ref(), &case.stretches, &stresses),
        figures: Figures::Uniaxial {
            stretch: case.stretches.clone(),
            nominal_stress_pa: stresses,
            lateral_stretch: has_fibres.then_some(lateral),
        },
        unknowns: 0,
        estimated_error: 0.0,
        observed_order: None,
        warnings,
        vtu: None,
        recording: None,
    })
}

fn over_stretch(problem: &Problem, law: &dyn Law, stretches: &[f64], stresses: &[f64]) -> Plot {
    let lowest = stretches.iter().copied().fold(1.0, f64::min);
    let highest = stretches.iter().copied().fold(1.0, f64::max);
    let between = (0..=120).filter_map(|k| {
        let stretch = lowest + (highest - lowest) * f64::from(k) / 120.0;
        Some((stretch, nominal_stress(law, stretch).ok()?))
    });
    let requested = stretches.iter().copied().zip(stresses.iter().copied());
    Plot {
        title: format!(
            "Stretched bar, {} law",
            problem.tissue.elasticity.law().row().title
        ),
        x_label: "Stretch [-]".to_owned(),
        y_label: "Nominal stress [Pa]".to_owned(),
        series: vec![
            Series {
                style: Style::Dots,
                ..plots::line("asked for", requested)
            },
            plots::line("in between", between),
        ],
        ..Plot::default()
    }
}
