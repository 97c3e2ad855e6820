use palpate_files::{Pose, Scene};
use palpate_geometry::{AabbTree, Vec3};
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};

use crate::Error;
use crate::m06::Printed;
use crate::published::SECTION_6_4_5;
use crate::row::Value;
use crate::{Item, Rows};
use palpate_jobs::plot::{Plot, Series, Style};
use palpate_jobs::preparation;

pub(crate) const SECTION_7_8: Item = Item {
    name: "section-7-8",
    title: "what the simulated esophagus answers, with the printed modulus and with one that fits table 5-1; takes minutes",
    seconds: 28.0,
    run,
};

/// The modulus that forces are computed with, to be scaled [Pa].
const UNIT: f64 = 10_000.0;

/// The source's simplified model has this many triangles; its probe has a radius of 1 mm. Nearly incompressible
/// as far as the elements are compared.
const ESOPHAGUS: &str = "format = 1\n[organ]\nbuiltin = \"esophagus\"\ntriangles = 3726\n\
     [organ.tissue]\nlaw = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
     [organ.touchable]\nspheres = [{ center_m = [0.0, -0.0075, 0.0], radius_m = 0.014 }]\n\
     [model]\nkind = \"hybrid\"\n[[tool]]\nname = \"right\"\n\
     tip = { shape = \"flat\", radius_m = 0.001, contact = \"stick\" }\n";

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let missing = || Error::failed("section 6.4.5 cannot be read; please report this");
    let cell = |column| SECTION_6_4_5.first(column).ok_or_else(missing);
    let (printed, relaxes) = (1e3 * cell("youngs_modulus_kpa")?, cell("prony_g1")?);
    let measured = Printed::all("esophagus");
    let depths: Vec<f64> = measured
        .iter()
        .map(|row| 1e-3 * f64::from(row.depth_mm))
        .collect();
    let unit = unit_forces(&simulated(rows, &scene()?)?, &depths);
    let note = "the esophagus of 3,726 triangles between its anchors, probe of 1 mm radius bonded to its front, half-way";
    for (row, unit) in measured.iter().zip(&unit) {
        let value = Value::beside(Some(row.mean), printed * unit, "N");
        let remark = format!(
            "published: mean of table 5-1; ours: with the printed modulus of the simulation, before relaxation; {note}"
        );
        rows.add(
            &format!("printed_modulus/{}_mm", row.depth_mm),
            value,
            remark,
        );
    }
    let products: f64 = unit
        .iter()
        .zip(&measured)
        .map(|(u, row)| u * row.mean)
        .sum();
    let squares: f64 = unit.iter().map(|u| u * u).sum();
    let fitted = products / squares;
    rows.add(
        "fitted_modulus",
        Value::beside(Some(1e-3 * printed), 1e-3 * fitted, "kPa"),
        "published: the modulus of the simulation, which is (6.1) at 8 mm, the rule for a half-space; ours: the relaxed modulus \
         with which this organ comes nearest to all means of table 5-1. A tube yields as a whole, so its tissue has to be \
         several times stiffer",
    );
    rows.add(
        "fitted_modulus/instantaneous",
        Value::own(1e-3 * fitted / (1.0 - relaxes), "kPa"),
        "the same before relaxation, with the printed Prony term of section 6.4.5: what a scene's tissue states",
    );
    for (row, unit) in measured.iter().zip(&unit) {
        let value = Value::beside(Some(row.mean), fitted * unit, "N");
        let remark =
            format!("published: mean of table 5-1; ours: with the fitted modulus, relaxed; {note}");
        rows.add(
            &format!("fitted_modulus/{}_mm", row.depth_mm),
            value,
            remark,
        );
    }
    let plot = drawn(&depths, (&unit, &measured), [printed, fitted]);
    let remark =
        "linear tissue: the measured curve bends a little more than the simulated organ does";
    rows.add_figure(None, &plot, remark)
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
            (time, simulation.step()),
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

fn drawn(depths: &[f64], (unit, measured): (&[f64], &[Printed]), moduli: [f64; 2]) -> Plot {
    let line = |modulus: f64, name: &str, color| Series {
        name: format!("{name}, {:.1} kPa", 1e-3 * modulus),
        points: depths
            .iter()
            .zip(unit)
            .map(|(depth, unit)| (1e3 * depth, 1e3 * modulus * unit))
            .collect(),
        style: Style::Line,
        color,
    };
    let means = measured
        .iter()
        .map(|row| (f64::from(row.depth_mm), 1e3 * row.mean))
        .collect();
    Plot {
        title: "The simulated esophagus beside table 5-1".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series: vec![
            line(moduli[0], "printed modulus", 0),
            line(moduli[1], "fitted modulus", 1),
            Series {
                name: "mean of table 5-1".to_owned(),
                points: means,
                style: Style::Dots,
                color: 2,
            },
        ],
        ..Plot::default()
    }
}
