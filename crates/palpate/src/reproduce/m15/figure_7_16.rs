use palpate_files::scene::Shading;
use palpate_geometry::CutMethod;

use super::top::{Look, Top, or_missing};
use crate::failure::Failure;
use crate::reproduce::{Item, Rows};

pub(crate) const FIGURE_7_16: Item = Item {
    name: "figure-7-16",
    title: "a cube: uncut, as a wire frame after cutting, and cut with its texture",
    seconds: 3.1,
    run,
};

/// Sixteen squares along an edge of the cube.
const TRIANGLES: usize = 3_072;

/// The blade's way over the top [m].
const WAY: [(f64, f64); 3] = [(-0.034, -0.010), (0.0, 0.005), (0.034, -0.003)];

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let made = pictures(rows);
    or_missing(rows, made)
}

fn pictures(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let mut top = Top::new(TRIANGLES, [0.05, -0.13, 0.165])?;
    let fault = |error: palpate_geometry::CutError| Failure::failed(error);
    let (uncut, _) = top.cut(CutMethod::SnapVertices, &WAY[..1]).map_err(fault)?;
    let (cut, _) = top.cut(CutMethod::SnapVertices, &WAY).map_err(fault)?;
    let textured = Look {
        shading: Shading::CubeMap,
        width: 0.012,
        wires: None,
    };
    let framed = Look {
        shading: Shading::Plain,
        wires: Some(0.0003),
        ..textured
    };
    let what = "as it was";
    top.add(rows, ("left", what), &uncut, textured)?;
    let what =
        "vertices are snapped and split; held open 12 mm wide without mechanics, as an ellipse";
    top.add(rows, ("middle", what), &cut, framed)?;
    let what =
        "under the opening lies the inner layer, which the source has as a second, coarser model";
    top.add(rows, ("right", what), &cut, textured)
}
