use palpate_servo::Vec3;

/// The straight line along which an indenter approaches, presses and withdraws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    /// Out of the tissue, of length one [-].
    pub(super) normal: Vec3,
    /// Where it meets the plane through the rig's zero across it [m].
    pub(super) side: Vec3,
}

impl Line {
    /// The line through `point` [m] along `normal`, of length one.
    pub(super) fn through(point: &Vec3, normal: Vec3) -> Self {
        let side = point - normal * normal.dot(point);
        Self { normal, side }
    }

    /// The point at a height [m].
    pub(super) fn at(&self, height: f64) -> Vec3 {
        self.side + self.normal * height
    }

    /// The height of a point [m].
    pub(super) fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(point)
    }
}
