//! The source's tables, as given.

/// Table 3-1.
pub(crate) const TABLE_3_1: Table = Table(include_str!(
    "../../../../published/table_3_1_pcmfs_vs_fem.csv"
));

/// A table of the source: comments, names of columns, rows named by their first cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Table(&'static str);

impl Table {
    /// The number in the row that begins with `row`, under the name `column`.
    pub(crate) fn value(self, row: &str, column: &str) -> Option<f64> {
        let mut lines = self.0.lines().filter(|line| !line.starts_with('#'));
        let at = lines.next()?.split(',').position(|name| name == column)?;
        let mut cells = lines.map(|line| line.split(','));
        let found = cells.find_map(|mut cells| (cells.next() == Some(row)).then_some(cells))?;
        // The first cell is taken out already.
        found.into_iter().nth(at.checked_sub(1)?)?.parse().ok()
    }
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
    }
}
