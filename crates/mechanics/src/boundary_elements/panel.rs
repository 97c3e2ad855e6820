use crate::Vec3;

/// A flat triangle of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panel {
    /// Corners [m], counterclockwise seen from outside.
    pub corners: [Vec3; 3],
    /// The collocation point of its equations [m].
    pub centroid: Vec3,
    /// Outward unit normal [-].
    pub normal: Vec3,
    /// Area [m²].
    pub area: f64,
}

impl Panel {
    /// The panel with these `corners` [m]; none where they span no area.
    pub fn new(corners: [Vec3; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let twice = (b - a).cross(&(c - a));
        let area = 0.5 * twice.norm();
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        // Below this the normal is rounding.
        (area > 1e-12 * longest * longest).then(|| Self {
            corners,
            centroid: (a + b + c) / 3.0,
            normal: twice / (2.0 * area),
            area,
        })
    }
}
