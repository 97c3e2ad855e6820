//! Sheets between clamps that keep their width.

use std::path::Path;

use palpate_characterize::inverse::{CandidateLaw, Terms};
use palpate_characterize::lumped::{FittedPiece, PieceTest, UniaxialFit, piece_stress};
use palpate_characterize::{
    Characterization, CharacterizeSettings, CleanRecording, CleanSettings, characterize, clean,
};
use palpate_files::Recording;
use palpate_files::recording::ForeignColumns;

use crate::data;

const OGDEN: CandidateLaw = CandidateLaw::Ogden(Terms::One);

/// Judges: P = 2 (λ − λ⁻³) (C₁₀ + C₀₁), to which C₂₀ adds 4 C₂₀ (λ − λ⁻³) (λ² + λ⁻² − 2), and 2 μ/α (λ^(α−1) − λ^(−α−1));
/// exact.
#[test]
fn stresses_are_the_closed_forms() {
    let test = PieceTest::PlanarTension;
    for stretch in [0.8_f64, 1.2, 2.0] {
        let of = |law: CandidateLaw, p: &[f64]| piece_stress(law, test, p, stretch).unwrap();
        let shear = 2.0 * (stretch - stretch.powi(-3));
        let strain = stretch.powi(2) + stretch.powi(-2) - 2.0;
        let alpha = 4.4;
        let cases = [
            (of(CandidateLaw::NeoHookean, &[300.0]), shear * 300.0),
            (
                of(CandidateLaw::MooneyRivlin, &[300.0, 50.0]),
                shear * 350.0,
            ),
            (
                of(CandidateLaw::ReducedPolynomial(Terms::Two), &[300.0, 50.0]),
                shear * (300.0 + 100.0 * strain),
            ),
            (
                of(OGDEN, &[2000.0, alpha]),
                4000.0 / alpha * (stretch.powf(alpha - 1.0) - stretch.powf(-alpha - 1.0)),
            ),
        ];
        for (found, expected) in cases {
            assert!(
                (found - expected).abs() < 1e-10 * expected.abs(),
                "{found} {expected}"
            );
        }
    }
    let none = piece_stress(CandidateLaw::NeoHookean, test, &[300.0], 0.0);
    assert!(none.is_err());
}

/// What a researcher writes above a table of displacements and forces.
const HEADER: &str = "# stimulus = \"planar_tension\"\n# area_m2 = 0.00012\n# height_m = 0.01\n";

fn read(text: &str) -> CleanRecording {
    let columns = ForeignColumns::default();
    let recording = Recording::parse_foreign(text, Path::new("sheet.csv"), &columns).unwrap();
    clean(&recording, &CleanSettings::default()).unwrap()
}

fn found(recording: &CleanRecording, laws: &[CandidateLaw]) -> Characterization {
    let settings = CharacterizeSettings {
        laws: laws.to_vec(),
        ..CharacterizeSettings::default()
    };
    characterize(std::slice::from_ref(recording), &settings, &mut |_| ())
}

fn fit(all: &Characterization, law: CandidateLaw) -> UniaxialFit {
    let own = all.uniaxial.iter().find(|(own, _)| *own == law);
    own.unwrap().1.clone().unwrap()
}

/// Displacements [mm] and forces [mN] of a sheet of Ogden's law, without noise, as a table with these times and signs.
fn table(time: bool, sign: f64) -> String {
    let mut text = HEADER.to_owned();
    text += if time {
        "time (s),displacement (mm),force (mN)\n"
    } else {
        "displacement (mm),force (mN)\n"
    };
    for row in 0..=100 {
        let way = 0.05 * f64::from(row);
        let stress = piece_stress(
            OGDEN,
            PieceTest::PlanarTension,
            &[2331.0, 4.44],
            1.0 + 0.1 * way,
        );
        let force = sign * 1e3 * 1.2e-4 * stress.unwrap();
        if time {
            text += &format!("{},", 0.1 * f64::from(row));
        }
        text += &format!("{},{force}\n", sign * way);
    }
    text
}

/// Judge: the law that the table is made of. With times the table is of another program, whose signs may be either.
#[test]
fn a_sheet_returns_its_law_with_and_without_times() {
    for (time, sign) in [(false, 1.0), (true, 1.0), (true, -1.0)] {
        let all = found(&read(&table(time, sign)), &[OGDEN]);
        let own = fit(&all, OGDEN);
        let tests: Vec<PieceTest> = own.loadings.iter().map(|own| own.test).collect();
        assert_eq!(tests, [PieceTest::PlanarTension]);
        let [mu, alpha] = [0, 1].map(|place| own.parameters[place].1.value);
        println!("{time} {sign}: {mu} {alpha} {:?}", all.identifiability);
        assert!((mu / 2331.0 - 1.0).abs() < 1e-6, "{mu}");
        assert!((alpha / 4.44 - 1.0).abs() < 1e-6, "{alpha}");
    }
}

/// I₁ and I₂ are one in planar tension, so that C₁₀ and C₀₁ are: that is said, and no number is none.
#[test]
fn mooney_and_rivlin_are_not_told_apart() {
    let all = found(&read(&table(false, 1.0)), &CandidateLaw::DEFAULT);
    let own = fit(&all, CandidateLaw::MooneyRivlin);
    println!("{:?} {:?}", own.parameters, all.identifiability);
    assert!(own.parameters.iter().all(|(_, own)| own.value.is_finite()));
    let is_said = |said: &String| said.starts_with("mooney_rivlin");
    assert!(all.identifiability.iter().any(is_said));
}

/// A blood clot, 40 mm wide, 10 mm between its clamps, 3 mm thick. Judges: the fit published with the recording (to 20 samples
/// of it), and a refit of the closed form to all samples with another program, as the data's notes print it.
#[test]
fn ogden_of_a_clot_beside_published_fits() {
    let Some(folder) = data::folder() else {
        return;
    };
    let path = folder.join("../validation/blood_clot_shear/example_data.txt");
    let text = std::fs::read_to_string(path).unwrap();
    let recording = read(&format!("{HEADER}displacement (mm)\tforce (mN)\n{text}"));
    let all = found(&recording, &[OGDEN]);
    let own = fit(&all, OGDEN);
    println!(
        "{:?}, misfit {}, {:?}",
        own.parameters, own.misfit, all.identifiability
    );
    let [mu, alpha] = [0, 1].map(|place| own.parameters[place].1.value);
    // The refit is printed to a pascal and to two digits behind the point.
    assert!((mu - 2331.0).abs() <= 0.5, "{mu}");
    assert!((alpha - 4.44).abs() <= 0.005, "{alpha}");
    // Least squares of all samples cannot be beaten there by a fit to some.
    let pulled = FittedPiece::of(&recording).unwrap();
    let squares = |p: [f64; 2]| -> f64 {
        let each = pulled.stretches.iter().zip(&pulled.stresses);
        each.map(|(stretch, known)| {
            let own = piece_stress(OGDEN, PieceTest::PlanarTension, &p, *stretch);
            (own.unwrap() - known).powi(2)
        })
        .sum()
    };
    assert_eq!(pulled.stretches.len(), 1068);
    let [ours, theirs] = [[mu, alpha], [2378.17, 4.280]].map(squares);
    let in_millinewtons = |squares: f64| 1e3 * 1.2e-4 * (squares / 1068.0).sqrt();
    println!(
        "{} and {} mN",
        in_millinewtons(ours),
        in_millinewtons(theirs)
    );
    assert!(ours <= theirs);
}
