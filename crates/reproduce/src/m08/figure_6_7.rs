use palpate_files::Tissue;
use palpate_files::tissue::BuiltinTissue;

use crate::Error;
use crate::{Item, Rows};

pub(crate) const FIGURE_6_7: Item = Item {
    name: "figure-6-7",
    title: "the relaxation of the liver as Abaqus takes it",
    seconds: 0.1,
    run,
};

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let card = Tissue::builtin(BuiltinTissue::PigLiver)
        .to_abaqus()
        .map_err(Error::failed)?;
    let note = "the source shows the panel into which its terms are typed; ours: the material card with the terms of table 6-3 and C10 \
                of table 6-4, relative to instantaneous moduli as Abaqus means them";
    rows.add_text("inp", &card, note)
}
