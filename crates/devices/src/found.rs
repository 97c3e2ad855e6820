use palpate_servo::Capabilities;

/// Where a number of a device comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// The device said it.
    Device,
    /// It is ours, and cautious, for neither the device nor its documents say it.
    Ours,
}

/// A device that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Its number among those of its kind, from zero on.
    pub number: usize,
    /// Its model, as its service or library calls it.
    pub model: String,
    /// Its serial number or name.
    pub serial: String,
    /// What else is known of it, a short sentence each.
    pub remarks: Vec<String>,
    /// Its limits.
    pub capabilities: Capabilities,
    /// Where the limits of its forces come from.
    pub forces: Origin,
}
