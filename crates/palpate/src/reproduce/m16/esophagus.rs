//! What each method says of the esophagus: the table of `docs/theory/esophagus.md`.

use palpate_files::Scene;
use palpate_mechanics::{IndentationCurve, Material};

use super::section_7_8::unit_forces;
use crate::command::TRAINER;
use crate::failure::Failure;
use crate::plot::{Plot, Series, Style};
use crate::reproduce::m06::Printed;
use crate::reproduce::m09::{POISSONS_RATIO, at_finite_strain, at_small_strain, nearest_modulus};
use crate::reproduce::row::Value;
use crate::reproduce::virtual_rig::RADIUS;
use crate::reproduce::{Item, Rows};

pub(crate) const ESOPHAGUS: Item = Item {
    name: "section-7-8/esophagus",
    title: "the esophagus by each method: forces and fitted moduli; takes minutes",
    seconds: 90.0,
    run,
};

/// Depths at which methods are compared [mm].
const DEPTHS_MM: [u32; 3] = [1, 4, 7];
/// The tube cannot be pressed deeper than its axis, so all moduli are fitted down to here [mm].
const DEEPEST_MM: u32 = 6;

/// A way to compute the force.
struct Method {
    /// In the names of rows.
    word: &'static str,
    /// In the legend of the figure.
    title: &'static str,
    /// Force [N] over depth [m] for a Young's modulus of 1 Pa.
    unit: IndentationCurve,
    /// What it assumes.
    note: String,
}

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let trainer = trainer()?;
    let relaxed = trainer.modulus * trainer.left;
    rows.add(
        "trainer/modulus",
        Value::own(1e-3 * trainer.modulus, "kPa"),
        "the instantaneous Young's modulus of the trainer's scene",
    );
    rows.add(
        "trainer/relaxed_modulus",
        Value::own(1e-3 * relaxed, "kPa"),
        "the same after relaxation (section 6.4.5): forces of this item are computed with it",
    );
    let methods = methods(rows)?;
    let measured = Printed::all("esophagus");
    let fitted: Vec<Printed> = measured
        .iter()
        .filter(|row| row.depth_mm <= DEEPEST_MM)
        .copied()
        .collect();
    for method in &methods {
        for depth_mm in DEPTHS_MM {
            let published = measured.iter().find(|row| row.depth_mm == depth_mm);
            let force = relaxed * method.unit.force(1e-3 * f64::from(depth_mm));
            let value = Value::beside(published.map(|row| row.mean), force, "N");
            let note = format!("published: mean of table 5-1; ours: {}", method.note);
            rows.add(&format!("{}/{depth_mm}_mm", method.word), value, note);
        }
        let modulus = nearest_modulus(&method.unit, &fitted);
        let note = format!(
            "relaxed modulus with which this method comes nearest to the means of table 5-1 from 1 to {DEEPEST_MM} mm; {}",
            method.note
        );
        let value = Value::own(modulus, "kPa");
        rows.add(&format!("{}/fitted_modulus", method.word), value, note);
        let note = "the same before relaxation: what a tissue of this method has to state";
        let value = Value::own(modulus / trainer.left, "kPa");
        let name = format!("{}/fitted_modulus/instantaneous", method.word);
        rows.add(&name, value, note);
    }
    let plot = drawn(&methods, relaxed, &measured);
    rows.add_figure(None, &plot, "relaxed forces with the trainer's modulus")
}

/// The tissue of the trainer.
struct Trainer {
    /// Instantaneous Young's modulus at small strain [Pa].
    modulus: f64,
    /// Part of the force that is left after relaxation [-].
    left: f64,
}

fn trainer() -> Result<Trainer, Failure> {
    let scene = Scene::parse(TRAINER, "built-in scene")?;
    let material = Material::from_tissue(&scene.organ.tissue.read()?)?;
    Ok(Trainer {
        modulus: material.at_rest.youngs_modulus(),
        left: material.prony.relaxation(f64::INFINITY),
    })
}

/// All methods, from the simplest model of the organ to the trainer's.
fn methods(rows: &Rows<'_>) -> Result<Vec<Method>, Failure> {
    let depths = [1e-3, 2e-3, 4e-3, 5e-3, 6e-3, 7e-3];
    let tube = "straight tube of 60 mm with radii of 5 and 7.5 mm, its end faces fixed, bonded face of 1 mm radius";
    // (6.1) with nu = 0.5.
    let half_space = depths.map(|depth| 2.0 * RADIUS * depth / 0.75);
    let small = at_small_strain(rows)?;
    let finite = at_finite_strain(rows)?;
    rows.say("simulator");
    let simulated = unit_forces(&depths)?;
    Ok(vec![
        Method {
            word: "half_space",
            title: "half-space (6.1)",
            unit: IndentationCurve::through(&depths, &half_space),
            note: "(6.1), closed form of a half-space, Poisson's ratio 0.5: the organ is not hollow".to_owned(),
        },
        Method {
            word: "tube_small_strain",
            title: "tube, small strain",
            unit: small.unit.clone(),
            note: format!(
                "finite elements at small strain, Poisson's ratio {POISSONS_RATIO}, {tube}; relative error {:.3}",
                small.error
            ),
        },
        Method {
            word: "tube_finite_strain",
            title: "tube, finite strain",
            unit: finite.unit.clone(),
            note: format!(
                "finite elements at finite strain, incompressible neo-Hookean tissue, {tube}; relative error {:.3}",
                finite.error
            ),
        },
        Method {
            word: "simulator",
            title: "simulator",
            unit: IndentationCurve::through(&depths, &simulated),
            note: format!(
                "linear model of the whole organ that the trainer renders: curved, flared ends of which 4 mm each are fixed, \
                 Poisson's ratio {POISSONS_RATIO}"
            ),
        },
    ])
}

fn drawn(methods: &[Method], modulus: f64, measured: &[Printed]) -> Plot {
    let line = |(color, method): (usize, &Method)| {
        let depths = (0..=70).map(|i| 0.1 * f64::from(i));
        let force = |depth: f64| (depth, 1e3 * modulus * method.unit.force(1e-3 * depth));
        Series::new(method.title, depths.map(force).collect(), Style::Line, color)
    };
    let means = measured
        .iter()
        .map(|row| (f64::from(row.depth_mm), 1e3 * row.mean))
        .collect();
    let mut series: Vec<Series> = methods.iter().enumerate().map(line).collect();
    series.push(Series::new("mean of table 5-1", means, Style::Dots, methods.len()));
    Plot {
        title: format!("The esophagus by each method, {:.1} kPa", 1e-3 * modulus),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    }
}
