//! The organ to be drawn, where it lies: nothing is copied.

use std::ptr;

use palpate_geometry::{NodeId, TriangleMesh, Vec3};

use crate::pointers::{self, Answer};
use crate::simulation::{SimulationHandle, with_simulation};
use crate::state::{Own, StateHandle};
use crate::status::{Status, answer};

// A vertex is its three numbers, a corner its one: both are transparent about them.
const _: () = assert!(size_of::<Vec3>() == 3 * size_of::<f64>());
const _: () = assert!(size_of::<[NodeId; 3]>() == 3 * size_of::<u32>());

/// The triangles of an organ. The arrays are the library's own, to be read only.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceView {
    /// x, y, z of each vertex in the scene's frame [m].
    pub vertices_m: *const f64,
    /// How many vertices there are.
    pub vertices: usize,
    /// The three vertices of each triangle, counter-clockwise seen from outside, counted from 0.
    pub corners: *const u32,
    /// How many triangles there are.
    pub triangles: usize,
    /// Another number whenever the triangles of a state are others; 0: they are those at rest, nothing is cut.
    pub version: u64,
}

impl SurfaceView {
    fn new(vertices: &[Vec3], triangles: &[[NodeId; 3]], version: u64) -> Self {
        Self {
            vertices_m: vertices.as_ptr().cast(),
            vertices: vertices.len(),
            corners: triangles.as_ptr().cast(),
            triangles: triangles.len(),
            version,
        }
    }

    fn of(mesh: &TriangleMesh) -> Self {
        Self::new(mesh.vertices(), mesh.triangles(), 0)
    }
}

/// The organ at rest, for as long as the simulation lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_simulation_surface(
    simulation: *const SimulationHandle,
    surface: *mut SurfaceView,
) -> Status {
    answer(|| {
        let place = Answer::at(surface, "surface")?;
        // SAFETY: the header demands it of who calls.
        let own = unsafe { pointers::borrowed(simulation, "simulation") }?;
        let seen = SurfaceView::of(own.simulation.surface().mesh());
        // SAFETY: the header demands it of who calls.
        unsafe { place.put(0, seen) };
        Ok(())
    })
}

/// x, y, z of the unit outward normal at each vertex of the organ at rest [-], for as long as the simulation lives; null
/// for a null pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_simulation_normals(
    simulation: *const SimulationHandle,
) -> *const f64 {
    let normals = |own: &SimulationHandle| own.simulation.surface().vertex_normals().as_ptr();
    // SAFETY: the header demands it of who calls.
    unsafe { with_simulation(simulation, ptr::null(), normals) }.cast()
}

/// The organ as it is deformed and cut now, until the next call that changes the state. Uncut it has the vertices and
/// triangles of the organ at rest, in their order; a cut changes some and adds others.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn palpate_state_surface(
    state: *const StateHandle,
    surface: *mut SurfaceView,
) -> Status {
    answer(|| {
        let place = Answer::at(surface, "surface")?;
        // SAFETY: the header demands it of who calls.
        let state = unsafe { pointers::borrowed(state, "state") }?;
        let seen = state.own()?.surface();
        // SAFETY: the header demands it of who calls.
        unsafe { place.put(0, seen) };
        Ok(())
    })
}

impl Own {
    fn surface(&self) -> SurfaceView {
        let state = &self.course.state;
        match state.cuts.as_ref().filter(|cuts| cuts.has_openings()) {
            Some(cuts) => {
                // A restored state may have cut other triangles under the same number.
                let version = u64::from(self.restored) << 32 | cuts.version() & 0xffff_ffff;
                SurfaceView::new(cuts.places(), cuts.triangles(), version + 1)
            }
            None => SurfaceView::of(&state.deformed),
        }
    }
}
