use super::figure_5_14::of_means;
use crate::Error;
use crate::{Item, Rows};
use palpate_jobs::plot::Plot;

pub(crate) const FIGURE_5_1: Item = Item {
    name: "figure-5-1",
    title: "static response of the liver in vivo; after death nothing is printed",
    seconds: 0.3,
    run,
};

fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    for hours in [6, 12, 24] {
        let reason = "the source draws this curve without numbers, and no table holds a recording after death; \
                      `palpate analyze` groups recordings by condition and hours after death where there are some";
        rows.add_missing(&format!("after_{hours}_h"), "N", reason);
    }
    let plot = Plot {
        title: "Static force of the pig's liver, in vivo".to_owned(),
        x_label: "depth [mm]".to_owned(),
        y_label: "force [mN]".to_owned(),
        series: of_means("liver", 0),
        ..Plot::default()
    };
    let note = "means of table 5-1, with bars from the least to the largest where those can be right; the source's curves \
                at 6, 12 and 24 h lie above, without numbers";
    rows.add_figure(None, &plot, note)
}
