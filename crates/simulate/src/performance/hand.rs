//! Motion measures of a tool, independent of frame and sampling rate.

use nalgebra::{Quaternion, Unit};
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

use super::jerk;

/// The path of one tool.
#[derive(Debug, Clone)]
pub(super) struct HandTracker {
    tool: String,
    /// Times [s] and positions [m] without a gap.
    stretches: Vec<Vec<(f64, Vec3)>>,
    last: Option<SessionRow>,
    path: f64,
    angular_path: f64,
    along: f64,
    /// Start of the present free move, and its path length so far [m].
    free: Option<(Vec3, f64)>,
    /// Straight distances and path lengths of completed free moves [m].
    straight: f64,
    free_path: f64,
}

/// Motion measures of a tool.
#[derive(Debug, Clone, PartialEq)]
pub struct HandScore {
    /// The tool's name.
    pub tool: String,
    /// Time of presence [s].
    pub time: f64,
    /// Path length of its tip [m].
    pub path: f64,
    /// The sum of its turns [rad].
    pub angular_path: f64,
    /// The part of the path along its shaft, in and out [m].
    pub path_along_shaft: f64,
    /// Straight distances over path lengths, between contacts [-]; none if it was never free.
    pub economy: Option<f64>,
    /// √(½ T⁵/L² ∫ j² dt), j being the third derivative of the position, T the time and L the path length [-]; none for
    /// less than half a second.
    pub jerk: Option<f64>,
}

impl HandTracker {
    pub(super) fn new(tool: &str) -> Self {
        Self {
            tool: tool.to_owned(),
            stretches: Vec::new(),
            last: None,
            path: 0.0,
            angular_path: 0.0,
            along: 0.0,
            free: None,
            straight: 0.0,
            free_path: 0.0,
        }
    }

    pub(super) fn add(&mut self, row: &SessionRow) {
        if row.events.contains(Event::Lifted) {
            self.last = None;
            self.end_free_move(&Vec3::from(row.position_m));
            return;
        }
        let place = Vec3::from(row.position_m);
        match self.last {
            None => self.stretches.push(vec![(row.time_s, place)]),
            Some(last) => {
                let motion = place - Vec3::from(last.position_m);
                let (from, to) = (turn(&last), turn(row));
                self.path += motion.norm();
                self.angular_path += from.angle_to(&to);
                // Halfway between the two directions, so that the order in time does not matter.
                let shaft = (from * Vec3::z() + to * Vec3::z()) * 0.5;
                self.along += motion.dot(&shaft).abs();
                if let Some((_, path)) = &mut self.free {
                    *path += motion.norm();
                }
                if let Some(stretch) = self.stretches.last_mut() {
                    stretch.push((row.time_s, place));
                }
            }
        }
        match row.contact {
            true => self.end_free_move(&place),
            false => {
                self.free.get_or_insert((place, 0.0));
            }
        }
        self.last = Some(*row);
    }

    fn end_free_move(&mut self, at: &Vec3) {
        if let Some((from, path)) = self.free.take() {
            self.straight += (at - from).norm();
            self.free_path += path;
        }
    }

    pub(super) fn score(&self) -> HandScore {
        let mut ended = self.clone();
        if let Some(last) = &self.last {
            ended.end_free_move(&Vec3::from(last.position_m));
        }
        let lengths = self
            .stretches
            .iter()
            .map(|stretch| match stretch.as_slice() {
                [(first, _), .., (last, _)] => last - first,
                _ => 0.0,
            });
        let time: f64 = lengths.sum();
        HandScore {
            tool: self.tool.clone(),
            time,
            path: self.path,
            angular_path: self.angular_path,
            path_along_shaft: self.along,
            economy: (ended.free_path > 0.0).then(|| ended.straight / ended.free_path),
            jerk: jerk::normalised(&self.stretches, time, self.path),
        }
    }
}

fn turn(row: &SessionRow) -> nalgebra::UnitQuaternion<f64> {
    let [x, y, z, w] = row.orientation;
    Unit::new_normalize(Quaternion::new(w, x, y, z))
}
