use palpate_geometry::{SimplifySettings, Surface, TriangleMesh, Vec3, simplify};

use super::section_7_4::esophagus;
use crate::Error;
use crate::published::cell;
use crate::rendered_body::{Painter, RenderedBody};
use crate::row::Rows;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let before = cell("section-7-4 original triangles")?;
    let after = cell("section-7-4 simplified triangles")?;
    let Some(mut painter) = Painter::or_missing(rows, &[""]) else {
        return Ok(());
    };
    let (mesh, whose) = esophagus(before as usize)?;
    let settings = SimplifySettings::to(after as usize);
    let simplified = simplify(&mesh, &settings)?;
    for (name, mesh) in [("before", mesh), ("after", simplified.mesh)] {
        let triangles = mesh.triangles().len();
        let png = portrait(&mut painter, mesh)?;
        rows.figure(name)
            .with("body", whose)
            .with("triangles", triangles)
            .picture(&png)?;
    }
    Ok(())
}

/// The whole mesh, at rest.
fn portrait(painter: &mut Painter, mesh: TriangleMesh) -> Result<Vec<u8>, Error> {
    let (low, high) = mesh.bounds();
    let places = mesh.vertices().to_vec();
    painter.draw(&RenderedBody {
        surface: &Surface::new(mesh)?,
        places: &places,
        middle: ((low + high) / 2.0, Vec3::zeros()),
        near: 1.0,
        lines: None,
    })
}
