use super::row::STATED_DIAMETER;
use super::{Event, Events, SessionRow};
use crate::table::{Column, Row, TableText};
use crate::words::or_list;
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
    /// Sessions before there were torques have none.
    pub(super) torque: Option<[Column; 3]>,
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
            torque: match table.optional_column("tx_nm")? {
                Some(_) => Some(three(["tx_nm", "ty_nm", "tz_nm"])?),
                None => None,
            },
            contact: table.column("contact")?,
            depth: table.column("depth_m")?,
            event: table.column("event")?,
            grip_force: table.optional_column("grip_force_n")?,
        })
    }

    pub(super) fn tool_name<'r>(&self, row: &Row<'r>) -> Result<&'r str, Error> {
        match row.text(&self.tool) {
            "" => Err(row.invalid(&self.tool, "the name of a tool")),
            name => Ok(name),
        }
    }

    pub(super) fn row(&self, row: &Row<'_>, tool: usize) -> Result<SessionRow, Error> {
        let finite = |column: &Column| row.number(column, Domain::FINITE);
        let three = |[x, y, z]: &[Column; 3]| -> Result<[f64; 3], Error> {
            Ok([finite(x)?, finite(y)?, finite(z)?])
        };
        let [qx, qy, qz, qw] = &self.orientation;
        let (events, stated_diameter_m) = self.events(row)?;
        Ok(SessionRow {
            time_s: finite(&self.time)?,
            tool,
            position_m: three(&self.position)?,
            orientation: [finite(qx)?, finite(qy)?, finite(qz)?, finite(qw)?],
            grip: row.number(&self.grip, Domain::FRACTION)?,
            cut: row.boolean(&self.cut)?,
            force_n: three(&self.force)?,
            torque_nm: self.torque.as_ref().map_or(Ok([0.0; 3]), three)?,
            contact: row.boolean(&self.contact)?,
            depth_m: finite(&self.depth)?,
            events,
            grip_force_n: self.grip_force.as_ref().map_or(Ok(0.0), finite)?,
            stated_diameter_m,
        })
    }

    /// The events, and the diameter that stands after them [m].
    fn events(&self, row: &Row<'_>) -> Result<(Events, Option<f64>), Error> {
        let text = row.text(&self.event);
        let (words, stated) = match text.split_once(STATED_DIAMETER) {
            None => (text, None),
            Some((words, number)) => {
                let number: Option<f64> = number.trim().parse().ok();
                let diameter = number.filter(|own| own.is_finite() && *own > 0.0);
                let diameter = diameter.ok_or_else(|| {
                    let expected = format!("a length [m] above 0 after `{STATED_DIAMETER}`");
                    row.invalid(&self.event, expected)
                })?;
                (words, Some(diameter))
            }
        };
        let events = Events::from_words(words).ok_or_else(|| {
            let words: Vec<_> = Event::WORDS.iter().map(|(word, _)| *word).collect();
            let expected = format!("events such as {}, with `;` between them", or_list(&words));
            row.invalid(&self.event, expected)
        })?;
        Ok((events, stated))
    }
}
