//! How a tool was moved: measures that no frame and no sampling rate changes.

use nalgebra::{Quaternion, Unit};
use palpate_files::{Event, SessionRow};
use palpate_geometry::Vec3;

use super::jerk;

/// The way of one tool.
#[derive(Debug, Clone)]
pub(super) struct HandWay {
    tool: String,
    /// Times [s] and places [m] without a gap.
    stretches: Vec<Vec<(f64, Vec3)>>,
    last: Option<SessionRow>,
    path: f64,
    angular_path: f64,
    along: f64,
    /// Where the present free move began, and how long its way is [m].
    free: Option<(Vec3, f64)>,
    /// Straight ways and ways of free moves that are over [m].
    straight: f64,
    free_path: f64,
}

/// How a tool was moved.
#[derive(Debug, Clone, PartialEq)]
pub struct HandScore {
    /// The tool's name.
    pub tool: String,
    /// How long it was there [s].
    pub time: f64,
    /// The way of its tip [m].
    pub path: f64,
    /// The sum of its turns [rad].
    pub angular_path: f64,
    /// The part of the way along its shaft, in and out [m].
    pub path_along_shaft: f64,
    /// Straight ways over the ways that were taken, between contacts [-]; none if it was never free.
    pub economy: Option<f64>,
    /// √(½ T⁵/L² ∫ j² dt), j being the third derivative of the place, T the time and L the way [-]; none for
    /// less than half a second.
    pub jerk: Option<f64>,
}

impl HandWay {
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
                let way = place - Vec3::from(last.position_m);
                let (from, to) = (turn(&last), turn(row));
                self.path += way.norm();
                self.angular_path += from.angle_to(&to);
                // Halfway between the two directions, which no order in time prefers.
                let shaft = (from * Vec3::z() + to * Vec3::z()) * 0.5;
                self.along += way.dot(&shaft).abs();
                if let Some((_, path)) = &mut self.free {
                    *path += way.norm();
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
