//! The items and their rows as data: `published/rows`, one file for each chapter of the source, in its order.
//!
//! An item has a `name`, a `title`, usual `seconds`, and rows and figures, or the reason why it is `not_computed`. A row
//! has a `name`, a `unit`, a `note`, a `mark` where it is not simply our number, and a `published` value: a number, or
//! the cell of a table, see [`cell`](crate::published::cell). A figure has axes `x` and `y`, a `title` and a `note`;
//! one without a title is a picture. Braces in a name match any text without a slash, or one of the
//! texts after a colon, as in `{organ:liver|kidney}/{depth}_mm`; of several rows that match, the first is meant.
//! Elsewhere they stand for the matched text, for a value that the computation passes (`with`), for the `item` or its `part` after the
//! slash, or for one of the `words`: a text, or a text for each value.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use palpate_jobs::plot::{Axis, Plot, Series};
use serde::Deserialize;

use crate::mark::Mark;

/// The chapters.
const CHAPTERS: [&str; 7] = [
    include_str!("../../../published/rows/chapter_2.toml"),
    include_str!("../../../published/rows/chapter_3.toml"),
    include_str!("../../../published/rows/chapter_4.toml"),
    include_str!("../../../published/rows/chapter_5.toml"),
    include_str!("../../../published/rows/chapter_6.toml"),
    include_str!("../../../published/rows/chapter_7.toml"),
    include_str!("../../../published/rows/appendix.toml"),
];

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Chapter {
    #[serde(default)]
    words: BTreeMap<String, Words>,
    item: Vec<ItemData>,
}

/// Texts for a name in braces.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Words {
    Always(String),
    ByValue(BTreeMap<String, String>),
}

/// A table, a figure or a statement of the source.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ItemData {
    pub(crate) name: String,
    pub(crate) title: String,
    /// Usual duration [s].
    #[serde(default)]
    pub(crate) seconds: f64,
    /// Why there is nothing to compute.
    pub(crate) not_computed: Option<String>,
    /// The item that has the same rows, in which `{part}` stands for what follows the slash in the name of each.
    like: Option<String>,
    #[serde(default)]
    words: BTreeMap<String, Words>,
    #[serde(default)]
    row: Vec<RowData>,
    #[serde(default)]
    figure: Vec<FigureData>,
}

/// Data of a row, without its computed number.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RowData {
    name: String,
    #[serde(default)]
    pub(crate) unit: String,
    pub(crate) published: Option<Published>,
    #[serde(default)]
    pub(crate) note: String,
    pub(crate) mark: Option<Mark>,
}

/// The published number.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Published {
    /// In its text.
    Number(f64),
    /// In a table.
    Cell(String),
}

/// Data of a figure, without its curves.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FigureData {
    #[serde(default)]
    name: String,
    #[serde(default)]
    title: String,
    #[serde(default)]
    x: String,
    #[serde(default)]
    y: String,
    /// Which axes divide by decades.
    #[serde(default)]
    logarithmic: String,
    #[serde(default)]
    pub(crate) note: String,
}

impl FigureData {
    /// Its plot of `series`.
    pub(crate) fn plot(&self, fill: impl Fn(&str) -> String, series: Vec<Series>) -> Plot {
        let axis = |name: char| match self.logarithmic.contains(name) {
            true => Axis::Logarithmic,
            false => Axis::Linear,
        };
        Plot {
            title: fill(&self.title),
            x_label: fill(&self.x),
            y_label: fill(&self.y),
            x_axis: axis('x'),
            y_axis: axis('y'),
            series,
            ..Plot::default()
        }
    }
}

/// All items, in the order of the source.
pub(crate) fn items() -> impl Iterator<Item = &'static ItemData> {
    chapters().iter().flat_map(|chapter| &chapter.item)
}

fn chapters() -> &'static [Chapter] {
    static READ: OnceLock<Vec<Chapter>> = OnceLock::new();
    READ.get_or_init(|| {
        let read = CHAPTERS
            .map(|text| toml::from_str(text).expect("the registry is constant, and tests read it"));
        read.into()
    })
}

/// Values of the names in braces.
pub(crate) type Values = Vec<(String, String)>;

