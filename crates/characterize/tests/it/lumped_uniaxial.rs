//! Pieces that are pressed or pulled along one axis.

use std::path::Path;

use palpate_characterize::fit::Random;
use palpate_characterize::inverse::{CandidateLaw, Terms};
use palpate_characterize::lumped::{UniaxialFit, fit_uniaxial, fit_uniaxial_recordings};
use palpate_characterize::{CleanRecording, CleanSettings, Error, clean};
use palpate_files::Recording;
use palpate_files::recording::ForeignColumns;

use crate::data;
use crate::made_up::{own, times};

/// Nominal stresses [Pa], typed from textbooks.
fn stress(law: CandidateLaw, p: &[f64], l: f64) -> f64 {
    let bar = l - 1.0 / (l * l);
    match law {
        CandidateLaw::NeoHookean => 2.0 * p[0] * bar,
        CandidateLaw::MooneyRivlin => 2.0 * bar * (p[0] + p[1] / l),
        CandidateLaw::Exponential => {
            let (along, across) = (p[1] * (l * l - 1.0), p[1] * (1.0 / l - 1.0));
            p[0] / (p[1] + 1.0) * (l * along.exp() - across.exp() / (l * l))
        }
        CandidateLaw::Ogden(_) => {
            let term =
                |p: &[f64]| 2.0 * p[0] / p[1] * (l.powf(p[1] - 1.0) - l.powf(-0.5 * p[1] - 1.0));
            p.chunks(2).map(term).sum()
        }
        CandidateLaw::ReducedPolynomial(_) => {
            let i = l * l + 2.0 / l - 3.0;
            let c = |place: usize| p.get(place).copied().unwrap_or(0.0);
            2.0 * bar * (c(0) + 2.0 * c(1) * i + 3.0 * c(2) * i * i)
        }
        CandidateLaw::HolzapfelGasserOgden => panic!("its strips are those of `fibres`"),
    }
}

const TRUTHS: [(CandidateLaw, &[f64]); 7] = [
    (CandidateLaw::NeoHookean, &[800.0]),
    (CandidateLaw::MooneyRivlin, &[500.0, 300.0]),
    (CandidateLaw::Exponential, &[1500.0, 2.0]),
    (CandidateLaw::Ogden(Terms::One), &[900.0, 5.7]),
    (CandidateLaw::Ogden(Terms::Two), &[700.0, 3.1, 200.0, -5.3]),
    (CandidateLaw::ReducedPolynomial(Terms::Two), &[500.0, 180.0]),
    (
        CandidateLaw::ReducedPolynomial(Terms::Three),
        &[500.0, 90.0, 40.0],
    ),
];

/// Judge: the closed forms that made the stresses, pressed and pulled. Tolerance: rounding, grown by the fit.
#[test]
fn laws_return_from_their_closed_forms() {
    let stretches: Vec<f64> = (0..60).map(|i| 0.5 + 0.02 * f64::from(i)).collect();
    for (law, truth) in TRUTHS {
        let stresses: Vec<f64> = stretches.iter().map(|&l| stress(law, truth, l)).collect();
        let found = fit_uniaxial(law, &stretches, &stresses).unwrap();
        for ((name, estimate), truth) in found.parameters.iter().zip(truth) {
            let off = (estimate.value / truth - 1.0).abs();
            assert!(off < 1e-7, "{name}: {off}");
        }
        assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    }
}

/// Pieces of 4 cm² and 10 mm that are pressed by a third, with noise of 1 mN.
fn pieces(law: CandidateLaw, truth: &[f64]) -> Vec<CleanRecording> {
    let (area, height) = (4e-4, 10e-3);
    let mut random = Random::new(7);
    let speeds = [1e-4, 2e-4];
    let each = speeds.map(|speed| {
        let depth = |t: f64| (speed * (t - 1.0)).max(0.0);
        let force = |t: f64| -area * stress(law, truth, 1.0 - depth(t) / height);
        let time = times(20.0, 1.0 + height / 3.0 / speed);
        let noise = |t: f64| force(t) + 1e-3 * random.normal();
        let mut recording = clean(&own(&time, depth, noise), &CleanSettings::default()).unwrap();
        recording.header.area_m2 = Some(area);
        recording.header.height_m = Some(height);
        recording
    });
    each.into()
}

