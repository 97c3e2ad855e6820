//! Forces on rigid tools.

use palpate_mechanics::finite_elements::rigid_tool::ToolLoad;
use palpate_mechanics::finite_elements::solid::SolidAnswer;

use super::super::super::problem::Solid;
use super::super::super::table::Table;
use super::super::figures::ToolFigures;
use super::super::{millinewtons, plots};
use crate::plot::{Plot, Series, Style};

/// The figures of each tool, or of each of its jaws, at the positions of its path.
pub(super) fn figures(case: &Solid, answer: &SolidAnswer) -> Vec<ToolFigures> {
    let waypoints = answer.waypoints();
    let names = case.tools.iter().flat_map(|tool| tool.names());
    let each = names.enumerate().map(|(number, name)| {
        let loads: Vec<&ToolLoad> = waypoints.iter().map(|loads| &loads[number]).collect();
        let vectors = |of: fn(&ToolLoad) -> [f64; 3]| loads.iter().map(|load| of(load)).collect();
        let numbers = |of: fn(&ToolLoad) -> f64| loads.iter().map(|load| of(load)).collect();
        ToolFigures {
            name,
            position_m: vectors(|load| load.position.into()),
            force_n: vectors(|load| load.force.into()),
            moment_n_m: vectors(|load| load.moment.into()),
            normal_force_n: numbers(|load| load.normal_force),
            contact_area_m2: numbers(|load| load.area),
            slipping_area_m2: numbers(|load| load.slipping_area),
        }
    });
    each.collect()
}

/// The figures of tools without contact.
pub(super) fn warnings(tools: &[ToolFigures]) -> impl Iterator<Item = String> + '_ {
    let idle = tools.iter();
    let idle = idle.filter(|tool| tool.contact_area_m2.iter().all(|area| *area == 0.0));
    idle.map(|tool| {
        format!(
            "{} touches the body at no place of its path; move `path_m` into the body",
            tool.name
        )
    })
}

/// One row for each position of each path.
pub(super) fn table(tools: &[ToolFigures]) -> Table {
    let rows = || {
        let each = tools.iter();
        each.flat_map(|tool| (0..tool.force_n.len()).map(move |place| (tool, place)))
    };
    let force = |axis: usize| {
        let forces: Vec<f64> = rows()
            .map(|(tool, place)| {
                let [force, size] = [tool.force_n[place][axis], tool.normal_force_n[place]];
                // Rounding errors are no force.
                if force.abs() > 1e-9 * size {
                    force
                } else {
                    0.0
                }
            })
            .collect();
        millinewtons(&forces).collect::<Vec<_>>()
    };
    let normal: Vec<f64> = rows()
        .map(|(tool, place)| tool.normal_force_n[place])
        .collect();
    Table::default()
        .with_texts("tool", rows().map(|(tool, _)| tool.name.clone()))
        .with_texts("place", rows().map(|(_, place)| (place + 1).to_string()))
        .with("on the tool: x [mN]", force(0))
        .with("y [mN]", force(1))
        .with("z [mN]", force(2))
        .with("normal force [mN]", millinewtons(&normal))
        .with(
            "contact [mm²]",
            rows().map(|(tool, place)| 1e6 * tool.contact_area_m2[place]),
        )
        .with(
            "slipping [mm²]",
            rows().map(|(tool, place)| 1e6 * tool.slipping_area_m2[place]),
        )
}

/// The force on each tool along its path, at each step of the solution.
pub(super) fn along_paths(case: &Solid, answer: &SolidAnswer) -> Plot {
    let bodies = case
        .tools
        .iter()
        .flat_map(|tool| tool.names().zip(&tool.bodies));
    let series = bodies.enumerate().map(|(number, (name, body))| {
        let start = (body.path[0], 0.0);
        let points = answer.tools.iter().scan(start, |(at, length), step| {
            let load = &step.loads[number];
            *length += (load.position - *at).norm();
            *at = load.position;
            Some((1e3 * *length, 1e3 * load.force.norm()))
        });
        Series {
            style: Style::LineWithDots,
            color: number,
            ..plots::line(&name, std::iter::once((0.0, 0.0)).chain(points))
        }
    });
    Plot {
        title: "The force on the tools along their paths".to_owned(),
        x_label: "Length of the path [mm]".to_owned(),
        y_label: "Force [mN]".to_owned(),
        series: series.collect(),
        ..Plot::default()
    }
}
