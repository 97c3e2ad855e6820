use super::super::text::{number, unexpected};
use crate::{ReadFault, Vec3};

/// The lines of a text that are not empty, trimmed, with their numbers from one.
pub(super) struct Lines<'a> {
    lines: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    last: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let lines = text.lines().enumerate();
        let lines = lines
            .map(|(index, line)| (index + 1, line.trim()))
            .filter(|(_, line)| !line.is_empty());
        Self {
            lines: Box::new(lines),
            last: 0,
        }
    }

    /// The next line, if there is one.
    pub(super) fn try_next(&mut self) -> Option<(usize, &'a str)> {
        let (line, content) = self.lines.next()?;
        self.last = line;
        Some((line, content))
    }

    /// The next line, where `expected` must follow.
    pub(super) fn next(&mut self, expected: &'static str) -> Result<(usize, &'a str), ReadFault> {
        let line = self.last;
        self.try_next()
            .ok_or(ReadFault::EndsEarly { line, expected })
    }

    /// The words of all lines that are left.
    pub(super) fn into_words(self) -> Words<'a> {
        let line = self.last;
        let words = self
            .lines
            .flat_map(|(line, content)| content.split_ascii_whitespace().map(move |w| (line, w)));
        Words {
            words: Box::new(words),
            line,
        }
    }
}

/// The words of a text, with the lines that they stand on.
pub(super) struct Words<'a> {
    words: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    line: usize,
}

impl<'a> Words<'a> {
    /// The words of `text`, which begins on this line.
    pub(super) fn starting_at(text: &'a str, line: usize) -> Self {
        let words = text.lines().enumerate().flat_map(move |(index, content)| {
            let words = content.split_ascii_whitespace();
            words.map(move |word| (line + index, word))
        });
        Self {
            words: Box::new(words),
            line,
        }
    }

    /// The line of the last word.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    pub(super) fn try_next(&mut self) -> Option<&'a str> {
        let (line, word) = self.words.next()?;
        self.line = line;
        Some(word)
    }

    pub(super) fn next(&mut self, expected: &'static str) -> Result<&'a str, ReadFault> {
        let line = self.line;
        self.try_next()
            .ok_or(ReadFault::EndsEarly { line, expected })
    }

    pub(super) fn point(&mut self) -> Result<Vec3, ReadFault> {
        let mut coordinate = || {
            let word = self.next("a coordinate")?;
            number(Some(word), self.line)
        };
        Ok(Vec3::new(coordinate()?, coordinate()?, coordinate()?))
    }

    pub(super) fn integer(&mut self, expected: &'static str) -> Result<i64, ReadFault> {
        let word = self.next(expected)?;
        integer(Some(word), self.line, expected)
    }

    pub(super) fn count(&mut self, expected: &'static str) -> Result<usize, ReadFault> {
        let word = self.next(expected)?;
        count(Some(word), self.line, expected)
    }
}

pub(super) fn integer(
    word: Option<&str>,
    line: usize,
    expected: &'static str,
) -> Result<i64, ReadFault> {
    let word = word.unwrap_or("");
    word.parse().map_err(|_| unexpected(line, word, expected))
}

pub(super) fn count(
    word: Option<&str>,
    line: usize,
    expected: &'static str,
) -> Result<usize, ReadFault> {
    let word = word.unwrap_or("");
    word.parse().map_err(|_| unexpected(line, word, expected))
}
