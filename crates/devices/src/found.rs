use palpate_servo::Capabilities;

/// The source of a device's force limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// The device reports it.
    Device,
    /// It is our conservative assumption: neither the device nor its documentation states it.
    Assumed,
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
    /// Further facts, a short sentence each.
    pub remarks: Vec<String>,
    /// Its limits.
    pub capabilities: Capabilities,
    /// The source of its force limits.
    pub forces: Origin,
}
