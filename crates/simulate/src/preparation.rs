use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_devices::Places;
use palpate_devices::publisher::Publisher;

use crate::Error;

/// Resources for making a simulation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Resources {
    /// The folder of stored responses of whole organs, which is searched first; none: they are solved anew each time.
    pub responses: Option<PathBuf>,
    /// The memory limit [byte]; a model that needs more is rejected before it begins.
    pub memory: usize,
    /// Where to look for services and libraries of haptic devices.
    pub devices: Places,
    /// Servers that send the running simulation to other programs.
    pub publishers: Vec<Publisher>,
}

/// Eight gibibytes.
const MEMORY: usize = 8 << 30;

impl Default for Resources {
    /// Stores nothing, and uses up to eight gibibytes.
    fn default() -> Self {
        Self {
            responses: None,
            memory: MEMORY,
            devices: Places::default(),
            publishers: Vec::new(),
        }
    }
}

/// Long work while a simulation is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Work {
    /// The force of nonlinear tissue over depth.
    ForceOverDepth,
    /// Reading a stored response of the whole organ.
    Reading,
    /// The influences of the organ's triangles on one another.
    Influences,
    /// The tetrahedra that fill the organ, and their equations.
    Tetrahedra,
    /// The factors of the equations.
    Factors,
    /// The response to a force on each touchable triangle.
    Responses,
    /// Storing the response.
    Storing,
}

impl Work {
    /// A description for people.
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

/// The progress of making a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The current work.
    pub work: Work,
    /// The completed part of it [-]; for a response, of all its works.
    pub part: f64,
}

impl Progress {
    /// The beginning of a work that reports no parts.
    pub(crate) fn begin(work: Work) -> Self {
        Self { work, part: 0.0 }
    }
}

/// Reports the beginning of a work; an error if it is cancelled.
pub(crate) fn report_progress(
    on_progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    progress: Progress,
) -> Result<(), Error> {
    match on_progress(progress) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(palpate_mechanics::Error::Cancelled.into()),
    }
}
