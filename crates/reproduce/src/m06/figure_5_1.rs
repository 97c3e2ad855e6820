use super::figure_5_14::of_means;
use crate::Error;
use crate::row::Rows;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for hours in [6, 12, 24] {
        rows.without(&format!("after_{hours}_h"));
    }
    rows.figure("").draw(of_means("liver", 0))
}
