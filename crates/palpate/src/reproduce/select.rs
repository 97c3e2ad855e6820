//! Which items and rows the words of the command line mean.

use super::{ITEMS, Item, Row};
use crate::failure::Failure;
use palpate_jobs::nearest;

/// What was asked for; nothing means everything.
#[derive(Debug, Clone)]
pub(crate) struct Selection(Vec<String>);

/// Reads the words; each must begin an item or one of its rows.
pub(crate) fn select(words: &[String]) -> Result<Selection, Failure> {
    for word in words {
        if !ITEMS.iter().any(|item| is_meant(item, word)) {
            return Err(unknown(word, ITEMS.iter().map(|item| item.name).collect()));
        }
    }
    Ok(Selection(words.to_vec()))
}

impl Selection {
    /// The items that have to be run.
    pub(crate) fn items(&self) -> Vec<Item> {
        let meant =
            |item: &&Item| self.0.is_empty() || self.0.iter().any(|word| is_meant(item, word));
        ITEMS.iter().filter(meant).copied().collect()
    }

    /// The rows that were asked for; a word that no row begins with is a mistake.
    pub(crate) fn rows(&self, mut rows: Vec<Row>) -> Result<Vec<Row>, Failure> {
        for word in &self.0 {
            if !rows.iter().any(|row| row.row.starts_with(word)) {
                return Err(unknown(word, rows.iter().map(|row| &*row.row).collect()));
            }
        }
        rows.retain(|row| self.0.is_empty() || self.0.iter().any(|word| row.row.starts_with(word)));
        Ok(rows)
    }
}

fn is_meant(item: &Item, word: &str) -> bool {
    let row_of_it = word
        .strip_prefix(item.name)
        .is_some_and(|rest| rest.starts_with('/'));
    item.name.starts_with(word) || row_of_it
}

fn unknown(word: &str, known: Vec<&str>) -> Failure {
    Failure::input(format!(
        "there is no row `{word}`; the nearest is `{}`, and there are {}",
        nearest(word, &known),
        known.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(words: &[&str]) -> Result<Vec<&'static str>, Failure> {
        let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
        select(&words).map(|selection| selection.items().iter().map(|item| item.name).collect())
    }

    #[test]
    fn a_word_selects_by_its_beginning() {
        assert_eq!(words(&[]).unwrap().len(), ITEMS.len());
        assert_eq!(words(&["table-3-1/nodes"]).unwrap(), ["table-3-1"]);
        let figures = ["figure-3-3", "figure-3-4", "figure-3-7"];
        assert_eq!(words(&["figure-3"]).unwrap(), figures);
    }

    #[test]
    fn an_unknown_word_is_answered_with_the_nearest() {
        let message = words(&["tabel-3-1"]).unwrap_err().to_string();
        assert!(message.contains("nearest is `table-3-1`") && message.contains("figure-3-4"));
    }
}
