use crate::{DeadMan, Vec3};

/// What a device is. Its frame is right-handed: x right, y up, z toward the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Capabilities {
    /// Its name.
    pub name: String,
    /// Least and greatest corner of where its handle can go [m]; none for everywhere.
    pub workspace: Option<[Vec3; 2]>,
    /// The largest force that it displays [N].
    pub peak_force: f64,
    /// The largest that its motors bear for as long as one likes [N].
    pub continuous_force: f64,
    /// What a hand holds while it wants forces; none where there is no such switch.
    pub dead_man: Option<DeadMan>,
    /// Bit by bit, which of its buttons take all forces of the session off for as long as one is pressed.
    pub stop_buttons: u32,
    /// Whether its forces reach a hand. A mouse takes every force and displays none.
    pub displays_force: bool,
}

impl Capabilities {
    /// One that takes every force and displays none.
    pub fn without_force(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            workspace: None,
            peak_force: f64::INFINITY,
            continuous_force: f64::INFINITY,
            dead_man: None,
            stop_buttons: 0,
            displays_force: false,
        }
    }

    /// A PHANTOM Premium 1.5: 8.5 N, and 1.4 N for as long as one likes, as its maker states.
    pub fn premium(name: &str) -> Self {
        Self {
            peak_force: 8.5,
            continuous_force: 1.4,
            displays_force: true,
            ..Self::without_force(name)
        }
    }
}
