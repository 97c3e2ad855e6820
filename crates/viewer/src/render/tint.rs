use palpate_files::scene::{BuiltinOrgan, Shape};

use super::uniforms::BodyUniform;

/// The colours of a tissue, as linear red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tint {
    /// Where it is dark.
    pub dark: [f32; 3],
    /// Where it is light.
    pub light: [f32; 3],
    /// Its vessels, where its surface has some.
    pub vessel: [f32; 3],
    /// Whether vessels are seen on its surface: not under the capsule of a solid organ.
    pub has_vessels: bool,
    /// How rough it is [-]: 1 for folded mucosa, less for a smooth capsule.
    pub relief: f32,
}

impl Tint {
    /// Of an organ; that of muscle for what has no name.
    pub fn of(shape: &Shape) -> Self {
        let colors = |relief, dark, light, vessel| Self {
            dark,
            light,
            vessel,
            has_vessels: matches!(
                shape,
                Shape::Builtin {
                    organ: BuiltinOrgan::Stomach | BuiltinOrgan::Esophagus,
                    ..
                }
            ),
            relief,
        };
        let Shape::Builtin { organ, .. } = shape else {
            return Self::MUSCLE;
        };
        match organ {
            BuiltinOrgan::Liver => colors(
                0.50,
                [0.105, 0.017, 0.012],
                [0.215, 0.042, 0.027],
                [0.075, 0.010, 0.009],
            ),
            BuiltinOrgan::Kidney => colors(
                0.55,
                [0.150, 0.026, 0.022],
                [0.300, 0.072, 0.055],
                [0.120, 0.014, 0.014],
            ),
            BuiltinOrgan::Spleen => colors(
                0.60,
                [0.090, 0.014, 0.024],
                [0.190, 0.038, 0.054],
                [0.070, 0.008, 0.015],
            ),
            BuiltinOrgan::Stomach => colors(
                0.80,
                [0.37, 0.125, 0.095],
                [0.60, 0.275, 0.215],
                [0.26, 0.022, 0.022],
            ),
            BuiltinOrgan::Esophagus => colors(
                0.85,
                [0.35, 0.110, 0.090],
                [0.57, 0.255, 0.205],
                [0.27, 0.022, 0.024],
            ),
            BuiltinOrgan::Diaphragm => colors(
                0.60,
                [0.25, 0.060, 0.050],
                [0.47, 0.180, 0.140],
                [0.21, 0.020, 0.020],
            ),
            // The colour of drapes: no tissue, and what lies below it is seen.
            BuiltinOrgan::Slab => colors(
                0.30,
                [0.045, 0.105, 0.125],
                [0.085, 0.165, 0.185],
                [0.045, 0.105, 0.125],
            ),
            BuiltinOrgan::Hemisphere | BuiltinOrgan::Cube => Self::MUSCLE,
        }
    }

    /// Of what has no name.
    pub const MUSCLE: Self = Self {
        dark: [0.25, 0.062, 0.050],
        light: [0.44, 0.155, 0.120],
        vessel: [0.20, 0.018, 0.018],
        has_vessels: false,
        relief: 0.7,
    };

    /// Muscle where it is cut through.
    pub const MUSCLE_CUT: Self = Self {
        dark: [0.17, 0.022, 0.018],
        light: [0.42, 0.095, 0.070],
        vessel: [0.13, 0.012, 0.012],
        has_vessels: false,
        relief: 1.1,
    };

    /// A layer of muscle that is bare, not cut through.
    pub const MUSCLE_UNDER: Self = Self {
        dark: [0.30, 0.048, 0.038],
        light: [0.52, 0.150, 0.115],
        vessel: [0.22, 0.020, 0.020],
        has_vessels: false,
        relief: 0.9,
    };

    /// The light reddish layer inside of a muscular tube.
    pub const MUCOSA: Self = Self {
        dark: [0.76, 0.315, 0.295],
        light: [0.93, 0.490, 0.460],
        vessel: [0.62, 0.110, 0.110],
        has_vessels: true,
        relief: 0.35,
    };

    /// What is seen through the innermost layer.
    pub const LUMEN: Self = Self {
        dark: [0.016, 0.004, 0.004],
        light: [0.040, 0.010, 0.009],
        vessel: [0.012, 0.003, 0.003],
        has_vessels: false,
        relief: 0.3,
    };

    /// The lines of a wire frame.
    pub const WIRE: Self = Self {
        dark: [0.010, 0.012, 0.016],
        light: [0.010, 0.012, 0.016],
        vessel: [0.010, 0.012, 0.016],
        has_vessels: false,
        relief: 0.0,
    };

    /// Further away from the one that is looked at: paler and duller.
    #[must_use]
    pub fn receding(self) -> Self {
        let dull = |color: [f32; 3]| color.map(|c| 0.45 * c + 0.035);
        Self {
            dark: dull(self.dark),
            light: dull(self.light),
            vessel: dull(self.vessel),
            has_vessels: self.has_vessels,
            relief: self.relief,
        }
    }

    pub(super) fn uniform(self, map_as_color: f32) -> BodyUniform {
        let color = |[red, green, blue]: [f32; 3]| [red, green, blue, 0.0];
        let detail = [
            1.0 / super::tissue_map::LENGTH as f32,
            self.relief,
            map_as_color,
            1.0,
        ];
        BodyUniform::new([self.dark, self.light, self.vessel].map(color), detail)
    }
}
