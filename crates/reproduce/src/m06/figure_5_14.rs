use super::printed::{ORGANS, Printed};
use crate::Error;
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let mut series = Vec::new();
    for (color, organ) in ORGANS.into_iter().enumerate() {
        let printed = Printed::all(organ);
        if let [first, .., last] = printed.as_slice() {
            let depths = f64::from(last.depth_mm) / f64::from(first.depth_mm);
            let power = (last.mean / first.mean).ln() / depths.ln();
            rows.add(&format!("power/{organ}"), power);
        }
        series.extend(of_means(organ, color));
    }
    rows.figure("").draw(series)
}

/// The means of `organ`, and a bar for each row without a misprint.
pub(super) fn of_means(organ: &str, color: usize) -> Vec<Series> {
    let printed = Printed::all(organ);
    let at = |row: &Printed, force: f64| (f64::from(row.depth_mm), 1e3 * force);
    let means = printed.iter().map(|row| at(row, row.mean)).collect();
    let means = Series::new(organ, means, Style::LineWithDots, color);
    let bars = printed.iter().filter(|row| !row.suspect).map(|row| {
        let ends = vec![at(row, row.min), at(row, row.max)];
        Series::new("", ends, Style::Line, color)
    });
    [means].into_iter().chain(bars).collect()
}
