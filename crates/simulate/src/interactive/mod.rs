//! Real-time interaction: the model runs in parallel with a servo loop per device and a display.
//!
//! ```text
//!  display 60 Hz ◀─latest(Snapshot)─ model thread 200 Hz ─latest(AffineForce)─▶ servo thread 1 kHz ─▶ device
//!  recorder      ◀─every SessionRow─      step           ◀───latest(Sample)────  extrapolate, limit
//! ```
//!
//! A [`ModelCommand`] (pause, resume, undo, reset) reaches the model through a ring of its own. The recorder writes a
//! session that is recorded, and passes its rows on for display. A monitor thread detects a loop that hangs and a request
//! to end the program ([`palpate_servo::monitor`]). Another model can take over while the devices stay open
//! ([`PreparedModel`]).
//!
//! No thread waits for another: unread values are replaced, and values that do not fit are counted. [`Interaction`]
//! runs on the machine's clock; [`VirtualInteraction`] runs the same parts on a virtual one, in one thread, identical
//! to the last bit every time.
//!
//! *How we know*: `interactive::…` in the tests.
//!
//! *Limits*: one device moves one tool; forces only, no torques.

mod command;
mod device_placement;
mod endpoints;
mod extrapolation_error;
mod force_renderer;
mod hand_over;
mod interaction;
mod model;
mod model_loop;
mod placement;
mod published;
mod quality;
mod recorder;
mod scene_devices;
mod snapshot;
mod virtual_interaction;

/// Capacity for unread rows: a minute of two tools at 200 Hz.
const ROWS: usize = 24_000;

pub use command::ModelCommand;
pub use device_placement::DevicePlacement;
pub use endpoints::PlacedDevice;
pub use extrapolation_error::measure_extrapolation_error;
pub use force_renderer::ForceRenderer;
pub use hand_over::affine_force;
pub use interaction::{Environment, Interaction};
pub use model::PreparedModel;
pub use model_loop::CUTS;
pub(crate) use model_loop::DISPLAY;
pub use quality::{ExtrapolationError, ModelReport, Quality};
pub use recorder::{MAX_ROWS_IN_MEMORY, RecordingFailure};
pub use scene_devices::SceneDevices;
pub use snapshot::{ContactSnapshot, OpenedPart, OpenedSnapshot, Snapshot, ToolSnapshot};
pub use virtual_interaction::VirtualInteraction;
