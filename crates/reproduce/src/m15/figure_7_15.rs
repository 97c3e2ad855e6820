use palpate_files::scene::Shading;
use palpate_geometry::CutMethod;

use super::top::{Look, Top, or_missing};
use crate::Error;
use crate::row::Rows;

/// Eight squares along an edge of the cube.
const TRIANGLES: usize = 768;

/// The blade's way over the top [m], and what there is to see when it has come so far.
const WAY: [(f64, f64); 4] = [
    (-0.0330, -0.0040),
    (-0.0100, 0.0050),
    (0.0120, 0.0030),
    (0.0330, 0.0100),
];
const STAGES: [(usize, &str); 3] = [(2, "1"), (3, "2"), (4, "3")];

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let made = pictures(rows);
    or_missing(rows, made)
}

fn pictures(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut top = Top::new(TRIANGLES, [0.0, -0.004, 0.155])?;
    let look = Look {
        shading: Shading::Plain,
        width: 0.006,
        wires: Some(0.0005),
    };
    for (until, name) in STAGES {
        let cut = top.cut(CutMethod::SnapVertices, &WAY[..until]);
        let (cut, lag) = cut.map_err(Error::failed)?;
        top.add(rows, name, &cut, look)?;
        let added = cut.mesh().triangles().len() - TRIANGLES;
        rows.add(&format!("{name}/triangles_added"), added as f64);
        rows.add(&format!("{name}/lag"), lag as f64);
    }
    Ok(())
}
