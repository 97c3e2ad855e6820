//! The normal of a surface, measured by touching it around a place.
//!
//! Four contacts at ±d along two directions across the approach give the slopes of the surface,
//! s = (h(+d) − h(−d)) / 2d, and the normal n − s₁ t₁ − s₂ t₂. Curvature leaves with the difference.
//!
//! *How we know*: `normal::…` on a virtual specimen whose normal is known.
//!
//! *Limits*: a contact is found to 0.05 mm or so, which is 0.4° at d = 5 mm.

use palpate_servo::Vec3;

use super::{Ended, Line, Listener, Phase, Rig};
use crate::Error;

/// The steepest surface that is taken for one [rad].
const STEEPEST: f64 = 0.61;

impl Rig {
    /// The direction out of the tissue along which it approaches, of length one [-].
    pub fn normal(&self) -> Vec3 {
        self.line.normal
    }

    /// Approaches along `normal` from now on; where the tissue begins along it is not known.
    ///
    /// # Errors
    /// When it leads down or is no direction.
    pub fn face(&mut self, normal: &Vec3) -> Result<(), Error> {
        let length = normal.norm();
        let normal = normal / length;
        if !(length.is_finite() && normal.z > 0.0) {
            return Err(Error::NotUpward);
        }
        self.forget_contact();
        let [here, above] = [self.aim, self.retreat].map(|height| self.line.at(height));
        self.line = Line::through(&here, normal);
        self.aim = self.line.height(&here);
        self.retreat = self.line.height(&above).max(self.aim);
        Ok(())
    }

    /// Touches the surface at four places around the one that it is over and [faces](Self::face) it from above that place.
    ///
    /// # Errors
    /// When one of the places is beyond the limits, which is known before anything moves; when there is no tissue or too
    /// much force at one, or the surface is too steep for the direction in which it was looked for.
    pub fn measure_normal(&mut self, listener: Listener<'_>) -> Result<Ended, Error> {
        let (normal, place) = (self.line.normal, self.line.at(self.aim));
        let [first, second] = across(&normal);
        let far = self.settings.probe_distance;
        let around = [first, -first, second, -second].map(|way| place + far * way);
        around.iter().try_for_each(|to| self.check_reach(to))?;
        self.check_out_of_tissue()?;
        let mut heights = [0.0; 4];
        for (height, to) in heights.iter_mut().zip(&around) {
            match self.touch_at(to, listener)? {
                Some(found) => *height = found,
                None => return Ok(Ended::Stopped),
            }
        }
        let [right, left, away, near] = heights;
        let slopes = [(right - left) / (2.0 * far), (away - near) / (2.0 * far)];
        let found = (normal - first * slopes[0] - second * slopes[1]).normalize();
        let angle = found.dot(&normal).min(1.0).acos();
        if angle > STEEPEST {
            return Err(Error::TooSteep {
                angle_deg: angle.to_degrees(),
                limit_deg: STEEPEST.to_degrees(),
            });
        }
        // Above the same point of the surface as before, and as far.
        let surface = heights.iter().sum::<f64>() / 4.0;
        let above = self.line.height(&place) - surface;
        let to = place - normal * above + found * above;
        self.check_reach(&to)?;
        let ended = self.travel(&to, Phase::Jogging, listener)?;
        if ended == Ended::Complete {
            self.face(&found)?;
        }
        Ok(ended)
    }

    /// The height of the contact at `to` [m], from where it is withdrawn to; none when somebody stopped it.
    fn touch_at(&mut self, to: &Vec3, listener: Listener<'_>) -> Result<Option<f64>, Error> {
        let from = self.line.height(to);
        if self.travel(to, Phase::Jogging, listener)? == Ended::Stopped
            || self.approach(listener)? == Ended::Stopped
        {
            return Ok(None);
        }
        let contact = self.contact.ok_or(Error::NotApproached)?;
        let speed = self.settings.withdrawal_speed;
        match self.go(from, speed, Phase::Jogging, listener)? {
            Ended::Complete => Ok(Some(contact)),
            Ended::Stopped | Ended::Enough => Ok(None),
        }
    }
}

/// Two directions across another, of length one.
fn across(normal: &Vec3) -> [Vec3; 2] {
    // It never leads along x, for it leads up.
    let first = (Vec3::x() - normal * normal.x).normalize();
    [first, normal.cross(&first)]
}
