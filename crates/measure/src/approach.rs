use std::ops::Range;

/// Height of first contact [m] from falling heights [m] and forces [N]: the height from which a linear rise of
/// force fits all samples best, with the force before it as zero. None without a rise.
///
/// A threshold alone would be met too late, by its force over the stiffness of the tissue. The rise is looked for
/// in means first and then about the best of them, so that it takes no longer than a tick may be late.
pub(crate) fn contact_height(heights: &[f64], forces: &[f64]) -> Option<f64> {
    let means = |values: &[f64]| -> Vec<f64> {
        let blocks = values.chunks_exact(BLOCK);
        blocks
            .map(|block| block.iter().sum::<f64>() / BLOCK as f64)
            .collect()
    };
    let (coarse_heights, coarse_forces) = (means(heights), means(forces));
    let all = 1..coarse_heights.len().saturating_sub(1);
    let near = BLOCK * best(&coarse_heights, &coarse_forces, all, 1)?;
    let last = heights.len().saturating_sub(SAMPLES_IN_CONTACT);
    let about = near.saturating_sub(2 * BLOCK).max(1)..(near + 3 * BLOCK).min(last);
    best(heights, forces, about, STRIDE).map(|place| heights[place])
}

/// The place among `candidates`, every so many of them, from which a rise comes nearest to the forces.
fn best(heights: &[f64], forces: &[f64], candidates: Range<usize>, stride: usize) -> Option<usize> {
    let mut best: Option<(f64, usize)> = None;
    for place in candidates.step_by(stride) {
        let zero = forces[..place].iter().sum::<f64>() / place as f64;
        let (mut products, mut squares) = (0.0, 0.0);
        for (height, force) in heights[place..].iter().zip(&forces[place..]) {
            let depth = (heights[place] - height).max(0.0);
            products += depth * (force - zero);
            squares += depth * depth;
        }
        let slope = products / squares;
        let missed: f64 = heights
            .iter()
            .zip(forces)
            .map(|(height, force)| {
                let depth = (heights[place] - height).max(0.0);
                (force - zero - slope * depth).powi(2)
            })
            .sum();
        if slope > 0.0 && best.is_none_or(|(least, _)| missed < least) {
            best = Some((missed, place));
        }
    }
    best.map(|(_, place)| place)
}

/// Samples that must lie in the tissue.
const SAMPLES_IN_CONTACT: usize = 20;
/// Samples of one mean.
const BLOCK: usize = 16;
/// From one candidate to the next.
const STRIDE: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Noise;

    /// A rise from a known height with the noise of the sensor: found to 0.1 mm, where noise of 0.4 mN over
    /// 5 N/m is 0.08 mm in one sample.
    #[test]
    fn the_beginning_of_a_rise_is_found() {
        let mut random = Noise::new(3);
        let heights: Vec<f64> = (0..3000).map(|i| -2e-6 * f64::from(i)).collect();
        let forces: Vec<f64> = heights
            .iter()
            .map(|height| 5.0 * (-0.005 - height).max(0.0) + 4e-4 * random.normal() + 0.02)
            .collect();
        let found = contact_height(&heights, &forces).unwrap();
        assert!((found + 0.005).abs() < 1e-4, "{found}");
    }
}
