use std::ptr;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

use palpate_files::Pose;
use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace};

use crate::pointers::{self, Answer};
use crate::refused::Refused;
use crate::simulation::SimulationHandle;
use crate::status::{Status, answer};

/// All that a step changes. One thread at a time may use it; each may have one of its own.
pub struct StateHandle {
    pub(crate) simulation: Arc<Simulation>,
    own: Mutex<Own>,
}

/// It may go from thread to thread.
const _: fn() = || {
    fn wanders<T: Send + Sync>() {}
    wanders::<StateHandle>();
};

/// What one thread has while it uses a state.
pub(crate) struct Own {
    pub(crate) course: SavedState,
    pub(crate) workspace: SimulationWorkspace,
    /// Room for those of the next step.
    pub(crate) poses: Vec<Option<Pose>>,
    /// How often another course was put in the place of this one.
    pub(crate) restored: u32,
}

/// What is kept and restored.
#[derive(Clone)]
pub(crate) struct SavedState {
    pub(crate) state: SimulationState,
    /// Of the last step [s].
    pub(crate) time: Option<f64>,
    /// Whether the last cut is closed again before the next step.
    pub(crate) undo: bool,
}

impl SavedState {
    fn new(simulation: &Simulation) -> Self {
        Self {
            state: SimulationState::new(simulation),
            time: None,
            undo: false,
        }
    }
}

impl StateHandle {
    fn new(simulation: Arc<Simulation>, course: SavedState) -> Self {
        let own = Own {
            course,
            workspace: SimulationWorkspace::new(&simulation),
            poses: Vec::with_capacity(simulation.tools().len()),
            restored: 0,
        };
        Self {
            own: Mutex::new(own),
            simulation,
        }
    }

    /// What is behind it, if nobody else is there. It never waits.
    pub(crate) fn own(&self) -> Result<MutexGuard<'_, Own>, Refused> {
        self.own.try_lock().map_err(|reason| match reason {
            TryLockError::Poisoned(_) => Refused::Broken,
            TryLockError::WouldBlock => Refused::Busy,
        })
    }
}

/// Makes a state in which nothing was touched yet: `*state` has to be freed. It keeps what it needs of the simulation,
/// which may be freed before it. Where it is refused, `*state` is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_new(
    simulation: *const SimulationHandle,
    state: *mut *mut StateHandle,
) -> Status {
    answer(|| {
        let place = Answer::at(state, "state")?;
        // SAFETY: the header demands it of who calls.
        unsafe { place.put(0, ptr::null_mut()) };
        // SAFETY: the header demands it of who calls.
        let simulation = unsafe { pointers::borrowed(simulation, "simulation") }?;
        let simulation = Arc::clone(&simulation.simulation);
        let course = SavedState::new(&simulation);
        let made = pointers::handle(StateHandle::new(simulation, course));
        // SAFETY: the header demands it of who calls.
        unsafe { place.put(0, made) };
        Ok(())
    })
}

/// Makes a second state that is as `state` is now: to come back to (palpate_state_restore), or to go on from elsewhere.
/// `*copy` has to be freed. Where it is refused, `*copy` is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_clone(
    state: *const StateHandle,
    copy: *mut *mut StateHandle,
) -> Status {
    answer(|| {
        let place = Answer::at(copy, "copy")?;
        // SAFETY: the header demands it of who calls.
        unsafe { place.put(0, ptr::null_mut()) };
        // SAFETY: the header demands it of who calls.
        let state = unsafe { pointers::borrowed(state, "state") }?;
        let course = state.own()?.course.clone();
        let made = StateHandle::new(Arc::clone(&state.simulation), course);
        // SAFETY: the header demands it of who calls.
        unsafe { place.put(0, pointers::handle(made)) };
        Ok(())
    })
}

