//! What happened: for each tool and step of the model its pose, its force and what it did.

mod columns;
mod event;
mod header;
mod row;
mod writer;

use std::path::Path;

pub use event::{Event, Events};
pub use header::SessionHeader;
pub use row::SessionRow;
pub use writer::SessionWriter;

use crate::motion::{Motion, MotionRow, Pose, ToolMotion};
use crate::table::TableText;
use crate::whole_file::{newlines, read_text};
use crate::{Error, error::Place};

/// A session that was played.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// Under which conditions.
    pub header: SessionHeader,
    /// The names of the tools, in the order of the scene.
    pub tools: Vec<String>,
    /// The rows, in the order of the file.
    pub rows: Vec<SessionRow>,
    /// The line that was cut off and left out, when the program was stopped while it wrote.
    pub truncated: Option<Place>,
}

impl Session {
    /// Reads a session file. A last line without its end is left out and reported.
    ///
    /// # Errors
    /// When the file cannot be read or does not hold a session.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path)?, path)
    }

    /// Reads the text of a session file; `path` is its name in errors.
    ///
    /// # Errors
    /// When the text does not hold a session.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        // Whole lines are all that a writer promises: what follows the last of them is a fragment,
        // even when it happens to look like a row.
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let truncated =
            (whole.len() < text.len()).then(|| Place::line(path, 1 + newlines(whole.as_bytes())));
        let table = TableText::parse(whole, path, SessionHeader::KEYS)?;
        let header = SessionHeader::from_keys(&table.header.keys(path, SessionHeader::KEYS))?;
        let columns = columns::Columns::find(&table)?;
        let mut session = Self {
            header,
            tools: Vec::new(),
            rows: Vec::new(),
            truncated,
        };
        let mut previous = Vec::new();
        let mut rows = table.rows();
        while let Some(row) = rows.next()? {
            let name = columns.tool_name(&row)?;
            let tool = session.tool_number(name);
            let read = columns.row(&row, tool)?;
            previous.resize(session.tools.len(), None);
            row.check_after(&columns.time, read.time_s, previous[tool])?;
            previous[tool] = Some(read.time_s);
            session.rows.push(read);
        }
        Ok(session)
    }

    fn tool_number(&mut self, name: &str) -> usize {
        let known = self.tools.iter().position(|tool| tool == name);
        known.unwrap_or_else(|| {
            self.tools.push(name.to_owned());
            self.tools.len() - 1
        })
    }

    /// The motion that was played, to be played again.
    ///
    /// # Errors
    /// When there is no row, or there are more than two tools.
    pub fn motion(&self) -> Result<Motion, Error> {
        let tools = self.tools.iter().enumerate().map(|(number, name)| {
            let rows = self.rows.iter().filter(|row| row.tool == number);
            let rows = rows.map(|row| MotionRow {
                time_s: row.time_s,
                pose: Pose {
                    position_m: row.position_m,
                    orientation: Some(row.orientation),
                    grip: row.grip,
                    cut: row.cut,
                },
            });
            ToolMotion::new(name, rows.collect())
        });
        Motion::new(tools.collect::<Result<_, _>>()?)
    }
}
