use crate::Status;

/// Why a call cannot be done.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refused {
    /// A pointer is null.
    #[error("`{name}` is a null pointer; give one to what the header says")]
    Null {
        /// The parameter.
        name: &'static str,
    },
    /// A pointer is not where such a thing can be.
    #[error(
        "`{name}` does not lie where its type can; give a pointer to a variable or an array of that type"
    )]
    NotAUnitVector {
        /// The parameter.
        name: &'static str,
    },
    /// A text is not UTF-8.
    #[error("`{name}` is not UTF-8; give it in that encoding")]
    NotText {
        /// The parameter.
        name: &'static str,
    },
    /// There is not one pose for each tool.
    #[error(
        "the scene has {known}, but {given} were given; give one for each, in the scene's order (`is_there` is 0 where \
         there is none)",
        known = counted(*known, "tool"),
        given = counted(*given, "pose")
    )]
    OtherTools {
        /// Of the scene.
        known: usize,
        /// Poses.
        given: usize,
    },
    /// A place is none.
    #[error("the position of tool {tool} is {position:?}; give three finite numbers, in metres")]
    NoPosition {
        /// Its number, from zero.
        tool: usize,
        /// What was given [m].
        position: [f64; 3],
    },
    /// A quaternion turns nowhere.
    #[error(
        "the orientation of tool {tool} is {orientation:?}; give a quaternion (qx, qy, qz, qw) of length 1, or set \
         `has_orientation` to 0"
    )]
    NoOrientation {
        /// Its number, from zero.
        tool: usize,
        /// What was given [-].
        orientation: [f64; 4],
    },
    /// Jaws are more than open or shut.
    #[error("the grip of tool {tool} is {grip}; give a number from 0, open, to 1, shut")]
    NoGrip {
        /// Its number, from zero.
        tool: usize,
        /// What was given [-].
        grip: f64,
    },
    /// A time is none.
    #[error("`{name}` is {time}; give a finite number of seconds that is not negative")]
    NoTime {
        /// The parameter.
        name: &'static str,
        /// What was given [s].
        time: f64,
    },
    /// The clock goes back.
    #[error(
        "the time goes back from {was} s to {is} s; give times that never become less, or reset or restore the state \
         before"
    )]
    TimeGoesBack {
        /// Of the last step [s].
        was: f64,
        /// Of this one [s].
        is: f64,
    },
    /// A state of another organ.
    #[error("the states belong to two simulations; restore a state from one of its own simulation")]
    OtherSimulation,
    /// Two calls at once.
    #[error(
        "the state is in use by another thread; use it in one at a time, or give each thread a state of its own"
    )]
    Busy,
    /// An earlier panic left it as it was.
    #[error(
        "an earlier call on this state panicked, and the state is not valid; free it and make a new one"
    )]
    Broken,
    /// A defect here.
    #[error("palpate panicked ({said}); report it as a defect, with the scene and what was done")]
    Panicked {
        /// What the panic said.
        said: String,
    },
    /// The scene cannot be read.
    #[error(transparent)]
    File(#[from] palpate_files::Error),
    /// The scene cannot be simulated.
    #[error(transparent)]
    Simulation(#[from] palpate_simulate::Error),
}

impl Refused {
    pub(crate) fn status(&self) -> Status {
        let is_input = match self {
            Self::File(error) => error.is_input(),
            Self::Simulation(error) => error.is_input(),
            Self::Broken | Self::Panicked { .. } => false,
            Self::Null { .. }
            | Self::NotAUnitVector { .. }
            | Self::NotText { .. }
            | Self::OtherTools { .. }
            | Self::NoPosition { .. }
            | Self::NoOrientation { .. }
            | Self::NoGrip { .. }
            | Self::NoTime { .. }
            | Self::TimeGoesBack { .. }
            | Self::OtherSimulation
            | Self::Busy => true,
        };
        match is_input {
            true => Status::PalpateBadInput,
            false => Status::PalpateFailed,
        }
    }
}

fn counted(number: usize, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {what}{plural}")
}
