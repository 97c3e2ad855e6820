//! Deformed bodies for ParaView: rest positions, and the displacement for `Warp By Vector`.

use palpate_geometry::vtk::{CellKind, Cells, FieldValues, PointField, unstructured_grid};
use palpate_mechanics::finite_elements::{FiniteElementModel, FiniteElementState};
use palpate_mechanics::{PronySeries, Vec3};

use super::super::problem::{Indentation, Loading, Problem};
use super::indentation::mechanical;
use crate::Error;

/// Where the nodes of a row-by-row grid of nine stand in VTK's: corners, middles of the edges, centre.
const IN_ORDER_OF_VTK: [usize; 9] = [0, 2, 8, 6, 1, 5, 7, 3, 4];

/// The half section of an indented block, r along x and z along z, at the largest depth with instantaneous moduli. On
/// the coarsest mesh, which is enough for a picture.
pub(crate) fn of_indentation(problem: &Problem, case: &Indentation) -> Result<Vec<u8>, Error> {
    let depth = match &case.loading {
        Loading::Depths(depths) => depths.iter().copied().fold(0.0, f64::max),
        Loading::Ramp(ramp) => ramp.depth,
    };
    let refused = |error| problem.refused(error);
    let mut run = mechanical(problem, case)
        .run(&PronySeries::default(), depth, 1)
        .map_err(refused)?;
    if depth > 0.0 {
        run.press(0.0, depth, |_| ()).map_err(refused)?;
    }
    Ok(half_section(run.model(), run.state()))
}

fn half_section(model: &FiniteElementModel, state: &FiniteElementState) -> Vec<u8> {
    let upright = |x: &Vec3| Vec3::new(x.x, 0.0, x.y);
    let mesh = model.mesh();
    let positions: Vec<Vec3> = mesh.nodes.iter().map(upright).collect();
    let displacement = |node| upright(&state.displacement(model, node));
    let displacements: Vec<Vec3> = (0..positions.len()).map(displacement).collect();
    let elements = (0..mesh.len()).map(|element| mesh.element(element));
    let nodes: Vec<u32> = elements
        .flat_map(|nodes| IN_ORDER_OF_VTK.map(|place| nodes[place]))
        .collect();
    let cells = Cells {
        kind: CellKind::BiquadraticQuad,
        nodes: &nodes,
    };
    let field = PointField {
        name: "displacement_m",
        values: FieldValues::Vectors(&displacements),
    };
    unstructured_grid(&positions, &cells, &[field], &[])
}
