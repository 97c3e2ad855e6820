//! Results of each method for the esophagus: the table of `docs/theory/esophagus.md`.

use palpate_mechanics::contact::Friction;
use std::sync::Arc;

use palpate_files::Scene;
use palpate_mechanics::finite_elements::solid::{Body, Loads, MovedPatch, SolidProblem, solve};
use palpate_mechanics::{IndentationCurve, LinearElastic, Material};
use palpate_simulate::{Simulation, fixed_region};

use super::figures::TRAINER;
use super::section_7_8::{front, means, scene, scene_of_the_trainer, simulated, unit_forces};
use crate::Error;
use crate::m06::Printed;
use crate::m09::{POISSONS_RATIO, at_finite_strain, at_small_strain, nearest_modulus};
use crate::row::Rows;
use crate::virtual_rig::RADIUS;
use palpate_jobs::plot::{Series, Style};

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
    /// Relative error of it, of finite elements [-].
    error: f64,
}

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let trainer = trainer()?;
    let relaxed = trainer.modulus * trainer.left;
    rows.add("trainer/modulus", 1e-3 * trainer.modulus);
    rows.add("trainer/relaxed_modulus", 1e-3 * relaxed);
    let methods = methods(rows)?;
    let measured = Printed::all("esophagus");
    let fitted: Vec<Printed> = measured
        .iter()
        .filter(|row| row.depth_mm <= DEEPEST_MM)
        .copied()
        .collect();
    for method in &methods {
        let mut add = |name: &str, ours: f64| {
            rows.row(&format!("{}/{name}", method.word))
                .with("nu", POISSONS_RATIO)
                .with("error", format!("{:.3}", method.error))
                .with("deepest", DEEPEST_MM)
                .is(ours);
        };
        for depth_mm in DEPTHS_MM {
            let force = relaxed * method.unit.force(1e-3 * f64::from(depth_mm));
            add(&format!("{depth_mm}_mm"), force);
        }
        let modulus = nearest_modulus(&method.unit, &fitted);
        add("fitted_modulus", modulus);
        add("fitted_modulus/instantaneous", modulus / trainer.left);
    }
    rows.figure("")
        .with("modulus", format!("{:.1}", 1e-3 * relaxed))
        .draw(drawn(&methods, relaxed, &measured))
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
    let finite = at_finite_strain(rows)?;
    let small = at_small_strain(rows, None)?;
    let short = at_small_strain(rows, Some(FREE))?;
    rows.report_step("simulator");
    let simulation = simulated(rows, &scene()?)?;
    let of_source = unit_forces(&simulation, &depths);
    rows.report_step("trainer");
    let of_trainer = unit_forces(&simulated(rows, &scene_of_the_trainer()?)?, &depths);
    let organ = organ(rows, &simulation)?;
    let through = |forces: &[f64]| IndentationCurve::through(&depths, forces);
    let line = depths.map(|depth| organ.stiffness * depth);
    let exact = 0.0;
    let methods = [
        (
            "half_space",
            "half-space (6.1)",
            through(&half_space),
            exact,
        ),
        (
            "tube_finite_strain",
            "tube, finite strain",
            finite.unit.clone(),
            finite.error,
        ),
        (
            "tube_small_strain",
            "tube, small strain",
            small.unit,
            small.error,
        ),
        (
            "short_tube",
            "tube of 52 mm, small strain",
            short.unit,
            short.error,
        ),
        (
            "organ_small_strain",
            "simulated shape, small strain",
            through(&line),
            organ.error,
        ),
        ("simulator", "simulator", through(&of_source), exact),
        ("trainer", "trainer", through(&of_trainer), exact),
    ];
    let method = |(word, title, unit, error)| Method {
        word,
        title,
        unit,
        error,
    };
    Ok(methods.map(method).into())
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
        anchor: fixed_region(&scene()?.organ.shape, None),
        patch: Some(MovedPatch {
            center,
            radius: RADIUS,
            // Small strain: any will do.
            displacement: -1e-3 * normal,
            friction: Friction::Bonded,
        }),
        law: Arc::new(LinearElastic::new(1.0, POISSONS_RATIO)?),
        regions: Vec::new(),
        fibres: None,
        loads: Loads::default(),
        tools: Vec::new(),
        points: Vec::new(),
    };
    let found = solve(&problem, ACCURACY, &mut rows.meshes("organ, "))?;
    Ok(SolidOrgan {
        stiffness: 1e3 * found.answer.force_along,
        error: found.error,
    })
}

fn drawn(methods: &[Method], modulus: f64, measured: &[Printed]) -> Vec<Series> {
    let line = |(color, method): (usize, &Method)| {
        let depths = (0..=70).map(|i| 0.1 * f64::from(i));
        let force = |depth: f64| (depth, 1e3 * modulus * method.unit.force(1e-3 * depth));
        let points = depths.map(force).collect();
        Series::new(method.title, points, Style::Line, color)
    };
    let mut series: Vec<Series> = methods.iter().enumerate().map(line).collect();
    series.push(means(measured, "mean of table 5-1", methods.len()));
    series
}
