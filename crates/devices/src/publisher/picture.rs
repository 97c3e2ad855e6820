use nalgebra::UnitQuaternion;
use palpate_servo::{Fault, Vec3};

/// The state to display.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PublishedState {
    /// The tools.
    pub tools: Vec<ShownTool>,
    /// Whether the simulation is paused.
    pub paused: bool,
}

/// A tool, in the scene's axes.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownTool {
    /// Its name.
    pub name: String,
    /// Position of its tip [m]; none while no hand holds it.
    pub place: Option<Vec3>,
    /// The rotation from tool to scene.
    pub orientation: UnitQuaternion<f64>,
    /// The force on it [N].
    pub force: Vec3,
    /// The torque on it about its tip [N m].
    pub torque: Vec3,
    /// Why its device has no force, if that is so.
    pub fault: Option<Fault>,
}

/// A surface, in the scene's axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShownSurface {
    /// Its vertices [m].
    pub vertices: Vec<[f32; 3]>,
    /// The vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}
