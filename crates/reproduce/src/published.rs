//! The source's tables, as given.

use palpate_mechanics::PronySeries;

use crate::Error;

macro_rules! tables {
    ($($name:literal in $file:literal,)*) => {
        &[$(($name, include_str!(concat!("../../../published/", $file))),)*]
    };
}

/// Each table under the number that the source gives it, or the place where its numbers stand.
const TABLES: &[(&str, &str)] = tables![
    "table-3-1" in "table_3_1_pcmfs_vs_fem.csv",
    "table-4-1" in "table_4_1_bem.csv",
    "table-5-1" in "table_5_1_static_force.csv",
    "table-6-1" in "table_6_1_mean_elastic_modulus.csv",
    "table-6-2" in "table_6_2_nonlinear_springs.csv",
    "equation-6-3" in "kelvin_liver.csv",
    "table-6-3" in "table_6_3_prony.csv",
    "table-6-4" in "table_6_4_neo_hookean.csv",
    "table-6-5" in "table_6_5_mooney_rivlin.csv",
    "section-6-4-5" in "esophagus_6_4_5.csv",
    "section-7-4" in "section_7_4_simplification.csv",
    "table-7-1" in "table_7_1_environment_mapping.csv",
    "equation-7-6" in "device_7_6.csv",
    "appendix-a" in "appendix_a_pigs.csv",
];

/// Numbers in the text and the captions of chapters 5 and 7, by place and name.
const RIG_AND_DEVICE: &str = include_str!("../../../published/rig_and_device.csv");

/// The number of the source at `place`: a table, the first cells of a row, and a column, as in `table-5-1 liver 4
/// mean_n`; or a place of the text and a name, as in `figure-7-7 share`.
pub(crate) fn cell(place: &str) -> Result<f64, Error> {
    let words: Vec<&str> = place.split(' ').collect();
    let found = match words.as_slice() {
        [table, row @ .., column] => match lines(table) {
            Some(lines) => number(lines, row, column),
            None => number(cells(RIG_AND_DEVICE), &words, "value"),
        },
        _ => None,
    };
    found.ok_or_else(|| Error::NotPublished(place.to_owned()))
}

/// The names of the rows of `table`, with their numbers under the name `column`.
pub(crate) fn column(table: &str, column: &str) -> Vec<(&'static str, f64)> {
    let Some(mut lines) = lines(table) else {
        return Vec::new();
    };
    let names = lines.next().unwrap_or_default();
    let at = names.iter().position(|name| *name == column);
    let number = |line: Vec<&'static str>| Some((line[0], line.get(at?)?.parse().ok()?));
    lines.filter_map(number).collect()
}

/// The animals of appendix A that have a number other than zero of `organ`.
pub(crate) fn animals(organ: &str) -> Vec<&'static str> {
    let all = column("appendix-a", organ).into_iter();
    all.filter(|(_, count)| *count != 0.0)
        .map(|(name, _)| name)
        .collect()
}

fn lines(table: &str) -> Option<impl Iterator<Item = Vec<&'static str>>> {
    let text = TABLES.iter().find(|(name, _)| *name == table);
    text.map(|(_, text)| cells(text))
}

/// Comments are left out.
fn cells(text: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split(',').collect())
}

/// The number under the name `column` in the first row that begins with the cells `row`.
fn number(
    mut lines: impl Iterator<Item = Vec<&'static str>>,
    row: &[&str],
    column: &str,
) -> Option<f64> {
    let at = lines.next()?.iter().position(|name| *name == column)?;
    let found = lines.find(|line| line.starts_with(row))?;
    found.get(at)?.parse().ok()
}

/// How `organ` relaxes by the row of table 6-3 at `depth_mm`.
pub(crate) fn prony(organ: &str, depth_mm: u32) -> Result<PronySeries, Error> {
    let cell = |column| cell(&format!("table-6-3 {organ} {depth_mm} {column}"));
    Ok(PronySeries::new(&[
        (cell("g1")?, cell("tau1_s")?),
        (cell("g2")?, cell("tau2_s")?),
    ])?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_found_by_its_row_and_column() {
        let printed = [
            ("table-3-1 nodes pcmfs_local", 34.0),
            ("table-3-1 total_time fe_model_adina", 18.32),
            ("table-5-1 kidney 8 mean_n", 0.4541),
            ("equation-6-3 k2_n_per_mm", 0.007),
            ("section-5-4-2 settled_after", 40.0),
        ];
        for (place, value) in printed {
            assert_eq!(cell(place).ok(), Some(value), "{place}");
        }
        assert!(cell("table-3-1 nodes nowhere").is_err() && cell("").is_err());
        assert_eq!(animals("spleen"), ["B3", "B4", "B5", "B6"]);
        assert_eq!(animals("esophagus").len(), 8);
    }
}
