//! The answer for a person.

use palpate_files::quantity::rounded;

use super::answer::Answer;
use super::problem::Problem;

/// Columns of numbers under their names.
#[derive(Debug, Default)]
pub(crate) struct Table {
    columns: Vec<(String, Vec<String>)>,
    /// A row that is always shown.
    always: Option<usize>,
}

/// Longer tables are thinned out; the JSON object has all rows.
const MAX_ROWS: usize = 24;

impl Table {
    /// With one more column, whose values are printed to four digits.
    pub(crate) fn with(self, name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        self.with_texts(name, values.into_iter().map(|value| rounded(value, 4)))
    }

    pub(crate) fn with_texts(
        mut self,
        name: &str,
        texts: impl IntoIterator<Item = String>,
    ) -> Self {
        self.columns
            .push((name.to_owned(), texts.into_iter().collect()));
        self
    }

    /// Always shows the row of the largest of `values`.
    pub(crate) fn with_peak_shown(mut self, values: &[f64]) -> Self {
        self.always = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b]));
        self
    }

    fn text(&self) -> String {
        let rows = self.columns.first().map_or(0, |(_, texts)| texts.len());
        let mut text = self.line(|(name, _)| name);
        for row in shown(rows, self.always) {
            text += &self.line(|(_, texts)| texts.get(row).map_or("", String::as_str));
        }
        if rows > MAX_ROWS {
            text += &format!("  (every row of {rows} is in --json)\n");
        }
        text
    }

    /// Every column as wide as its widest text.
    fn line<'t>(&'t self, of: impl Fn(&'t (String, Vec<String>)) -> &'t str) -> String {
        let cells = self.columns.iter().map(|column| {
            let texts = column.1.iter().map(|text| text.chars().count());
            let width = texts.fold(column.0.chars().count(), usize::max);
            format!("  {:>width$}", of(column))
        });
        cells.collect::<String>() + "\n"
    }
}

/// The rows to show: all, or some, evenly, ends included, and the row `always`.
fn shown(rows: usize, always: Option<usize>) -> Vec<usize> {
    if rows <= MAX_ROWS {
        return (0..rows).collect();
    }
    let even = (0..MAX_ROWS).map(|k| k * (rows - 1) / (MAX_ROWS - 1));
    let mut shown: Vec<usize> = even.chain(always).collect();
    shown.sort_unstable();
    shown.dedup();
    shown
}

/// The whole answer as text.
pub fn in_words(problem: &Problem, answer: &Answer) -> String {
    let solution = &answer.solution;
    let error = format!("{:.2}", 100.0 * solution.estimated_error);
    let order = solution.observed_order;
    let order = order.map_or(String::new(), |order| {
        format!("; observed order {order:.1}")
    });
    format!(
        "{}\n{}\n\n{}\nestimated error {error} % (asked for {} %{order}), {} unknowns, {:.1} s\n",
        solution.heading,
        problem.tissue_in_words(),
        solution
            .tables
            .iter()
            .map(Table::text)
            .collect::<Vec<_>>()
            .join("\n"),
        100.0 * problem.accuracy,
        solution.unknowns,
        answer.seconds,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_tables_are_thinned_out_and_keep_their_ends() {
        let table = Table::default().with("a", (0..100).map(f64::from));
        let text = table.text();
        assert_eq!(text.lines().count(), 2 + MAX_ROWS);
        assert!(text.contains("99.00") && text.contains("100 is in"));
        assert_eq!(shown(3, Some(1)), [0, 1, 2]);
        assert!(shown(1000, Some(1)).starts_with(&[0, 1, 43]));
    }
}