/// Makes `state` as `from` is now; both are states of one simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_restore(
    state: *mut StateHandle,
    from: *const StateHandle,
) -> Status {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        let (state, from) = unsafe {
            (
                pointers::borrowed(state, "state")?,
                pointers::borrowed(from, "from")?,
            )
        };
        if !Arc::ptr_eq(&state.simulation, &from.simulation) {
            return Err(Refused::OtherSimulation);
        }
        if ptr::eq(state, from) {
            return Ok(());
        }
        let course = from.own()?.course.clone();
        let mut own = state.own()?;
        own.course = course;
        own.restored = own.restored.wrapping_add(1);
        Ok(())
    })
}

/// Makes the organ whole and at rest, as if nothing had been touched yet; time begins anew.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_reset(state: *mut StateHandle) -> Status {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        let state = unsafe { pointers::borrowed(state, "state") }?;
        let course = &mut state.own()?.course;
        course.state.reset(&state.simulation);
        course.time = None;
        course.undo = false;
        Ok(())
    })
}

/// Closes the last cut again, in the next step, which tells so (PALPATE_EVENT_UNDO_CUT). Nothing happens where there is
/// none, or one is being made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_undo_cut(state: *mut StateHandle) -> Status {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        let state = unsafe { pointers::borrowed(state, "state") }?;
        state.own()?.course.undo = true;
        Ok(())
    })
}

/// Shapes the organ for the eye no more often than every `period_s` [s]; forces are those
/// of every step. 0, as it is at first: in each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_show_every(
    state: *mut StateHandle,
    period_s: f64,
) -> Status {
    answer(|| {
        let period = a_time("period_s", period_s)?;
        // SAFETY: the header demands it of who calls.
        let state = unsafe { pointers::borrowed(state, "state") }?;
        let course = &mut state.own()?.course;
        course.state = course.state.clone().show_every(period);
        Ok(())
    })
}

/// A finite time that is not negative [s].
pub(crate) fn a_time(name: &'static str, time: f64) -> Result<f64, Refused> {
    match time.is_finite() && time >= 0.0 {
        true => Ok(time),
        false => Err(Refused::NoTime { name, time }),
    }
}

/// Frees a state. Null is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_free(state: *mut StateHandle) {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        unsafe { pointers::free(state) };
        Ok(())
    });
}

#[cfg(test)]
mod tests {
    use palpate_files::Scene;

    use super::*;
    use crate::message::last;

    fn state() -> StateHandle {
        let text = "format = 1\norgan = { builtin = \"hemisphere\", builtin_tissue = \"pig-liver\" }\n\
                    tool = [{ name = \"right\", tip = { shape = \"flat\", radius_m = 0.001 } }]";
        let simulation = Simulation::new(&Scene::parse(text, "scene.toml").unwrap()).unwrap();
        let simulation = Arc::new(simulation);
        let course = SavedState::new(&simulation);
        StateHandle::new(simulation, course)
    }

    #[test]
    fn a_state_that_panicked_is_refused_and_can_be_freed() {
        let state = pointers::handle(state());
        let panicked = answer(|| {
            // SAFETY: it was made above.
            let _own = unsafe { pointers::borrowed(state, "state") }?.own()?;
            panic!("in the midst of it");
        });
        assert_eq!(panicked, Status::PalpateFailed);
        assert!(last().contains("in the midst of it"), "{}", last());
        // SAFETY: it was made above, and is freed last.
        unsafe {
            assert_eq!(palpate_state_reset(state), Status::PalpateFailed);
            assert!(last().contains("earlier call"), "{}", last());
            palpate_state_free(state);
        }
    }

    #[test]
    fn a_second_call_at_once_is_refused() {
        let state = state();
        let _first = state.own().unwrap();
        // SAFETY: it lives to the end.
        let second = unsafe { palpate_state_reset((&raw const state).cast_mut()) };
        assert_eq!(second, Status::PalpateBadInput);
        assert!(last().contains("another thread"), "{}", last());
    }
}
