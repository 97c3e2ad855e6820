//! How tools move: a table with a row for each tool and time, linear between the rows.

mod pose;
mod tool_motion;

use std::fmt::Write;
use std::path::Path;

pub use pose::{IDENTITY, Pose};
pub use tool_motion::{Cursor, MotionRow, ToolMotion};

use crate::table::{Column, Row, TableText, field};
use crate::whole_file::read_text;
use crate::{Domain, Error, write_whole};

/// The motions of one or two tools.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    tools: Vec<ToolMotion>,
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
            [_] | [_, _] => Ok(Self { tools }),
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
        Self::parse(&read_text(path)?, path)
    }

    /// Reads the text of a motion file; `path` is its name in errors. A session is a motion too:
    /// columns that a motion does not have are passed over.
    ///
    /// # Errors
    /// When the text does not hold a motion.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let table = TableText::parse(text, path, &["format"])?;
        let columns = Columns::find(&table)?;
        let mut tools: Vec<ToolMotion> = Vec::new();
        let mut rows = table.rows();
        while let Some(row) = rows.next()? {
            let name = columns.tool_name(&row)?;
            let read = columns.row(&row)?;
            let tool = match tools.iter().position(|tool| tool.name() == name) {
                Some(known) => &mut tools[known],
                None if tools.len() < 2 => {
                    tools.push(ToolMotion::without_rows(name));
                    tools.last_mut().expect("a tool was just added")
                }
                None => return Err(row.bad(&columns.tool, "one of the two tools named above")),
            };
            row.check_after(&columns.time, read.time_s, tool.last_time_s())?;
            tool.push(read);
        }
        if tools.is_empty() {
            let path = path.to_owned();
            return Err(Error::NoRows { path });
        }
        Ok(Self { tools })
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

    /// Where the tool called `name` is at `time_s` [s]: none before its first row or when there is
    /// no such tool; after its last row it rests.
    pub fn pose(&self, name: &str, time_s: f64) -> Option<Pose> {
        self.tool(name)?.pose(time_s, &mut Cursor::default())
    }

    /// The text of a motion file: what [`Motion::parse`] reads back to the same motion.
    pub fn to_csv(&self) -> String {
        let mut text = "# format = 1\ntime_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut\n".to_owned();
        let turned = |tool: &ToolMotion| tool.rows().iter().any(|r| r.pose.orientation.is_some());
        // The columns are there for all rows or for none.
        let with_orientation = self.tools.iter().any(turned);
        if !with_orientation {
            text = text.replace(",qx,qy,qz,qw", "");
        }
        for tool in &self.tools {
            for row in tool.rows() {
                let Pose {
                    position_m: [x, y, z],
                    orientation,
                    grip,
                    cut,
                } = row.pose;
                let name = field(tool.name());
                write!(text, "{:?},{name},{x:?},{y:?},{z:?}", row.time_s).expect(INFALLIBLE);
                if with_orientation {
                    let [qx, qy, qz, qw] = orientation.unwrap_or(IDENTITY);
                    write!(text, ",{qx:?},{qy:?},{qz:?},{qw:?}").expect(INFALLIBLE);
                }
                writeln!(text, ",{grip:?},{}", u8::from(cut)).expect(INFALLIBLE);
            }
        }
        text
    }

    /// Writes a motion file, whole or not at all.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        write_whole(path, self.to_csv().as_bytes())
    }
}

const INFALLIBLE: &str = "a string takes every text";

/// The columns of a motion.
struct Columns {
    time: Column,
    tool: Column,
    position: [Column; 3],
    orientation: Option<[Column; 4]>,
    grip: Option<Column>,
    cut: Option<Column>,
}

const NAMES: &[&str] = &[
    "time_s", "tool", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "grip", "cut",
];

impl Columns {
    fn find(table: &TableText<'_>) -> Result<Self, Error> {
        let columns = Self {
            time: table.column("time_s")?,
            tool: table.column("tool")?,
            position: [
                table.column("x_m")?,
                table.column("y_m")?,
                table.column("z_m")?,
            ],
            orientation: Self::find_orientation(table)?,
            grip: table.optional_column("grip")?,
            cut: table.optional_column("cut")?,
        };
        table.refuse_near_misses(NAMES)?;
        Ok(columns)
    }

    /// All four components or none.
    fn find_orientation(table: &TableText<'_>) -> Result<Option<[Column; 4]>, Error> {
        let names = ["qx", "qy", "qz", "qw"];
        let mut any = false;
        for name in names {
            any |= table.optional_column(name)?.is_some();
        }
        if !any {
            return Ok(None);
        }
        let [x, y, z, w] = names.map(|name| table.column(name));
        Ok(Some([x?, y?, z?, w?]))
    }

    fn tool_name<'r>(&self, row: &Row<'r>) -> Result<&'r str, Error> {
        match row.text(&self.tool) {
            "" => Err(row.bad(&self.tool, "the name of a tool of the scene")),
            name => Ok(name),
        }
    }

    fn row(&self, row: &Row<'_>) -> Result<MotionRow, Error> {
        let time_s = row.number(&self.time, Domain::FINITE)?;
        let [x, y, z] = &self.position;
        let finite = |column| row.number(column, Domain::FINITE);
        let position_m = [finite(x)?, finite(y)?, finite(z)?];
        let orientation = match &self.orientation {
            Some([x, y, z, w]) => {
                let q = [finite(x)?, finite(y)?, finite(z)?, finite(w)?];
                let expected = "a quaternion (qx, qy, qz, qw) that is not zero";
                Some(pose::normalised(q).ok_or_else(|| row.bad(x, expected))?)
            }
            None => None,
        };
        let grip = match &self.grip {
            Some(column) => row.number(column, Domain::FRACTION)?,
            None => 0.0,
        };
        let cut = match &self.cut {
            Some(column) => row.truth(column)?,
            None => false,
        };
        let pose = Pose {
            position_m,
            orientation,
            grip,
            cut,
        };
        Ok(MotionRow { time_s, pose })
    }
}
