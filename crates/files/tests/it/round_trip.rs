//! One battery for all formats: what is written reads back to the same values.

use palpate_files::motion::{MotionRow, ToolMotion};
use palpate_files::recording::{ExtraColumn, RecordingHeader, Samples};
use palpate_files::tissue::LawName;
use palpate_files::tissue::{EffectiveColumn, Kelvin, Lumped, TissueSource};
use palpate_files::{Elasticity, Estimate, Motion, Pose, PronyTerm, Recording, Tissue};
use proptest::prelude::*;

use crate::{MOTION, RECORDING, TISSUE, tries};

#[test]
fn the_examples_survive() {
    let tissue = Tissue::parse(TISSUE, "a.toml").unwrap();
    assert_eq!(Tissue::parse(&tissue.to_toml(), "b.toml").unwrap(), tissue);
    let motion = Motion::parse(MOTION, "a.csv").unwrap();
    assert_eq!(Motion::parse(&motion.to_csv(), "b.csv").unwrap(), motion);
    let recording = Recording::parse(RECORDING, "a.csv").unwrap();
    assert_eq!(
        Recording::parse(&recording.to_csv(), "b.csv").unwrap(),
        recording
    );
}

#[test]
fn files_survive() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    let tissue = Tissue::parse(TISSUE, "a.toml").unwrap();
    tissue.write(&path).unwrap();
    assert_eq!(Tissue::read(&path).unwrap(), tissue);
    let motion = Motion::parse(MOTION, "a.csv").unwrap();
    motion.write(&path).unwrap();
    assert_eq!(Motion::read(&path).unwrap(), motion);
    let recording = Recording::parse(RECORDING, "a.csv").unwrap();
    recording.write(&path).unwrap();
    assert_eq!(Recording::read(&path).unwrap(), recording);
}

fn positive() -> impl Strategy<Value = f64> {
    // In the domains of all quantities.
    prop_oneof![0.01..10.0, Just(0.1)]
}

fn finite() -> impl Strategy<Value = f64> {
    let any = prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO;
    // Usual coordinates, of which no reader warns.
    any.prop_map(|x| x % 5.0)
}

fn estimate(value: impl Strategy<Value = f64>) -> impl Strategy<Value = Estimate> {
    let standard_error = prop::option::of(positive());
    (value, standard_error).prop_map(|(value, standard_error)| Estimate {
        value,
        standard_error,
    })
}

fn elasticity() -> impl Strategy<Value = Elasticity> {
    let pa = || estimate(positive());
    let law = |law, parameters: &[Estimate]| Elasticity::new(law, parameters).unwrap();
    let several = prop::collection::vec(pa(), 1..=3);
    let ogden = prop::collection::vec((pa(), estimate(-20.0..20.0)), 1..=3);
    prop_oneof![
        (pa(), estimate(-0.999..0.4999)).prop_map(move |(e, nu)| law(LawName::Linear, &[e, nu])),
        pa().prop_map(move |c10| law(LawName::NeoHookean, &[c10])),
        (pa(), pa()).prop_map(move |(c10, c01)| law(LawName::MooneyRivlin, &[c10, c01])),
        (pa(), pa()).prop_map(move |(gamma, alpha)| law(LawName::Exponential, &[gamma, alpha])),
        several.prop_map(move |c| law(LawName::ReducedPolynomial, &c)),
        (
            pa(),
            pa(),
            estimate(0.0..500.0),
            estimate(0.0..0.3333),
            estimate(0.0..90.0)
        )
            .prop_map(move |(c10, k1, k2, dispersion, angle)| {
                let parameters = [c10, k1, k2, dispersion, angle];
                law(LawName::HolzapfelGasserOgden, &parameters)
            }),
        ogden.prop_map(move |terms| {
            let each: Vec<_> = terms.into_iter().flat_map(|(mu, a)| [mu, a]).collect();
            law(LawName::Ogden, &each)
        }),
    ]
}

fn lumped() -> impl Strategy<Value = Lumped> {
    let any = || estimate(positive());
    let kelvin = (any(), any(), any(), prop::option::of(any())).prop_map(
        |(k1_n_per_m, k2_n_per_m, b_n_s_per_m, tau_s)| Kelvin {
            k1_n_per_m,
            k2_n_per_m,
            b_n_s_per_m,
            tau_s,
        },
    );
    let column = (any(), any(), any(), any()).prop_map(
        |(gamma_pa, alpha, effective_area_m2, effective_length_m)| EffectiveColumn {
            gamma_pa,
            alpha,
            effective_area_m2,
            effective_length_m,
        },
    );
    (prop::option::of(kelvin), prop::option::of(column)).prop_map(|(kelvin, column)| Lumped {
        kelvin,
        column,
        nonlinear_springs: None,
    })
}

