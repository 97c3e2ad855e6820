use super::body::{Body, MODELS};
use crate::Error;
use crate::rendered_body::{Painter, RenderedBody};
use crate::row::Rows;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let Some(mut painter) = Painter::or_missing(rows, &MODELS.map(|model| model.row)) else {
        return Ok(());
    };
    for model in MODELS {
        let body = Body::new(model)?;
        let mesh = body.surface.mesh();
        let (low, high) = mesh.bounds();
        let png = painter.draw(&RenderedBody {
            surface: &body.surface,
            places: mesh.vertices(),
            middle: (0.5 * (low + high), body.touched_normal()),
            near: 1.0,
            lines: None,
        })?;
        rows.figure(model.row)
            .with("body", &body.description)
            .with("adapter", painter.gpu.adapter())
            .picture(&png)?;
    }
    Ok(())
}