/// Judge: the laws that made the recordings. Tolerance: four of the standard errors, and the contact, which is
/// found to the part of a percent. Of three parameters or more a piece pressed by a third tells some badly.
#[test]
fn laws_return_from_recordings() {
    for (law, truth) in TRUTHS {
        let found = fit_uniaxial_recordings(law, &pieces(law, truth)).unwrap();
        for ((name, estimate), truth) in found.parameters.iter().zip(truth) {
            let error = estimate.standard_error.unwrap();
            println!("{name}: {truth} {} +- {error}", estimate.value);
            let off = (estimate.value - truth).abs();
            assert!(off < 4.0 * error + 0.01 * truth, "{name}: {estimate:?}");
            let tells_all = found.parameters.len() < 3;
            assert!(error < 0.02 * truth || !tells_all, "{name}: {estimate:?}");
        }
    }
    let mut unknown = pieces(TRUTHS[0].0, TRUTHS[0].1);
    unknown[1].header.height_m = None;
    let refused = fit_uniaxial_recordings(CandidateLaw::NeoHookean, &unknown);
    assert_eq!(refused.unwrap_err(), Error::Unknown { key: "height_m" });
}

#[test]
fn a_stress_that_falls_is_no_law() {
    let falls = fit_uniaxial(
        CandidateLaw::NeoHookean,
        &[1.0, 1.1, 1.2],
        &[0.0, -1.0, -2.0],
    );
    assert_eq!(falls.unwrap_err(), Error::NoContactForce);
    let few = fit_uniaxial(CandidateLaw::MooneyRivlin, &[1.1], &[100.0]);
    assert!(matches!(few, Err(Error::TooShort { .. })));
}

fn cleaned(path: &Path, columns: &ForeignColumns) -> CleanRecording {
    let recording = Recording::read_foreign(path, columns).unwrap();
    clean(&recording, &CleanSettings::default()).unwrap()
}

/// Judge: Treloar's rubber, pulled to 7.6 times its length. What is linear has its closed form, to rounding. Its
/// curve is an S, which the first two laws have not: that is said of them, and not of the exponential law.
#[test]
fn rubber_is_missed_by_two_laws() {
    let Some(folder) = data::folder() else {
        return;
    };
    let columns = ForeignColumns {
        force_unit: Some("MPa".to_owned()),
        ..ForeignColumns::default()
    };
    let rubber = [cleaned(
        &folder.join("rubber/treloar1944_uniaxial.csv"),
        &columns,
    )];
    let found = CandidateLaw::DEFAULT.map(|law| fit_uniaxial_recordings(law, &rubber).unwrap());
    for fit in &found {
        println!("{:?} {:.3} {:#?}", fit.parameters, fit.misfit, fit.warnings);
    }
    let (mut products, mut squares) = (0.0, 0.0);
    for (depth, force) in rubber[0].depth.iter().zip(&rubber[0].force) {
        let unit = stress(CandidateLaw::NeoHookean, &[1.0], 1.0 - depth);
        products -= unit * force;
        squares += unit * unit;
    }
    let off = found[0].parameters[0].1.value / (products / squares) - 1.0;
    assert!(off.abs() < 1e-9, "{off}");
    let misses = |fit: &UniaxialFit| {
        let said = "misses the shape of the stress";
        fit.warnings.iter().any(|warning| warning.contains(said))
    };
    assert_eq!(
        [0, 1, 2].map(|law: usize| misses(&found[law])),
        [true, true, false]
    );
}

