use std::ffi::{c_char, c_int, c_void};
use std::ops::ControlFlow;
use std::path::PathBuf;

use palpate_files::Scene;
use palpate_simulate::{Error, Progress, Resources, Simulation};

use crate::pointers;
use crate::refused::Refused;

/// Hears how far a long preparation is: what is being done, in words that are gone when it returns, and how much of it
/// is done, from 0 to 1. Other than 0 breaks it off. It is called by the thread that opens the scene, with the `data` of
/// the preparation. No exception may leave it.
pub type Watch =
    Option<unsafe extern "C" fn(work: *const c_char, part: f64, data: *mut c_void) -> c_int>;

/// What may be used to prepare a scene. All zero is as good as none: nobody listens, nothing is kept, eight gibibytes
/// may be used.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Preparation {
    /// Hears how far it is; may be null.
    pub watch: Watch,
    /// Is given to `watch`.
    pub data: *mut c_void,
    /// The folder in which responses of whole organs (`model.kind = "hybrid"`) are kept and looked for first; null:
    /// they are solved anew each time, which takes from seconds to minutes.
    pub responses: *const c_char,
    /// Memory [byte] that may be taken; what needs more is refused before it begins; 0: eight gibibytes.
    pub memory: u64,
}

/// Makes the simulation of `scene` with what is at `how`, which may be null.
///
/// # Safety
/// As of [`pointers::borrowed`] for `how` and its text; its function can be called with its data.
pub(crate) unsafe fn prepare(
    scene: &Scene,
    how: *const Preparation,
) -> Result<Simulation, Refused> {
    if how.is_null() {
        return Ok(Simulation::new(scene)?);
    }
    // SAFETY: the caller vouches.
    let how = unsafe { pointers::borrowed(how, "how") }?;
    let mut resources = Resources::default();
    if !how.responses.is_null() {
        // SAFETY: the caller vouches.
        let folder = unsafe { pointers::text(how.responses, "how.responses") }?;
        resources.responses = Some(PathBuf::from(folder));
    }
    if how.memory != 0 {
        resources.memory = usize::try_from(how.memory).unwrap_or(usize::MAX);
    }
    let mut cancelled = false;
    let simulation = Simulation::prepare(scene, &resources, &mut |Progress { work, part }| {
        let Some(watch) = how.watch else {
            return ControlFlow::Continue(());
        };
        let words = pointers::text_for_c(work.words());
        // SAFETY: the caller vouches for the function; the words live until it returns.
        cancelled |= unsafe { watch(words.as_ptr(), part, how.data) } != 0;
        match cancelled {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    })?;
    // Some work cannot be cancelled, and ends all the same.
    match cancelled {
        true => Err(Error::Model(palpate_mechanics::Error::Cancelled).into()),
        false => Ok(simulation),
    }
}
