use nalgebra::{Matrix4, UnitQuaternion};
use palpate_files::scene::{Tip, TipShape};
use palpate_geometry::Vec3;

/// Radius of a laparoscopic shaft [m].
const SHAFT: f64 = 0.0025;

/// Length of a shaft without a trocar [m].
const REACH: f64 = 0.3;

/// Corners around a shaft.
const AROUND: usize = 40;

/// A tool where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolPicture {
    /// Its shape.
    pub(super) shape: ToolShape,
    /// Its tip: the centre of a flat face or of a ball [m].
    pub(super) tip: Vec3,
    /// From the tool's frame to the scene; the shaft runs along its +z.
    pub(super) turned: UnitQuaternion<f64>,
    /// The place of the resting surface that it touches [m] and the radius of the mark there [m].
    pub(super) mark: Option<(Vec3, f64)>,
}

/// What a tool looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ToolShape {
    tip: TipShape,
    /// Of the tip [m].
    radius: f64,
    /// Radius of the shaft [m].
    pub(super) shaft: f64,
    /// Length of the shaft [m].
    reach: f64,
}

impl ToolPicture {
    /// A tool with this `tip` at `position` [m], turned by the quaternion (x, y, z, w), with a shaft up to
    /// `trocar` [m] and a little beyond.
    pub fn new(
        tip: &Tip,
        (position, orientation): ([f64; 3], [f64; 4]),
        trocar: Option<[f64; 3]>,
    ) -> Self {
        let [x, y, z, w] = orientation;
        let at = Vec3::from(position);
        let reach = trocar.map_or(REACH, |t| (Vec3::from(t) - at).norm() + 0.02);
        Self {
            shape: ToolShape {
                tip: tip.shape,
                radius: tip.radius_m,
                shaft: SHAFT.max(match tip.shape {
                    TipShape::Flat => tip.radius_m,
                    TipShape::Sphere => 0.6 * tip.radius_m,
                }),
                reach: reach.max(0.03),
            },
            tip: at,
            turned: UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, x, y, z)),
            mark: None,
        }
    }

    /// The same, with a mark where it touches the resting surface [m].
    #[must_use]
    pub fn touching(mut self, place: Vec3) -> Self {
        self.mark = Some((place, 1.35 * self.shape.radius.max(5e-4)));
        self
    }

    /// The axis of the part that shades the organ [m].
    pub(super) fn capsule(&self) -> (Vec3, Vec3) {
        let along = self.turned * Vec3::z();
        let lift = match self.shape.tip {
            TipShape::Flat => self.shape.shaft,
            TipShape::Sphere => 0.0,
        };
        let far = self.shape.reach.min(0.12);
        (self.tip + lift * along, self.tip + far * along)
    }

    pub(super) fn placed(&self) -> Matrix4<f64> {
        let mut placed = self.turned.to_homogeneous();
        placed.fixed_view_mut::<3, 1>(0, 3).copy_from(&self.tip);
        placed
    }
}

impl ToolShape {
    /// Position and normal of three corners of each triangle, in the tool's frame.
    pub(super) fn triangles(&self) -> Vec<[f32; 6]> {
        let outline = self.outline();
        let mut corners = Vec::with_capacity(6 * AROUND * outline.len());
        for pair in outline.windows(2) {
            for step in 0..AROUND {
                let angle = |k: usize| std::f64::consts::TAU * k as f64 / AROUND as f64;
                let [a, b] = [pair[0], pair[1]];
                let quad = [(a, step), (a, step + 1), (b, step), (b, step + 1)]
                    .map(|(point, k)| turned(point, angle(k)));
                corners.extend([quad[0], quad[1], quad[2], quad[2], quad[1], quad[3]]);
            }
        }
        corners
    }

    /// The half outline, from the tip to the end: radius, height, and the normal's two parts. Corners
    /// stand there twice.
    fn outline(&self) -> Vec<[f64; 4]> {
        let (r, shaft) = (self.radius, self.shaft);
        let mut outline = match self.tip {
            TipShape::Flat => flat_tip(r),
            TipShape::Sphere => ball_tip(r, 0.55 * r.min(shaft / 0.55)),
        };
        let [neck, height, ..] = outline[outline.len() - 1];
        // A slender neck, then a cone to the shaft.
        let start = height.max(8.0 * r);
        outline.push([neck, start, 1.0, 0.0]);
        let end = start + 1.6 * (shaft - neck);
        let (dr, dz) = (shaft - neck, end - start);
        let length = dr.hypot(dz);
        if length > 1e-6 {
            let cone = (dz / length, -dr / length);
            outline.push([neck, start, cone.0, cone.1]);
            outline.push([shaft, end, cone.0, cone.1]);
        }
        outline.push([shaft, end, 1.0, 0.0]);
        outline.push([shaft, self.reach.max(2.0 * end), 1.0, 0.0]);
        outline
    }
}

/// A flat face, an edge that is rounded for the eye, and the side.
fn flat_tip(r: f64) -> Vec<[f64; 4]> {
    let bevel = 0.08 * r;
    let mut outline = vec![[0.0, 0.0, 0.0, -1.0], [r - bevel, 0.0, 0.0, -1.0]];
    for k in 1..=4 {
        let (sin, cos) = (std::f64::consts::FRAC_PI_2 * f64::from(k) / 4.0).sin_cos();
        outline.push([r - bevel + bevel * sin, bevel - bevel * cos, sin, -cos]);
    }
    outline
}

/// A ball around the origin up to where a neck of radius `neck` begins.
fn ball_tip(r: f64, neck: f64) -> Vec<[f64; 4]> {
    const STEPS: u32 = 20;
    let last = std::f64::consts::PI - (neck / r).asin();
    let mut outline: Vec<_> = (0..=STEPS)
        .map(|k| {
            let (sin, cos) = (last * f64::from(k) / f64::from(STEPS)).sin_cos();
            [r * sin, -r * cos, sin, -cos]
        })
        .collect();
    let [radius, height, ..] = outline[outline.len() - 1];
    outline.push([radius, height, 1.0, 0.0]);
    outline
}

fn turned([radius, height, out, along]: [f64; 4], angle: f64) -> [f32; 6] {
    let (sin, cos) = angle.sin_cos();
    [
        radius * cos,
        radius * sin,
        height,
        out * cos,
        out * sin,
        along,
    ]
    .map(|c| c as f32)
}
