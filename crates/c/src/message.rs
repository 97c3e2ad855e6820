//! The sentence of a thread's last refused call, kept without allocating: a step in a loop may be refused too.

use std::cell::Cell;
use std::ffi::c_char;
use std::fmt::{self, Display, Write};

use palpate_files::is_hidden;

/// Room for a sentence and the zero after it [byte]; a longer one is cut off.
const ROOM: usize = 4096;

thread_local! {
    static LAST: [Cell<u8>; ROOM] = const { [const { Cell::new(0) }; ROOM] };
}

/// Writes into cells, of which the last stays free.
struct Sentence<'c> {
    cells: &'c [Cell<u8>],
    length: usize,
}

impl Sentence<'_> {
    /// Adds all of `text`, or nothing.
    fn put(&mut self, text: &str) -> fmt::Result {
        if text.len() > self.cells.len() - 1 - self.length {
            return Err(fmt::Error);
        }
        for byte in text.bytes() {
            self.cells[self.length].set(byte);
            self.length += 1;
        }
        Ok(())
    }
}

/// Hidden characters are escapes, for a program may print the sentence to a terminal, and a zero would end it.
impl Write for Sentence<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for letter in text.chars() {
            match is_hidden(letter) {
                true => {
                    for part in letter.escape_unicode() {
                        self.put(part.encode_utf8(&mut [0; 4]))?;
                    }
                }
                false => self.put(letter.encode_utf8(&mut [0; 4]))?,
            }
        }
        Ok(())
    }
}

/// Keeps what is said, for this thread.
pub(crate) fn keep(what: &impl Display) {
    LAST.with(|cells| {
        let mut sentence = Sentence { cells, length: 0 };
        // What does not fit is left out.
        let _ = write!(sentence, "{what}");
        cells[sentence.length].set(0);
    });
}

/// The sentence that says why a call of this thread was refused the last time: cause, then remedy; UTF-8; empty before
/// that. It stays until the next refused call of this thread. A call that succeeds leaves it as it is.
#[unsafe(no_mangle)]
pub extern "C" fn palpate_error_message() -> *const c_char {
    LAST.with(|cells| cells.as_ptr().cast())
}

#[cfg(test)]
pub(crate) fn last() -> String {
    LAST.with(|cells| {
        let bytes = cells.iter().map(Cell::get).take_while(|byte| *byte != 0);
        String::from_utf8(bytes.collect()).unwrap()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_sentence_is_cut_between_letters() {
        keep(&"ä".repeat(ROOM));
        assert_eq!(last(), "ä".repeat((ROOM - 1) / 2));
        keep(&"short\0er \u{1b}[2J");
        assert_eq!(last(), r"short\u{0}er \u{1b}[2J");
    }
}
