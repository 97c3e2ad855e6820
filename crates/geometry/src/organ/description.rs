use std::fmt;

use crate::Vec3;

/// What a user has to know to place tools at a built-in organ. Displayed as a few lines of text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrganDescription {
    /// What it is, in one sentence.
    pub summary: &'static str,
    /// Where x, y and z point.
    pub axes: &'static str,
    /// Where the origin lies.
    pub origin: &'static str,
    /// Its lengths, in words and numbers.
    pub lengths: &'static str,
    /// What holds it by default.
    pub held: &'static str,
    /// Size along x, y and z of a fine mesh [m].
    pub extent: Vec3,
    /// Enclosed volume of a fine mesh [m³].
    pub volume: f64,
}

/// The axes of the organs; those of a patient who lies on the back, seen from the front.
pub(super) const PATIENT_AXES: &str =
    "x to the patient's left, y to the back, z to the head; a camera in front looks along +y";

impl fmt::Display for OrganDescription {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(formatter, "{}", self.summary)?;
        writeln!(formatter, "axes:    {}", self.axes)?;
        writeln!(formatter, "origin:  {}", self.origin)?;
        writeln!(formatter, "lengths: {}", self.lengths)?;
        let mm = self.extent * 1e3;
        writeln!(
            formatter,
            "extent:  {:.1} x {:.1} x {:.1} mm along x, y, z; volume {:.4} l",
            mm.x,
            mm.y,
            mm.z,
            self.volume * 1e3
        )?;
        write!(formatter, "held:    {}", self.held)
    }
}
