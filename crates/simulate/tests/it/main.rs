//! Scenes played through the crate's own front door.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests may unwrap, and print what they measured"
)]

mod agreement;
mod analytic;
mod cut_mechanics;
mod cutting;
#[path = "../../../geometry/tests/it/data.rs"]
mod data;
mod demonstration;
mod digest;
mod enhanced;
mod errors;
mod estimated_inclusions;
mod friction;
mod gestures;
mod grip;
mod hand_over;
mod haptic_devices;
mod hybrid;
mod indentation;
mod interactive;
mod invariants;
mod kill;
mod large_organs;
mod layers;
mod limits;
mod loss;
mod neighbours;
mod no_allocation;

mod nonlinear;
mod nonlinear_cavities;
mod nonlinear_cuts;
mod nonlinear_lobes;
mod nonlinear_neighbours;
mod nonlinear_organs;
mod nonlinear_shafts;
mod nonlinear_soft;
mod nonlinear_tube;
mod nonlinear_walls;
mod performance;
mod precision_cutting;
mod random_scenes;
mod regions;
mod replay;
mod retraction;
mod scenes;
mod session_end;
mod silicone_beam;
mod sized;
mod slides;
mod take_over;
mod thin_walls;
mod tips;
mod trocar;
mod tutor;
mod variants;
