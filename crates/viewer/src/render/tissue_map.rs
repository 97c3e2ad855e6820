//! Texture of tissue as a block that repeats in space: the resting position on the organ's surface determines
//! relief and colour, so that there are no seams and no stretched places, and the texture follows tissue
//! that deforms.
//!
//! A texel holds the slope of the relief along x, y and z and the tone: 0 a vessel, 0.3 dark, 1 light.

use nalgebra::Vector3;

use super::noise::{Clouds, Noise};

/// Texels along an edge of the block.
pub(super) const EDGE: usize = 80;

/// Length of an edge of the block [m].
pub(super) const LENGTH: f64 = 0.030;

/// The block without vessels and with them, each with its halves, quarters and so on, as bytes.
pub(super) fn levels() -> [Vec<Vec<u8>>; 2] {
    let values = values();
    [0.0, 1.0].map(|vessels| {
        let mut levels = vec![finest(&values, vessels)];
        let mut edge = EDGE;
        while edge > 6 {
            levels.push(halved(&levels[levels.len() - 1], edge));
            edge /= 2;
        }
        levels
    })
}

/// Height, tone and vessels of each texel.
fn values() -> Vec<[f32; 3]> {
    let layers = EDGE.div_ceil(4);
    let grain = &Grain::new();
    // The block is made in four parts at once: it is what takes longest of all that is made at a start.
    let parts: Vec<Vec<[f32; 3]>> = std::thread::scope(|scope| {
        let make = move |part: usize| -> Vec<[f32; 3]> {
            let range = part * layers..((part + 1) * layers).min(EDGE);
            range.flat_map(|z| grain.layer(z)).collect()
        };
        let making: Vec<_> = (0..4)
            .map(|part| {
                let thread = std::thread::Builder::new();
                (part, thread.spawn_scoped(scope, move || make(part)))
            })
            .collect();
        making
            .into_iter()
            .map(|(part, thread)| match thread {
                Ok(thread) => thread
                    .join()
                    .expect("noise is arithmetic and does not panic"),
                // The system gives no thread: here, then.
                Err(_) => make(part),
            })
            .collect()
    });
    parts.into_iter().flatten().collect()
}

fn finest(values: &[[f32; 3]], vessels: f32) -> Vec<u8> {
    let index = |x: usize, y: usize, z: usize| (z % EDGE * EDGE + y % EDGE) * EDGE + x % EDGE;
    // A vessel stands out a little.
    let height = |x, y, z| {
        let [bumps, _, blood] = values[index(x, y, z)];
        bumps + 0.16 * vessels * blood
    };
    let mut bytes = Vec::with_capacity(4 * EDGE * EDGE * EDGE);
    let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
    for z in 0..EDGE {
        for y in 0..EDGE {
            for x in 0..EDGE {
                let before = EDGE - 1;
                let slopes = [
                    height(x + 1, y, z) - height(x + before, y, z),
                    height(x, y + 1, z) - height(x, y + before, z),
                    height(x, y, z + 1) - height(x, y, z + before),
                ];
                bytes.extend(slopes.map(|slope| byte(0.5 + slope)));
                let [_, patches, blood] = values[index(x, y, z)];
                bytes.push(byte(patches * (1.0 - vessels * blood)));
            }
        }
    }
    bytes
}

/// Components of the tissue texture.
struct Grain {
    bumps: [Noise; 2],
    patches: Clouds,
    warp: [Noise; 3],
    width: [Noise; 2],
    vessels: [Noise; 2],
}

impl Grain {
    fn new() -> Self {
        Self {
            bumps: [Noise::new(9, 11), Noise::new(20, 12)],
            patches: Clouds::new(4, 21),
            warp: [31, 32, 33].map(|seed| Noise::new(5, seed)),
            width: [Noise::new(3, 41), Noise::new(4, 42)],
            vessels: [Noise::new(3, 51), Noise::new(7, 52)],
        }
    }

    /// Height, tone and vessels of the texels of one layer.
    fn layer(&self, z: usize) -> impl Iterator<Item = [f32; 3]> {
        (0..EDGE * EDGE).map(move |k| {
            let at = Vector3::new((k % EDGE) as f32, (k / EDGE) as f32, z as f32);
            self.texel(at / EDGE as f32)
        })
    }

    /// Height, tone and vessels at a place of the block, from 0 to 1 along its edges.
    fn texel(&self, at: Vector3<f32>) -> [f32; 3] {
        let bumps = 0.55 * self.bumps[0].at(at * 9.0) + 0.30 * self.bumps[1].at(at * 20.0);
        let patches = 0.68 + 0.36 * self.patches.at(at * 4.0);
        // Vessels lie where a warped noise changes its sign; they thin out and end.
        let warp = Vector3::from_fn(|k, _| self.warp[k].at(at * 5.0));
        let warped = at + 0.055 * warp;
        let wide = 0.050 * (0.30 + self.width[0].at(at * 3.0)).clamp(0.0, 0.8);
        let thin = 0.050 * (0.12 - self.width[1].at(at * 4.0)).clamp(0.0, 0.6);
        let trunk = vessel(self.vessels[0].at(warped * 3.0), wide);
        let branch = vessel(self.vessels[1].at(warped * 7.0), 1.6 * thin);
        let blood = trunk.max(0.85 * branch);
        [bumps, patches.clamp(0.32, 1.0), blood]
    }
}

/// How much of a vessel of half width `width` there is where the noise is `value`.
fn vessel(value: f32, width: f32) -> f32 {
    if width <= 0.0 {
        return 0.0;
    }
    let across = (value / width).abs().min(1.0);
    (1.0 - across * across).powi(2) * (width / 0.02).min(1.0)
}

/// The next coarser level: the mean of each eight texels.
fn halved(finer: &[u8], edge: usize) -> Vec<u8> {
    let half = edge / 2;
    let mut coarser = Vec::with_capacity(finer.len() / 8);
    for z in 0..half {
        for y in 0..half {
            for x in 0..half {
                for channel in 0..4 {
                    let sum: u32 = (0..8)
                        .map(|corner| {
                            let (dx, dy, dz) = (corner & 1, corner >> 1 & 1, corner >> 2);
                            let at = ((2 * z + dz) * edge + 2 * y + dy) * edge + 2 * x + dx;
                            u32::from(finer[4 * at + channel])
                        })
                        .sum();
                    coarser.push(((sum + 4) / 8) as u8);
                }
            }
        }
    }
    coarser
}

/// Length of a texel [m].
pub(super) fn texel_length() -> f64 {
    LENGTH / EDGE as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tone of dark tissue is 0.32 of 255; what is darker is a vessel.
    #[test]
    fn only_one_block_has_vessels() {
        let [bare, vessels] = levels();
        let darkest = |levels: &[Vec<u8>]| levels[0].iter().skip(3).step_by(4).copied().min();
        assert_eq!(darkest(&bare), Some(82));
        assert!(darkest(&vessels) < Some(20));
    }
}
