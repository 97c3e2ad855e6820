//! The cached response of an organ for a hybrid model: displacements of its surface for unit traction.
//!
//! ```text
//! palpate response 1                  the words and the version of the layout
//! key = <64 hexadecimal digits>       what it was made from; another organ has another key
//! touchable = 500                     triangles t that may be loaded
//! triangles = 5146                    triangles n that are moved
//! made_by = ...                       provenance, for people
//!                                     an empty line
//! <t numbers of triangles>             four bytes each, as all numbers
//! <3 n × 3 t displacements [1/m], one column after the other>
//! <SHA-256 of all that stands before, 32 bytes>
//! ```
//!
//! Numbers are little-endian. The file can always be computed again; a program that finds it damaged writes a new
//! one.

mod checked;
mod read;
mod write;

use std::borrow::Cow;

/// How a surface moves under a unit force on each of its touchable triangles, times Young's modulus.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredResponse<'a> {
    /// 64 hexadecimal digits that identify its inputs.
    pub key: String,
    /// Its provenance, for people: one line.
    pub made_by: String,
    /// The triangles on which forces act, each in three directions: a column for each.
    pub touchable: Vec<u32>,
    /// The number of displaced triangles.
    pub triangles: usize,
    /// Displacements of all triangles, column by column [1/m].
    pub displacements: Cow<'a, [f32]>,
}

/// The first line of the file.
const FIRST_LINE: &str = "palpate response 1";

/// Bytes of the digest at the end.
const DIGEST: usize = 32;

/// Longest header that is read [byte].
const LONGEST_HEADER: usize = 4096;
