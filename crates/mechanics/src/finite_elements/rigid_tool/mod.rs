//! Rigid tools in contact with a solid: their shapes as signed distances, and the forces between them and the boundary.

mod contact;
mod meridian;
mod shape;
mod surface;

pub use contact::ToolLoad;
pub use shape::{RigidShape, RigidTool};

pub(super) use contact::Contacts;
pub(super) use meridian::MeridianDistance;
pub(super) use surface::ContactSurface;
