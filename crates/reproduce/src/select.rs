//! Items and rows that the words of the command line select: an exact name selects that item or row alone, any other
//! word selects all that begin with it.

use std::collections::BTreeSet;

use super::mark::Mark;
use super::{Item, Row, items};
use crate::Error;
use palpate_jobs::nearest;

/// The selected items and rows; an empty selection means all.
#[derive(Debug, Clone)]
pub struct Selection {
    words: Vec<String>,
    /// Places of words that a row has matched.
    met: BTreeSet<usize>,
    /// Names of the rows of the items that have run.
    known: Vec<String>,
}

/// Reads the words; each must be or begin an item, or begin with one and a slash.
///
/// # Errors
/// When one does not.
pub fn select(words: &[String]) -> Result<Selection, Error> {
    for word in words {
        if !items().iter().any(|item| is_meant(item, word)) {
            let names: Vec<&str> = items().iter().map(|item| item.name).collect();
            return Err(unknown(word, &names));
        }
    }
    Ok(Selection {
        words: words.to_vec(),
        met: BTreeSet::new(),
        known: Vec::new(),
    })
}

impl Selection {
    /// The items that have to be run.
    pub fn items(&self) -> Vec<Item> {
        let words = &self.words;
        let meant = |item: &Item| words.is_empty() || words.iter().any(|word| is_meant(item, word));
        items().into_iter().filter(meant).collect()
    }

    /// Those of the `rows` of `item` that were asked for, and the one that says that it failed.
    pub fn rows_of(&mut self, item: &Item, rows: Vec<Row>) -> Vec<Row> {
        if self.words.is_empty() {
            return rows;
        }
        self.known.extend(rows.iter().map(|row| row.row.clone()));
        let mut is_wanted = vec![false; rows.len()];
        for (place, word) in self.words.iter().enumerate() {
            if !is_meant(item, word) {
                continue;
            }
            let is_exact = rows.iter().any(|row| row.row == *word);
            for (row, is_wanted) in rows.iter().zip(&mut is_wanted) {
                let begins = row.row.starts_with(word) && (row.row == *word || !is_exact);
                if row_of(item, word).is_none() || row.mark == Some(Mark::Failed) || begins {
                    *is_wanted = true;
                    self.met.insert(place);
                }
            }
        }
        let wanted = rows.into_iter().zip(is_wanted);
        wanted
            .filter_map(|(row, is_wanted)| is_wanted.then_some(row))
            .collect()
    }

    /// When all items have run: a word that no row begins with is a mistake.
    ///
    /// # Errors
    /// When there is one.
    pub fn check(&self) -> Result<(), Error> {
        let missed = (0..self.words.len()).find(|place| !self.met.contains(place));
        match missed {
            None => Ok(()),
            Some(place) => {
                let known: Vec<&str> = self.known.iter().map(|row| &**row).collect();
                Err(unknown(&self.words[place], &known))
            }
        }
    }
}

fn is_meant(item: &Item, word: &str) -> bool {
    let is_exact = items().iter().any(|item| item.name == word);
    match is_exact {
        true => item.name == word,
        false => item.name.starts_with(word) || row_of(item, word).is_some(),
    }
}

/// What follows the item's name, of a word that names its rows.
fn row_of<'w>(item: &Item, word: &'w str) -> Option<&'w str> {
    word.strip_prefix(item.name)?.strip_prefix('/')
}

fn unknown(word: &str, known: &[&str]) -> Error {
    Error::UnknownRow {
        word: word.to_owned(),
        nearest: nearest(word, known).to_owned(),
        known: known.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(words: &[&str]) -> Result<Vec<&'static str>, Error> {
        let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
        select(&words).map(|selection| selection.items().iter().map(|item| item.name).collect())
    }

    #[test]
    fn a_word_selects_by_its_beginning() {
        assert_eq!(words(&[]).unwrap().len(), items().len());
        assert_eq!(words(&["table-3-1/nodes"]).unwrap(), ["table-3-1"]);
        let figures = words(&["figure-3"]).unwrap();
        assert_eq!(figures.len(), 7);
        assert!(figures.iter().all(|name| name.starts_with("figure-3-")));
        assert_eq!(words(&["chapter-5"]).unwrap().len(), 4);
    }

    #[test]
    fn an_exact_name_selects_nothing_else() {
        assert_eq!(words(&["figure-5-1"]).unwrap(), ["figure-5-1"]);
        assert_eq!(words(&["figure-7-1"]).unwrap(), ["figure-7-1"]);
    }

    #[test]
    fn an_unknown_word_is_answered_with_the_nearest() {
        let message = words(&["tabel-3-1"]).unwrap_err().to_string();
        assert!(message.contains("nearest is `table-3-1`") && message.contains("figure-3-4"));
    }
}
