/// Where a tip met tissue, from heights [m], falling, and forces [N]: the height from which a straight rise of
/// force comes nearest to all, after the force before it was taken for zero. None without a rise.
///
/// A threshold alone would be met too late, by its force over the stiffness of the tissue.
pub(crate) fn contact_height(heights: &[f64], forces: &[f64]) -> Option<f64> {
    let mut best: Option<(f64, f64)> = None;
    let candidates = (1..heights.len().saturating_sub(SAMPLES_IN_CONTACT)).step_by(STRIDE);
    for place in candidates {
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
            best = Some((missed, heights[place]));
        }
    }
    best.map(|(_, height)| height)
}

/// Samples that must lie in the tissue.
const SAMPLES_IN_CONTACT: usize = 20;
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
