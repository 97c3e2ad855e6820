//! What each method says of the esophagus: the table of `docs/theory/esophagus.md`.

use std::sync::Arc;

use palpate_files::Scene;
use palpate_mechanics::finite_elements::estimate::Progress;
use palpate_mechanics::finite_elements::indentation::Grip;
use palpate_mechanics::finite_elements::solid::{Body, MovedPatch, SolidProblem, solve};
use palpate_mechanics::{IndentationCurve, LinearElastic, Material};
use palpate_simulate::{Simulation, held_region};

use super::figures::TRAINER;
use super::section_7_8::{front, scene, scene_of_the_trainer, simulated, unit_forces};
use crate::Error;
use crate::m06::Printed;
use crate::m09::{POISSONS_RATIO, at_finite_strain, at_small_strain, nearest_modulus};
use crate::row::Value;
use crate::virtual_rig::RADIUS;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};

pub(crate) const ESOPHAGUS: Item = Item {
    name: "section-7-8/esophagus",
    title: "the esophagus by each method: forces and fitted moduli; takes minutes",
    seconds: 110.0,
    run,
};

/// Depths at which methods are compared [mm].
const DEPTHS_MM: [u32; 3] = [1, 4, 7];
/// The tube cannot be pressed deeper than its axis, so all moduli are fitted down to here [mm].
const DEEPEST_MM: u32 = 6;
/// Length of the simulated organ between its anchors [m].
const FREE: f64 = 0.052;
/// Of the organ's finite elements [-].
const ACCURACY: f64 = 0.05;

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

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
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

fn trainer() -> Result<Trainer, Error> {
    let scene = Scene::parse(TRAINER, "built-in scene")?;
    let material = Material::from_tissue(&scene.organ.tissue.read()?)?;
    Ok(Trainer {
        modulus: material.at_rest.youngs_modulus(),
        left: material.prony.relaxation(f64::INFINITY),
    })
}

/// All methods, from the simplest model of the organ to the trainer's.
fn methods(rows: &Rows<'_>) -> Result<Vec<Method>, Error> {
    // The last one beyond those that are compared.
    let depths = [1e-3, 2e-3, 4e-3, 5e-3, 6e-3, 7e-3];
    // (6.1) with nu = 0.5.
    let half_space = depths.map(|depth| 2.0 * RADIUS * depth / 0.75);
    let punch = "its end faces fixed, bonded face of 1 mm radius";
    let radii = "straight tube with radii of 5 and 7.5 mm";
    let finite = at_finite_strain(rows)?;
    let small = at_small_strain(rows, None)?;
    let short = at_small_strain(rows, Some(FREE))?;
    rows.say("simulator");
    let simulation = simulated(rows, &scene()?)?;
    let of_source = unit_forces(&simulation, &depths);
    rows.say("trainer");
    let of_trainer = unit_forces(&simulated(rows, &scene_of_the_trainer()?)?, &depths);
    let organ = organ(rows, &simulation)?;
    let small_strain = format!("finite elements at small strain, Poisson's ratio {POISSONS_RATIO}");
    let method = |word, title, unit, note| Method {
        word,
        title,
        unit,
        note,
    };
    let line = |stiffness: f64| IndentationCurve::through(&depths, &depths.map(|d| stiffness * d));
    Ok(vec![
        method(
            "half_space",
            "half-space (6.1)",
            IndentationCurve::through(&depths, &half_space),
            "(6.1), closed form of a half-space, Poisson's ratio 0.5: the organ is not hollow"
                .to_owned(),
        ),
        method(
            "tube_finite_strain",
            "tube, finite strain",
            finite.unit.clone(),
            format!(
                "finite elements at finite strain, incompressible neo-Hookean tissue, {radii}, 60 mm long, {punch}; relative \
                 error {:.3}",
                finite.error
            ),
        ),
        method(
            "tube_small_strain",
            "tube, small strain",
            small.unit,
            format!(
                "{small_strain}, {radii}, 60 mm long, {punch}; relative error {:.3}",
                small.error
            ),
        ),
        method(
            "short_tube",
            "tube of 52 mm, small strain",
            short.unit,
            format!(
                "{small_strain}, {radii}, 52 mm long as the simulated organ is between its anchors, {punch}; relative error {:.3}",
                short.error
            ),
        ),
        method(
            "organ_small_strain",
            "simulated shape, small strain",
            line(organ.stiffness),
            format!(
                "{small_strain}, on the simulated organ's surface, whose ends widen, with its anchors, bonded patch of 1 mm radius; \
                 relative error {:.3}",
                organ.error
            ),
        ),
        method(
            "simulator",
            "simulator",
            IndentationCurve::through(&depths, &of_source),
            format!(
                "the simulator's linear model of the same organ on the source's 3,726 triangles (condensed finite elements), Poisson's \
                 ratio {POISSONS_RATIO}"
            ),
        ),
        method(
            "trainer",
            "trainer",
            IndentationCurve::through(&depths, &of_trainer),
            format!(
                "the same on the trainer's triangles, 14,000 of which 2,500 are solved, Poisson's ratio {POISSONS_RATIO}"
            ),
        ),
    ])
}

/// The simulated organ by finite elements that are refined to the edge of the probe.
struct SolidOrgan {
    /// Force per depth for a Young's modulus of 1 Pa [N/m].
    stiffness: f64,
    /// Relative error of it [-].
    error: f64,
}

fn organ(rows: &Rows<'_>, simulation: &Simulation) -> Result<SolidOrgan, Error> {
    let (center, normal) = front(simulation);
    let problem = SolidProblem {
        body: Body::Surface(simulation.surface().clone()),
        anchor: held_region(&scene()?.organ.shape, None),
        patch: MovedPatch {
            center,
            radius: RADIUS,
            // Small strain: any will do.
            displacement: -1e-3 * normal,
            grip: Grip::Stick,
        },
        law: Arc::new(LinearElastic::new(1.0, POISSONS_RATIO)?),
    };
    let found = solve(&problem, ACCURACY, &mut |progress: Progress| {
        let (mesh, part) = (progress.mesh + 1, 100.0 * progress.part);
        rows.say(format!("organ, mesh {mesh}, {part:.0} %"));
    })?;
    Ok(SolidOrgan {
        stiffness: 1e3 * found.answer.force_along,
        error: found.error,
    })
}

fn drawn(methods: &[Method], modulus: f64, measured: &[Printed]) -> Plot {
    let line = |(color, method): (usize, &Method)| {
        let depths = (0..=70).map(|i| 0.1 * f64::from(i));
        let force = |depth: f64| (depth, 1e3 * modulus * method.unit.force(1e-3 * depth));
        Series::new(
            method.title,
            depths.map(force).collect(),
            Style::Line,
            color,
        )
    };
    let means = measured
        .iter()
        .map(|row| (f64::from(row.depth_mm), 1e3 * row.mean))
        .collect();
    let mut series: Vec<Series> = methods.iter().enumerate().map(line).collect();
    series.push(Series::new(
        "mean of table 5-1",
        means,
        Style::Dots,
        methods.len(),
    ));
    Plot {
        title: format!("The esophagus by each method, {:.1} kPa", 1e-3 * modulus),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series,
        ..Plot::default()
    }
}