fn text() -> impl Strategy<Value = String> {
    // Any character at all, but not only blanks.
    any::<String>().prop_map(|text| format!("x{text}"))
}

fn source() -> impl Strategy<Value = TissueSource> {
    let texts = || prop::collection::vec(any::<String>(), 0..3);
    (texts(), prop::option::of(text()), texts()).prop_map(|(recordings, method, warnings)| {
        TissueSource {
            recordings,
            method,
            version: None,
            warnings,
        }
    })
}

fn tissue() -> impl Strategy<Value = Tissue> {
    let term = (estimate(0.0..0.3), estimate(positive()));
    let term = term.prop_map(|(g, tau_s)| PronyTerm { g, tau_s });
    let name = prop::option::of(text());
    let prony = prop::collection::vec(term, 0..4);
    (
        name,
        estimate(positive()),
        elasticity(),
        prony,
        lumped(),
        source(),
    )
        .prop_map(
            |(name, density_kg_m3, elasticity, prony, lumped, source)| Tissue {
                name,
                density_kg_m3,
                elasticity,
                prony,
                lumped,
                source,
                warnings: Vec::new(),
            },
        )
}

fn increasing(times: Vec<f64>) -> Vec<f64> {
    let mut times = times;
    times.sort_by(f64::total_cmp);
    // Zero and minus zero are the same time.
    times.dedup_by(|a, b| a == b);
    times
}

fn recording() -> impl Strategy<Value = Recording> {
    let field = any::<String>().prop_map(|text| text.trim().to_owned());
    let sample = (finite(), finite(), finite(), field);
    prop::collection::vec(sample, 1..20).prop_map(|rows| {
        let time_s = increasing(rows.iter().map(|row| row.0).collect());
        let rows = &rows[..time_s.len()];
        let samples = Samples {
            time_s,
            depth_m: rows.iter().map(|row| row.1).collect(),
            force_n: rows.iter().map(|row| row.2).collect(),
        };
        let note = ExtraColumn {
            name: "note".to_owned(),
            values: rows.iter().map(|row| row.3.clone()).collect(),
        };
        let header = RecordingHeader::default();
        let recording = Recording::new(header, samples).unwrap();
        recording.with_extra_column(note).unwrap()
    })
}

fn motion() -> impl Strategy<Value = Motion> {
    let component = -1.0..1.0;
    let quaternion = [component.clone(), component.clone(), component, 0.1..1.0];
    let row = (
        finite(),
        [finite(), finite(), finite()],
        quaternion,
        0.0..=1.0,
        any::<bool>(),
    );
    prop::collection::vec(row, 1..20).prop_map(|rows| {
        let times = increasing(rows.iter().map(|row| row.0).collect());
        let rows = times.iter().zip(rows).map(|(time, row)| MotionRow {
            time_s: *time,
            pose: Pose {
                position_m: row.1,
                orientation: Some(row.2),
                grip: row.3,
                cut: row.4,
            },
        });
        Motion::new(vec![ToolMotion::new("right", rows.collect()).unwrap()]).unwrap()
    })
}

proptest! {
    #![proptest_config(tries(2000))]

    #[test]
    fn tissues_survive(tissue in tissue()) {
        let text = tissue.to_toml();
        let mut read = Tissue::parse(&text, "a.toml").expect(&text);
        // Few of these numbers are usual.
        read.warnings.clear();
        prop_assert_eq!(read, tissue);
    }

    #[test]
    fn recordings_survive(recording in recording()) {
        let text = recording.to_csv();
        prop_assert_eq!(Recording::parse(&text, "a.csv").expect(&text), recording);
    }

    #[test]
    fn motions_survive(motion in motion()) {
        let text = motion.to_csv();
        prop_assert_eq!(Motion::parse(&text, "a.csv").expect(&text), motion);
    }

    #[test]
    fn texts_above_a_recording_survive(organ in text(), source in text()) {
        let mut recording = Recording::parse(RECORDING, "a.csv").unwrap();
        recording.header.organ = Some(organ);
        recording.header.source = Some(source);
        let text = recording.to_csv();
        prop_assert_eq!(Recording::parse(&text, "a.csv").expect(&text), recording);
    }
}
