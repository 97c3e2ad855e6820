use palpate_files::scene::Shading;
use palpate_geometry::CutMethod;

use super::top::{Look, Top, or_missing};
use crate::failure::Failure;
use crate::reproduce::row::Value;
use crate::reproduce::{Item, Rows};

pub(crate) const FIGURE_7_15: Item = Item {
    name: "figure-7-15",
    title: "vertices are snapped and split while a blade moves on",
    seconds: 3.3,
    run,
};

/// Eight squares along an edge of the cube.
const TRIANGLES: usize = 768;

/// The blade's way over the top [m], and what there is to see when it has come so far.
const WAY: [(f64, f64); 4] = [
    (-0.0330, -0.0040),
    (-0.0100, 0.0050),
    (0.0120, 0.0030),
    (0.0330, 0.0100),
];
const STAGES: [(usize, &str, &str); 3] = [
    (
        2,
        "1",
        "the vertex nearest to the first contact is snapped, others where edges were crossed; the first \
              edges are open",
    ),
    (
        3,
        "2",
        "the blade has moved on, and each vertex behind it is one on either side",
    ),
    (4, "3", "the blade at the end of its way"),
];

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let made = pictures(rows);
    or_missing(rows, made)
}

fn pictures(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let mut top = Top::new(TRIANGLES, [0.0, -0.004, 0.155])?;
    let look = Look {
        shading: Shading::Plain,
        width: 0.006,
        wires: Some(0.0005),
    };
    for (until, name, what) in STAGES {
        let cut = top.cut(CutMethod::SnapVertices, &WAY[..until]);
        let (cut, lag) = cut.map_err(Failure::failed)?;
        top.add(rows, (name, what), &cut, look)?;
        let mesh = cut.mesh();
        let added = mesh.triangles().len() - TRIANGLES;
        let note = "the source: \"without increasing the number of polygons\"";
        rows.add(
            &format!("{name}/triangles_added"),
            Value::own(added as f64, "1"),
            note,
        );
        let note = "triangles from the end of the opening to the blade, at most; the source: \"a small amount of lag\"";
        rows.add(&format!("{name}/lag"), Value::own(lag as f64, "1"), note);
    }
    Ok(())
}
