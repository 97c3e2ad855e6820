//! Means over subjects. Judges: tables of Student's distribution; the known means of drawn populations.

use palpate_characterize::fit::{Random, pooled_mean};

/// Subjects 1 to 9: mean 5, standard deviation √7.5, and t = 2.306 004 of eight degrees of freedom from a table.
#[test]
fn an_interval_is_that_of_the_table() {
    let values: Vec<f64> = (1..10).map(f64::from).collect();
    let pooled = pooled_mean(&values, 0.95).unwrap();
    assert_eq!(pooled.mean, 5.0);
    let deviation = 7.5_f64.sqrt();
    assert!((pooled.deviation.unwrap() - deviation).abs() < 1e-12);
    let [low, high] = pooled.interval.unwrap();
    let reach = 2.306_004 * deviation / 3.0;
    assert!((high - 5.0 - reach).abs() < 1e-5 * reach && (low + high - 10.0).abs() < 1e-12);
    let one = pooled_mean(&[3.0], 0.95).unwrap();
    assert_eq!((one.mean, one.deviation, one.interval), (3.0, None, None));
    assert_eq!(pooled_mean(&[], 0.95), None);
}

const STUDIES: usize = 20_000;

/// How often the interval of 95 % of `count` subjects holds the mean of the population they are drawn from [-].
fn coverage(count: usize, mean: f64, mut draw: impl FnMut(&mut Random) -> f64) -> f64 {
    let mut random = Random::new(count as u64);
    let held = (0..STUDIES).filter(|_| {
        let values: Vec<f64> = (0..count).map(|_| draw(&mut random)).collect();
        let [low, high] = pooled_mean(&values, 0.95).unwrap().interval.unwrap();
        low <= mean && mean <= high
    });
    held.count() as f64 / STUDIES as f64
}

/// Of normal subjects 95 %, to four standard errors of so many studies (0.6 %). A bootstrap of subjects held the mean
/// in 50, 75, 84 and 90 % of the same.
///
/// Of lognormal subjects, whose logarithm has the deviation 0.5 (moduli from 0.6 to 1.6 times their median in the
/// middle two thirds), no theory gives the coverage: at least 90 % is asked for, and what is found is printed and
/// stated in `docs/theory/characterization.md`.
#[test]
#[ignore = "long"]
fn intervals_hold_the_mean_of_the_population() {
    let skew = 0.5_f64;
    let chance = 4.0 * (0.95 * 0.05 / STUDIES as f64).sqrt();
    for count in [2, 3, 5, 10] {
        let normal = coverage(count, 450.0, |random| 450.0 + 120.0 * random.normal());
        let mean = (0.5 * skew * skew).exp();
        let lognormal = coverage(count, mean, |random| (skew * random.normal()).exp());
        println!("{count} subjects: normal {normal:.4}, lognormal {lognormal:.4}");
        assert!((normal - 0.95).abs() < chance, "{count}: {normal}");
        assert!(lognormal > 0.90, "{count}: {lognormal}");
    }
}
