//! The low-pass against what is known of it.

use std::f64::consts::{PI, TAU};

use palpate_characterize::Error;
use palpate_characterize::clean::LowPass;
use palpate_characterize::fit::Random;

const RATE: f64 = 200.0;

/// Amplitude of cosine and sine of a signal over its middle half, at `frequency` [Hz].
fn answer(frequency: f64, cutoff: f64) -> [f64; 2] {
    // Twenty seconds hold whole periods of every frequency below.
    let time: Vec<f64> = (0..8000).map(|sample| f64::from(sample) / RATE).collect();
    let signal: Vec<f64> = time.iter().map(|t| (TAU * frequency * t).cos()).collect();
    let smooth = LowPass::new(cutoff, RATE).unwrap().smooth(&signal);
    let middle = 2000..6000;
    let along = |basis: fn(f64) -> f64| {
        let terms = middle
            .clone()
            .map(|i| smooth[i] * basis(TAU * frequency * time[i]));
        terms.sum::<f64>() / 2000.0
    };
    [along(f64::cos), along(f64::sin)]
}

/// Judge: |H|² of Butterworth at the frequencies that the bilinear transform puts in place of f and of
/// the cut-off, tan(π f / rate). Tolerance: what the ends, ten seconds away, still do, below 1e-9.
#[test]
fn gain_is_that_of_butterworth() {
    for cutoff in [2.0, 10.0, 60.0] {
        for frequency in [0.5, 2.0, 5.0, 10.0, 30.0, 60.0, 80.0] {
            let ratio = (PI * frequency / RATE).tan() / (PI * cutoff / RATE).tan();
            let expected = 1.0 / (1.0 + ratio.powi(6));
            let [cosine, _] = answer(frequency, cutoff);
            assert!(
                (cosine - expected).abs() < 1e-8,
                "{frequency} Hz through {cutoff} Hz: {cosine} for {expected}"
            );
        }
    }
}

/// Judge: a cosine that went through forward and backward has no sine.
#[test]
fn nothing_is_shifted() {
    for frequency in [0.5, 5.0, 10.0, 30.0] {
        let [cosine, sine] = answer(frequency, 10.0);
        assert!(
            sine.abs() < 1e-8 * cosine.max(1e-3),
            "{frequency} Hz: {sine} beside {cosine}"
        );
    }
}

/// Judge: a low-pass changes neither. Tolerance: what the slowest pole has left of its start after the
/// lead-in, exp(−5 π) = 1.5e-7, of a slope times the delay of the filter.
#[test]
fn constants_and_lines_are_kept() {
    let filter = LowPass::new(3.0, RATE).unwrap();
    let constant = filter.smooth(&[7.25; 500]);
    assert!(constant.iter().all(|value| (value - 7.25).abs() < 1e-12));
    let line: Vec<f64> = (0..2000)
        .map(|sample| 3.0 + 0.5 * f64::from(sample))
        .collect();
    for (sample, value) in filter.smooth(&line).iter().enumerate() {
        assert!(
            (value - line[sample]).abs() < 1e-5,
            "sample {sample}: {value}"
        );
    }
}

#[test]
fn short_signals_and_bad_cutoffs_are_met() {
    let filter = LowPass::new(3.0, RATE).unwrap();
    assert!(filter.smooth(&[]).is_empty());
    assert_eq!(filter.smooth(&[2.0]).len(), 1);
    assert!(
        filter
            .smooth(&[1.0, 2.0, 4.0])
            .iter()
            .all(|value| value.is_finite())
    );
    for cutoff in [0.0, -1.0, 100.0, f64::NAN] {
        assert!(matches!(
            LowPass::new(cutoff, RATE),
            Err(Error::BadCutoff { .. })
        ));
    }
}

/// Judge: the end of a straight line through n samples with noise σ is off by 2 σ/√n, which is 0.24 σ of the 67 samples of
/// an inverse cut-off; what passes the filter besides is less than that of the middle, σ √(2 f/rate) = 0.17 σ. Together 0.30
/// σ; of 300 draws within 10 %. Turned about its last sample, a signal would end with σ.
#[test]
fn the_noise_of_the_last_sample_is_lost() {
    let filter = LowPass::new(3.0, RATE).unwrap();
    let mut random = Random::new(5);
    let (mut first, mut last) = (0.0, 0.0);
    for _ in 0..300 {
        let noise: Vec<f64> = (0..600).map(|_| random.normal()).collect();
        let smooth = filter.smooth(&noise);
        first += smooth[0].powi(2) / 300.0;
        last += smooth[599].powi(2) / 300.0;
    }
    println!("ends {:.3} {:.3}", f64::sqrt(first), f64::sqrt(last));
    assert!(f64::sqrt(first) < 0.33 && f64::sqrt(last) < 0.33);
}
