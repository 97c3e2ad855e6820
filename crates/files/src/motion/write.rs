use std::fmt::{self, Write};
use std::path::Path;

use super::{IDENTITY, Motion, MotionRow, Pose};
use crate::table::{end_mark, field};
use crate::{Error, write_atomically};

const COLUMNS: &str = "time_s,tool,x_m,y_m,z_m,grip,cut";
const COLUMNS_WITH_ORIENTATION: &str = "time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut";

impl Motion {
    /// The text of a motion file, which [`Motion::parse`] reads back to the same motion, except that rows without an
    /// orientation among others with one come back with [`IDENTITY`]. A motion that was read
    /// [incomplete](Motion::incomplete) gets no end mark.
    pub fn to_csv(&self) -> String {
        // The columns are there for all rows or for none.
        let turned = |row: &MotionRow| row.pose.orientation.is_some();
        let with_orientation = self
            .tools()
            .iter()
            .any(|tool| tool.rows().iter().any(turned));
        let columns = if with_orientation {
            COLUMNS_WITH_ORIENTATION
        } else {
            COLUMNS
        };
        let mut text = format!("# format = 1\n{columns}\n");
        for tool in self.tools() {
            for row in tool.rows() {
                let orientation =
                    with_orientation.then(|| row.pose.orientation.unwrap_or(IDENTITY));
                print(row, tool.name(), orientation, &mut text).expect("a string takes every text");
            }
        }
        if self.incomplete().is_none() {
            let rows = self.tools().iter().map(|tool| tool.rows().len()).sum();
            text += &end_mark(&text, rows);
        }
        text
    }

    /// Writes a motion file, whole or not at all.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        write_atomically(path, self.to_csv().as_bytes())
    }
}

fn print(
    row: &MotionRow,
    tool: &str,
    orientation: Option<[f64; 4]>,
    text: &mut String,
) -> fmt::Result {
    let Pose {
        position_m: [x, y, z],
        grip,
        cut,
        ..
    } = row.pose;
    write!(text, "{:?},{},{x:?},{y:?},{z:?}", row.time_s, field(tool))?;
    for component in orientation.iter().flatten() {
        write!(text, ",{component:?}")?;
    }
    writeln!(text, ",{grip:?},{}", u8::from(cut))
}
