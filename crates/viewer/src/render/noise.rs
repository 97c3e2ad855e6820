//! Smooth noise that repeats along every axis, for tissue without seams.

use nalgebra::Vector3;

/// Gradient noise [Perlin 2002], about within -1 to 1, which repeats after a whole number of cells along
/// every axis.
pub(super) struct Noise {
    period: i32,
    /// Per corner of a cell.
    gradients: Vec<Vector3<f32>>,
}

impl Noise {
    /// One of many, by its `seed`.
    pub(super) fn new(period: i32, seed: u32) -> Self {
        let corners = (period * period * period) as u32;
        let gradients = (0..corners).map(|corner| gradient(hash(corner, seed)));
        Self {
            period,
            gradients: gradients.collect(),
        }
    }

    /// At a place that is counted in cells.
    pub(super) fn at(&self, at: Vector3<f32>) -> f32 {
        let floor = at.map(f32::floor);
        let inside = at - floor;
        let ease = inside.map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
        let wrapped = |k: usize| {
            let near = (floor[k] as i32).rem_euclid(self.period);
            let next = if near + 1 == self.period { 0 } else { near + 1 };
            [near as usize, next as usize]
        };
        let [x, y, z] = [0, 1, 2].map(wrapped);
        let edge = self.period as usize;
        let corner = |dx: usize, dy: usize, dz: usize| {
            let offset = inside - Vector3::new(dx as f32, dy as f32, dz as f32);
            self.gradients[(z[dz] * edge + y[dy]) * edge + x[dx]].dot(&offset)
        };
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let along_x = |dy, dz| mix(corner(0, dy, dz), corner(1, dy, dz), ease.x);
        let along_y = |dz| mix(along_x(0, dz), along_x(1, dz), ease.y);
        mix(along_y(0), along_y(1), ease.z)
    }
}

/// Three octaves of [`Noise`], each twice as fine and half as strong as the last.
pub(super) struct Clouds([Noise; 3]);

impl Clouds {
    pub(super) fn new(period: i32, seed: u32) -> Self {
        Self([0, 1, 2].map(|k| Noise::new(period << k, seed + k)))
    }

    /// At a place that is counted in the coarsest cells.
    pub(super) fn at(&self, at: Vector3<f32>) -> f32 {
        let [coarse, middle, fine] = &self.0;
        coarse.at(at) + 0.5 * middle.at(2.0 * at) + 0.25 * fine.at(4.0 * at)
    }
}

/// A number from a number, without pattern.
fn hash(number: u32, seed: u32) -> u32 {
    let mut h = number ^ seed.wrapping_mul(0x9e37_79b9);
    for factor in [0x85eb_ca6b, 0xc2b2_ae35] {
        h = (h ^ (h >> 16)).wrapping_mul(factor);
    }
    h ^ (h >> 16)
}

/// One of the twelve directions from the middle of a cube to its edges.
fn gradient(hash: u32) -> Vector3<f32> {
    let signed = |bit: u32| if hash & bit == 0 { 1.0 } else { -1.0 };
    let (u, v) = (signed(0x1000), signed(0x2000));
    match hash % 3 {
        0 => Vector3::new(u, v, 0.0),
        1 => Vector3::new(u, 0.0, v),
        _ => Vector3::new(0.0, u, v),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_repeats_and_stays_small() {
        let noise = Noise::new(8, 1);
        for k in 0..200 {
            let at = Vector3::new(0.37, 0.71, 0.13) * k as f32 * 0.21;
            let here = noise.at(at);
            let there = noise.at(at + Vector3::new(8.0, -8.0, 16.0));
            // Rounding of coordinates up to 60.
            assert!((here - there).abs() < 1e-3 && here.abs() < 1.2, "{k}");
        }
    }
}
