use palpate_servo::{PidGains, Vec3};

use crate::{DepthTrajectory, Error};

/// How the normal of a surface is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NormalFrom {
    /// Somebody said it.
    Stated,
    /// The surface is touched around the place.
    ByTouch,
}

/// What may be chosen about a rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigSettings {
    /// Time from tick to tick [s].
    pub period: f64,
    /// How hard the indenter is driven.
    pub gains: PidGains,
    /// How fast it goes to the tissue [m/s].
    pub approach_speed: f64,
    /// The force above the sensor's zero that is a contact [N].
    pub contact_force: f64,
    /// How far it looks for tissue [m].
    pub approach_distance: f64,
    /// How far above the tissue it waits [m].
    pub clearance: f64,
    /// How far up breath moves the tissue [m]: so much higher it waits, and a stimulus begins when the held tissue
    /// is at rest. Zero for what does not breathe.
    pub breath_motion: f64,
    /// How far sideways it may go from where the rig began [m].
    pub lateral_limit: f64,
    /// The direction from the tip to the device, in the rig's axes [-].
    pub indenter_axis: Vec3,
    /// From the origin of a virtual sensor to the tip [m].
    pub tip_distance: f64,
    /// How far from a place the surface is touched to measure its normal [m].
    pub probe_distance: f64,
    /// How fast it is moved by hand [m/s].
    pub jog_speed: f64,
    /// How fast it leaves the tissue [m/s].
    pub withdrawal_speed: f64,
    /// The largest force that the sensor may show [N].
    pub force_limit: f64,
    /// The deepest that it may go [m].
    pub depth_limit: f64,
    /// The fastest that it may be [m/s].
    pub speed_limit: f64,
    /// How long a breath is held at most [s]; none for what does not breathe.
    pub breath: Option<f64>,
    /// How long the tissue rests between two stimuli [s].
    pub recovery: f64,
}

impl Default for RigSettings {
    fn default() -> Self {
        Self {
            period: 1e-3,
            gains: PidGains::tuned(),
            approach_speed: 0.002,
            contact_force: 4.0 / 1280.0,
            approach_distance: 0.030,
            clearance: 0.002,
            breath_motion: 0.0,
            lateral_limit: 0.030,
            indenter_axis: Vec3::z(),
            tip_distance: 0.040,
            probe_distance: 0.005,
            jog_speed: 0.005,
            withdrawal_speed: 0.02,
            force_limit: 2.0,
            depth_limit: 0.012,
            speed_limit: 0.060,
            breath: None,
            recovery: 30.0,
        }
    }
}

/// Time in which breath and device come to rest [s].
pub(crate) const SETTLING_TIME: f64 = 2.0;
/// Time before a stimulus that is recorded too [s], and how far above the tissue the indenter then is [m].
pub(crate) const LEAD: f64 = 0.5;
pub(crate) const STANDOFF: f64 = 0.5e-3;
/// The longest stimulus [s]; at 1 kHz it makes a recording of 1 GB.
const LONGEST: f64 = 4.0 * 3600.0;

impl RigSettings {
    /// How long `course` takes from where the indenter waits [s], for which a breath is held.
    pub fn time_of(&self, trajectory: &DepthTrajectory) -> f64 {
        let [_, speed] = trajectory.at(0.0);
        let down = self.breath_motion / self.withdrawal_speed;
        let way = (self.clearance - STANDOFF).abs() / self.approach_speed;
        self.settling_time() + down + way + LEAD + STANDOFF / speed + trajectory.duration()
    }

    /// Whether the indenter hangs from its device.
    ///
    /// # Errors
    /// When it does not.
    pub(crate) fn check_direction(&self) -> Result<(), Error> {
        let axis = self.indenter_axis;
        match axis.norm().is_normal() && axis.z > 0.0 {
            true => Ok(()),
            false => Err(Error::NotUpward),
        }
    }

    /// Whether a place [m] can be reached from where the rig begins, with the contacts around it if its normal is
    /// `measured`.
    ///
    /// # Errors
    /// When it cannot.
    pub fn check_place(
        &self,
        place: &Vec3,
        normal: &Vec3,
        measured: NormalFrom,
    ) -> Result<(), Error> {
        let normal = normal.normalize();
        let height = normal.dot(place);
        let around = match measured {
            NormalFrom::Stated => 0.0,
            // At most, for places around it lie across the normal.
            NormalFrom::ByTouch => self.probe_distance,
        };
        let sideways = (place - normal * height).norm() + around;
        let way = self.approach_distance;
        check_within("along the normal", height, [-way, way], 0.0)?;
        check_within("sideways", sideways, [0.0, self.lateral_limit], 0.0)
    }

    /// How long tissue takes to come to rest when a breath is held [s].
    pub(crate) fn settling_time(&self) -> f64 {
        if self.breath_motion > 0.0 {
            SETTLING_TIME
        } else {
            0.0
        }
    }

    /// Whether `course` keeps within the limits.
    ///
    /// # Errors
    /// When it does not: too deep, too fast, too long for a breath.
    pub fn check(&self, trajectory: &DepthTrajectory) -> Result<(), Error> {
        if trajectory.deepest() > self.depth_limit {
            return Err(Error::TooDeep {
                depth_mm: 1e3 * trajectory.deepest(),
                limit_mm: 1e3 * self.depth_limit,
            });
        }
        if trajectory.fastest() > self.speed_limit {
            return Err(Error::TooFast {
                speed_mm_s: 1e3 * trajectory.fastest(),
                limit_mm_s: 1e3 * self.speed_limit,
            });
        }
        let duration = self.time_of(trajectory);
        if duration.is_nan() || duration > LONGEST {
            return Err(Error::TooLong {
                duration,
                longest: LONGEST,
            });
        }
        match self.breath {
            Some(breath) if duration > breath => {
                Err(Error::BreathHoldTooShort { duration, breath })
            }
            _ => Ok(()),
        }
    }
}

/// Whether a place is within bounds [m] in a direction, but for `rounding` [m].
pub(crate) fn check_within(
    direction: &'static str,
    found: f64,
    [least, most]: [f64; 2],
    rounding: f64,
) -> Result<(), Error> {
    if found >= least - rounding && found <= most + rounding {
        return Ok(());
    }
    Err(Error::OutOfReach {
        direction,
        to_mm: 1e3 * found,
        least_mm: 1e3 * least,
        most_mm: 1e3 * most,
    })
}
