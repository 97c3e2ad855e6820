//! What a researcher waits for: the relaxation and the laws of one recording of 1,501 samples, on one core.
//!
//! Budgets: relaxation with a stated number of terms 50 ms; neo-Hookean law with the dimensionless curve
//! 0.1 s, an estimate while pressing 0.2 s and each sample 1 µs, Mooney-Rivlin law 5 s, exponential law 30 s (three runs of finite elements; ten samples take minutes:
//! `cargo bench --package palpate-characterize --bench fits -- exponential`). The source: hours a run.

#![allow(missing_docs, reason = "criterion's macros write functions without")]
#![allow(
    clippy::unwrap_used,
    reason = "a bench that fails to unwrap has failed, and tells more than times"
)]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use palpate_characterize::fit::Random;
use palpate_characterize::inverse::{Body, CandidateLaw, Curves, Indentation, PUNCH, law_fit};
use palpate_characterize::online::{OnlineContact, OnlineEstimator, OnlineSample, OnlineSettings};
use palpate_characterize::viscoelastic::{RelaxationRecord, RelaxationSettings, relaxation};
use palpate_files::recording::{RecordingHeader, Samples};
use palpate_mechanics::{IndentationCurve, PronySeries};

const LIVER: [(f64, f64); 2] = [(0.2866, 1.537), (0.2022, 6.090)];
const C10: f64 = 452.92;

/// A ramp of 0.2 s to 5 mm and a hold of 30 s at 50 Hz, with noise of 0.2 mN.
fn samples() -> Samples {
    let time_s: Vec<f64> = (0..=1500).map(|i| 0.02 * f64::from(i)).collect();
    let depth_m: Vec<f64> = time_s.iter().map(|t| 5e-3 * (t / 0.2).min(1.0)).collect();
    let depths: Vec<f64> = PUNCH.iter().map(|row| 1e-3 * row.0).collect();
    let elastic: Vec<f64> = PUNCH.iter().map(|row| 1e-6 * C10 * row.1).collect();
    let series = PronySeries::new(&LIVER).unwrap();
    let curve = IndentationCurve::through(&depths, &elastic);
    let mut random = Random::new(1);
    let forces = curve.relaxed(&series, &time_s, &depth_m);
    let felt = forces.iter().map(|force| force + 2e-4 * random.normal());
    Samples {
        force_n: felt.collect(),
        depth_m,
        time_s,
    }
}

fn of_relaxation(criterion: &mut Criterion) {
    let Samples {
        time_s,
        depth_m,
        force_n,
    } = samples();
    let largest = force_n.iter().copied().fold(0.0, f64::max);
    let course =
        RelaxationRecord::new(&time_s, &depth_m, &force_n, largest, |depth| depth).unwrap();
    let settings = RelaxationSettings { terms: Some(2) };
    criterion.bench_function("relaxation of two terms (budget 50 ms)", |b| {
        b.iter(|| relaxation(black_box(std::slice::from_ref(&course)), settings).unwrap());
    });
}

fn of_laws(criterion: &mut Criterion) {
    let Samples {
        time_s,
        depth_m,
        force_n,
    } = samples();
    let series = PronySeries::new(&LIVER).unwrap();
    let mut group = criterion.benchmark_group("laws");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(5));
    for (law, name) in [
        (CandidateLaw::NeoHookean, "neo-Hookean (budget 0.1 s)"),
        (CandidateLaw::MooneyRivlin, "Mooney-Rivlin (budget 5 s)"),
        (CandidateLaw::Exponential, "exponential (budget 30 s)"),
    ] {
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut curves = Curves::new(Body::under_punch(1e-3), law, 5e-3);
                let indentation = Indentation::new(&time_s, &depth_m, &force_n);
                law_fit(&mut curves, black_box(&[indentation]), &series).unwrap()
            });
        });
    }
    group.finish();
}

fn while_pressing(criterion: &mut Criterion) {
    let Samples {
        time_s,
        depth_m,
        force_n,
    } = samples();
    let header = RecordingHeader {
        indenter_radius_m: Some(1e-3),
        ..RecordingHeader::default()
    };
    let mut online = OnlineEstimator::new(OnlineSettings {
        header,
        contact: OnlineContact::Stated { error_m: 1e-5 },
        deepest_m: None,
    })
    .unwrap();
    let each = time_s.iter().zip(&depth_m).zip(&force_n);
    for ((&time_s, &depth_m), &force_n) in each {
        online.add(OnlineSample {
            time_s,
            depth_m,
            force_n,
        });
    }
    let _ = online.estimate();
    criterion.bench_function("estimate while pressing (budget 0.2 s)", |b| {
        b.iter(|| black_box(&mut online).estimate());
    });
    let mut sample = OnlineSample {
        time_s: time_s[time_s.len() - 1],
        depth_m: 5e-3,
        force_n: force_n[force_n.len() - 1],
    };
    criterion.bench_function("a sample while pressing (budget 1 µs)", |b| {
        b.iter(|| {
            sample.time_s += 1e-3;
            black_box(&mut online).add(sample);
        });
    });
}

criterion_group!(benches, of_relaxation, of_laws, while_pressing);
criterion_main!(benches);
