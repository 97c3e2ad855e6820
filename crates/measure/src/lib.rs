//! The rig: a force-feedback device that presses an indenter into tissue and records depth and force (chapter
//! 5).
//!
//! ```text
//!  DepthTrajectory ───▶ Rig ──latest(Reference)──▶ Indenter (PID) ─▶ servo loop ─▶ device ─▶ tip on a specimen
//!               ▲                                                            │            │
//!               └──── RigSample ◀── encoders ────────────────────────────────┘   sensor ──┘
//! ```
//!
//! [`Rig`] approaches along the surface's normal until first contact, presses one [`DepthTrajectory`] of a stimulus at a time and withdraws. It runs on a real
//! clock and on a virtual one. Without a device, a [`VirtualSpecimen`] under a virtual PHANTOM replaces specimen and
//! device; its recordings have the steps of the sensor and of the encoders, a heart that beats and a
//! breath that is held. A [`live`] rig runs on its own thread and carries out the commands of a person.

mod approach;
mod depth_trajectory;
mod error;
mod indenter;
pub mod live;
mod naming;
mod noise;
pub mod phantom;
mod recorder;
mod rig;
mod rig_settings;
mod sensing;
mod sensor;
mod specimen;

pub use depth_trajectory::DepthTrajectory;
pub use error::Error;
pub use indenter::{Indenter, Reference};
pub use naming::{recording_name, stimulus_name};
pub use recorder::{Axes, Recorded, Recorder};
pub use rig::{Ended, Listener, Phase, Rig, RigSample};
pub use rig_settings::{NormalFrom, RigSettings};
pub use sensing::MountedSensor;
pub use sensor::VirtualForceSensor;
pub use specimen::{BREATH_MOTION, PeriodicMotion, Shape, VirtualSpecimen};
