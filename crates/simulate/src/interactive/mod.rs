//! An organ that answers a hand while it moves: the model beside a servo loop per device and a display.
//!
//! ```text
//!  display 60 Hz ◀─latest(Snapshot)─ model thread 200 Hz ─latest(AffineForce)─▶ servo thread 1 kHz ─▶ device
//!  recorder      ◀─every SessionRow─      step           ◀───latest(Sample)────  extrapolate, limit
//! ```
//!
//! A [`ModelCommand`] (pause, undo, anew) goes to the model by a ring of its own. The recorder writes a session that is
//! recorded, and hands its rows on to who shows them. A watch thread notices a loop that hangs and a program that shall end
//! ([`palpate_servo::watch`]). Another model takes over while the devices stay open ([`PreparedModel`]).
//!
//! Nobody waits for anybody: what was not read is replaced, and what finds no room is counted.
//! [`Interaction`] runs it on the machine's clock; [`VirtualInteraction`] runs the same parts on a virtual
//! one, in one thread, the same to the last bit every time.
//!
//! *How we know*: `interactive::…` in the tests.
//!
//! *Limits*: one device moves one tool; forces only, no torques.

mod command;
mod device_placement;
mod endpoints;
mod force_renderer;
mod hand_over;
mod interaction;
mod judge;
mod model;
mod model_loop;
mod placement;
mod published;
mod quality;
mod recorder;
mod scene_devices;
mod snapshot;
mod virtual_interaction;

/// Rows that have room until somebody reads them: a minute of two tools at 200 Hz.
const ROWS: usize = 24_000;

pub use command::ModelCommand;
pub use device_placement::DevicePlacement;
pub use endpoints::PlacedDevice;
pub use force_renderer::ForceRenderer;
pub use hand_over::affine_force;
pub use interaction::{Environment, Interaction};
pub use judge::judge_samples;
pub use model::PreparedModel;
pub use model_loop::CUTS;
pub(crate) use model_loop::DISPLAY;
pub use quality::{ExtrapolationError, ModelReport, Quality};
pub use recorder::{MOST_ROWS_IN_MEMORY, Unwritten};
pub use scene_devices::SceneDevices;
pub use snapshot::{ContactSnapshot, OpenedPart, OpenedSnapshot, Snapshot, ToolSnapshot};
pub use virtual_interaction::VirtualInteraction;
