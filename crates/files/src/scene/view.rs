use std::f64::consts::PI;
use std::ops::Bound::Excluded;

use crate::words::words;
use crate::{Domain, Error, Key, Keys};

words! {
    /// How the surface of the organ is drawn.
    pub enum Shading {
        /// In one colour.
        Plain = "plain",
        /// With a texture.
        Texture = "texture",
        /// Wet, by a sphere map.
        SphereMap = "sphere_map",
        /// Wet, by a cube map.
        CubeMap = "cube_map",
    }
}

/// The view of the scene. The viewer chooses missing entries so that the organ fills the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The position of the camera [m].
    pub eye_m: Option<[f64; 3]>,
    /// The point at which the camera looks [m].
    pub target_m: Option<[f64; 3]>,
    /// The direction that is up in the picture [-].
    pub up: Option<[f64; 3]>,
    /// The angle from the lower to the upper edge of the picture [rad].
    pub field_of_view_rad: f64,
    /// The rendering of the organ.
    pub shading: Shading,
}

impl Default for View {
    fn default() -> Self {
        Self {
            eye_m: None,
            target_m: None,
            up: None,
            field_of_view_rad: 45_f64.to_radians(),
            shading: Shading::CubeMap,
        }
    }
}

const FIELD_OF_VIEW: Domain = Domain::number("an angle", [Excluded(0.0), Excluded(PI)])
    .with_remark("pi radians, 180 degrees");

impl View {
    pub(super) const KEYS: &'static [Key] = &[
        Key::vector("eye_m", Domain::POSITION, "Where the eye is.")
            .optional("[0.0, -0.3, 0.2]", "so that the organ fills the picture"),
        Key::vector("target_m", Domain::POSITION, "What it looks at.")
            .optional("[0.0, 0.0, 0.0]", "so that the organ fills the picture"),
        Key::direction("up", "The direction that is up in the picture.")
            .optional("[0.0, 0.0, 1.0]", "chosen by the viewer"),
        Key::number(
            "field_of_view_rad",
            FIELD_OF_VIEW,
            "The angle from the lower to the upper edge of the picture.",
        )
        .default("0.7853981633974483"),
        Key::word("shading", Shading::MEANINGS, "How the organ is drawn.").default("\"cube_map\""),
    ];

    pub(super) fn from_keys(keys: Option<&Keys<'_>>) -> Result<Self, Error> {
        let default = Self::default();
        let Some(keys) = keys else {
            return Ok(default);
        };
        Ok(Self {
            eye_m: keys.vector("eye_m")?,
            target_m: keys.vector("target_m")?,
            up: keys.direction("up")?,
            field_of_view_rad: keys
                .number("field_of_view_rad")?
                .unwrap_or(default.field_of_view_rad),
            shading: keys
                .word("shading", Shading::WORDS)?
                .unwrap_or(default.shading),
        })
    }
}
