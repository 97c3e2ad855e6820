//! Sessions: for each tool and step of the model its pose, its force and its events.

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

use crate::atomic_write::{MAX_TABLE_BYTES, read_text};
use crate::motion::{Motion, MotionRow, Pose, ToolMotion};
use crate::table::{Ended, RowDigest, TableText};
use crate::{Error, Incomplete};

/// A recorded session.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// Its conditions.
    pub header: SessionHeader,
    /// The names of the tools, in the order of the scene.
    pub tools: Vec<String>,
    /// The rows, in the order of the file.
    pub rows: Vec<SessionRow>,
    /// Whether the rows have torques; those of an older file are zero.
    pub has_torques: bool,
    /// Why rows may be missing; none for a session with its end mark.
    pub incomplete: Option<Incomplete>,
}

impl Session {
    /// Reads a session file. A last line without its end is left out.
    ///
    /// # Errors
    /// When the file cannot be read or does not hold a session.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_TABLE_BYTES)?, path)
    }

    /// Reads the text of a session file; `path` is its name in errors.
    ///
    /// # Errors
    /// When the text does not hold a session.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let ended = Ended::of(text);
        let table = TableText::parse(ended.whole, path, SessionHeader::KEYS)?;
        let header = SessionHeader::from_keys(&table.header.keys(path, SessionHeader::KEYS))?;
        let columns = columns::Columns::find(&table)?;
        let mut session = Self {
            header,
            tools: Vec::new(),
            rows: Vec::new(),
            has_torques: columns.torque.is_some(),
            incomplete: None,
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
        session.incomplete = ended.incomplete(session.rows.len());
        Ok(session)
    }

    fn tool_number(&mut self, name: &str) -> usize {
        let known = self.tools.iter().position(|tool| tool == name);
        known.unwrap_or_else(|| {
            self.tools.push(name.to_owned());
            self.tools.len() - 1
        })
    }

    /// A name for its content: the SHA-256 of the columns and rows as they are written, in hexadecimal digits. It is
    /// the digest in the end mark of a session that this program wrote.
    pub fn digest(&self) -> String {
        let mut digest = RowDigest::default();
        digest.add(match self.has_torques {
            true => row::COLUMNS,
            false => row::COLUMNS_WITHOUT_TORQUE,
        });
        let mut line = String::new();
        for row in &self.rows {
            line.clear();
            row.print_with(&self.tools[row.tool], self.has_torques, &mut line)
                .expect("a string takes every text");
            digest.add(&line);
        }
        digest.hexadecimal()
    }

    /// The pose of each row, without an orientation where the direction of the tool's shaft was not known.
    pub fn poses(&self) -> impl Iterator<Item = Pose> {
        let mut is_known = vec![true; self.tools.len()];
        self.rows.iter().map(move |row| {
            let known = &mut is_known[row.tool];
            // After a restart the session states an unknown direction again.
            *known |= row.events.contains(Event::ShaftKnown);
            *known |= row.events.contains(Event::Restart);
            *known &= !row.events.contains(Event::ShaftUnknown);
            Pose {
                position_m: row.position_m,
                orientation: known.then_some(row.orientation),
                grip: row.grip,
                cut: row.cut,
            }
        })
    }

    /// The recorded motion, to be played again.
    ///
    /// # Errors
    /// When there is no row, or there are more than two tools.
    pub fn motion(&self) -> Result<Motion, Error> {
        let tools = self.tools.iter().enumerate().map(|(number, name)| {
            let rows = self.rows.iter().zip(self.poses());
            let rows = rows.filter(|(row, _)| row.tool == number);
            let rows = rows.map(|(row, pose)| MotionRow {
                time_s: row.time_s,
                pose,
            });
            ToolMotion::new(name, rows.collect())
        });
        let mut motion = Motion::new(tools.collect::<Result<_, _>>()?)?;
        motion.incomplete.clone_from(&self.incomplete);
        Ok(motion)
    }
}