/// An entry for a name, and what its braces matched.
pub(crate) type Found<T> = Option<(&'static T, Values)>;

/// The item that has the rows of `item`.
fn data(item: &str) -> Option<&'static ItemData> {
    let named = |name: &str| items().find(|data| data.name == name);
    let own = named(item)?;
    own.like.as_ref().map_or(Some(own), |like| named(like))
}

/// The row `name` of `item`.
pub(crate) fn row(item: &str, name: &str) -> Found<RowData> {
    let found = |row: &'static RowData| Some((row, captured(&row.name, name)?));
    data(item)?.row.iter().find_map(found)
}

/// The figure `name` of `item`.
pub(crate) fn figure(item: &str, name: &str) -> Found<FigureData> {
    let found = |figure: &'static FigureData| Some((figure, captured(&figure.name, name)?));
    data(item)?.figure.iter().find_map(found)
}

/// What the braces of `pattern` match in `name`; none when they differ.
fn captured(pattern: &str, name: &str) -> Option<Values> {
    let Some((before, rest)) = pattern.split_once('{') else {
        return (pattern == name).then(Vec::new);
    };
    let (key, after) = rest.split_once('}')?;
    let name = name.strip_prefix(before)?;
    let (key, ends): (&str, Vec<usize>) = match key.split_once(':') {
        Some((key, choices)) => {
            let choices = choices.split('|').filter(|choice| name.starts_with(choice));
            (key, choices.map(str::len).collect())
        }
        None => (key, (1..=name.find('/').unwrap_or(name.len())).collect()),
    };
    ends.into_iter()
        .filter(|&end| name.is_char_boundary(end))
        .find_map(|end| {
            let mut values = captured(after, &name[end..])?;
            values.insert(0, (key.to_owned(), name[..end].to_owned()));
            Some(values)
        })
}

/// `text` of `item` with the values of what stands in braces; the last of two values of one name counts.
pub(crate) fn filled(item: &str, text: &str, values: &Values) -> String {
    let braces = text.split_once('{');
    let Some((before, (key, after))) =
        braces.and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
    else {
        return text.to_owned();
    };
    let value = values.iter().rev().find(|(name, _)| name == key);
    let value = match key {
        "item" => Some(item),
        "part" => item.split_once('/').map(|(_, part)| part),
        _ => value.map(|(_, value)| &**value),
    };
    let meant = match words(item, key) {
        Some(Words::Always(words)) => filled(item, words, values),
        Some(Words::ByValue(words)) => {
            let words = value.and_then(|value| words.get(value));
            words.map_or(String::new(), |words| filled(item, words, values))
        }
        None => value.map_or(format!("{{{key}}}"), str::to_owned),
    };
    format!("{before}{meant}{}", filled(item, after, values))
}

/// The words of `item` for what stands in braces, or those of its chapter.
fn words(item: &str, key: &str) -> Option<&'static Words> {
    let own = data(item)?.words.get(key);
    let mut chapters = chapters().iter();
    let chapter = chapters.find(|chapter| chapter.item.iter().any(|own| own.name == item))?;
    own.or_else(|| chapter.words.get(key))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::published::cell;

    #[test]
    fn a_pattern_matches_within_slashes() {
        let found = captured("{organ}_{depth}_mm/tau1", "liver_6_mm/tau1").unwrap();
        let found: Vec<&str> = found.iter().map(|(_, value)| &**value).collect();
        assert_eq!(found, ["liver", "6"]);
        assert!(captured("{organ}/mean", "liver/6_mm/mean").is_none());
        assert!(captured("{organ}", "").is_none());
        let mesh = "elements{mesh:|/fine}/{of:nodes|time}";
        assert!(captured(mesh, "elements/fine/time").is_some());
        assert!(captured(mesh, "elements/nodes").is_some());
        assert!(captured(mesh, "elements/coarse/nodes").is_none());
    }

    /// Judge: the tables. What is meant of a row whose name is a pattern shows when it is computed.
    #[test]
    fn every_cell_that_a_row_names_is_printed() {
        let rows = items().flat_map(|item| &item.row);
        for row in rows {
            if let Some(Published::Cell(place)) = &row.published
                && !place.contains('{')
            {
                assert!(cell(place).is_ok(), "{}: {place}", row.name);
            }
        }
    }
}
