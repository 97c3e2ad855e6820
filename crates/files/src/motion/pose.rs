/// Pose and controls of a tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The tip in the scene's frame [m].
    pub position_m: [f64; 3],
    /// The unit quaternion (qx, qy, qz, qw) that maps tool to scene [-]; none when the motion does
    /// not state one.
    pub orientation: Option<[f64; 4]>,
    /// From 0, open, to 1, shut [-].
    pub grip: f64,
    /// Whether the tool cuts.
    pub cut: bool,
}

/// The quaternion that turns nothing [-].
pub const IDENTITY: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

impl Pose {
    /// The same with a quaternion of length 1, if it is one that a motion can hold.
    ///
    /// # Errors
    /// The expected values, when a number is not finite, a quaternion is zero or a grip is outside 0 to 1.
    pub fn checked(mut self) -> Result<Self, &'static str> {
        if !self.position_m.iter().all(|c| c.is_finite()) {
            return Err("a position of finite numbers");
        }
        if !(0.0..=1.0).contains(&self.grip) {
            return Err("a grip from 0 to 1");
        }
        if let Some(q) = self.orientation {
            self.orientation = Some(normalised(q).ok_or("a quaternion that is not zero")?);
        }
        Ok(self)
    }

    /// A pose between this one and a `later` one, at `part` [-] of the way: 0 is here, 1 is there.
    pub(super) fn towards(&self, later: &Self, part: f64) -> Self {
        let between = |from: f64, to: f64| from + part * (to - from);
        let axis = |i: usize| between(self.position_m[i], later.position_m[i]);
        Self {
            position_m: [axis(0), axis(1), axis(2)],
            orientation: match (self.orientation, later.orientation) {
                (Some(from), Some(to)) => Some(turned(from, to, part)),
                (from, _) => from,
            },
            grip: between(self.grip, later.grip),
            // A cut is on or off; it changes at the row that states it.
            cut: self.cut,
        }
    }
}

/// A quaternion of length 1; none for zero.
pub(super) fn normalised(q: [f64; 4]) -> Option<[f64; 4]> {
    // Scaled first, so that neither very large nor very small components lose the length.
    let largest = q.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let scaled = q.map(|c| c / largest);
    let squares: f64 = scaled.iter().map(|c| c * c).sum();
    let length = squares.sqrt();
    // A quaternion that is already of length 1 keeps every bit: files read back unchanged.
    let own: f64 = q.iter().map(|c| c * c).sum();
    Some(if (own - 1.0).abs() <= 4.0 * f64::EPSILON {
        q
    } else {
        scaled.map(|c| c / length)
    })
}

/// Constant angular speed along the shorter way.
fn turned(from: [f64; 4], to: [f64; 4], part: f64) -> [f64; 4] {
    let dot: f64 = (0..4).map(|i| from[i] * to[i]).sum();
    // A quaternion and its negative are the same turn.
    let sign = if dot < 0.0 { -1.0 } else { 1.0 };
    let angle = dot.abs().min(1.0).acos();
    // Below this angle a straight line is exact to all digits and the sine below is not.
    let (a, b) = if angle < 1e-4 {
        (1.0 - part, part)
    } else {
        let sine = angle.sin();
        (
            ((1.0 - part) * angle).sin() / sine,
            (part * angle).sin() / sine,
        )
    };
    let sum = [0, 1, 2, 3].map(|i| a * from[i] + sign * b * to[i]);
    normalised(sum).unwrap_or(from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halfway_of_a_quarter_turn_is_an_eighth() {
        let eighth = std::f64::consts::FRAC_PI_8;
        let quarter = [0.0, 0.0, (2.0 * eighth).sin(), (2.0 * eighth).cos()];
        for to in [quarter, quarter.map(|c| -c)] {
            let [x, y, z, w] = turned(IDENTITY, to, 0.5);
            assert_eq!((x.abs(), y.abs()), (0.0, 0.0));
            assert!((z - eighth.sin()).abs() < 1e-15 && (w - eighth.cos()).abs() < 1e-15);
        }
    }

    #[test]
    fn normalization_works_at_any_scale() {
        assert_eq!(normalised([0.0; 4]), None);
        assert_eq!(
            normalised([1e-200, 0.0, 0.0, 0.0]),
            Some([1.0, 0.0, 0.0, 0.0])
        );
        assert_eq!(
            normalised([0.0, 0.0, 0.0, -1e300]),
            Some([0.0, 0.0, 0.0, -1.0])
        );
    }
}
