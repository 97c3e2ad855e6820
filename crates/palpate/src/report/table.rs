use super::Markup;

/// A table; its first column names the rows.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    head: Vec<Markup>,
    rows: Vec<(&'static str, Vec<Markup>)>,
    class: &'static str,
}

impl Table {
    pub(crate) fn new<M: Into<Markup>>(head: impl IntoIterator<Item = M>) -> Self {
        Self {
            head: head.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
            class: "",
        }
    }

    /// The same in another style.
    pub(crate) fn of_class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }

    pub(crate) fn row(&mut self, cells: Vec<Markup>) {
        self.rows.push(("", cells));
    }

    /// A highlighted row.
    pub(crate) fn marked_row(&mut self, cells: Vec<Markup>) {
        self.rows.push(("marked", cells));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

impl From<Table> for Markup {
    /// As wide as it must be, scrolled where the page is narrower.
    fn from(table: Table) -> Self {
        let head = table.head.into_iter();
        let head: Self = head
            .map(|cell| Self::element("th", &[("scope", "col")], cell))
            .collect();
        let rows: Self = table.rows.into_iter().map(row).collect();
        let inside = Self::plain("thead", Self::plain("tr", head)).and(Self::plain("tbody", rows));
        Self::of_class(
            "div",
            "scrolled",
            Self::of_class("table", table.class, inside),
        )
    }
}

fn row((class, cells): (&str, Vec<Markup>)) -> Markup {
    let cells = cells
        .into_iter()
        .enumerate()
        .map(|(place, cell)| match place {
            0 => Markup::element("th", &[("scope", "row")], cell),
            _ => Markup::plain("td", cell),
        });
    Markup::of_class("tr", class, cells.collect::<Markup>())
}
