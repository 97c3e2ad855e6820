//! Overlays of a task: the remaining work, the solution when it is over, and an expert's tools as bright
//! outlines.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2};
use nalgebra::{Quaternion, Unit};
use palpate_files::scene::{CutLine, EstimatedInclusion};
use palpate_geometry::Vec3;
use palpate_simulate::Ghost;

use super::texts::text;
use crate::Camera;
use crate::style::{BRIGHT, LEFT};

/// How much of a shaft is drawn [m].
const SHAFT: f64 = 0.06;

/// Length of the jaws that are drawn [m], and how far they open to either side [m].
const JAWS: f64 = 0.012;
const OPEN: f64 = 0.004;

/// Length of the arrow of a pull [m].
const ARROW: f64 = 0.025;

/// The middle of the lump that a target lies over [m], for from the eye it is not below that; the target where there is
/// no lump.
pub(super) fn nearest_lump(lumps: &[EstimatedInclusion], target: Vec3) -> Vec3 {
    let middles = lumps.iter().map(|lump| Vec3::from(lump.middle()));
    let off = |middle: &Vec3| (middle - target).norm();
    let nearest = middles.min_by(|one, other| off(one).total_cmp(&off(other)));
    nearest.unwrap_or(target)
}

/// A picture that is drawn on, and from where it was taken.
pub(super) struct Over<'a> {
    pub(super) painter: Painter,
    pub(super) rect: Rect,
    pub(super) camera: &'a Camera,
}

