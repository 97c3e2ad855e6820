//! A server that publishes the running simulation to ROS programs, without ROS: topics as JSON over a WebSocket, by
//! version 2 of the rosbridge protocol, which roslibjs, roslibpy and Foxglove read.
//!
//! Fifty times a second each subscriber gets the pose of a tool ([`message::pose`]), the force on it ([`message::wrench`])
//! and the status; at most ten times a second the surface of the organ ([`message::mesh`]). Lengths are metres, forces
//! newtons, in the axes of the scene, which is the frame `scene`. A client that does not read as fast gets fewer messages,
//! the newest ones.
//!
//! *How we know*: `rosbridge::…` in the tests; a client of another language reads it in the Python tests.
//!
//! *Limits*: it accepts only subscriptions and requests for topics; no compression, no encryption. A WebSocket has no
//! same-origin rule: a page in a browser on the same machine can read it. Not tried with ROS itself.

pub mod message;
mod server;

pub(crate) use server::Server;

/// The default port of this protocol.
pub const PORT: u16 = 9090;
