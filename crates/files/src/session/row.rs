use std::fmt::{self, Write};

use super::Events;
use crate::table::field;

/// A tool in a step of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessionRow {
    /// The time [s].
    pub time_s: f64,
    /// Number of the tool in the scene, from zero.
    pub tool: usize,
    /// The tip in the scene's frame, after any fulcrum [m].
    pub position_m: [f64; 3],
    /// The quaternion (qx, qy, qz, qw) that maps tool to scene [-].
    pub orientation: [f64; 4],
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Whether the tool cuts.
    pub cut: bool,
    /// The force on the tool [N].
    pub force_n: [f64; 3],
    /// The torque on the tool about its tip [N m].
    pub torque_nm: [f64; 3],
    /// Whether the tool touches the organ.
    pub contact: bool,
    /// Depth of the tip below the rest surface [m]; 0 without contact.
    pub depth_m: f64,
    /// The events.
    pub events: Events,
    /// The force of each of its jaws on the tissue that it holds [N]; 0 without.
    pub grip_force_n: f64,
    /// The diameter that the trainee stated for the target [m].
    pub stated_diameter_m: Option<f64>,
}

/// The names of the columns, as written above the rows.
pub(super) const COLUMNS: &str = "time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut,\
                                  fx_n,fy_n,fz_n,tx_nm,ty_nm,tz_nm,contact,depth_m,event,grip_force_n";

/// The names of the columns in sessions without torques.
pub(super) const COLUMNS_WITHOUT_TORQUE: &str = "time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut,\
                                                 fx_n,fy_n,fz_n,contact,depth_m,event,grip_force_n";

/// Precedes the diameter in the column `event`, the only value there.
pub(super) const STATED_DIAMETER: &str = "stated_diameter_m=";

impl SessionRow {
    /// The first number of the row that is not finite, with its column.
    pub(super) fn not_finite(&self) -> Option<(&'static str, f64)> {
        self.numbers()
            .into_iter()
            .find(|(_, value)| !value.is_finite())
    }

    fn numbers(&self) -> [(&'static str, f64); 18] {
        let ([x, y, z], [fx, fy, fz]) = (self.position_m, self.force_n);
        let [tx, ty, tz] = self.torque_nm;
        let [qx, qy, qz, qw] = self.orientation;
        [
            ("time_s", self.time_s),
            ("x_m", x),
            ("y_m", y),
            ("z_m", z),
            ("qx", qx),
            ("qy", qy),
            ("qz", qz),
            ("qw", qw),
            ("grip", self.grip),
            ("fx_n", fx),
            ("fy_n", fy),
            ("fz_n", fz),
            ("tx_nm", tx),
            ("ty_nm", ty),
            ("tz_nm", tz),
            ("depth_m", self.depth_m),
            ("grip_force_n", self.grip_force_n),
            ("event", self.stated_diameter_m.unwrap_or(0.0)),
        ]
    }

    /// Adds the row to a text. The same numbers are always the same text: each is printed with the
    /// fewest digits that read back to it.
    pub(super) fn print(&self, tool: &str, text: &mut String) -> fmt::Result {
        self.print_with(tool, true, text)
    }

    /// The same with or without torques.
    pub(super) fn print_with(
        &self,
        tool: &str,
        has_torques: bool,
        text: &mut String,
    ) -> fmt::Result {
        write!(text, "{:?},{}", self.time_s, field(tool))?;
        for value in self.position_m.iter().chain(&self.orientation) {
            write!(text, ",{value:?}")?;
        }
        write!(text, ",{:?},{}", self.grip, u8::from(self.cut))?;
        let torque = if has_torques {
            &self.torque_nm[..]
        } else {
            &[]
        };
        for value in self.force_n.iter().chain(torque) {
            write!(text, ",{value:?}")?;
        }
        let contact = u8::from(self.contact);
        write!(text, ",{contact},{:?},{}", self.depth_m, self.event_text())?;
        writeln!(text, ",{:?}", self.grip_force_n)
    }

    /// The text of the column `event`: the events, and after them the stated diameter, with `;` between them.
    pub fn event_text(&self) -> String {
        let mut text = self.events.to_string();
        if let Some(diameter) = self.stated_diameter_m {
            let separator = if text.is_empty() { "" } else { ";" };
            text += &format!("{separator}{STATED_DIAMETER}{diameter:?}");
        }
        text
    }
}