impl Over<'_> {
    fn seen(&self, place: &Vec3) -> Option<Pos2> {
        let aspect = f64::from(self.rect.width() / self.rect.height().max(1.0));
        let ((across, down), _) = self.camera.project(place, aspect)?;
        let size = self.rect.size();
        Some(self.rect.min + Vec2::new(size.x * across as f32, size.y * down as f32))
    }

    fn line(&self, from: &Vec3, to: &Vec3, stroke: Stroke) {
        if let (Some(from), Some(to)) = (self.seen(from), self.seen(to)) {
            self.painter.line_segment([from, to], stroke);
        }
    }

    /// Draws the line that shall be cut, dashed, and the ends of an open one.
    pub(super) fn wanted(&self, line: &CutLine) {
        let points = line.points_m().iter();
        let seen: Option<Vec<Pos2>> = points.map(|point| self.seen(&Vec3::from(*point))).collect();
        let Some(seen) = seen else {
            return;
        };
        let stroke = Stroke::new(2.0, BRIGHT.gamma_multiply(0.8));
        self.painter
            .extend(Shape::dashed_line(&seen, stroke, 7.0, 6.0));
        let ends = [seen.first(), seen.last()];
        for end in ends.into_iter().flatten().filter(|_| !line.is_closed()) {
            self.painter.circle_filled(*end, 3.5, BRIGHT);
        }
    }

    /// Draws what of a line is not cut yet.
    pub(super) fn left(&self, stretches: &[[Vec3; 2]]) {
        for [from, to] in stretches {
            self.line(from, to, Stroke::new(5.0, Color32::from_black_alpha(110)));
            self.line(from, to, Stroke::new(2.5, LEFT));
        }
    }

    /// Draws where a tip shall pull to.
    pub(super) fn arrow(&self, tip: &Vec3, direction: &Vec3) {
        let end = tip + ARROW * direction.normalize();
        if let (Some(from), Some(to)) = (self.seen(tip), self.seen(&end)) {
            let way = to - from;
            // Straight at the eye an arrow is a point, which says so.
            if way.length() < 12.0 {
                self.painter
                    .circle_stroke(from, 14.0, Stroke::new(3.0, LEFT));
                self.painter.circle_filled(from, 4.0, LEFT);
            } else {
                self.painter.arrow(from, way, Stroke::new(3.5, LEFT));
            }
        }
    }

    /// Draws a lump through the organ: a disc of its size.
    pub(super) fn lump(&self, middle: &Vec3, radius: f64) {
        let [right, ..] = self.camera.axes();
        let edge = middle + radius * right;
        if let (Some(at), Some(edge)) = (self.seen(middle), self.seen(&edge)) {
            let size = at.distance(edge);
            self.painter
                .circle_filled(at, size, LEFT.gamma_multiply(0.45));
            self.painter.circle_stroke(at, size, Stroke::new(2.5, LEFT));
            self.named(
                at + Vec2::new(0.0, -size - 4.0),
                &text!("picture-lump"),
                LEFT,
            );
        }
    }

    /// Draws the outline of the radius [m] that was stated for a lump, whose true one is `truth` [m].
    pub(super) fn stated(&self, middle: &Vec3, radius: f64, truth: f64) {
        let [right, ..] = self.camera.axes();
        let size_of = |radius: f64| {
            let (at, edge) = (self.seen(middle)?, self.seen(&(middle + radius * right))?);
            Some((at, at.distance(edge)))
        };
        if let (Some((at, size)), Some((_, lump))) = (size_of(radius), size_of(truth)) {
            self.dashed_ring(at, size, BRIGHT);
            let below = at + Vec2::new(0.0, size.max(lump) + 22.0);
            self.named(below, &text!("picture-stated"), BRIGHT);
        }
    }

    /// Draws the place that is to be touched: a full ring where it is seen, a dashed one where something covers it.
    pub(super) fn target(&self, target: &Vec3, radius: f64, is_covered: bool) {
        let [right, ..] = self.camera.axes();
        let edge = target + radius * right;
        let (Some(at), Some(edge)) = (self.seen(target), self.seen(&edge)) else {
            return;
        };
        let size = at.distance(edge).max(6.0);
        if is_covered {
            self.dashed_ring(at, size, LEFT.gamma_multiply(0.8));
        } else {
            let shadow = Stroke::new(5.0, Color32::from_black_alpha(110));
            self.painter.circle_stroke(at, size, shadow);
            self.painter.circle_stroke(at, size, Stroke::new(2.5, LEFT));
            self.painter.circle_filled(at, 3.0, LEFT);
        }
        self.named(
            at + Vec2::new(0.0, -size - 4.0),
            &text!("picture-target"),
            LEFT,
        );
    }

    fn dashed_ring(&self, at: Pos2, size: f32, color: Color32) {
        let turn = |part: u8| {
            let angle = std::f32::consts::TAU * f32::from(part) / 48.0;
            at + size * Vec2::angled(angle)
        };
        for part in (0..48).step_by(2) {
            let dash = [turn(part), turn(part + 1)];
            self.painter.line_segment(dash, Stroke::new(2.5, color));
        }
    }

    /// Draws where a place was marked, and how far from the right one.
    pub(super) fn mark(&self, marked: &Vec3, target: &Vec3) {
        self.line(marked, target, Stroke::new(1.5, BRIGHT));
        if let Some(at) = self.seen(marked) {
            let stroke = Stroke::new(3.0, BRIGHT);
            for side in [-1.0, 1.0] {
                let way = Vec2::new(7.0, 7.0 * side);
                self.painter.line_segment([at - way, at + way], stroke);
            }
            self.named(at + Vec2::new(0.0, 26.0), &text!("picture-mark"), BRIGHT);
        }
    }

    /// Writes a name whose lower middle is `at`.
    fn named(&self, at: Pos2, words: &str, color: Color32) {
        let font = FontId::proportional(14.0);
        let shadow = Color32::from_black_alpha(220);
        self.painter.text(
            at + Vec2::splat(1.0),
            Align2::CENTER_BOTTOM,
            words,
            font.clone(),
            shadow,
        );
        self.painter
            .text(at, Align2::CENTER_BOTTOM, words, font, color);
    }

    /// Draws where an expert's tools were.
    pub(super) fn tools(&self, ghosts: &[Option<Ghost>]) {
        for ghost in ghosts.iter().flatten() {
            let [x, y, z, w] = ghost.orientation;
            let turned = Unit::new_normalize(Quaternion::new(w, x, y, z));
            let tip = Vec3::from(ghost.position);
            let (along, across) = (turned * Vec3::z(), turned * Vec3::x());
            let hinge = tip + along * JAWS;
            self.line(
                &hinge,
                &(tip + along * SHAFT),
                Stroke::new(5.0, BRIGHT.gamma_multiply(0.35)),
            );
            let open = (1.0 - ghost.grip) * OPEN;
            for side in [-1.0, 1.0] {
                self.line(
                    &hinge,
                    &(tip + across * (side * open)),
                    Stroke::new(2.5, BRIGHT),
                );
            }
            if let Some(at) = self.seen(&tip) {
                self.painter
                    .circle_stroke(at, 7.0, Stroke::new(1.5, BRIGHT));
            }
        }
    }
}
