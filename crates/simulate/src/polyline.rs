//! A line over a surface, measured along itself.

use palpate_files::scene::CutLine;
use palpate_geometry::Vec3;

/// Points joined by straight pieces.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Polyline {
    /// Points [m], and their arc length along the line [m].
    points: Vec<(f64, Vec3)>,
    /// Twice the area that a closed line encloses, along its normal [m²]; none of an open one.
    enclosed: Option<Vec3>,
}

/// The point of a line that is closest to another point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearestOnLine {
    /// Arc length of it along the line [m].
    pub(crate) along: f64,
    /// From it to the other point [m].
    pub(crate) offset: Vec3,
    /// Whether the other point is inside the line; none for an open one.
    pub(crate) is_inside: Option<bool>,
}

impl Polyline {
    /// The line of a cut; none if it has no length.
    pub(crate) fn new(line: &CutLine) -> Option<Self> {
        let mut points: Vec<(f64, Vec3)> = Vec::new();
        for point in line.points_m() {
            let point = Vec3::from(*point);
            let along = points
                .last()
                .map_or(0.0, |(along, last)| along + (point - last).norm());
            points.push((along, point));
        }
        let (_, first) = points.first()?;
        let enclosed = points.windows(2).map(|piece| {
            let [from, to] = [piece[0].1, piece[1].1];
            (from - first).cross(&(to - first))
        });
        let enclosed = line.is_closed().then(|| enclosed.sum());
        let own = Self { points, enclosed };
        (own.length() > 0.0).then_some(own)
    }

    /// Its length [m].
    pub(crate) fn length(&self) -> f64 {
        self.points.last().map_or(0.0, |(along, _)| *along)
    }

    /// Whether it ends where it begins.
    pub(crate) fn is_closed(&self) -> bool {
        self.enclosed.is_some()
    }

    /// Its points [m]; the last one of a closed line is the first one.
    pub(crate) fn points(&self) -> impl Iterator<Item = Vec3> {
        self.points.iter().map(|(_, point)| *point)
    }

    /// The point at this arc length [m]: beyond the ends of an open line straight on, of a closed one around again.
    pub(crate) fn at(&self, along: f64) -> Vec3 {
        let along = match self.is_closed() {
            true => along.rem_euclid(self.length()),
            false => along,
        };
        let end = self.points.partition_point(|(own, _)| *own <= along);
        let end = end.clamp(1, self.points.len() - 1);
        let ((start, from), (stop, to)) = (self.points[end - 1], self.points[end]);
        from + (to - from) * ((along - start) / (stop - start))
    }

    /// The straight pieces between two arc lengths [m]: their ends [m].
    pub(crate) fn pieces(&self, from: f64, to: f64) -> Vec<[Vec3; 2]> {
        let inner = self.points.iter().map(|(along, _)| *along);
        let inner = inner.filter(|along| from < *along && *along < to);
        let ends: Vec<f64> = [from].into_iter().chain(inner).chain([to]).collect();
        let pieces = ends.windows(2);
        // The end of a closed line is its last point, not its first one.
        let end = self.points.last().map_or_else(Vec3::zeros, |(_, end)| *end);
        let at = |along: f64| match along < self.length() {
            true => self.at(along),
            false => end,
        };
        pieces.map(|piece| [at(piece[0]), at(piece[1])]).collect()
    }

    /// Its point that is closest to `place` [m].
    pub(crate) fn nearest(&self, place: &Vec3) -> NearestOnLine {
        let mut found = NearestOnLine {
            along: 0.0,
            offset: Vec3::repeat(f64::INFINITY),
            is_inside: None,
        };
        for piece in self.points.windows(2) {
            let ((start, from), (stop, to)) = (piece[0], piece[1]);
            let segment = to - from;
            let part = (place - from).dot(&segment) / segment.norm_squared();
            let part = if part.is_finite() {
                part.clamp(0.0, 1.0)
            } else {
                0.0
            };
            let offset = place - (from + segment * part);
            if offset.norm_squared() < found.offset.norm_squared() {
                // A closed line runs counter-clockwise about its enclosed area.
                let outward = self.enclosed.map(|enclosed| segment.cross(&enclosed));
                found = NearestOnLine {
                    along: start + (stop - start) * part,
                    offset,
                    is_inside: outward.map(|outward| offset.dot(&outward) < 0.0),
                };
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: a circle's closed forms. Tolerances: its chords, half a thousandth of the radius, whose normals are up to half
    /// of their angle, 2π/96, off that of the circle.
    #[test]
    fn a_circle_is_measured_around_itself() {
        let (center, radius) = (Vec3::new(0.01, -0.02, 0.03), 0.014);
        let line = CutLine::circle(center.into(), radius, [0.0, 0.0, 2.0]);
        let line = Polyline::new(&line).unwrap();
        let around = std::f64::consts::TAU * radius;
        assert!(line.is_closed() && (line.length() / around - 1.0).abs() < 5e-4);
        let quarter = line.at(0.25 * line.length()) - center;
        let start = line.at(0.0) - center;
        assert!((start.norm() - radius).abs() < 1e-15);
        assert!((Vec3::z().cross(&start) - quarter).norm() < 1e-15);
        assert!((line.at(line.length() + 0.001) - line.at(0.001)).norm() < 1e-15);
        for (part, off) in [(0.1, 0.003_f64), (0.7, -0.002), (0.99, 0.001)] {
            let on = line.at(part * line.length()) - center;
            let near = line.nearest(&(center + on * (1.0 + off / radius) - 0.002 * Vec3::z()));
            let tolerance = 5e-4 * radius + off.abs() * std::f64::consts::PI / 96.0;
            assert!(
                (near.along - part * line.length()).abs() < tolerance,
                "{part}"
            );
            let offset: f64 = near.offset.xy().norm();
            assert!((offset - off.abs()).abs() < 5e-4 * radius, "{part}");
            assert!((near.offset.z + 0.002).abs() < 1e-15, "{part}");
            assert_eq!(near.is_inside, Some(off < 0.0), "{part}");
        }
        let pieces = line.pieces(0.9 * line.length(), line.length());
        let sum: f64 = pieces.iter().map(|[from, to]| (to - from).norm()).sum();
        assert!((sum - 0.1 * line.length()).abs() < 1e-15);
        assert!((pieces[pieces.len() - 1][1] - line.at(0.0)).norm() < 1e-15);
    }

    #[test]
    fn a_straight_line_goes_straight_on() {
        let line = CutLine::straight([0.0; 3], [0.03, 0.0, 0.0]);
        let line = Polyline::new(&line).unwrap();
        assert!((line.at(-0.002) - Vec3::x() * -0.002).norm() < 1e-15);
        assert!((line.at(0.032) - Vec3::x() * 0.032).norm() < 1e-15);
        let near = line.nearest(&Vec3::new(0.034, 0.003, 0.0));
        assert_eq!((near.along, near.is_inside), (0.03, None));
        assert!((near.offset.norm() - 0.005).abs() < 1e-15);
        assert_eq!(line.pieces(0.01, 0.03).len(), 1);
    }
}
