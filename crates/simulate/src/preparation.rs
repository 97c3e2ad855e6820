use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_devices::Places;
use palpate_devices::publisher::Publisher;

use crate::Error;

/// What may be used to make a simulation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Resources {
    /// The folder in which responses of whole organs are kept, and looked for first; none: they are solved
    /// anew each time.
    pub responses: Option<PathBuf>,
    /// Memory [byte] that may be taken; what needs more is refused before it begins.
    pub memory: usize,
    /// Where services and libraries of haptic devices are looked for.
    pub devices: Places,
    /// Servers that send the running simulation to other programs.
    pub publishers: Vec<Publisher>,
}

/// Eight gibibytes.
const MEMORY: usize = 8 << 30;

impl Default for Resources {
    /// Nothing is kept, and eight gibibytes may be used.
    fn default() -> Self {
        Self {
            responses: None,
            memory: MEMORY,
            devices: Places::default(),
            publishers: Vec::new(),
        }
    }
}

/// Work that may take long while a simulation is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// The force of nonlinear tissue over depth.
    ForceOverDepth,
    /// A stored response of the whole organ is read.
    Reading,
    /// The influences of the organ's triangles on one another.
    Influences,
    /// The tetrahedra that fill the organ, and their equations.
    Tetrahedra,
    /// The factors of the equations.
    Factors,
    /// The answer to a force on each touchable triangle.
    Responses,
    /// The response is stored.
    Storing,
}

impl Work {
    /// What is being done, for people.
    pub fn words(self) -> &'static str {
        match self {
            Self::ForceOverDepth => "the tissue's force over depth",
            Self::Reading => "the organ's stored response",
            Self::Influences => "the organ's response: influences",
            Self::Tetrahedra => "the organ's response: tetrahedra",
            Self::Factors => "the organ's response: factors",
            Self::Responses => "the organ's response: a force on each triangle",
            Self::Storing => "storing the organ's response",
        }
    }
}

/// How far the making of a simulation is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub work: Work,
    /// How much of it is done [-]; of a response, how much of all its works.
    pub part: f64,
}

impl Progress {
    /// At the beginning of a work that is told alone.
    pub(crate) fn begin(work: Work) -> Self {
        Self { work, part: 0.0 }
    }
}

/// Tells what is begun; an error when it shall not be.
pub(crate) fn tell(
    watch: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    progress: Progress,
) -> Result<(), Error> {
    match watch(progress) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(palpate_mechanics::Error::BrokenOff.into()),
    }
}
