use std::collections::BTreeSet;

/// Buckets of each clock; each keeps three samples at most.
const BUCKETS: usize = 100;

/// Indices of at most 900 samples that draw the same lines as all samples: over time, over depth, and over the
/// logarithm of the time since a hold began. Each bucket of each of these axes contributes its first sample and the
/// least and largest of `drawn`, so that no peak is lost.
pub fn thinned_indices(time: &[f64], depth: &[f64], drawn: &[f64]) -> Vec<usize> {
    let samples = time.len().min(depth.len()).min(drawn.len());
    if samples <= 3 * BUCKETS {
        return (0..samples).collect();
    }
    let [mut travelled, mut held] = [0.0, 0.0];
    let clocks: Vec<[f64; 3]> = (0..samples)
        .map(|i| {
            let before = i.saturating_sub(1);
            let step = (depth[i] - depth[before]).abs();
            travelled += step;
            held = if step > 0.0 {
                0.0
            } else {
                held + time[i] - time[before]
            };
            [time[i] - time[0], travelled, held]
        })
        .collect();
    let mut chosen = BTreeSet::from([0, samples - 1]);
    for clock in 0..3 {
        let ticks: Vec<f64> = clocks.iter().map(|of| of[clock]).collect();
        add_extremes(&buckets(&ticks, clock == 2), drawn, &mut chosen);
    }
    chosen.into_iter().collect()
}

/// The bucket of each tick: of even width, or of a logarithm.
fn buckets(ticks: &[f64], logarithmic: bool) -> Vec<usize> {
    let most = ticks.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let least = ticks
        .iter()
        .copied()
        .filter(|tick| *tick > 0.0)
        .fold(most, f64::min);
    let part = |tick: f64| match logarithmic {
        true if tick <= least || least >= most => 0.0,
        true => (tick / least).ln() / (most / least).ln(),
        false => tick / most,
    };
    let bucket = |tick: &f64| (part(*tick) * BUCKETS as f64) as usize;
    ticks
        .iter()
        .map(|tick| bucket(tick).min(BUCKETS - 1))
        .collect()
}

/// Adds the first, the least and the largest sample of each bucket.
fn add_extremes(buckets: &[usize], drawn: &[f64], chosen: &mut BTreeSet<usize>) {
    let mut first = [None; BUCKETS];
    let (mut least, mut largest) = (first, first);
    for (i, &bucket) in buckets.iter().enumerate() {
        first[bucket].get_or_insert(i);
        let beats = |other: Option<usize>, sign: f64| {
            other.is_none_or(|other: usize| sign * drawn[i] > sign * drawn[other])
        };
        if beats(largest[bucket], 1.0) {
            largest[bucket] = Some(i);
        }
        if beats(least[bucket], -1.0) {
            least[bucket] = Some(i);
        }
    }
    let all = first.into_iter().chain(least).chain(largest);
    chosen.extend(all.flatten());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp and a hold of 20,000 samples, with a peak and a dip of one sample each.
    #[test]
    fn no_peak_is_lost() {
        let time: Vec<f64> = (0..20_000).map(|i| 0.01 * f64::from(i)).collect();
        let depth: Vec<f64> = time.iter().map(|t| t.min(0.5)).collect();
        let mut force: Vec<f64> = depth.iter().map(|d| d.powi(2)).collect();
        force[12_345] = 2.0;
        force[17_000] = -1.0;
        let chosen = thinned_indices(&time, &depth, &force);
        assert!(chosen.len() <= 900, "{}", chosen.len());
        for place in [0, 12_345, 17_000, 19_999] {
            assert!(chosen.contains(&place), "{place}");
        }
        // The ramp is 0.25 % of the time, and drawn all the same; so is the beginning of the hold.
        assert!(chosen.iter().filter(|place| **place <= 50).count() >= 50);
        assert!(
            chosen
                .iter()
                .filter(|place| (51..150).contains(*place))
                .count()
                >= 20
        );
        assert!(chosen.is_sorted());
    }

    #[test]
    fn few_samples_all_stay() {
        let values: Vec<f64> = (0..40).map(f64::from).collect();
        assert_eq!(thinned_indices(&values, &values, &values).len(), 40);
        assert!(thinned_indices(&[], &[], &[]).is_empty());
    }
}
