use std::sync::Arc;

use palpate_mechanics::NeoHookean;
use palpate_mechanics::finite_elements::estimate::{Estimated, Progress};
use palpate_mechanics::finite_elements::tube::{Ends, Inflated, Tube, TubeProblem, inflate};

use crate::failure::Failure;
use crate::plot::{Plot, Series, Style};
use crate::reproduce::published::{SECTION_6_4_5 as PUBLISHED, TABLE_5_1};
use crate::reproduce::row::Value;
use crate::reproduce::{Item, Rows};

pub(crate) const SECTION_6_4_5: Item = Item {
    name: "section-6-4-5",
    title: "the esophagus as a tube under pressure",
    run,
};

/// The source gives a diameter of about 15 mm (section 7.1) and no wall; 2.5 mm is a reading.
const INNER_RADIUS: f64 = 5e-3;
const OUTER_RADIUS: f64 = 7.5e-3;
const PASCAL_PER_MMHG: f64 = 133.322_387_415;
const ACCURACY: f64 = 0.01;

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    // The file's one row begins with the modulus.
    let printed = |column| PUBLISHED.value("5.222", column);
    let (Some(modulus_kpa), Some(pressure_mmhg), Some(length_mm)) = (
        printed("youngs_modulus_kpa"),
        printed("internal_pressure_mmhg"),
        printed("length_mm"),
    ) else {
        rows.add_missing(
            "limit_pressure",
            "mmHg",
            "the published values cannot be read",
        );
        return Ok(());
    };
    add_modulus(rows, modulus_kpa);
    let law = NeoHookean::incompressible(1e3 * modulus_kpa / 6.0)?;
    let problem = TubeProblem {
        tube: Tube {
            length: 1e-3 * length_mm,
            inner_radius: INNER_RADIUS,
            outer_radius: OUTER_RADIUS,
        },
        law: Arc::new(law),
        ends: Ends::Held,
    };
    let found = solve(rows, &problem, &[])?;
    let limit = found.answer.limit_pressure;
    let value = Value {
        published: Some(pressure_mmhg),
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
    let (depth, radius) = (8e-3, 1e-3);
    // (6.1) with nu = 0.5.
    let half_space = TABLE_5_1
        .value_of(["esophagus", "8"], "mean_n")
        .map(|force| 1e-3 * 0.75 * force / (2.0 * radius * depth));
    let value = Value {
        published: Some(modulus_kpa),
        ours: half_space,
        unit: "kPa",
    };
    let note = "published as the result of inverse finite elements on the tube; ours: the half-space \
                formula (6.1) with the mean of table 5-1 at 8 mm, which is the same number to four digits";
    rows.add("youngs_modulus", value, note);
}

fn solve(
    rows: &Rows<'_>,
    problem: &TubeProblem,
    pressures: &[f64],
) -> Result<Estimated<Inflated>, Failure> {
    let mut say = |progress: Progress| {
        let (mesh, part) = (progress.halvings + 1, 100.0 * progress.part);
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
