use super::body::{Body, MODELS};
use crate::Error;
use crate::portrait::{Painter, Sitter};
use crate::{Item, Rows};

pub(crate) const FIGURE_4_2: Item = Item {
    name: "figure-4-2",
    title: "the bodies of table 4-1",
    seconds: 3.6,
    run,
};

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut painter = match Painter::new() {
        Ok(painter) => painter,
        Err(why) => {
            for model in MODELS {
                rows.add_missing(model.row, "", why.to_string());
            }
            return Ok(());
        }
    };
    for model in MODELS {
        let body = Body::new(model)?;
        let mesh = body.surface.mesh();
        let (low, high) = mesh.bounds();
        let png = painter.draw(&Sitter {
            surface: &body.surface,
            places: mesh.vertices(),
            middle: (0.5 * (low + high), body.touched_normal()),
            near: 1.0,
            lines: None,
        })?;
        let adapter = painter.gpu.adapter();
        let note = format!(
            "{}, at rest as in the source; pressed in figure-4-6 and figure-4-7; drawn by {adapter}",
            body.told
        );
        rows.add_picture(Some(model.row), &png, note)?;
    }
    Ok(())
}
