use super::*;

/// Values on meshes whose elements are halved, of f = 1 + a h + b h².
fn mixed(a: f64, b: f64) -> impl Fn(f64) -> f64 {
    move |h| 1.0 + a * h + b * h * h
}

const HALVED: [f64; 4] = [0.4, 0.2, 0.1, 0.05];

fn refined(sizes: &[f64], order: f64, accuracy: f64, value: impl Fn(f64) -> f64) -> Estimated<f64> {
    refine(&Meshes { sizes, order }, accuracy, |mesh| {
        let value = value(sizes[mesh]);
        Ok(Some((value, vec![Quantity::new("force", vec![value])])))
    })
    .unwrap()
}

/// Judge: the limit, 1. What is promised without a warning is between half and five times the error.
#[test]
fn the_index_is_honest_or_warns() {
    let (mut promised, mut warned) = (0, 0);
    for sizes in [&[0.4, 0.2, 0.1][..], &[0.3, 0.15, 0.1]] {
        for k in -40..=40 {
            let (a, b) = (0.01, 0.001 * f64::from(k));
            for order in [1.0, 2.0] {
                let found = refined(sizes, 1.0, 0.0, |h| {
                    1.0 + a * h.powf(order) + b * h.powf(order + 1.0)
                });
                let error = (found.answer - 1.0).abs();
                let ratio = found.error / error;
                if found.warnings.is_empty() {
                    promised += 1;
                    assert!(
                        (0.5..5.0).contains(&ratio),
                        "{sizes:?} {order} {k}: {ratio}"
                    );
                } else {
                    warned += 1;
                    assert!(
                        ratio >= 0.5 && found.observed_order.is_none(),
                        "{sizes:?} {order} {k}: {ratio}"
                    );
                }
            }
        }
    }
    println!("{promised} promised, {warned} warned");
    assert!(promised > 100 && warned > 20);
}

/// Judge: the exponent, with meshes that are not halved.
#[test]
fn the_order_of_three_meshes_is_found() {
    for sizes in [[0.4, 0.2, 0.1], [1.0, 0.5, 1.0 / 3.0], [1.0, 0.9, 0.7]] {
        for order in [0.6, 1.0, 1.7] {
            let found = refined(&sizes, 1.0, 0.0, |h| 1.0 - 0.1 * h.powf(order));
            let observed = found.observed_order.unwrap();
            assert!((observed - order).abs() < 1e-2, "{sizes:?}: {observed}");
            // The index with the safety factor, up to the expected order.
            let ratio = sizes[1] / sizes[2];
            let error = 1.25 * 0.1 * (sizes[1].powf(order) - sizes[2].powf(order))
                / (ratio.powf(order.min(1.0)) - 1.0);
            assert!((found.error * found.answer / error - 1.0).abs() < 1e-2);
        }
    }
}

/// Judge: the sequences themselves. Each has three meshes whose last two agree to 1 %.
#[test]
fn what_does_not_converge_promises_nothing() {
    let sequences: [([f64; 3], &str, f64); 5] = [
        ([1.02, 0.99, 1.0], "goes up and down", 0.03),
        ([1.000, 1.005, 1.015], "hardly converges", 0.03),
        ([1.0, 1.01, 1.02], "hardly converges", 0.03),
        ([1.0, 1.2, 1.201], "chance", 0.1),
        ([1.0, f64::NAN, 1.0], "hardly converges", f64::INFINITY),
    ];
    for (values, word, least) in sequences {
        let sizes = [0.4, 0.2, 0.1];
        let found = refined(&sizes, 1.0, 0.0, |h| {
            values[sizes.iter().position(|s| *s == h).unwrap()]
        });
        assert!(found.observed_order.is_none());
        assert!(
            found.warnings.len() == 1 && found.warnings[0].contains(word),
            "{found:?}"
        );
        assert!(found.error >= least * 0.98, "{found:?}");
    }
}

/// Two meshes: the assumed order is said, and the factor is 3.
#[test]
fn two_meshes_say_what_they_assume() {
    let value = mixed(0.02, 0.0);
    let coarse = refined(&HALVED, 1.0, 0.2, &value);
    assert_eq!(coarse.answer, value(0.2));
    assert!((coarse.error / (3.0 * (value(0.4) - value(0.2)) / value(0.2)) - 1.0).abs() < 1e-9);
    assert!(coarse.warnings[0].contains("two meshes") && coarse.warnings[0].contains("order"));
    // A third mesh beyond the machine.
    let sizes = &HALVED;
    let found = refine(&Meshes { sizes, order: 1.0 }, 1e-9, |mesh| {
        let values = vec![value(sizes[mesh])];
        Ok((mesh < 2).then(|| (mesh, vec![Quantity::new("force", values)])))
    });
    let found = found.unwrap();
    assert_eq!(
        (found.answer, found.error, &found.warnings),
        (1, coarse.error, &coarse.warnings)
    );
}

/// Three meshes are the least where accuracy is asked for, and a fourth is solved where it is needed.
#[test]
fn as_many_meshes_as_it_takes() {
    let value = mixed(0.02, 0.0);
    for (accuracy, size) in [(0.01, 0.1), (0.0022, 0.05), (0.0, 0.05)] {
        let found = refined(&HALVED, 1.0, accuracy, &value);
        assert_eq!(found.answer, value(size), "{accuracy}");
        assert!(found.warnings.is_empty());
    }
}

/// The largest of the quantities' errors counts; one that some meshes lack gives a warning.
#[test]
fn every_quantity_counts() {
    let sizes = [0.4, 0.2, 0.1];
    let found = refine(
        &Meshes {
            sizes: &sizes,
            order: 1.0,
        },
        0.0,
        |mesh| {
            let h = sizes[mesh];
            Ok(Some((
                (),
                vec![
                    Quantity::new("force", vec![1.0 + 0.01 * h]),
                    Quantity::new("profile", vec![1.0 + 0.05 * h]),
                    Quantity::new("limit", vec![1.0; mesh / 2]),
                ],
            )))
        },
    )
    .unwrap();
    assert!(
        (found.error / (1.25 * 0.05 * 0.1) - 1.0).abs() < 0.01,
        "{found:?}"
    );
    assert!((found.observed_order.unwrap() - 1.0).abs() < 1e-3);
    assert!(
        found.warnings.len() == 1 && found.warnings[0].contains("limit"),
        "{found:?}"
    );
}

/// A first mesh too coarse for an equilibrium is left out; a failure after two meshes is told with their
/// answer.
#[test]
fn meshes_may_fail() {
    let failing = |which: usize| {
        refine(
            &Meshes {
                sizes: &HALVED,
                order: 1.0,
            },
            0.0,
            |mesh| {
                if mesh == which {
                    return Err(Error::NoElements);
                }
                let value = mixed(0.02, 0.0)(HALVED[mesh]);
                Ok(Some((value, vec![Quantity::new("force", vec![value])])))
            },
        )
    };
    assert!(failing(0).unwrap().warnings.is_empty());
    assert!(failing(1).is_err());
    let found = failing(2).unwrap();
    assert_eq!(found.answer, mixed(0.02, 0.0)(0.2));
    assert!(found.warnings.len() == 2 && found.warnings[1].contains("finer mesh"));
}
