use super::Pose;
use crate::Error;

/// A tool's pose at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionRow {
    /// The time [s].
    pub time_s: f64,
    /// The pose at that time.
    pub pose: Pose,
}

/// The motion of one tool: at least one row, in the order of time.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolMotion {
    name: String,
    rows: Vec<MotionRow>,
}

/// Stores the place of the last look-up in a motion, so that stepping forward needs no search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cursor {
    row: usize,
}

impl ToolMotion {
    /// The motion of the tool called `name`. Quaternions are normalized.
    ///
    /// # Errors
    /// When the name is empty, there is no row, a number is not finite, the time does not grow, a
    /// quaternion is zero or a grip is outside 0 to 1.
    pub fn new(name: &str, mut rows: Vec<MotionRow>) -> Result<Self, Error> {
        let wrong = |what: String, found: String, expected: &'static str| Error::BadContent {
            what,
            found,
            expected: expected.into(),
        };
        if name.trim().is_empty() || name.trim() != name {
            let expected = "a name that is not empty, without spaces at its ends";
            return Err(wrong(
                "a tool's name".to_owned(),
                format!("{name:?}"),
                expected,
            ));
        }
        if rows.is_empty() {
            let what = format!("the motion of {name}");
            return Err(wrong(what, "empty".to_owned(), "at least one row"));
        }
        let mut previous = f64::NEG_INFINITY;
        for (number, row) in rows.iter_mut().enumerate() {
            check(row, previous).map_err(|expected| {
                let what = format!("row {number} of the motion of {name}");
                wrong(what, format!("{row:?}"), expected)
            })?;
            previous = row.time_s;
        }
        Ok(Self {
            name: name.to_owned(),
            rows,
        })
    }

    pub(super) fn without_rows(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            rows: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, row: MotionRow) {
        self.rows.push(row);
    }

    /// The tool's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The rows.
    pub fn rows(&self) -> &[MotionRow] {
        &self.rows
    }

    /// The time of the first row [s].
    pub fn first_time_s(&self) -> f64 {
        self.rows.first().map_or(f64::INFINITY, |row| row.time_s)
    }

    /// Whether a pose is in the box around those of all rows.
    pub(super) fn is_in_box(&self, pose: &Pose) -> bool {
        let axis = |row: &MotionRow, axis: usize| row.pose.position_m[axis];
        (0..3).all(|k| {
            let at = pose.position_m[k];
            self.rows.iter().any(|row| axis(row, k) <= at)
                && self.rows.iter().any(|row| axis(row, k) >= at)
        })
    }

    pub(super) fn last_time_s(&self) -> Option<f64> {
        self.rows.last().map(|row| row.time_s)
    }

    /// Pose of the tool at `time_s` [s]: none before the first row; after the last row it rests. Allocates nothing.
    /// With the `cursor` of the last look-up, a later time costs no search.
    pub fn pose(&self, time_s: f64, cursor: &mut Cursor) -> Option<Pose> {
        let started = |row: &MotionRow| row.time_s <= time_s;
        if !self.rows.get(cursor.row).is_some_and(started) {
            // Back in time, or a cursor of another motion.
            cursor.row = self.rows.partition_point(started).checked_sub(1)?;
        }
        while self.rows.get(cursor.row + 1).is_some_and(started) {
            cursor.row += 1;
        }
        let earlier = &self.rows[cursor.row];
        let Some(later) = self.rows.get(cursor.row + 1) else {
            return Some(earlier.pose);
        };
        let part = (time_s - earlier.time_s) / (later.time_s - earlier.time_s);
        // Exactly at the time of a row, returns the row itself, to the last bit.
        Some(if part > 0.0 {
            earlier.pose.towards(&later.pose, part)
        } else {
            earlier.pose
        })
    }
}

fn check(row: &mut MotionRow, previous: f64) -> Result<(), &'static str> {
    if !row.time_s.is_finite() || row.time_s <= previous {
        return Err("a time after that of the row before");
    }
    row.pose = row.pose.checked()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(time_s: f64, x: f64) -> MotionRow {
        let pose = Pose {
            position_m: [x, 0.0, 0.0],
            orientation: None,
            grip: x,
            cut: x > 0.4,
        };
        MotionRow { time_s, pose }
    }

    #[test]
    fn linear_between_rows_and_at_rest_after_them() {
        let rows = vec![row(1.0, 0.0), row(2.0, 0.5), row(4.0, 1.0)];
        let motion = ToolMotion::new("right", rows).unwrap();
        let mut cursor = Cursor::default();
        assert_eq!(motion.pose(0.9, &mut cursor), None);
        let x = |time, cursor: &mut Cursor| motion.pose(time, cursor).unwrap().position_m[0];
        assert_eq!(x(1.0, &mut cursor), 0.0);
        assert_eq!(x(1.5, &mut cursor), 0.25);
        assert!(!motion.pose(1.999, &mut cursor).unwrap().cut);
        assert!(motion.pose(2.0, &mut cursor).unwrap().cut);
        assert_eq!(x(3.0, &mut cursor), 0.75);
        assert_eq!(x(9.0, &mut cursor), 1.0);
        assert_eq!(x(1.5, &mut cursor), 0.25, "the cursor goes back too");
    }

    #[test]
    fn a_motion_that_goes_back_is_refused() {
        let error = ToolMotion::new("right", vec![row(1.0, 0.0), row(1.0, 0.1)]).unwrap_err();
        assert!(
            error.to_string().contains("row 1 of the motion of right"),
            "{error}"
        );
        assert!(ToolMotion::new(" ", vec![row(1.0, 0.0)]).is_err());
        assert!(ToolMotion::new("right", Vec::new()).is_err());
    }
}
