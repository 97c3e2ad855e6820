//! Motions of tools: a table with a row for each tool and time, linear between the rows.

mod columns;
mod pose;
mod tool_motion;
mod write;

use std::path::Path;

pub use pose::{IDENTITY, Pose};
pub use tool_motion::{Cursor, MotionRow, ToolMotion};

use crate::atomic_write::{MAX_TABLE_BYTES, read_text};
use crate::error::Place;
use crate::table::{Ended, TableText};
use crate::{Error, Incomplete};

/// The motions of one or two tools.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    tools: Vec<ToolMotion>,
    pub(crate) incomplete: Option<Incomplete>,
    warnings: Vec<String>,
}

impl Motion {
    /// The motions of one or two tools with different names, each with at least one row.
    ///
    /// # Errors
    /// When there are fewer or more, a name comes twice or a tool has no row.
    pub fn new(tools: Vec<ToolMotion>) -> Result<Self, Error> {
        let wrong = |found: String, expected: &'static str| {
            Err(Error::BadContent {
                what: "a motion".to_owned(),
                found,
                expected: expected.into(),
            })
        };
        match tools.as_slice() {
            [] => wrong(
                "without a tool".to_owned(),
                "the motion of one or two tools",
            ),
            [a, b] if a.name() == b.name() => wrong(
                format!("of two tools that are both called {:?}", a.name()),
                "each tool a name of its own",
            ),
            [_] | [_, _] => Ok(Self {
                tools,
                incomplete: None,
                warnings: Vec::new(),
            }),
            more => wrong(
                format!("of {} tools", more.len()),
                "the motion of one or two tools",
            ),
        }
    }

    /// Reads a motion file.
    ///
    /// # Errors
    /// When the file cannot be read or does not hold a motion.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::parse(&read_text(path, MAX_TABLE_BYTES)?, path)
    }

    /// Reads the text of a motion file; `path` is its name in errors. A session is a motion too: columns that a
    /// motion does not have are ignored. A last line without a line end may be truncated in its last number. If its
    /// position is within the box of the tool's earlier rows it is played, and [`Motion::incomplete`] reports it;
    /// elsewhere it is refused, because the number may be wrong.
    ///
    /// # Errors
    /// When the text does not hold a motion.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let ended = Ended::of(text);
        let table = TableText::parse(text, path, &[])?;
        let columns = columns::Columns::find(&table)?;
        let mut tools: Vec<ToolMotion> = Vec::new();
        let mut rows = table.rows();
        let mut last_is_inside = false;
        while let Some(row) = rows.next()? {
            let name = columns.tool_name(&row)?;
            let read = columns.row(&row)?;
            let tool = match tools.iter().position(|tool| tool.name() == name) {
                Some(known) => &mut tools[known],
                None if tools.len() < 2 => {
                    tools.push(ToolMotion::without_rows(name));
                    tools.last_mut().expect("a tool was just added")
                }
                None => return Err(row.invalid(&columns.tool, "one of the two tools named above")),
            };
            row.check_after(&columns.time, read.time_s, tool.last_time_s())?;
            last_is_inside = tool.is_in_box(&read.pose);
            tool.push(read);
        }
        if let Some(line) = ended.cut_line
            && !last_is_inside
        {
            return Err(Error::BadRow {
                place: Place::line(path, line),
                found: "a last line without a line end, which may have been cut in its middle"
                    .to_owned(),
                expected: "the whole line and a line end after it, or remove it".to_owned(),
            });
        }
        if tools.is_empty() {
            let path = path.to_owned();
            return Err(Error::NoRows { path });
        }
        let rows = tools.iter().map(|tool| tool.rows().len()).sum();
        let unusual = columns.warning(&tools);
        Ok(Self {
            tools,
            warnings: unusual
                .map(|warning| format!("{}: {warning}", path.display()))
                .into_iter()
                .collect(),
            incomplete: match ended.cut_line {
                Some(line) => Some(Incomplete::OpenLine { line }),
                None => ended.incomplete(rows),
            },
        })
    }

    /// Why rows may be missing; none for a motion with its end mark, and for one that does not come from a file.
    pub fn incomplete(&self) -> Option<&Incomplete> {
        self.incomplete.as_ref()
    }

    /// Warnings about its numbers, as sentences.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The motion of each tool, in the order in which they first occur.
    pub fn tools(&self) -> &[ToolMotion] {
        &self.tools
    }

    /// The motion of the tool called `name`.
    pub fn tool(&self, name: &str) -> Option<&ToolMotion> {
        self.tools.iter().find(|tool| tool.name() == name)
    }

    /// The first time over all tools [s].
    pub fn first_time_s(&self) -> f64 {
        let times = self.tools.iter().map(ToolMotion::first_time_s);
        times.fold(f64::INFINITY, f64::min)
    }

    /// The last time over all tools [s].
    pub fn final_time_s(&self) -> f64 {
        let times = self.tools.iter().filter_map(ToolMotion::last_time_s);
        times.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Pose of the tool called `name` at `time_s` [s]: none before its first row or when there is no such tool; after
    /// its last row it rests.
    pub fn pose(&self, name: &str, time_s: f64) -> Option<Pose> {
        self.tool(name)?.pose(time_s, &mut Cursor::default())
    }
}
