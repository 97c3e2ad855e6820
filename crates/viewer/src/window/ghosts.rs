//! What a task draws over the picture: the line that shall be cut, and an expert's tools as bright outlines.

use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2};
use nalgebra::{Quaternion, Unit};
use palpate_geometry::Vec3;
use palpate_simulate::Ghost;

use crate::Camera;

/// How much of a shaft is drawn [m].
const SHAFT: f64 = 0.06;

/// Length of the jaws that are drawn [m], and how far they open to either side [m].
const JAWS: f64 = 0.012;
const OPEN: f64 = 0.004;

const BRIGHT: Color32 = Color32::from_rgb(120, 232, 214);

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

    /// Draws the line that shall be cut, dashed.
    pub(super) fn wanted(&self, [from, to]: [Vec3; 2]) {
        if let (Some(from), Some(to)) = (self.seen(&from), self.seen(&to)) {
            let stroke = Stroke::new(2.0, BRIGHT.gamma_multiply(0.8));
            let dashes = Shape::dashed_line(&[from, to], stroke, 7.0, 6.0);
            self.painter.extend(dashes);
            for end in [from, to] {
                self.painter.circle_filled(end, 3.5, BRIGHT);
            }
        }
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
