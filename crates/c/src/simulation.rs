use std::ffi::{CString, c_char};
use std::ptr;
use std::sync::Arc;

use palpate_files::Scene;
use palpate_simulate::Simulation;

use crate::pointers::{self, Answer};
use crate::preparation::{self, Preparation};
use crate::refused::Refused;
use crate::status::{Status, answer, or_else};

/// An organ and the tools that may touch it. It never changes: any number of threads may use it.
pub struct SimulationHandle {
    pub(crate) simulation: Arc<Simulation>,
    tools: Vec<CString>,
    warnings: Vec<CString>,
}

/// Any number of threads may use it.
const _: fn() = || {
    fn shared<T: Send + Sync>() {}
    shared::<SimulationHandle>();
};

/// Reads the scene file `path` and prepares it: `*simulation` has to be freed. `how` may be null. Where it is refused,
/// `*simulation` is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_simulation_open(
    path: *const c_char,
    how: *const Preparation,
    simulation: *mut *mut SimulationHandle,
) -> Status {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        unsafe {
            open(how, simulation, || {
                Ok(Scene::read(pointers::text(path, "path")?)?)
            })
        }
    })
}

/// The same for the text of a scene. `name` is its name in errors, and relative paths in it begin in its folder.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_simulation_open_text(
    text: *const c_char,
    name: *const c_char,
    how: *const Preparation,
    simulation: *mut *mut SimulationHandle,
) -> Status {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        unsafe {
            open(how, simulation, || {
                let name = pointers::text(name, "name")?;
                Ok(Scene::parse(pointers::text(text, "text")?, name)?)
            })
        }
    })
}

/// # Safety
/// As of [`preparation::prepare`], and `simulation` is null, crooked or a place for a pointer.
unsafe fn open(
    how: *const Preparation,
    simulation: *mut *mut SimulationHandle,
    scene: impl FnOnce() -> Result<Scene, Refused>,
) -> Result<(), Refused> {
    let place = Answer::at(simulation, "simulation")?;
    // SAFETY: the caller vouches.
    unsafe { place.put(0, ptr::null_mut()) };
    let scene = palpate_simulate::draw_variant(&scene()?, 0)?;
    // SAFETY: the caller vouches.
    let simulation = unsafe { preparation::prepare(&scene, how) }?;
    let texts = |texts: &mut dyn Iterator<Item = &String>| {
        texts.map(|text| pointers::text_for_c(text)).collect()
    };
    let handle = SimulationHandle {
        tools: texts(&mut simulation.tools().iter().map(|tool| &tool.name)),
        warnings: texts(&mut simulation.warnings().iter()),
        simulation: Arc::new(simulation),
    };
    // SAFETY: the caller vouches.
    unsafe { place.put(0, pointers::handle(handle)) };
    Ok(())
}

/// Frees a simulation; its states go on. Null is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_simulation_free(simulation: *mut SimulationHandle) {
    answer(|| {
        // SAFETY: the header demands it of who calls.
        unsafe { pointers::free(simulation) };
        Ok(())
    });
}

/// How many tools the scene has; 0 for a null pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_tool_count(simulation: *const SimulationHandle) -> usize {
    // SAFETY: the header demands it of who calls.
    unsafe { with_simulation(simulation, 0, |own| own.tools.len()) }
}

/// The name of a tool, counted from 0 in the scene's order, for as long as the simulation lives; null where there is
/// none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_tool_name(
    simulation: *const SimulationHandle,
    tool: usize,
) -> *const c_char {
    // SAFETY: the header demands it of who calls.
    unsafe { with_simulation(simulation, ptr::null(), |own| text_of(&own.tools, tool)) }
}

/// The number of warnings about this scene; 0 for a null pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_warning_count(simulation: *const SimulationHandle) -> usize {
    // SAFETY: the header demands it of who calls.
    unsafe { with_simulation(simulation, 0, |own| own.warnings.len()) }
}

/// A warning, counted from 0, one sentence; valid for as long as the simulation lives; null where there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_warning(
    simulation: *const SimulationHandle,
    number: usize,
) -> *const c_char {
    // SAFETY: the header demands it of who calls.
    unsafe {
        with_simulation(simulation, ptr::null(), |own| {
            text_of(&own.warnings, number)
        })
    }
}

/// The step [s] that the scene asks for, `model.step_s`; 0 for a null pointer. Steps of other lengths are as good.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_step_length(simulation: *const SimulationHandle) -> f64 {
    // SAFETY: the header demands it of who calls.
    unsafe { with_simulation(simulation, 0.0, |own| own.simulation.step()) }
}

/// The factor [-] by which the scene wants forces felt, `model.force_scale`; the forces of a step are without it. 0 for
/// a null pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_force_scale(simulation: *const SimulationHandle) -> f64 {
    // SAFETY: the header demands it of who calls.
    unsafe { with_simulation(simulation, 0.0, |own| own.simulation.force_scale()) }
}

fn text_of(texts: &[CString], number: usize) -> *const c_char {
    texts.get(number).map_or(ptr::null(), |text| text.as_ptr())
}

/// What `tell` says of a simulation, or `otherwise`.
///
/// # Safety
/// As of [`pointers::borrowed`].
pub(crate) unsafe fn with_simulation<T>(
    simulation: *const SimulationHandle,
    otherwise: T,
    tell: impl FnOnce(&SimulationHandle) -> T,
) -> T {
    let call = || {
        // SAFETY: the caller vouches.
        let own = unsafe { pointers::borrowed(simulation, "simulation") }?;
        Ok(tell(own))
    };
    or_else(otherwise, call).0
}
