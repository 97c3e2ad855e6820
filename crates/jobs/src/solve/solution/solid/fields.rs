//! Output fields of a solid: the body for ParaView, and the displacement of its surface.

use palpate_geometry::vtk::{CellKind, Cells, FieldValues, PointField, unstructured_grid};
use palpate_mechanics::finite_elements::solid::SolidFields;

use super::super::super::problem::Solid;
use super::super::plots;
use crate::plot::{Plot, Series, Style};

/// Points of the plot; more are not visible.
const POINTS: usize = 3000;

/// The body at rest with its displacement, for ParaView's `Warp By Vector`.
pub(super) fn grid(fields: &SolidFields) -> Vec<u8> {
    let cells = Cells {
        kind: CellKind::QuadraticTetrahedron,
        nodes: &fields.cells,
    };
    let field = |name, values| PointField { name, values };
    let regions: Vec<f64> = fields
        .regions
        .iter()
        .map(|region| f64::from(*region))
        .collect();
    let mut in_cells = vec![
        field(
            "equivalent_stress_pa",
            FieldValues::Scalars(&fields.equivalent_stresses),
        ),
        field("region", FieldValues::Scalars(&regions)),
    ];
    if !fields.fibre_axes.is_empty() {
        in_cells.push(field(
            "fibre_axis",
            FieldValues::Vectors(&fields.fibre_axes),
        ));
    }
    let mut at_nodes = vec![
        field(
            "displacement_m",
            FieldValues::Vectors(&fields.displacements),
        ),
        field("mean_stress_pa", FieldValues::Scalars(&fields.pressures)),
    ];
    if !fields.contact_pressures.is_empty() {
        at_nodes.push(field(
            "contact_pressure_pa",
            FieldValues::Scalars(&fields.contact_pressures),
        ));
    }
    unstructured_grid(&fields.positions, &cells, &at_nodes, &in_cells)
}

/// Displacement of the surface: over its distance from the patch, or along the longest axis where there is none.
pub(super) fn around_patch(case: &Solid, fields: &SolidFields) -> Plot {
    let surface = &fields.surface;
    let step = surface.len() / POINTS + 1;
    let nodes = surface.iter().step_by(step);
    let nodes = nodes.map(|&node| (fields.positions[node], fields.displacements[node]));
    let (title, x_label, y_label, points): (_, _, _, Vec<(f64, f64)>) = match &case.patch {
        Some(patch) => {
            let along = patch.displacement.normalize();
            let points = nodes
                .map(|(at, moved)| (1e3 * (at - patch.center).norm(), 1e3 * moved.dot(&along)));
            (
                "How the surface moves around the patch",
                "Distance at rest from the centre of the patch [mm]",
                "Displacement along that of the patch [mm]",
                points.collect(),
            )
        }
        None => {
            let span = |axis: usize| {
                let each = fields.positions.iter().map(|at| at[axis]);
                let (low, high) = each
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                        (low.min(x), high.max(x))
                    });
                high - low
            };
            let longest = (0..3)
                .max_by(|&a, &b| span(a).total_cmp(&span(b)))
                .unwrap_or(0);
            (
                "How the surface moves along the body",
                ["x at rest [mm]", "y at rest [mm]", "z at rest [mm]"][longest],
                "Displacement [mm]",
                nodes
                    .map(|(at, moved)| (1e3 * at[longest], 1e3 * moved.norm()))
                    .collect(),
            )
        }
    };
    Plot {
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        series: vec![Series {
            style: Style::Dots,
            ..plots::line("", points.into_iter())
        }],
        ..Plot::default()
    }
}
