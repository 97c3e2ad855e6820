//! What a hybrid model has prepared of an organ: the response of its surface to unit traction.
//!
//! ```text
//! palpate response 1                  the words and the version of the layout
//! key = <64 hexadecimal digits>       what it was made from; another organ has another key
//! rows = 15438                        numbers per column
//! columns = 1500                      three per touchable triangle
//! made_by = ...                       provenance, for people
//!                                     an empty line
//! <columns / 3 numbers of triangles, 4 bytes each>
//! <rows × columns numbers [m], 4 bytes each, column by column>
//! <SHA-256 of all that stands before, 32 bytes>
//! ```
//!
//! Numbers are little-endian. The file can always be made again; whoever finds one that is damaged makes a
//! new one.

mod checked;
mod read;
mod write;

/// A surface's response to unit traction on each of its touchable triangles, for a unit modulus.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredResponse {
    /// 64 hexadecimal digits that name what it was made from.
    pub key: String,
    /// How it was made, for people: one line.
    pub made_by: String,
    /// Numbers in a column [-].
    pub rows: usize,
    /// The triangles that columns stand for, three each.
    pub touchable: Vec<u32>,
    /// Column by column: displacement times the modulus over the traction [m].
    pub values: Vec<f32>,
}

/// The first line of the file.
const FIRST_LINE: &str = "palpate response 1";

/// Bytes of the digest at the end.
const DIGEST: usize = 32;

/// Longest header that is read [byte].
const LONGEST_HEADER: usize = 4096;
