use palpate_files::Tissue;
use palpate_files::tissue::BuiltinTissue;

use crate::Error;
use crate::row::Rows;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let tissue = Tissue::builtin(BuiltinTissue::PigLiver);
    let card = tissue.to_abaqus()?;
    rows.figure("").file("inp", card.as_bytes())
}
