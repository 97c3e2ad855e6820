use std::collections::BTreeMap;
use std::path::Path;

use palpate_files::scene::{LengthUnit, Shape};
use palpate_geometry::read_tetrahedra;
use palpate_geometry::vtk::{CellKind, Cells, FieldValues, PointField, unstructured_grid};
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::solid::{
    Body, MovedPatch, SolidFields, SolidProblem, solve,
};
use palpate_simulate::{held_region, read_organ};

use super::super::problem::{Problem, Solid};
use super::super::table::Table;
use super::{Figures, Solution, Wanted, plots, warnings};
use crate::Error;
use crate::plot::{Plot, Series, Style};
use crate::solve::telling::Telling;

/// Points of the plot; more are not seen.
const POINTS: usize = 3000;

/// Files that hold tetrahedra.
const VOLUMES: [&str; 3] = ["msh", "vtk", "vtu"];

/// Force on a patch that is moved.
pub(crate) fn solution(
    problem: &Problem,
    case: &Solid,
    wanted: Wanted,
    telling: &Telling<'_>,
) -> Result<Solution, Error> {
    let (body, mut warnings) = body(&case.shape)?;
    let mechanical = SolidProblem {
        body,
        anchor: held_region(&case.shape, case.anchor.as_ref()),
        patch: MovedPatch {
            center: case.center,
            radius: case.radius,
            displacement: case.displacement,
            grip: case.contact,
        },
        law: problem.material.law.clone(),
    };
    let found = solve(&mechanical, problem.accuracy, &mut |progress| {
        telling.at(progress);
    })
    .map_err(|error| problem.refused(error))?;
    let answer = found.answer;
    warnings.extend(found.warnings);
    warnings.extend(answer.warnings);
    let length = case.displacement.norm();
    warnings.extend(warnings::of_depths(problem, case.radius, &[length]));
    let on_tool = -answer.force;
    let table = Table::default()
        .with("displacement [mm]", [1e3 * length])
        .with("force along it [mN]", [1e3 * answer.force_along])
        .with("on the tool: x [mN]", [1e3 * on_tool.x])
        .with("y [mN]", [1e3 * on_tool.y])
        .with("z [mN]", [1e3 * on_tool.z]);
    Ok(Solution {
        heading: heading(case),
        tables: vec![table],
        plot: around_patch(case, &answer.fields),
        figures: Figures::Solid {
            force_n: on_tool.into(),
            force_along_displacement_n: answer.force_along,
            displacement_m: case.displacement.into(),
        },
        unknowns: answer.unknowns,
        estimated_error: found.error,
        observed_order: found.observed_order,
        warnings,
        vtu: wanted.vtu.then(|| grid(&answer.fields)),
        recording: None,
    })
}

/// What is to be filled, and warnings about it.
fn body(shape: &Shape) -> Result<(Body, Vec<String>), Error> {
    if let Shape::Mesh { path, unit } = shape
        && holds_tetrahedra(path)
    {
        let imported = read_tetrahedra(path, unit.map(in_words).transpose()?)?;
        return Ok((Body::Volume(imported.mesh), imported.warnings));
    }
    let (surface, warnings) = read_organ(shape)?;
    Ok((Body::Surface(surface), warnings))
}

fn holds_tetrahedra(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    VOLUMES.iter().any(|volume| extension == *volume)
}

fn in_words(unit: LengthUnit) -> Result<palpate_geometry::LengthUnit, Error> {
    Ok(unit.word().parse()?)
}

fn heading(case: &Solid) -> String {
    let name = match &case.shape {
        Shape::Builtin { organ, .. } => format!("Built-in {organ}"),
        Shape::Mesh { path, .. } => path.display().to_string(),
    };
    let how = match case.contact {
        Friction::Bonded => "sticks",
        Friction::Frictionless => "slips",
    };
    let radius = plots::short(1e3 * case.radius);
    format!("{name}, moved by a patch of radius {radius} mm that {how}")
}

/// The body at rest with its displacement, for ParaView's `Warp By Vector`.
fn grid(fields: &SolidFields) -> Vec<u8> {
    let cells = Cells {
        kind: CellKind::QuadraticTetrahedron,
        nodes: &fields.cells,
    };
    let field = |name, values| PointField { name, values };
    unstructured_grid(
        &fields.positions,
        &cells,
        &[
            field(
                "displacement_m",
                FieldValues::Vectors(&fields.displacements),
            ),
            field("mean_stress_pa", FieldValues::Scalars(&fields.pressures)),
        ],
        &[field(
            "equivalent_stress_pa",
            FieldValues::Scalars(&fields.equivalent_stresses),
        )],
    )
}

/// How far the surface moves, by its distance from the patch.
fn around_patch(case: &Solid, fields: &SolidFields) -> Plot {
    let surface = boundary_nodes(&fields.cells);
    let step = surface.len() / POINTS + 1;
    let along = case.displacement.normalize();
    let points = surface.iter().step_by(step).map(|&node| {
        let (at, moved) = (fields.positions[node], fields.displacements[node]);
        (1e3 * (at - case.center).norm(), 1e3 * moved.dot(&along))
    });
    Plot {
        title: "How the surface moves around the patch".to_owned(),
        x_label: "Distance at rest from the centre of the patch [mm]".to_owned(),
        y_label: "Displacement along that of the patch [mm]".to_owned(),
        series: vec![Series {
            style: Style::Dots,
            ..plots::line("", points)
        }],
        ..Plot::default()
    }
}

/// Corners of faces that belong to one tetrahedron only.
fn boundary_nodes(cells: &[u32]) -> Vec<usize> {
    let mut faces: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    for cell in cells.chunks_exact(10) {
        for face in [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]] {
            let mut corners = face.map(|corner: usize| cell[corner]);
            corners.sort_unstable();
            *faces.entry(corners).or_default() += 1;
        }
    }
    let alone = faces.iter().filter(|(_, count)| **count == 1);
    let mut nodes: Vec<usize> = alone
        .flat_map(|(face, _)| face.map(|n| n as usize))
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
