use std::fs;

use palpate_characterize::inverse::{CandidateLaw, Terms};
use palpate_files::Tissue;
use palpate_jobs::characterize::{Choice, FoundLaw, Identified, characterize, specimens};
use palpate_jobs::{NoProgress, Recordings, json_text};
use palpate_mechanics::finite_elements::uniaxial::stretched;
use palpate_mechanics::{FibreFrame, Material, Vec3};

use crate::measured;

/// Few draws, one law: the question is who is asked, not what is found.
pub(crate) fn quick() -> Choice {
    Choice {
        law: Some(Choice::law_named("neo_hookean", None).unwrap()),
        draws: 10,
        ..Choice::default()
    }
}

/// Judge: the same recordings as files.
#[test]
#[ignore = "long"]
fn texts_answer_as_files_do() {
    let folder = tempfile::tempdir().unwrap();
    let paths = measured(folder.path());
    let texts = paths
        .iter()
        .map(|path| (path.clone(), fs::read_to_string(path).unwrap()))
        .collect();
    let as_files = Recordings {
        paths,
        ..Recordings::default()
    };
    let as_texts = Recordings {
        texts,
        ..Recordings::default()
    };
    let answers = [&as_files, &as_texts].map(|recordings| {
        let found = characterize(recordings, quick(), None, &NoProgress).unwrap();
        json_text(&found.answer).unwrap()
    });
    assert_eq!(answers[0], answers[1]);
    assert_eq!(
        specimens(&as_files).unwrap().0,
        specimens(&as_texts).unwrap().0
    );
}

/// A curve in two waves of Igor is one recording; a position without its deflection is named, to be refused by name.
#[test]
fn the_position_of_a_curve_is_no_recording_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    // Of the seeds for fuzzing: four deflections, which stand for positions too.
    let seed = "../../fuzz/corpus/documents/1a4be55dbe945d9e4e797c4cf97ccbd229e6d7f8";
    let wave = &fs::read(seed).unwrap()[1..];
    let recordings = Recordings {
        paths: vec![folder.path().to_owned()],
        ..Recordings::default()
    };
    let seen = || {
        let mut names = Vec::new();
        // So few samples may be refused.
        let _ = recordings.read(|path| {
            names.push(path.file_name().unwrap().to_str().unwrap().to_owned());
        });
        names
    };
    fs::write(folder.path().join("Curve7ZSnsr.ibw"), wave).unwrap();
    assert_eq!(seen(), ["Curve7ZSnsr.ibw"]);
    fs::write(folder.path().join("Curve7Defl.ibw"), wave).unwrap();
    assert_eq!(seen(), ["Curve7Defl.ibw"]);
}

/// The bounds are those of the settings: 0 is an answer without repeated fits, and from ten draws on there is a spread.
#[test]
#[ignore = "long"]
fn too_few_draws_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let recordings = Recordings {
        paths: measured(folder.path()),
        ..Recordings::default()
    };
    let found = |draws: usize| {
        let choice = Choice { draws, ..quick() };
        characterize(&recordings, choice, None, &NoProgress).map(|found| json_text(&found.answer))
    };
    for draws in [1, 9] {
        let sentence = found(draws).map(drop).unwrap_err().to_string();
        assert!(
            sentence.contains(&format!("{draws} draws are too few")),
            "{sentence}"
        );
    }
    for (draws, repeated) in [(0, false), (10, true)] {
        let text = found(draws).unwrap().unwrap();
        assert_eq!(
            text.contains("\"bootstrap_error\""),
            repeated,
            "{draws}: {text}"
        );
    }
}

#[test]
#[ignore = "long"]
fn specimens_are_told_without_being_characterized() {
    let folder = tempfile::tempdir().unwrap();
    let paths = measured(folder.path());
    fs::write(folder.path().join("wrong.csv"), "nothing").unwrap();
    let recordings = Recordings {
        paths: vec![folder.path().to_owned()],
        ..Recordings::default()
    };
    let (found, unusable) = specimens(&recordings).unwrap();
    let named: Vec<_> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(named, ["soft, 1", "soft, 2"]);
    assert_eq!(found[0].1, [paths[0].clone()]);
    assert!(unusable[0].sentence().contains("wrong.csv"));
}

#[test]
fn a_law_that_is_not_there_is_refused_with_the_nearest() {
    let refused = Choice::law_named("neohookean", None).unwrap_err();
    assert!(refused.is_input());
    assert!(refused.to_string().contains("such as neo_hookean"));
}

