//! Pictures of a simulation, the simulator's window in which an organ is touched, and the window of the rig.
//!
//! A [`Renderer`] draws bodies and tools into a [`Target`]; a [`Studio`] is a renderer with a scene, which
//! needs no display. A [`FrameWriter`] takes pictures of a motion at a constant rate.

mod animation;
mod camera;
mod displayed_cut;
mod displayed_organ;
mod error;
mod frame;
mod gpu;
mod history;
mod native;
mod opened_surface;
mod orbit;
mod pick;
mod render;
pub mod rig;
mod style;
mod window;

pub use image::RgbaImage;

pub use animation::Animation;
pub use camera::{Camera, Lamp};
pub use error::Error;
pub use frame::{DisplayedTool, FRAME_SIZE, FrameWriter, Studio, png, tool_pictures};
pub use gpu::Gpu;
pub use opened_surface::OpenedSurface;
pub use orbit::{Orbit, scene_camera, scene_endoscope};
pub use pick::{Picked, pick};
pub use render::user_map::TissuePicture;
pub use render::{
    Body, Label, LabelTarget, Labels, Looks, Renderer, Target, Tint, ToolPicture, View,
    single_precision,
};
pub use window::{
    PlayedSession, Start, WindowOptions, check_display, gesture, hands, open_window, settings,
    training,
};
