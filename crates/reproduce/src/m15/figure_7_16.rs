use palpate_files::scene::Shading;
use palpate_geometry::CutMethod;

use super::top::{Look, Top, or_missing};
use crate::Error;
use crate::row::Rows;

/// Sixteen squares along an edge of the cube.
const TRIANGLES: usize = 3_072;

/// The blade's way over the top [m].
const WAY: [(f64, f64); 3] = [(-0.034, -0.010), (0.0, 0.005), (0.034, -0.003)];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let made = pictures(rows);
    or_missing(rows, made)
}

fn pictures(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut top = Top::new(TRIANGLES, [0.05, -0.13, 0.165])?;
    let (uncut, _) = top
        .cut(CutMethod::SnapVertices, &WAY[..1])
        .map_err(Error::failed)?;
    let (cut, _) = top
        .cut(CutMethod::SnapVertices, &WAY)
        .map_err(Error::failed)?;
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
    top.add(rows, "left", &uncut, textured)?;
    top.add(rows, "middle", &cut, framed)?;
    top.add(rows, "right", &cut, textured)
}
