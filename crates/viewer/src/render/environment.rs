//! The surroundings of an organ, which its wet film mirrors: the inside of an abdomen under two lamps, or the
//! user's picture; as a sphere map and as a cube map.
//!
//! A sphere map is the picture of a mirroring ball, as graphics hardware reads it: the reflection
//! `r` of the eye's frame is at `r.xy / (2 |r + z|) + 1/2`. A cube map has six sides.
//!
//! *How we know*: `analytic::both_maps_show_the_same_surroundings`.

use nalgebra::Vector3;

use super::noise::Clouds;

/// Brightest light that a map holds; its texels are square roots of light over this [-].
const BRIGHTEST: f32 = 4.0;

/// Texels across a sphere map.
pub(crate) const SPHERE_EDGE: usize = 192;
/// Texels along the edge of a side of a cube map.
pub(crate) const CUBE_EDGE: usize = 96;

/// Light that comes from a unit direction [-], as linear red, green and blue.
pub(crate) type Surroundings<'a> = dyn Fn(Vector3<f32>) -> [f32; 3] + 'a;

/// The inside of an abdomen: peritoneum above and around, fat in it, the dark of the other organs below,
/// and lamps. Up is +z.
pub(crate) fn abdomen() -> impl Fn(Vector3<f32>) -> [f32; 3] {
    let (waves, lobes) = (Clouds::new(8, 61), Clouds::new(8, 71));
    move |direction| {
        let wavy = waves.at(direction * 1.8);
        let fat = smooth(0.05, 0.55, lobes.at(direction * 2.6));
        wall(direction, wavy, fat)
    }
}

fn wall(direction: Vector3<f32>, wavy: f32, fat: f32) -> [f32; 3] {
    let height = direction.z + 0.25 * wavy;
    let dark = Vector3::new(0.055, 0.012, 0.010);
    let wall = Vector3::new(0.46, 0.15, 0.12);
    let above = Vector3::new(0.86, 0.52, 0.44);
    let yellow = Vector3::new(0.85, 0.60, 0.30);
    let mut color = dark.lerp(&wall, smooth(-0.75, 0.15, height));
    color = color.lerp(&above, smooth(0.1, 0.9, height));
    color = color.lerp(&yellow, 0.55 * fat * smooth(-0.4, 0.4, height));
    let lamps = [
        (Vector3::new(-0.50, -0.62, 0.62), 26.0, 3.6),
        (Vector3::new(0.75, -0.30, 0.45), 40.0, 1.6),
        (Vector3::new(0.1, 0.8, 0.5), 14.0, 0.8),
    ];
    for (towards, narrow, strength) in lamps {
        let near = (narrow * (direction.dot(&towards.normalize()) - 1.0)).exp();
        color += Vector3::new(1.0, 0.95, 0.88) * strength * near;
    }
    color.into()
}

fn smooth(from: f32, to: f32, value: f32) -> f32 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn encoded(light: [f32; 3]) -> [u8; 4] {
    let byte = |c: f32| ((c / BRIGHTEST).clamp(0.0, 1.0).sqrt() * 255.0).round() as u8;
    let [red, green, blue] = light.map(byte);
    [red, green, blue, 255]
}

/// The sphere map of `surroundings`, seen by an eye that looks along +y, the way organs are looked at.
pub(crate) fn sphere_map(surroundings: &Surroundings<'_>) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(4 * SPHERE_EDGE * SPHERE_EDGE);
    for row in 0..SPHERE_EDGE {
        for column in 0..SPHERE_EDGE {
            let place = |k: usize| (k as f32 + 0.5) / SPHERE_EDGE as f32 - 0.5;
            let seen = mirrored_at(place(column), -place(row));
            bytes.extend(encoded(surroundings(seen)));
        }
    }
    bytes
}

/// The direction in the scene that a sphere map shows at (x, y) from its middle, from -1/2 to 1/2.
pub(crate) fn mirrored_at(x: f32, y: f32) -> Vector3<f32> {
    // The rim shows what is behind the ball; outside of it nothing is looked up.
    let squared = (4.0 * (x * x + y * y)).min(1.0 - 1e-6);
    let along = 4.0 * (1.0 - squared).sqrt();
    let (right, up, back) = (x * along, y * along, 1.0 - 2.0 * squared);
    // The eye's back is -y of the scene, and its up is +z.
    Vector3::new(right, -back, up).normalize()
}

/// The six sides of the cube map of `surroundings`, in the order of graphics hardware.
pub(crate) fn cube_map(surroundings: &Surroundings<'_>) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(24 * CUBE_EDGE * CUBE_EDGE);
    for side in 0..6 {
        for row in 0..CUBE_EDGE {
            for column in 0..CUBE_EDGE {
                let place = |k: usize| 2.0 * (k as f32 + 0.5) / CUBE_EDGE as f32 - 1.0;
                let seen = through_side(side, place(column), place(row));
                bytes.extend(encoded(surroundings(seen)));
            }
        }
    }
    bytes
}

/// The direction in the scene that `side` shows at (u, v), from -1 to 1 to the right and down.
pub(crate) fn through_side(side: usize, u: f32, v: f32) -> Vector3<f32> {
    let (x, y, z) = match side {
        0 => (1.0, -v, -u),
        1 => (-1.0, -v, u),
        2 => (u, 1.0, v),
        3 => (u, -1.0, -v),
        4 => (u, -v, 1.0),
        _ => (-u, -v, -1.0),
    };
    // Sides are left-handed with y up; a scene has z up.
    Vector3::new(x, z, y).normalize()
}
