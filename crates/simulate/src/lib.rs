//! Simulation of tools on an organ: from a scene and the motion of tools to forces, deformation and events.
//!
//! ```text
//! Scene ──Simulation::new──▶ Simulation ──step──▶ SimulationState (forces, contacts, moved surface)
//!                                 ▲                      │
//!                     Motion ──poses──            SessionRow per tool
//! ```
//!
//! A [`Simulation`] is built once and never changes; a [`SimulationState`] has all state that a step changes; a
//! [`SimulationWorkspace`] is scratch. [`play`] runs a whole motion on a virtual clock: nothing there waits, and the
//! same motion gives the same bytes. [`interactive`] runs the same steps in real time, with a servo loop and a display.
//!
//! ```
//! use palpate_files::{Pose, Scene};
//! use palpate_simulate::{Simulation, SimulationState, SimulationWorkspace, step};
//!
//! let scene = r#"
//! format = 1
//! organ = { builtin = "liver", builtin_tissue = "pig-liver" }
//! tool = [{ name = "right", tip = { shape = "flat", radius_m = 0.001 } }]
//! "#;
//! let simulation = Simulation::new(&Scene::parse(scene, "liver.toml")?)?;
//! let mut state = SimulationState::new(&simulation);
//! let mut workspace = SimulationWorkspace::new(&simulation);
//!
//! // 4 mm below the first vertex, along its inward normal.
//! let surface = simulation.surface();
//! let tip = surface.mesh().vertices()[0] - 0.004 * surface.vertex_normals()[0];
//! let pose = Pose { position_m: tip.into(), orientation: None, grip: 0.0, cut: false };
//! step(&simulation, 0.0, 0.0, &[Some(pose)], &mut state, &mut workspace);
//! assert!(state.tools[0].force.norm() > 0.02); // [N]
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contact;
mod cutting;
mod deform;
mod demonstration;
mod digest;
mod energy;
mod error;
mod estimated_inclusions;
mod global;
mod grip;
mod hand_speed;
mod indentation;
pub mod interactive;
mod limits;
mod neighbour;
mod nonlinear;
mod organ;
mod orientation;
pub mod performance;
mod play;
mod polyline;
mod preparation;
mod regions;
mod replay;
mod session_folder;
mod shaft;
mod simulation;
mod state;
mod step;
mod summary;
mod swings;
mod target;
mod tip_force;
mod tip_laws;
mod tool;
mod trocar;
mod tutor;
mod variant;
mod walls;

pub use contact::Contact;
pub use cutting::{CutPart, Cuts, gape};
pub use demonstration::{Demonstration, ShownTool};
pub use error::Error;
pub use estimated_inclusions::check_estimated_inclusions;
pub use global::{EnhancedSurface, OrganField, ResponseOrigin};
pub use hand_speed::FASTEST_HAND;
pub use indentation::Site;
pub use limits::LimitCounts;
pub use organ::{builtin_organ, fixed_region, read_neighbour, read_organ, read_tissue};
pub use play::{Flow, Frame, check_motion, play};
pub use preparation::{Progress, Resources, Work};
pub use regions::read_inclusion;
pub use replay::Replay;
pub use session_folder::{SessionFolder, SessionFolderWriter, read_experts};
pub use simulation::Simulation;
pub use state::{SimulationState, SimulationWorkspace, ToolState};
pub use step::{TRUSTED_DEPTH, shape, show, step, touch};
pub use summary::{CavitySummary, CutSummary, LayerCut, StepTimes, Summary};
pub use target::check_target;
pub use tool::Tool;
pub use trocar::{ShaftFriction, Trocar};
pub use tutor::{Ghost, Tutor};
pub use variant::draw_variant;
