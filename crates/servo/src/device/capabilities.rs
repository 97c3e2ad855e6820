use crate::{DeadMan, Vec3};

/// The properties of a device. Its frame is right-handed: x right, y up, z toward the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Capabilities {
    /// Its name.
    pub name: String,
    /// Least and greatest corner of its workspace [m]; none if unlimited.
    pub workspace: Option<[Vec3; 2]>,
    /// The largest force that it displays [N].
    pub peak_force: f64,
    /// The largest continuous force, which its motors bear without a time limit [N].
    pub continuous_force: f64,
    /// Its dead-man's switch; none for a device without one.
    pub dead_man: Option<DeadMan>,
    /// Bit mask of the stop buttons: they take off all forces of the session while pressed.
    pub stop_buttons: u32,
    /// Whether its forces reach a hand. A mouse accepts every force and displays none.
    pub displays_force: bool,
}

impl Capabilities {
    /// A device that accepts every force and displays none.
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

    /// A PHANTOM Premium 1.5: 8.5 N peak and 1.4 N continuous force, as its maker states.
    pub fn premium(name: &str) -> Self {
        Self {
            peak_force: 8.5,
            continuous_force: 1.4,
            displays_force: true,
            ..Self::without_force(name)
        }
    }
}
