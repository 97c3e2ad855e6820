use std::f64::consts::{FRAC_PI_2, PI, TAU};

use palpate_files::scene::TipShape;

/// Corners around a shaft.
pub(super) const AROUND: usize = 40;

/// What a half outline is turned into: radius, height, and the normal's two parts at each of its points.
/// Corners stand there twice.
pub(super) fn turned(outline: &[[f64; 4]]) -> Vec<[f32; 6]> {
    let mut corners = Vec::with_capacity(6 * AROUND * outline.len());
    for pair in outline.windows(2) {
        for step in 0..AROUND {
            let angle = |k: usize| TAU * (k % AROUND) as f64 / AROUND as f64;
            let [a, b] = [pair[0], pair[1]];
            let quad = [(a, step), (a, step + 1), (b, step), (b, step + 1)]
                .map(|(point, k)| corner(point, angle(k)));
            corners.extend([quad[0], quad[1], quad[2], quad[2], quad[1], quad[3]]);
        }
    }
    corners
}

fn corner([radius, height, out, along]: [f64; 4], angle: f64) -> [f32; 6] {
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

/// An outline through `points` of radius and height with a sharp corner at each, as [`turned`] wants it.
pub(super) fn sharp(points: &[(f64, f64)]) -> Vec<[f64; 4]> {
    let mut outline = Vec::with_capacity(2 * points.len());
    for pair in points.windows(2) {
        let [(r, z), (s, up)] = [pair[0], pair[1]];
        let (across, along) = (s - r, up - z);
        let length = across.hypot(along).max(1e-12);
        let normal = (along / length, -across / length);
        outline.push([r, z, normal.0, normal.1]);
        outline.push([s, up, normal.0, normal.1]);
    }
    outline
}

/// A shaft of `radius` [m], open at its lower end and one metre long.
pub(super) fn shaft(radius: f64) -> Vec<[f32; 6]> {
    turned(&sharp(&[
        (0.0, 0.0),
        (radius, 0.0),
        (radius, 1.0),
        (0.0, 1.0),
    ]))
}

/// The end of a probe, up to where its shaft has its full radius, and how high that is [m].
pub(super) fn probe(tip: TipShape, radius: f64, shaft: f64) -> (Vec<[f32; 6]>, f64) {
    let mut outline = match tip {
        TipShape::Flat => flat_tip(radius),
        TipShape::Sphere => ball_tip(radius, 0.55 * radius.min(shaft / 0.55)),
    };
    let [neck, height, ..] = outline[outline.len() - 1];
    // A slender neck, then a cone to the shaft.
    let start = height.max(8.0 * radius);
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
    // The shaft that begins here hides the end.
    outline.push([shaft, end, 0.0, 1.0]);
    outline.push([0.0, end, 0.0, 1.0]);
    (turned(&outline), end)
}

/// A flat face, an edge that is rounded for the eye, and the side.
fn flat_tip(r: f64) -> Vec<[f64; 4]> {
    let bevel = 0.08 * r;
    let mut outline = vec![[0.0, 0.0, 0.0, -1.0], [r - bevel, 0.0, 0.0, -1.0]];
    for k in 1..=4 {
        let (sin, cos) = (FRAC_PI_2 * f64::from(k) / 4.0).sin_cos();
        outline.push([r - bevel + bevel * sin, bevel - bevel * cos, sin, -cos]);
    }
    outline
}

/// A ball around the origin up to where a neck of radius `neck` begins.
fn ball_tip(r: f64, neck: f64) -> Vec<[f64; 4]> {
    const STEPS: u32 = 20;
    let last = PI - (neck / r).asin();
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

/// A trocar on a shaft of radius `shaft` [m]: a sleeve that ends 22 mm inside of the wall, which is at
/// z = 0, and a collar outside.
pub(super) fn sleeve(shaft: f64) -> Vec<[f32; 6]> {
    let (inner, outer, collar) = (shaft + 2e-4, shaft + 1.1e-3, shaft + 4.5e-3);
    turned(&sharp(&[
        (inner, 0.008),
        (inner, -0.022),
        (outer, -0.020),
        (outer, 0.000),
        (collar, 0.001),
        (collar + 5e-4, 0.0015),
        (collar + 5e-4, 0.0035),
        (collar, 0.004),
        (outer + 2e-3, 0.0045),
        (outer + 2e-3, 0.0075),
        (outer + 1.5e-3, 0.008),
        (inner, 0.008),
    ]))
}