#[test]
fn an_order_is_one_of_a_law_that_has_some() {
    let law = Choice::law_named("ogden", Some(3)).unwrap();
    assert_eq!(law, CandidateLaw::Ogden(Terms::Three));
    for (name, order, why) in [
        ("ogden", 4, "give 1, 2 or 3"),
        ("exponential", 1, "has no order"),
    ] {
        let refused = Choice::law_named(name, Some(order)).unwrap_err();
        assert!(
            refused.is_input() && refused.to_string().contains(why),
            "{refused}"
        );
    }
}

/// Strips of the tutorial, as `benches/peers/fibres/compare.py` made them.
const STRIPS: [(&str, &str); 3] = [
    (
        "strip-0.csv",
        include_str!("../../../../assets/first/strip-0.csv"),
    ),
    (
        "strip-45.csv",
        include_str!("../../../../assets/first/strip-45.csv"),
    ),
    (
        "strip-90.csv",
        include_str!("../../../../assets/first/strip-90.csv"),
    ),
];

/// Judge: the parameters that the script made the strips of, within four standard errors; the tissue that is written gives the
/// stress of its fit where `solve` pulls a bar along and across the fibres.
#[test]
fn strips_become_a_tissue_with_fibres() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in STRIPS {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let recordings = Recordings {
        paths: vec![folder.path().to_owned()],
        ..Recordings::default()
    };
    let choice = Choice {
        draws: 0,
        ..Choice::default()
    };
    let found = characterize(&recordings, choice, None, &NoProgress).unwrap();
    let [specimen] = found.answer.specimens.as_slice() else {
        panic!("the strips are one specimen");
    };
    let name = "holzapfel_gasser_ogden";
    assert_eq!(specimen.preferred.as_deref(), Some(name));
    let law = &specimen.laws[name];
    let truth = [
        ("c10_pa", 1500.0),
        ("k1_pa", 9000.0),
        ("k2", 2.5),
        ("dispersion", 0.08),
    ];
    for (key, truth) in truth {
        let known = &law.parameters[key];
        let error = known.standard_error.unwrap();
        assert!(
            (known.value - truth).abs() < 4.0 * error,
            "{key}: {known:?}"
        );
        assert!(error < 0.25 * truth, "{key}: {error}");
    }
    let angle = &law.parameters["fibre_angle_deg"];
    assert_eq!((angle.value, angle.standard_error), (0.0, None));
    assert_eq!(angle.verdict, Some(Identified::Stated));
    let text = found.tissues[0].as_ref().unwrap();
    let tissue = Tissue::parse(text, "muscle.toml").unwrap();
    assert!(tissue.to_abaqus().unwrap().contains("HOLZAPFEL"));
    assert!(
        tissue
            .to_febio()
            .unwrap()
            .contains("Holzapfel-Gasser-Ogden")
    );
    let fit = &specimen.fits[name];
    let values = law.parameters.iter();
    let mut evaluated = FoundLaw {
        law: name.to_owned(),
        values: values.map(|(key, own)| (key.clone(), own.value)).collect(),
        series: Vec::new(),
        covariance: fit.covariance.clone(),
        elastic: None,
        test: fit.test,
        fibre_axis_angle_deg: fit.fibre_axis_angle_deg,
    };
    let material = Material::from_tissue(&tissue).unwrap();
    let [x, y] = [Vec3::x(), Vec3::y()];
    for (angle, frame) in [(0.0, [x, y]), (90.0, [y, x])] {
        evaluated.fibre_axis_angle_deg = Some(angle);
        let [stress, error] = evaluated.evaluate(None, &[1.2]).unwrap()[0];
        let law = material
            .law
            .in_frame(&FibreFrame::new(&frame[0], &frame[1]).unwrap());
        let solved = stretched(law.unwrap().as_ref(), 1.2)
            .unwrap()
            .nominal_stress;
        // The tissue's numbers are written to some digits.
        assert!(
            (stress / solved - 1.0).abs() < 1e-3,
            "{angle}: {stress} {solved}"
        );
        assert!(error > 0.0 && error < 0.1 * stress, "{error}");
    }
    evaluated.fibre_axis_angle_deg = None;
    let said = evaluated.evaluate(None, &[1.2]).unwrap_err().to_string();
    assert!(said.contains("fibre_axis_angle_deg"), "{said}");
}
