use super::{Event, Events, SessionRow};
use crate::table::{Column, Row, TableText};
use crate::words::either;
use crate::{Domain, Error};

/// The columns of a session.
pub(super) struct Columns {
    pub(super) time: Column,
    tool: Column,
    position: [Column; 3],
    orientation: [Column; 4],
    grip: Column,
    cut: Column,
    force: [Column; 3],
    contact: Column,
    depth: Column,
    event: Column,
    /// Sessions before there were jaws have none.
    grip_force: Option<Column>,
}

impl Columns {
    pub(super) fn find(table: &TableText<'_>) -> Result<Self, Error> {
        let three = |[x, y, z]: [&str; 3]| -> Result<[Column; 3], Error> {
            Ok([table.column(x)?, table.column(y)?, table.column(z)?])
        };
        let [qx, qy, qz] = three(["qx", "qy", "qz"])?;
        Ok(Self {
            time: table.column("time_s")?,
            tool: table.column("tool")?,
            position: three(["x_m", "y_m", "z_m"])?,
            orientation: [qx, qy, qz, table.column("qw")?],
            grip: table.column("grip")?,
            cut: table.column("cut")?,
            force: three(["fx_n", "fy_n", "fz_n"])?,
            contact: table.column("contact")?,
            depth: table.column("depth_m")?,
            event: table.column("event")?,
            grip_force: table.optional_column("grip_force_n")?,
        })
    }

    pub(super) fn tool_name<'r>(&self, row: &Row<'r>) -> Result<&'r str, Error> {
        match row.text(&self.tool) {
            "" => Err(row.bad(&self.tool, "the name of a tool")),
            name => Ok(name),
        }
    }

    pub(super) fn row(&self, row: &Row<'_>, tool: usize) -> Result<SessionRow, Error> {
        let finite = |column: &Column| row.number(column, Domain::FINITE);
        let three = |[x, y, z]: &[Column; 3]| -> Result<[f64; 3], Error> {
            Ok([finite(x)?, finite(y)?, finite(z)?])
        };
        let [qx, qy, qz, qw] = &self.orientation;
        Ok(SessionRow {
            time_s: finite(&self.time)?,
            tool,
            position_m: three(&self.position)?,
            orientation: [finite(qx)?, finite(qy)?, finite(qz)?, finite(qw)?],
            grip: row.number(&self.grip, Domain::FRACTION)?,
            cut: row.truth(&self.cut)?,
            force_n: three(&self.force)?,
            contact: row.truth(&self.contact)?,
            depth_m: finite(&self.depth)?,
            events: self.events(row)?,
            grip_force_n: self.grip_force.as_ref().map_or(Ok(0.0), finite)?,
        })
    }

    fn events(&self, row: &Row<'_>) -> Result<Events, Error> {
        Events::from_words(row.text(&self.event)).ok_or_else(|| {
            let words: Vec<_> = Event::WORDS.iter().map(|(word, _)| *word).collect();
            let expected = format!("events such as {}, with `;` between them", either(&words));
            row.bad(&self.event, expected)
        })
    }
}
