//! Calls as a careful program in C makes them.

use std::ffi::{CStr, CString};
use std::ptr;

use palpate_c::*;

/// A hemisphere of 50 mm and one probe.
pub(crate) const HEMISPHERE: &str = "format = 1\n\
    organ = { builtin = \"hemisphere\", builtin_tissue = \"pig-liver\" }\n\
    tool = [{ name = \"right\", tip = { shape = \"flat\", radius_m = 0.001 } }]\n";

/// A cube of 0.1 m, whose upper side is at z = 0.05, and a hook.
pub(crate) const CUBE_UNDER_A_HOOK: &str = "format = 1\n\
    organ = { builtin = \"cube\", triangles = 3072, builtin_tissue = \"pig-liver\" }\n\
    cutting = { toughness_j_per_m2 = 1.0 }\n\
    tool = [{ name = \"right\", kind = \"hook\", tip = { shape = \"flat\", radius_m = 0.001 } }]\n";

/// A kidney that answers as a whole, between a grasper and a probe.
pub(crate) const KIDNEY: &str = "format = 1\n\
    [organ]\nbuiltin = \"kidney\"\nbuiltin_tissue = \"pig-liver\"\n\
    [model]\nkind = \"hybrid\"\nmechanical_triangles = 400\n\
    [[tool]]\nname = \"left\"\nkind = \"grasper\"\ntip = { shape = \"flat\", radius_m = 0.001 }\n\
    [[tool]]\nname = \"right\"\ntip = { shape = \"sphere\", radius_m = 0.002, contact = \"slip\" }\n";

pub(crate) const NOBODY: ToolPose = ToolPose {
    position_m: [0.0; 3],
    orientation: [0.0; 4],
    grip: 0.0,
    is_there: 0,
    has_orientation: 0,
    cut: 0,
};

pub(crate) fn at(position_m: [f64; 3]) -> ToolPose {
    ToolPose {
        position_m,
        is_there: 1,
        ..NOBODY
    }
}

pub(crate) fn message() -> String {
    // SAFETY: a text that ends with a zero.
    let message = unsafe { CStr::from_ptr(palpate_error_message()) };
    message.to_str().unwrap().to_owned()
}

/// A simulation that is freed in the end.
#[derive(Debug)]
pub(crate) struct Model(pub(crate) *mut SimulationHandle);

// SAFETY: any number of threads may use it.
unsafe impl Sync for Model {}

impl Model {
    pub(crate) fn open(text: &str, how: *const Preparation) -> Result<Self, Status> {
        let text = CString::new(text).unwrap();
        let mut handle = ptr::dangling_mut();
        // SAFETY: texts that end with a zero, a variable for the pointer.
        let status = unsafe {
            palpate_simulation_open_text(text.as_ptr(), c"scene.toml".as_ptr(), how, &mut handle)
        };
        match status {
            Status::PalpateOk => Ok(Self(handle)),
            refused => {
                assert!(handle.is_null());
                Err(refused)
            }
        }
    }

    pub(crate) fn new(text: &str) -> Self {
        Self::open(text, ptr::null()).unwrap_or_else(|_| panic!("{}", message()))
    }

    pub(crate) fn surface(&self) -> Shape {
        // SAFETY: all zero is a view of nothing.
        let mut view = unsafe { std::mem::zeroed() };
        // SAFETY: a simulation and a variable.
        let status = unsafe { palpate_simulation_surface(self.0, &mut view) };
        assert_eq!(status, Status::PalpateOk);
        Shape::of(&view)
    }
}

impl Drop for Model {
    fn drop(&mut self) {
        // SAFETY: it is used no more.
        unsafe { palpate_simulation_free(self.0) };
    }
}

/// A copy of what a view shows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    pub(crate) vertices: Vec<f64>,
    pub(crate) corners: Vec<u32>,
    pub(crate) version: u64,
}

impl Shape {
    fn of(view: &SurfaceView) -> Self {
        // SAFETY: the arrays are as long as the view says.
        let (vertices, corners) = unsafe {
            (
                std::slice::from_raw_parts(view.vertices_m, 3 * view.vertices),
                std::slice::from_raw_parts(view.corners, 3 * view.triangles),
            )
        };
        Self {
            vertices: vertices.to_vec(),
            corners: corners.to_vec(),
            version: view.version,
        }
    }
}

/// A state that is freed in the end, with the time that its steps have come to.
#[derive(Debug)]
pub(crate) struct Hand {
    pub(crate) state: *mut StateHandle,
    pub(crate) time: f64,
    touches: Vec<ToolTouch>,
}

// SAFETY: it may go from thread to thread.
unsafe impl Send for Hand {}

impl Hand {
    pub(crate) fn new(model: &Model) -> Self {
        let mut state = ptr::null_mut();
        // SAFETY: a simulation and a variable.
        let status = unsafe { palpate_state_new(model.0, &mut state) };
        assert_eq!(status, Status::PalpateOk, "{}", message());
        Self::of(state, 0.0)
    }

    fn of(state: *mut StateHandle, time: f64) -> Self {
        Self {
            state,
            time,
            touches: Vec::with_capacity(2),
        }
    }

    pub(crate) fn cloned(&self) -> Self {
        let mut copy = ptr::null_mut();
        // SAFETY: a state and a variable.
        let status = unsafe { palpate_state_clone(self.state, &mut copy) };
        assert_eq!(status, Status::PalpateOk, "{}", message());
        Self::of(copy, self.time)
    }

    pub(crate) fn restore(&mut self, from: &Self) {
        // SAFETY: two states.
        let status = unsafe { palpate_state_restore(self.state, from.state) };
        assert_eq!(status, Status::PalpateOk, "{}", message());
        self.time = from.time;
    }

    /// What the tools feel, which are at `poses` 5 ms after the last step.
    pub(crate) fn go(&mut self, poses: &[ToolPose]) -> &[ToolTouch] {
        let (status, count) = (self.try_at(self.time, poses), poses.len());
        assert_eq!(status, Status::PalpateOk, "{}", message());
        self.time += 5e-3;
        // SAFETY: the step has written so many.
        unsafe { self.touches.set_len(count) };
        &self.touches
    }

    pub(crate) fn try_at(&mut self, time: f64, poses: &[ToolPose]) -> Status {
        self.touches.clear();
        self.touches.reserve(poses.len());
        let touches = self.touches.as_mut_ptr();
        // SAFETY: a state, and arrays of one length.
        unsafe { palpate_step(self.state, time, poses.as_ptr(), poses.len(), touches) }
    }

    pub(crate) fn shape(&self) -> Shape {
        // SAFETY: all zero is a view of nothing.
        let mut view = unsafe { std::mem::zeroed() };
        // SAFETY: a state and a variable.
        let status = unsafe { palpate_state_surface(self.state, &mut view) };
        assert_eq!(status, Status::PalpateOk, "{}", message());
        Shape::of(&view)
    }

    /// A cut of 20 mm along the upper side of the cube at this y [m]; what happened in it.
    pub(crate) fn cut_along(&mut self, y: f64) -> u32 {
        let lowered = (0..=200).map(|k| ToolPose {
            cut: 1,
            ..at([1e-4 * f64::from(k) - 0.01, y, 0.049])
        });
        let lifted = at([0.01, y, 0.06]);
        let steps = lowered.chain([lifted]);
        steps.fold(0, |events, pose| events | self.go(&[pose])[0].events)
    }
}

impl Drop for Hand {
    fn drop(&mut self) {
        // SAFETY: it is used no more.
        unsafe { palpate_state_free(self.state) };
    }
}
