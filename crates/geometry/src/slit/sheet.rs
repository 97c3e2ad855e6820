//! The surface of a slit: below a path over the surface of a body, down to a depth.

use super::SlitPoint;
use crate::Vec3;

/// A limit of the sheet; its value at a place is positive inside of it [m].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Limit {
    /// The beginning of the path.
    Start,
    /// Its end.
    End,
    /// How deep it goes.
    Floor,
}

/// A path with directions at its points.
pub(super) struct Sheet {
    knots: Vec<Knot>,
    /// Whether the path ends where it begins.
    is_closed: bool,
    /// Length of the path [m].
    pub(super) length: f64,
    /// Largest depth [m].
    pub(super) deepest: f64,
    /// How far it goes beyond the surface [m]: a coarse mesh does not end where its surface does.
    pub(super) above: f64,
}

struct Knot {
    place: Vec3,
    /// Unit outward normal, and the unit direction along the surface that crosses the path [-].
    normal: Vec3,
    across: Vec3,
    /// Length of the path up to here [m].
    along: f64,
    depth: f64,
}

/// A place in the coordinates of the sheet [m].
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetCoordinates {
    /// Distance from the sheet, positive to the left of the path.
    pub(super) side: f64,
    /// Along the path; below zero and beyond its length outside.
    pub(super) along: f64,
    /// How far below the surface.
    pub(super) below: f64,
    /// How deep the sheet goes there.
    floor: f64,
    /// The direction that crosses the sheet there [-].
    pub(super) across: Vec3,
}

impl SheetCoordinates {
    pub(super) fn within(&self, limit: Limit, sheet: &Sheet) -> f64 {
        match limit {
            Limit::Start | Limit::End if sheet.is_closed => sheet.length,
            Limit::Start => self.along,
            Limit::End => sheet.length - self.along,
            Limit::Floor => self.floor - self.below,
        }
    }
}

impl Sheet {
    /// None where the path has no length.
    pub(super) fn new(path: &[SlitPoint], above: f64) -> Option<Self> {
        let mut points: Vec<&SlitPoint> = Vec::with_capacity(path.len());
        for point in path {
            let last = points.last();
            if last.is_none_or(|last| (point.place - last.place).norm() > 0.0) {
                points.push(point);
            }
        }
        if points.len() < 2 {
            return None;
        }
        let direction = |from: usize, to: usize| {
            let by: Vec3 = points[to].place - points[from].place;
            by.normalize()
        };
        let ends = points.len() - 1;
        let is_closed = ends > 2 && points[0].place == points[ends].place;
        let mut along = 0.0;
        let knots = (0..points.len()).map(|k| {
            let SlitPoint {
                place,
                normal,
                depth,
            } = *points[k];
            if k > 0 {
                along += (place - points[k - 1].place).norm();
            }
            let [before, after] = [k.saturating_sub(1), (k + 1).min(ends)];
            let is_seam = is_closed && (k == 0 || k == ends);
            let normal = match is_seam {
                true => (points[0].normal + points[ends].normal).normalize(),
                false => normal,
            };
            let mean = match (before < k, k < after) {
                _ if is_seam => direction(ends - 1, ends) + direction(0, 1),
                (true, true) => direction(before, k) + direction(k, after),
                _ => direction(before, after),
            };
            let across = normal.cross(&mean).try_normalize(1e-9);
            Knot {
                place,
                normal,
                across: across
                    .unwrap_or_else(|| normal.cross(&direction(before, after)).normalize()),
                along,
                depth,
            }
        });
        let knots: Vec<Knot> = knots.collect();
        Some(Self {
            length: along_of(&knots),
            deepest: knots.iter().map(|knot| knot.depth).fold(0.0, f64::max),
            knots,
            is_closed,
            above,
        })
    }

    /// Whether a place is at most `reach` [m] outside of the box around the sheet.
    pub(super) fn is_near(&self, place: &Vec3, reach: f64) -> bool {
        let reach = reach + self.deepest.max(self.above);
        (0..3).all(|axis| {
            let each = self.knots.iter().map(|knot| knot.place[axis]);
            let low = each.clone().fold(f64::INFINITY, f64::min);
            let high = each.fold(f64::NEG_INFINITY, f64::max);
            (low - reach..=high + reach).contains(&place[axis])
        })
    }

    /// A place [m], moved across onto the sheet.
    pub(super) fn onto(&self, place: &Vec3) -> Vec3 {
        let SheetCoordinates { side, across, .. } = self.at(place);
        place - side * across
    }

    /// A place in the coordinates of the nearest part of the sheet.
    pub(super) fn at(&self, place: &Vec3) -> SheetCoordinates {
        let last = self.knots.len() - 2;
        let mut best: Option<(f64, SheetCoordinates)> = None;
        for (number, pair) in self.knots.windows(2).enumerate() {
            let [from, to] = pair else { continue };
            let by = to.place - from.place;
            let length = by.norm();
            let normal = (from.normal + to.normal).normalize();
            let tangent = (by - normal * by.dot(&normal)) / length;
            let part = (place - from.place).dot(&tangent) / (length * tangent.norm_squared());
            let [is_first, is_last] = [0, last].map(|end| number == end && !self.is_closed);
            let low = if is_first { f64::NEG_INFINITY } else { 0.0 };
            let high = if is_last { f64::INFINITY } else { 1.0 };
            let part = part.clamp(low, high);
            let inside = part.clamp(0.0, 1.0);
            let blend =
                |one: &Vec3, other: &Vec3| (one * (1.0 - inside) + other * inside).normalize();
            let normal = blend(&from.normal, &to.normal);
            let across = blend(&from.across, &to.across);
            let off = place - from.place - by * part;
            let at = SheetCoordinates {
                side: off.dot(&across),
                along: from.along + part * length,
                below: -off.dot(&normal),
                floor: from.depth + inside * (to.depth - from.depth),
                across,
            };
            let outside = (at.below - self.deepest)
                .max(-self.above - at.below)
                .max(0.0);
            let past = (part - inside) * length;
            let lateral = off - normal * off.dot(&normal);
            let distance = lateral.norm_squared() + outside.powi(2) + past.powi(2);
            if best.as_ref().is_none_or(|(least, _)| distance < *least) {
                best = Some((distance, at));
            }
        }
        // A sheet has two knots at least.
        best.map_or(
            SheetCoordinates {
                side: f64::NAN,
                along: f64::NAN,
                below: f64::NAN,
                floor: 0.0,
                across: Vec3::x(),
            },
            |(_, at)| at,
        )
    }
}

fn along_of(knots: &[Knot]) -> f64 {
    knots.last().map_or(0.0, |knot| knot.along)
}