/// The parameters [kPa] of a material's entry for a model in the authors' table.
fn authors(table: &str, material: &str, model: &str) -> Vec<f64> {
    let engineering = &table[table.find("\"engineering\"").unwrap()..];
    let entry = &engineering[engineering.find(&format!("\"{material}\"")).unwrap()..];
    let entry = &entry[entry.find(&format!("\"{model}\"")).unwrap()..];
    let (first, last) = (entry.find('[').unwrap(), entry.find(']').unwrap());
    let numbers = entry[first + 1..last].split(',');
    numbers
        .map(|number| number.trim().parse().unwrap())
        .collect()
}

/// The three pieces of a material that were lent, of the ten that the authors measured.
fn silicone(folder: &Path, material: &str) -> Vec<CleanRecording> {
    let pieces = ["A1", "A2", "B1"].map(|piece| {
        let path = folder.join(format!("{material}_{piece}.csv"));
        let mut clean = cleaned(&path, &ForeignColumns::default());
        // What the heads of the files say in words.
        clean.header.area_m2 = Some(std::f64::consts::PI * 25e-3 * 25e-3);
        clean.header.height_m = Some(30e-3);
        clean
    });
    pieces.into()
}

/// Judge: the authors' parameters of the same laws over the same two thirds of the height. Theirs are of the mean
/// curve of ten pieces from where the machine set out, ours of three of them from first contact. Tolerance: at no
/// stretch are the stresses of both farther apart than those of our pieces. The authors' neo-Hookean parameter is
/// μ = 2 C₁₀; that of Ogden's law belongs to W = μ/α Σ λ^α, so that ours is α/2 of it.
#[test]
#[ignore = "long"]
fn silicone_is_what_its_authors_found() {
    let Some(folder) = data::folder() else {
        return;
    };
    let folder = folder.join("silicone_phantoms");
    let table = std::fs::read_to_string(folder.join("hyperelastic_parameters.json")).unwrap();
    for material in ["EF10_0T", "EF10_50T", "EF10_100T", "EF30_0T", "EF50_0T"] {
        let pieces = silicone(&folder, material);
        for (law, model, unit) in [
            (CandidateLaw::NeoHookean, "Neo Hookean", 0.5),
            (CandidateLaw::MooneyRivlin, "Mooney Rivlin_o1", 1.0),
            (CandidateLaw::Ogden(Terms::One), "Ogden_o1", 1.0),
            (CandidateLaw::ReducedPolynomial(Terms::Two), "Yeoh_o2", 1.0),
            (
                CandidateLaw::ReducedPolynomial(Terms::Three),
                "Yeoh_o3",
                1.0,
            ),
        ] {
            let theirs = authors(&table, material, model).into_iter();
            let mut theirs: Vec<f64> = theirs.map(|value| 1e3 * unit * value).collect();
            if let (CandidateLaw::Ogden(_), [mu, alpha]) = (law, &mut theirs[..]) {
                *alpha *= 1e-3;
                *mu *= 0.5 * *alpha;
            }
            let fit = |pieces: &[CleanRecording]| fit_uniaxial_recordings(law, pieces).unwrap();
            let together = fit(&pieces);
            let alone: Vec<UniaxialFit> = pieces.chunks(1).map(fit).collect();
            println!(
                "{material}: theirs {theirs:?}, ours {:?}",
                together.parameters
            );
            for stretch in [0.8, 0.6, 0.4] {
                let ours = together.nominal_stress(stretch).unwrap();
                let theirs = stress(law, &theirs, stretch);
                let each = alone.iter().map(|fit| fit.nominal_stress(stretch).unwrap());
                let most = each.clone().fold(f64::NEG_INFINITY, f64::max);
                let range = most - each.fold(f64::INFINITY, f64::min);
                println!("{stretch}: {ours:.0} {theirs:.0} Pa, within {range:.0} Pa");
                assert!((ours - theirs).abs() <= range, "{material} {model}");
            }
        }
    }
}
