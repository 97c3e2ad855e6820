//! What a fit says about itself in words. Judge: problems made so that the sentence is known.

use nalgebra::DMatrix;
use palpate_characterize::fit::{
    CORRELATED, Parameter, Random, Settings, Verdict, correlated_pairs, least_squares, uncertainty,
    verdicts, warnings,
};

const MODULI: [&str; 2] = ["c10_pa", "c01_pa"];

/// A curve to which two parameters add, one of them by the part `apart` more toward its end.
fn sentences(names: [&str; 2], apart: f64) -> Vec<String> {
    let parameters = names.map(|name| Parameter::new(name, 200.0).within(-1e5, 1e5));
    let mut noise = Random::new(11);
    let drawn: Vec<f64> = (0..100).map(|_| 20.0 * noise.normal()).collect();
    let residuals = |p: &[f64], residuals: &mut [f64]| {
        for (i, residual) in residuals.iter_mut().enumerate() {
            let x = i as f64 / 100.0 - 0.495;
            *residual = (p[0] - 323.0) + (p[1] - 162.0) * (1.0 + apart * x) - drawn[i];
        }
        Some(())
    };
    let fit =
        least_squares(&parameters, 100, &Settings::default(), residuals).expect("the curve starts");
    warnings(&fit, &uncertainty(&fit), None)
}

/// With nearly the same effect only the sum of two moduli is known, and it is named; with their own, nothing
/// is left to say.
#[test]
fn moduli_that_cannot_be_told_apart_are_named_with_their_sum() {
    let found = sentences(MODULI, 0.005);
    assert_eq!(found.len(), 1, "{found:?}");
    let start = "c10_pa and c01_pa cannot be told apart from this recording; their sum is 48";
    assert!(found[0].starts_with(start), "{found:?}");
    // 20 Pa over √100, to two digits as they begin with a one.
    assert!(found[0].ends_with(" ± 2.0 Pa"), "{found:?}");
    assert!(sentences(MODULI, 2.0).is_empty());
}

/// Of parameters whose names have no unit no sum is told: they may be newtons and seconds.
#[test]
fn what_has_no_unit_is_not_added() {
    let found = sentences(["k01", "k11"], 0.005).join("\n");
    assert!(found.contains("k01") && !found.contains("sum"), "{found}");
}

/// A time constant beyond the recording, a parameter on its bound, and one that is not seen.
#[test]
fn what_a_recording_does_not_show_is_said() {
    let parameters = [
        Parameter::new("steady_n", 0.5),
        Parameter::new("tau_2_s", 30.0).within(1.0, 40.0),
        Parameter::new("offset_m", 1.0).within(0.0, 1.0),
    ];
    let residuals = |p: &[f64], residuals: &mut [f64]| {
        for (i, residual) in residuals.iter_mut().enumerate() {
            let t = 0.2 * i as f64;
            *residual = p[0] * (-t / p[1]).exp() - (-t / 35.0).exp() + 0.01 * (p[2] - 2.0);
        }
        Some(())
    };
    let fit = least_squares(&parameters, 100, &Settings::default(), residuals).unwrap();
    let found = warnings(&fit, &uncertainty(&fit), Some(20.0));
    assert!(
        found[0].starts_with("tau_2_s is longer than the recording shows: "),
        "{found:?}"
    );
    assert_eq!(
        found[1],
        "offset_m ended on its bound 1, which is no estimate"
    );
}

/// Judge: the numbers themselves. A bound goes before an error, an error before a correlation; where |ρ| = √0.9 the
/// error is √10 times what it would be if the other were known.
#[test]
fn verdicts_follow_from_the_numbers() {
    let of = |errors: [Option<f64>; 2], correlation: f64| {
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, correlation, correlation, 1.0]);
        verdicts(&errors, &matrix)
    };
    assert_eq!(of([Some(0.01), Some(0.2)], -0.9), [Verdict::Known; 2]);
    let [first, second] = [1, 0].map(|with| Verdict::Correlated {
        with,
        correlation: -0.99,
    });
    assert_eq!(of([Some(0.01), Some(0.2)], -0.99), [first, second]);
    assert_eq!(
        of([Some(0.01), Some(0.3)], -0.99),
        [first, Verdict::HardlyKnown]
    );
    assert_eq!(
        of([Some(0.01), None], -0.99),
        [Verdict::Known, Verdict::NoEstimate]
    );
    assert_eq!(of([Some(f64::NAN), None], 0.0)[0], Verdict::HardlyKnown);
    assert!((1.0 - CORRELATED * CORRELATED - 0.1).abs() < 1e-15);
    let names = ["c10_pa", "c01_pa"].map(str::to_owned);
    let pair = |correlation: f64| {
        correlated_pairs(
            &names,
            &DMatrix::from_row_slice(2, 2, &[1.0, correlation, correlation, 1.0]),
        )
    };
    assert!(pair(0.94).is_empty());
    // 1/√(1 − 0.99²) = 7.09.
    let said = "c10_pa and c01_pa are known together, not each by itself: their errors correlate by \
                -0.990, and if one were known, the other would be known 7 times better";
    assert_eq!(pair(-0.99), [([0, 1], said.to_owned())]);
}
