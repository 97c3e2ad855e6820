//! The source's tables, as given.

use palpate_mechanics::PronySeries;

use crate::Error;

/// Table 3-1.
pub(crate) const TABLE_3_1: Table = Table(include_str!(
    "../../../published/table_3_1_pcmfs_vs_fem.csv"
));

/// Table 4-1.
pub(crate) const TABLE_4_1: Table = Table(include_str!("../../../published/table_4_1_bem.csv"));

/// Table 5-1.
pub(crate) const TABLE_5_1: Table = Table(include_str!(
    "../../../published/table_5_1_static_force.csv"
));

/// Table 6-1.
pub(crate) const TABLE_6_1: Table = Table(include_str!(
    "../../../published/table_6_1_mean_elastic_modulus.csv"
));

/// Table 6-2.
pub(crate) const TABLE_6_2: Table = Table(include_str!(
    "../../../published/table_6_2_nonlinear_springs.csv"
));

/// Section 6.3.2.
pub(crate) const EQUATION_6_3: Table = Table(include_str!("../../../published/kelvin_liver.csv"));

/// Table 6-3.
pub(crate) const TABLE_6_3: Table = Table(include_str!("../../../published/table_6_3_prony.csv"));

/// Table 6-4.
pub(crate) const TABLE_6_4: Table =
    Table(include_str!("../../../published/table_6_4_neo_hookean.csv"));

/// Table 6-5.
pub(crate) const TABLE_6_5: Table = Table(include_str!(
    "../../../published/table_6_5_mooney_rivlin.csv"
));

/// Table 7-1.
pub(crate) const TABLE_7_1: Table = Table(include_str!(
    "../../../published/table_7_1_environment_mapping.csv"
));

/// Section 6.4.5.
pub(crate) const SECTION_6_4_5: Table =
    Table(include_str!("../../../published/esophagus_6_4_5.csv"));

/// Section 7.4.
pub(crate) const SECTION_7_4: Table = Table(include_str!(
    "../../../published/section_7_4_simplification.csv"
));

/// (7.6).
pub(crate) const DEVICE_7_6: Table = Table(include_str!("../../../published/device_7_6.csv"));

/// Numbers in the text and the captions of chapters 5 and 7.
const RIG_AND_DEVICE: Table = Table(include_str!("../../../published/rig_and_device.csv"));

/// Appendix A.
pub(crate) const APPENDIX_A: Table = Table(include_str!("../../../published/appendix_a_pigs.csv"));

/// A table of the source: comments, names of columns, rows named by their first cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Table(&'static str);

impl Table {
    /// The number in the first row that begins with `row`, under the name `column`.
    pub(crate) fn value(self, row: &str, column: &str) -> Option<f64> {
        self.value_of([row], column)
    }

    /// The number in the first row that begins with the cells `row`, under the name `column`.
    pub(crate) fn value_of<const N: usize>(self, row: [&str; N], column: &str) -> Option<f64> {
        let mut lines = self.0.lines().filter(|line| !line.starts_with('#'));
        let at = lines.next()?.split(',').position(|name| name == column)?;
        let found = lines.find(|line| line.split(',').take(N).eq(row))?;
        found.split(',').nth(at)?.parse().ok()
    }

    /// The number under the name `column` in the first row, whatever it begins with.
    pub(crate) fn first(self, column: &str) -> Option<f64> {
        self.value_of([], column)
    }

    /// The first cells of the rows that have a number other than zero under the name `column`.
    pub(crate) fn marked(self, column: &str) -> Vec<&'static str> {
        let names = self.0.lines().filter(|line| !line.starts_with('#'));
        let names = names.skip(1).filter_map(|line| line.split(',').next());
        names
            .filter(|name| self.value(name, column).is_some_and(|value| value != 0.0))
            .collect()
    }

    /// The sum of the numbers under the name `column`.
    pub(crate) fn sum(self, column: &str) -> Option<f64> {
        let mut lines = self.0.lines().filter(|line| !line.starts_with('#'));
        let at = lines.next()?.split(',').position(|name| name == column)?;
        lines
            .map(|line| line.split(',').nth(at)?.parse::<f64>().ok())
            .sum()
    }
}

/// What `place` prints of `what`, such as `figure-7-7` of `share`, in its printed unit.
pub(crate) fn rig_and_device(place: &str, what: &str) -> Option<f64> {
    RIG_AND_DEVICE.value_of([place, what], "value")
}

/// How `organ` relaxes by the row of table 6-3 at `depth_mm`.
pub(crate) fn prony(organ: &str, depth_mm: u32) -> Result<PronySeries, Error> {
    let row = [organ, &depth_mm.to_string()];
    let terms: Vec<_> = [("g1", "tau1_s"), ("g2", "tau2_s")]
        .into_iter()
        .filter_map(|(g, tau)| {
            let g = TABLE_6_3.value_of(row, g)?;
            Some((g, TABLE_6_3.value_of(row, tau)?))
        })
        .collect();
    Ok(PronySeries::new(&terms)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_found_by_its_row_and_column() {
        assert_eq!(TABLE_3_1.value("nodes", "pcmfs_local"), Some(34.0));
        assert_eq!(TABLE_3_1.value("total_time", "fe_model_adina"), Some(18.32));
        assert_eq!(TABLE_3_1.value("nodes", "no such column"), None);
        assert_eq!(TABLE_3_1.value("no such row", "pcmfs_local"), None);
        assert_eq!(TABLE_5_1.value_of(["kidney", "8"], "mean_n"), Some(0.4541));
        assert_eq!(EQUATION_6_3.first("k2_n_per_mm"), Some(0.007));
        assert_eq!(APPENDIX_A.sum("esophagus"), Some(8.0));
        assert_eq!(APPENDIX_A.marked("spleen"), ["B3", "B4", "B5", "B6"]);
        assert_eq!(rig_and_device("section-5-4-2", "settled_after"), Some(40.0));
    }
}
