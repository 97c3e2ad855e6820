//! The exponential law on an effective column (6.2).

use palpate_characterize::Error;
use palpate_characterize::fit::Random;
use palpate_characterize::lumped::{Contact, column_force, column_size, fit_column, mean_modulus};
use palpate_files::tissue::EffectiveColumn;

use crate::lumped::published;

const FLAT: Contact = Contact::Flat(1e-3);

fn column(gamma: f64, alpha: f64, [area, length]: [f64; 2]) -> EffectiveColumn {
    EffectiveColumn {
        gamma_pa: gamma.into(),
        alpha: alpha.into(),
        effective_area_m2: area.into(),
        effective_length_m: length.into(),
    }
}

/// Judge: (6.2), typed from the source with λ the deformed over the undeformed length. Tolerance: rounding.
#[test]
fn the_force_is_that_of_the_source() {
    let (gamma, alpha, area, length) = (800.0, 1.7, 3e-6, 32e-3);
    let column = column(gamma, alpha, [area, length]);
    for depth in [0.0, 1e-3, 8e-3, 24e-3] {
        let l = 1.0 - depth / length;
        let exponentials =
            l * (alpha * (l * l - 1.0)).exp() - (l * l).recip() * (alpha * (1.0 / l - 1.0)).exp();
        let exact = -area * gamma / (alpha + 1.0) * exponentials;
        let force = column_force(&column, depth).unwrap();
        assert!((force - exact).abs() <= 1e-12 * exact, "{depth}: {force}");
    }
    assert!(column_force(&column, length).is_err());
}

/// Judge: the half-space of E = 3 γ at a small depth, whose modulus the other fit finds. Tolerance: the strain.
#[test]
fn at_small_depth_the_column_is_the_half_space() {
    let depth = 1e-7;
    let column = column(1e3, 2.0, column_size(FLAT, depth));
    let force = column_force(&column, depth).unwrap();
    let modulus = mean_modulus(FLAT, false, depth, force).unwrap();
    assert!((modulus / 3e3 - 1.0).abs() < 1e-3, "{modulus:?}");
    // Deeper, the column is the longer.
    assert_eq!(column_size(FLAT, 8e-3)[1], 32e-3);
    let [area, _] = column_size(Contact::Sphere(3e-3), 1e-3);
    assert!((area / (std::f64::consts::PI * 3e-6) - 1.0).abs() < 1e-12);
}

/// Judge: the column that made the forces, with noise of a hundredth of the largest. Tolerance: four of the
/// standard errors.
#[test]
fn a_column_returns() {
    let (gamma, alpha) = (1200.0, 3.0);
    let mut random = Random::new(3);
    let depths: Vec<f64> = (1..=80).map(|i| 1e-4 * f64::from(i)).collect();
    let truth = column(gamma, alpha, column_size(FLAT, 8e-3));
    let largest = column_force(&truth, 8e-3).unwrap();
    let forces: Vec<f64> = depths
        .iter()
        .map(|&depth| column_force(&truth, depth).unwrap() + 0.01 * largest * random.normal())
        .collect();
    let found = fit_column(FLAT, &depths, &forces).unwrap();
    for (estimate, truth) in [(found.column.gamma_pa, gamma), (found.column.alpha, alpha)] {
        let error = estimate.standard_error.unwrap();
        assert!(error < 0.1 * truth, "{estimate:?}");
        assert!((estimate.value - truth).abs() < 4.0 * error, "{estimate:?}");
    }
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
}

/// Judge: the mean forces of table 5-1, with which figure 6-3 shows this law to agree: within a tenth of the
/// largest, as the line widths of the figure allow.
#[test]
fn the_law_follows_the_measured_organs() {
    let rows = published("table_5_1_static_force.csv");
    for organ in ["liver", "esophagus"] {
        let of_organ = rows.iter().filter(|row| row[0] == organ);
        let (depths, forces): (Vec<f64>, Vec<f64>) = of_organ
            .map(|row| {
                let [depth, mean] = [1, 3].map(|i: usize| row[i].parse::<f64>().unwrap());
                (1e-3 * depth, mean)
            })
            .unzip();
        let found = fit_column(FLAT, &depths, &forces).unwrap();
        println!(
            "{organ}: {:?} {} {:?}",
            found.column, found.misfit, found.warnings
        );
        for (&depth, mean) in depths.iter().zip(&forces) {
            let off = (column_force(&found.column, depth).unwrap() - mean).abs();
            assert!(
                off < 0.1 * forces[forces.len() - 1],
                "{organ} {depth}: {off}"
            );
        }
    }
}

#[test]
fn nothing_felt_is_no_column() {
    let nothing = fit_column(FLAT, &[0.0, 1e-3], &[0.0, 0.0]);
    assert_eq!(nothing.unwrap_err(), Error::NoContactForce);
    let one = fit_column(FLAT, &[1e-3], &[0.1]);
    assert!(matches!(one, Err(Error::TooShort { .. })));
}
