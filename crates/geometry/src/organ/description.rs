use std::fmt;

use crate::Vec3;

/// Description of a built-in organ, for placing tools. Displayed as a few lines of text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrganDescription {
    /// Summary in one sentence.
    pub summary: &'static str,
    /// Directions of x, y and z.
    pub axes: &'static str,
    /// Position of the origin.
    pub origin: &'static str,
    /// Its lengths, in words and numbers.
    pub lengths: &'static str,
    /// The part fixed by default.
    pub fixed: &'static str,
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
        write!(formatter, "fixed:   {}", self.fixed)
    }
}
