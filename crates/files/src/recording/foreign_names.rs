use super::ForeignColumns;
use super::foreign_units::base;
use crate::Error;
use crate::table::TableText;
use crate::words::or_list;

const TIME: &[&str] = &[
    "time",
    "t",
    "zeit",
    "prüfzeit",
    "temps",
    "tiempo",
    "elapsed",
];
const DEPTH: &[&str] = &[
    "depth",
    "indentation",
    "eindringtiefe",
    "displacement",
    "compression",
    "d",
    "weg",
    "standardweg",
    "extension",
    "travel",
    "distance",
    "crosshead",
    "traverse",
    "traversenweg",
    "position",
    "height",
];
const FORCE: &[&str] = &["force", "load", "f", "kraft", "standardkraft", "last"];
/// A name with more words, its unit included, is a sentence.
const MAX_WORDS: usize = 6;

/// A quantity and the names of its column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted<'c> {
    /// The quantity, such as `time`.
    pub(super) quantity: &'static str,
    /// The name that the user gives.
    named: Option<&'c str>,
    /// Words by which it is recognised otherwise, the most reliable first.
    words: &'static [&'static str],
    /// Words of other quantities.
    excluded: &'static [&'static str],
}

impl ForeignColumns {
    pub(super) fn wanted(&self) -> [Wanted<'_>; 3] {
        [
            Wanted::new("time", self.time.as_deref(), TIME),
            Wanted::new("depth", self.depth.as_deref(), DEPTH),
            Wanted::new("force", self.force.as_deref(), FORCE),
        ]
    }
}

impl<'c> Wanted<'c> {
    pub(super) fn new(
        quantity: &'static str,
        named: Option<&'c str>,
        words: &'static [&'static str],
    ) -> Self {
        Self {
            quantity,
            named: named.map(str::trim),
            words,
            excluded: &[],
        }
    }

    /// The same without columns whose names have one of these words.
    pub(super) fn without(self, excluded: &'static [&'static str]) -> Self {
        Self { excluded, ..self }
    }

    /// Whether `line` may hold the name of the column.
    pub(super) fn may_be_in(&self, line: &str) -> bool {
        self.named.is_some_and(|name| line.contains(name))
    }

    pub(super) fn is_recognised(&self) -> bool {
        self.named.is_none()
    }

    /// The names among `columns` that match best; several when they match equally.
    pub(super) fn candidates<'n>(&self, columns: &'n [String]) -> Vec<&'n str> {
        let mut best = usize::MAX;
        let mut found = Vec::new();
        for own in columns {
            let Some(rank) = self.rank(own) else {
                continue;
            };
            if rank < best {
                best = rank;
                found.clear();
            }
            if rank == best {
                found.push(own.as_str());
            }
        }
        found
    }

    /// Rank of a match, zero best; none when the name does not match.
    fn rank(&self, own: &str) -> Option<usize> {
        if let Some(named) = self.named {
            return (own == named).then_some(0);
        }
        if words(own).count() > MAX_WORDS {
            return None;
        }
        let base = base(own).to_lowercase();
        let parts: Vec<_> = words(&base).collect();
        if parts.iter().any(|part| self.excluded.contains(part)) {
            return None;
        }
        let place = |part: &str| self.words.iter().position(|word| *word == part);
        match parts.as_slice() {
            [only] => place(only),
            // A letter alone means something only when it stands alone.
            several => several
                .iter()
                .filter(|part| part.len() > 1)
                .filter_map(|part| place(part))
                .min()
                .map(|place| place + self.words.len()),
        }
    }

    /// The name of the column in `table`.
    pub(super) fn choose<'n>(&self, table: &'n TableText<'_>) -> Result<&'n str, Error> {
        match self.candidates(table.columns()).as_slice() {
            [only] => Ok(only),
            [] => Err(match self.named {
                Some(name) => table.missing_column(name),
                None => Error::UnrecognizedColumn {
                    place: table.column_place(),
                    quantity: self.quantity,
                    found: quoted(table.columns()).join(", "),
                },
            }),
            [first, ..] if self.named.is_some() => Ok(first),
            several => Err(Error::AmbiguousColumn {
                place: table.column_place(),
                quantity: self.quantity,
                found: or_list(&quoted(several)),
                first: (*several[0]).to_owned(),
            }),
        }
    }
}

fn words(name: &str) -> impl Iterator<Item = &str> {
    let parts = name.split(|c: char| !c.is_alphanumeric());
    parts.filter(|part| !part.is_empty())
}

fn quoted(names: &[impl AsRef<str>]) -> Vec<String> {
    let quote = |name: &_| format!("`{}`", AsRef::<str>::as_ref(name));
    names.iter().map(quote).collect()
}
