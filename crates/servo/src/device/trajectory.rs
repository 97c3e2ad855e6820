use nalgebra::UnitQuaternion;

use crate::{Fault, Vec3};

/// A waypoint: a position and its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waypoint {
    /// Time [s].
    pub time: f64,
    /// Position [m].
    pub position: Vec3,
    /// Orientation of the handle.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Bit mask of the pressed buttons.
    pub buttons: u32,
}

/// The motion of a scripted hand.
#[derive(Debug, Clone, PartialEq)]
pub enum Trajectory {
    /// Straight lines between waypoints; at rest before the first and after the last.
    Waypoints(Vec<Waypoint>),
    /// center + amplitude sin(2π f t).
    Sine {
        /// The middle [m].
        center: Vec3,
        /// From the middle to an end of the motion [m].
        amplitude: Vec3,
        /// f [Hz].
        frequency: f64,
    },
}

impl Waypoint {
    /// At `position` [m] at `time` [s].
    pub fn new(time: f64, position: Vec3) -> Self {
        Self {
            time,
            position,
            orientation: None,
            grip: 0.0,
            buttons: 0,
        }
    }
}

impl Trajectory {
    /// A path through `places`.
    ///
    /// # Errors
    /// When there is none, or their times do not increase.
    pub fn waypoints(places: Vec<Waypoint>) -> Result<Self, Fault> {
        let setting = |what, found, expected| Fault::Setting {
            what,
            found,
            expected,
        };
        if places.is_empty() {
            return Err(setting("the number of places of a way", 0.0, "one or more"));
        }
        for pair in places.windows(2) {
            if pair[1].time <= pair[0].time || !pair[1].time.is_finite() {
                let expected = "a time after that of the place before";
                return Err(setting("the time of a place [s]", pair[1].time, expected));
            }
        }
        Ok(Self::Waypoints(places))
    }

    /// The state of the hand at `time` [s]. Between two waypoints the handle turns about one axis and keeps the buttons
    /// of the first.
    pub fn at(&self, time: f64) -> Waypoint {
        match self {
            Self::Waypoints(places) => on_the_way(places, time),
            Self::Sine {
                center,
                amplitude,
                frequency,
            } => {
                let phase = std::f64::consts::TAU * frequency * time;
                Waypoint::new(time, center + amplitude * phase.sin())
            }
        }
    }
}

fn on_the_way(places: &[Waypoint], time: f64) -> Waypoint {
    let after = places.partition_point(|place| place.time <= time);
    if after == 0 || after == places.len() {
        let end = places[after.saturating_sub(1)];
        return Waypoint { time, ..end };
    }
    let (from, to) = (&places[after - 1], &places[after]);
    let part = (time - from.time) / (to.time - from.time);
    let orientation = match (from.orientation, to.orientation) {
        // Half a turn has no unique axis; the first waypoint then counts.
        (Some(from), Some(to)) => Some(from.try_slerp(&to, part, 1e-9).unwrap_or(from)),
        (from, _) => from,
    };
    Waypoint {
        time,
        position: from.position + (to.position - from.position) * part,
        orientation,
        grip: from.grip + (to.grip - from.grip) * part,
        buttons: from.buttons,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_straight_between_its_places() {
        let places = vec![
            Waypoint::new(1.0, Vec3::zeros()),
            Waypoint {
                grip: 1.0,
                ..Waypoint::new(3.0, Vec3::x())
            },
        ];
        let way = Trajectory::waypoints(places).unwrap();
        assert_eq!(way.at(0.0).position, Vec3::zeros());
        assert_eq!(way.at(1.5).position, Vec3::x() * 0.25);
        assert_eq!(way.at(2.0).grip, 0.5);
        assert_eq!(way.at(7.0).position, Vec3::x());
        assert!(Trajectory::waypoints(Vec::new()).is_err());
        let twice = vec![Waypoint::new(1.0, Vec3::x()); 2];
        assert!(Trajectory::waypoints(twice).is_err());
    }
}
