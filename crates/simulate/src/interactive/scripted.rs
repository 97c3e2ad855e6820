use nalgebra::{Quaternion, Unit};
use palpate_files::motion::ToolMotion;
use palpate_geometry::Vec3;
use palpate_servo::{Fault, Trajectory, VirtualDevice, Waypoint};

use super::PlacedDevice;
use super::model_loop::CUTS;

impl PlacedDevice {
    /// A stiff scripted hand that plays `motion`, whose first row is the beginning of time. A hand that is
    /// there from the start rests in the first place before.
    ///
    /// # Errors
    /// When the times do not rise, which those of a motion that was read do.
    pub fn playing(motion: &ToolMotion) -> Result<Self, Fault> {
        let first = motion.first_time_s();
        let rows = motion.rows().iter();
        let places = rows.map(|row| Waypoint {
            orientation: row
                .pose
                .orientation
                .map(|[x, y, z, w]| Unit::new_normalize(Quaternion::new(w, x, y, z))),
            grip: row.pose.grip,
            buttons: if row.pose.cut { CUTS } else { 0 },
            ..Waypoint::new(row.time_s - first, Vec3::from(row.pose.position_m))
        });
        let way = Trajectory::way(places.collect())?;
        Ok(Self::new(VirtualDevice::new(way)))
    }
}
