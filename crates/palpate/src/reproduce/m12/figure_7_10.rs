use palpate_geometry::{SimplifySettings, Surface, TriangleMesh, Vec3, simplify};

use super::section_7_4::esophagus;
use crate::failure::Failure;
use crate::reproduce::portrait::{Painter, Sitter};
use crate::reproduce::published::SECTION_7_4 as PUBLISHED;
use crate::reproduce::{Item, Rows};

pub(crate) const FIGURE_7_10: Item = Item {
    name: "figure-7-10",
    title: "the esophagus before and after it was simplified",
    seconds: 2.0,
    run,
};

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let counts = ["original", "simplified"].map(|row| PUBLISHED.value(row, "triangles"));
    let [Some(before), Some(after)] = counts else {
        rows.not_computed("the published numbers of triangles cannot be read");
        return Ok(());
    };
    let mut painter = match Painter::new() {
        Ok(painter) => painter,
        Err(why) => {
            rows.not_computed(&why.to_string());
            return Ok(());
        }
    };
    let (mesh, whose) = esophagus(before as usize)?;
    let settings = SimplifySettings::to(after as usize);
    let simplified = simplify(&mesh, &settings).map_err(Failure::input)?;
    for (name, mesh) in [("before", mesh), ("after", simplified.mesh)] {
        let note = format!("{whose}, {} triangles", mesh.triangles().len());
        let png = portrait(&mut painter, mesh)?;
        rows.add_picture(Some(name), &png, note)?;
    }
    Ok(())
}

/// The whole mesh, at rest.
fn portrait(painter: &mut Painter, mesh: TriangleMesh) -> Result<Vec<u8>, Failure> {
    let (low, high) = mesh.bounds();
    let places = mesh.vertices().to_vec();
    painter.draw(&Sitter {
        surface: &Surface::new(mesh)?,
        places: &places,
        middle: ((low + high) / 2.0, Vec3::zeros()),
        near: 1.0,
        lines: None,
    })
}
