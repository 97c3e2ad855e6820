//! The 1 kHz part: devices, the loop that drives them, the limits that make its forces safe, and the hand-over of
//! forces from a slower model.
//!
//! ```text
//!                                  Supervisor (a person, a fault, a silent program)
//!                                             │
//!  model thread ──latest(AffineForce)──▶ Controller ─force─▶ Guard ─OutputForce▶ Device ──▶ hand
//!       ▲                                     ▲                                        │
//!       └────────── latest(Sample) ───────────┴───────────────── DeviceState ──────────┘
//! ```
//!
//! The crate knows nothing of tissue, scenes or files. A [`ServoLoop`] owns its [`Device`]; nothing else calls it, and
//! it never waits for another thread. The same loop runs on a real [`Clock`] and on a virtual one, on a thread of its
//! own ([`ServoThread`]) and in the scheduler of a device that has one ([`Scheduler`]). A tick allocates nothing.
//!
//! ```
//! use palpate_servo::{Clock, DeviceState, ServoLoop, ServoSettings, Trajectory, Vec3, VirtualDevice};
//!
//! // A hand that moves 2 mm up and down at 2 Hz, held by a spring of 100 N/m.
//! let hand = VirtualDevice::new(Trajectory::Sine {
//!     center: Vec3::zeros(),
//!     amplitude: Vec3::z() * 2e-3,
//!     frequency: 2.0,
//! });
//! let spring = |state: &DeviceState, _dt: f64| -100.0 * state.position;
//! let (mut servo, mut reader) =
//!     ServoLoop::new(Box::new(hand), Box::new(spring), ServoSettings { log: 2000, ..Default::default() })?;
//! servo.run(&mut Clock::virtual_time(), |tick| tick < 1000);
//! let largest = reader.log.drain().map(|sample| sample.output.norm()).fold(0.0, f64::max);
//! assert!((largest - 0.2).abs() < 1e-3); // [N]
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod affine_force;
mod clock;
mod controller;
mod device;
pub mod dynamics;
mod extrapolate;
mod fault;
mod force_sensor;
mod histogram;
pub mod latest;
pub mod limits;
pub mod log;
mod memory;
pub mod monitor;
mod panics;
mod pid;
mod priority;
mod report;
mod sample;
mod servo_loop;
mod servo_settings;
mod servo_thread;
mod stepped_loop;
pub mod supervisor;
mod velocity;

pub use affine_force::AffineForce;
pub use clock::Clock;
pub use controller::Controller;
pub use device::{
    Capabilities, Command, Device, DeviceState, Disabled, HandImpedance, Next, NoDevice, Pointer,
    PointerHand, Scheduler, Tick, Trajectory, VirtualDevice, Waypoint,
};
pub use extrapolate::{Extrapolator, HandOver};
pub use fault::Fault;
pub use force_sensor::{AXIS_NAMES, ForceSensor, ForceSensorSpec, ForceTorque, SensorFault};
pub use histogram::{Histogram, Percentiles};
pub use limits::{DeadMan, Guard, Interventions, Limits, OutputForce, Stage};
pub use memory::{MemoryLock, lock_memory};
pub use pid::{Pid, PidGains};
pub use priority::{Priority, lower_priority, raise_model_priority, raise_priority};
pub use report::LoopReport;
pub use sample::Sample;
pub use servo_loop::{ServoLoop, ServoReader};
pub use servo_settings::ServoSettings;
pub use servo_thread::ServoThread;
pub use stepped_loop::SteppedLoop;
pub use supervisor::{ForceState, StopReason, Supervisor};

/// Three numbers: a position [m], a velocity [m/s] or a force [N].
pub type Vec3 = nalgebra::Vector3<f64>;
