use palpate_geometry::Vec3;

use crate::Camera;

/// Lighting, with colours as linear red, green, blue.
pub(super) struct Light {
    /// Direction towards the key light, or the place of the lamp [m].
    pub(super) key: Vec3,
    /// 1 for a place, 0 for a direction.
    pub(super) is_place: f32,
    /// With the squared distance at which a lamp is this bright [m²].
    pub(super) color: [f32; 4],
    /// Where the light from all sides comes from.
    pub(super) up: Vec3,
    pub(super) sky: [f32; 4],
    pub(super) ground: [f32; 4],
    pub(super) backdrop: [f32; 4],
    pub(super) backdrop_edge: [f32; 4],
    pub(super) exposure: f32,
    pub(super) vignette: f32,
}

impl Light {
    /// A lamp of the operating room from behind the left shoulder, or the endoscope's own.
    pub(super) fn of(camera: &Camera) -> Self {
        let [right, up, back] = camera.axes();
        match camera.lamp {
            None => Self {
                key: (-0.55 * right + 0.75 * up + 0.65 * back).normalize(),
                is_place: 0.0,
                color: [1.75, 1.66, 1.52, 1.0],
                up: (up + 0.35 * back).normalize(),
                sky: [0.46, 0.46, 0.50, 0.0],
                ground: [0.17, 0.11, 0.10, 0.0],
                backdrop: [0.235, 0.262, 0.295, 0.0],
                backdrop_edge: [0.060, 0.070, 0.084, 0.0],
                exposure: 0.98,
                vignette: 0.05,
            },
            Some(lamp) => Self {
                key: camera.eye + lamp.distance * (0.07 * up - 0.05 * right),
                is_place: 1.0,
                color: [
                    2.3,
                    2.2,
                    2.05,
                    (lamp.brightness * lamp.distance * lamp.distance) as f32,
                ],
                up: back,
                sky: [0.16, 0.11, 0.10, 0.0],
                ground: [0.05, 0.020, 0.018, 0.0],
                backdrop: [0.115, 0.050, 0.042, 0.0],
                backdrop_edge: [0.240, 0.110, 0.092, 0.0],
                exposure: 0.95,
                vignette: 0.28,
            },
        }
    }
}
