use palpate_files::{Pose, Scene};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

use crate::Error;
use crate::m06::Printed;
use crate::published::cell;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};
use palpate_jobs::preparation;

/// The modulus that forces are computed with, to be scaled [Pa].
const UNIT: f64 = 10_000.0;

/// The source's simplified model has this many triangles; its probe has a radius of 1 mm. Nearly incompressible
/// as far as the elements are compared.
const ESOPHAGUS: &str = "format = 1\n[organ]\nbuiltin = \"esophagus\"\ntriangles = 3726\n\
     [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
     [organ.touchable]\nspheres = [{ center_m = [0.0, -0.0075, 0.0], radius_m = 0.014 }]\n\
     [model]\nkind = \"hybrid\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"flat\", radius_m = 0.001, contact = \"stick\" }\n";

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let printed = 1e3 * cell("section-6-4-5 youngs_modulus_kpa")?;
    let relaxes = cell("section-6-4-5 prony_g1")?;
    let measured = Printed::all("esophagus");
    let [depths, _] = Printed::columns(&measured);
    let simulation = simulated(rows, &scene()?)?;
    let unit = unit_forces(&simulation, &depths);
    let both = || unit.iter().zip(&measured);
    for (unit, row) in both() {
        let name = format!("printed_modulus/{}_mm", row.depth_mm);
        rows.add(&name, printed * unit);
    }
    let products: f64 = both().map(|(u, row)| u * row.mean).sum();
    let squares: f64 = unit.iter().map(|u| u * u).sum();
    let fitted = products / squares;
    rows.add("fitted_modulus", 1e-3 * fitted);
    let instantaneous = 1e-3 * fitted / (1.0 - relaxes);
    rows.add("fitted_modulus/instantaneous", instantaneous);
    for (unit, row) in both() {
        let name = format!("fitted_modulus/{}_mm", row.depth_mm);
        rows.add(&name, fitted * unit);
    }
    let drawn = drawn(&depths, &unit, &measured, [printed, fitted]);
    rows.figure("").draw(drawn)
}

pub(super) fn scene() -> Result<Scene, Error> {
    Ok(Scene::parse(ESOPHAGUS, "built-in scene")?)
}

/// The same on the trainer's triangles: as many are drawn and as many are solved as in its scene.
pub(super) fn scene_of_the_trainer() -> Result<Scene, Error> {
    let text = ESOPHAGUS
        .replace("triangles = 3726", "triangles = 14000")
        .replace(
            "kind = \"hybrid\"",
            "kind = \"hybrid\"\nmechanical_triangles = 2500",
        );
    Ok(Scene::parse(&text, "built-in scene")?)
}

pub(super) fn simulated(rows: &Rows<'_>, scene: &Scene) -> Result<Simulation, Error> {
    Ok(preparation::simulation(
        scene,
        &preparation::resources(),
        rows,
    )?)
}

/// The force [N] that a Young's modulus of 1 Pa gives at each of `depths` [m], ascending.
pub(super) fn unit_forces(simulation: &Simulation, depths: &[f64]) -> Vec<f64> {
    let forces = pressed(simulation, depths);
    forces.iter().map(|force| force / UNIT).collect()
}

/// The touched place of the front, half-way [m], and the outward normal there [-].
pub(super) fn front(simulation: &Simulation) -> (Vec3, Vec3) {
    let surface = simulation.surface();
    let tree = AabbTree::new(surface.mesh());
    let front = tree.nearest(surface.mesh(), &Vec3::new(0.0, -1.0, 0.0));
    let near = tree.nearest(surface.mesh(), &Vec3::new(0.0, front.on.position.y, 0.0));
    let normal = surface.mesh().area_vector(near.triangle).normalize();
    (near.on.position, normal)
}

/// The force [N] at each of `depths` [m] below the front of the organ, half-way.
fn pressed(simulation: &Simulation, depths: &[f64]) -> Vec<f64> {
    let (place, normal) = front(simulation);
    let mut state = SimulationState::new(simulation);
    let mut workspace = SimulationWorkspace::new(simulation);
    let mut time = 0.0;
    let mut at = |depth: f64| {
        let pose = Pose {
            position_m: (place - normal * depth).into(),
            orientation: None,
            grip: 0.0,
            cut: false,
        };
        step(
            simulation,
            time,
            simulation.step(),
            &[Some(pose)],
            &mut state,
            &mut workspace,
        );
        time += simulation.step();
        state.tools[0].force.norm()
    };
    // In small steps, as a hand goes in.
    let mut before = -5e-4;
    let mut found = Vec::new();
    for &depth in depths {
        let steps = ((depth - before) / 1e-4).ceil().max(1.0) as u32;
        let ways = (1..=steps).map(|k| before + (depth - before) * f64::from(k) / f64::from(steps));
        found.push(ways.map(&mut at).last().unwrap_or(0.0));
        before = depth;
    }
    found
}

fn drawn(depths: &[f64], unit: &[f64], measured: &[Printed], moduli: [f64; 2]) -> Vec<Series> {
    let line = |modulus: f64, name: &str, color| {
        let points = depths.iter().zip(unit);
        let points = points.map(|(depth, unit)| (1e3 * depth, 1e3 * modulus * unit));
        let name = format!("{name}, {:.1} kPa", 1e-3 * modulus);
        Series::new(name, points.collect(), Style::Line, color)
    };
    vec![
        line(moduli[0], "printed modulus", 0),
        line(moduli[1], "fitted modulus", 1),
        means(measured, "mean of table 5-1", 2),
    ]
}

/// The measured means.
pub(super) fn means(measured: &[Printed], name: &str, color: usize) -> Series {
    let means = measured.iter();
    let means = means.map(Printed::drawn);
    Series::new(name, means.collect(), Style::Dots, color)
}
