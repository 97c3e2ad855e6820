use palpate_geometry::Vec3;

/// Width of an opening at one place, and extent of one along a cut beyond its ends on both sides together, in widths of
/// a cut [-].
const PUNCTURE: f64 = 0.5;

/// A straight part of a cut on the resting surface. One without length is a puncture, where a cut begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutPart {
    /// Its ends [m].
    pub ends: [Vec3; 2],
    /// Unit outward normal of the surface there [-].
    pub normal: Vec3,
    /// Whether it starts a cut; else it continues from the end of the part before.
    pub begins: bool,
    /// Number of open layers in it, from outside.
    pub layers: usize,
    /// Number of them that the mechanics include: those that were open when a blade was last lifted.
    pub(crate) in_mechanics: usize,
}

/// The point on a part that is closest to another point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Number of the part.
    pub(super) part: usize,
    /// Distance [m].
    pub(super) distance: f64,
    /// Coordinate of the other point along the part, below 0 and above 1 outside it [-].
    along: f64,
}

impl CutPart {
    /// Its length over the resting surface [m].
    pub fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    fn near(&self, part: usize, place: &Vec3) -> Near {
        let [start, end] = self.ends;
        let path = end - start;
        let squared = path.norm_squared();
        let along = match squared > 0.0 {
            true => (place - start).dot(&path) / squared,
            false => 0.5,
        };
        let nearest = start + along.clamp(0.0, 1.0) * path;
        Near {
            part,
            distance: (nearest - place).norm(),
            along,
        }
    }
}

/// The part that is nearest to `place` [m]; of several, one with a length.
pub(super) fn nearest(parts: &[CutPart], place: &Vec3) -> Option<Near> {
    let mut found: Option<Near> = None;
    for (number, part) in parts.iter().enumerate() {
        let near = part.near(number, place);
        let is_better = |best: Near| {
            near.distance < best.distance
                || near.distance == best.distance && parts[best.part].length() == 0.0
        };
        if found.is_none_or(is_better) {
            found = Some(near);
        }
    }
    found
}

/// The part in whose opening, `width` [m] wide, `place` [m] lies: next to the cut, or just beyond its ends.
pub(super) fn opening_at(parts: &[CutPart], place: &Vec3, width: f64) -> Option<usize> {
    let near = nearest(parts, place)?;
    let number = near.part;
    let is_alone = parts[number].length() == 0.0;
    let reach = 0.5 * width * if is_alone { PUNCTURE } else { 1.0 };
    let is_first = parts[number].begins || parts[number - 1].length() == 0.0;
    let is_last = parts.get(number + 1).is_none_or(|next| next.begins);
    let beyond = near.along < 0.0 && is_first || near.along > 1.0 && is_last;
    let reach = if beyond {
        0.5 * width * PUNCTURE
    } else {
        reach
    };
    (near.distance < reach).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(from: f64, to: f64, begins: bool) -> CutPart {
        CutPart {
            ends: [from, to].map(|x| Vec3::new(x, 0.0, 0.0)),
            normal: Vec3::z(),
            begins,
            layers: 1,
            in_mechanics: 1,
        }
    }

    #[test]
    fn an_opening_ends_at_its_ends() {
        let parts = [
            part(0.0, 0.0, true),
            part(0.0, 1.0, false),
            part(1.0, 2.0, false),
        ];
        let at = |x: f64, y: f64| opening_at(&parts, &Vec3::new(x, y, 0.0), 1.0);
        assert_eq!(at(0.5, 0.3), Some(1));
        assert_eq!(at(1.6, -0.3), Some(2));
        assert_eq!(at(1.6, 0.6), None);
        assert_eq!(at(-0.2, 0.0), Some(1));
        assert_eq!(at(-0.3, 0.0), None);
        assert_eq!(at(2.3, 0.0), None);
        assert_eq!(
            opening_at(&parts[..1], &Vec3::new(0.2, 0.0, 0.0), 1.0),
            Some(0)
        );
        assert_eq!(
            opening_at(&parts[..1], &Vec3::new(0.3, 0.0, 0.0), 1.0),
            None
        );
    }
}
