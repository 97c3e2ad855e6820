use super::pose::normalised;
use super::{MotionRow, Pose, ToolMotion};
use crate::table::{Column, Row, TableText};
use crate::{Domain, Error};

/// The columns of a motion.
pub(super) struct Columns {
    pub(super) time: Column,
    pub(super) tool: Column,
    position: [Column; 3],
    orientation: Option<[Column; 4]>,
    grip: Option<Column>,
    cut: Option<Column>,
}

const NAMES: &[&str] = &[
    "time_s", "tool", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "grip", "cut",
];

impl Columns {
    pub(super) fn find(table: &TableText<'_>) -> Result<Self, Error> {
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

    pub(super) fn tool_name<'r>(&self, row: &Row<'r>) -> Result<&'r str, Error> {
        match row.text(&self.tool) {
            "" => Err(row.invalid(&self.tool, "the name of a tool of the scene")),
            name => Ok(name),
        }
    }

    /// A warning about positions that no tool over an organ has; none for usual ones.
    pub(super) fn warning(&self, tools: &[ToolMotion]) -> Option<String> {
        let farthest = |axis: usize| {
            let all = tools.iter().flat_map(ToolMotion::rows);
            let along = all.map(|row| row.pose.position_m[axis]);
            along.max_by(|a, b| a.abs().total_cmp(&b.abs()))
        };
        let mut columns = self.position.iter().enumerate();
        columns.find_map(|(axis, column)| column.warning(farthest(axis)?, Domain::POSITION))
    }

    pub(super) fn row(&self, row: &Row<'_>) -> Result<MotionRow, Error> {
        let time_s = row.number(&self.time, Domain::TIME)?;
        let [x, y, z] = &self.position;
        let finite = |column| row.number(column, Domain::FINITE);
        let place = |column| row.number(column, Domain::POSITION);
        let position_m = [place(x)?, place(y)?, place(z)?];
        let orientation = match &self.orientation {
            Some([x, y, z, w]) => {
                let q = [finite(x)?, finite(y)?, finite(z)?, finite(w)?];
                let expected = "a quaternion (qx, qy, qz, qw) that is not zero";
                Some(normalised(q).ok_or_else(|| row.invalid(x, expected))?)
            }
            None => None,
        };
        let grip = match &self.grip {
            Some(column) => row.number(column, Domain::FRACTION)?,
            None => 0.0,
        };
        let cut = match &self.cut {
            Some(column) => row.boolean(column)?,
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
