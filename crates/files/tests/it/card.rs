//! Material cards, read again as their package would and compared with the tissue: G(t) at three times.

use palpate_files::tissue::LawName;
use palpate_files::{Elasticity, PronyTerm, Tissue};

const TERMS: [(f64, f64); 2] = [(0.2866, 1.537), (0.2022, 6.09)];

fn tissue(law: LawName, values: &[f64]) -> Tissue {
    let prony = TERMS.map(|(g, tau)| PronyTerm {
        g: g.into(),
        tau_s: tau.into(),
    });
    Tissue {
        name: Some("pig's liver".into()),
        prony: prony.to_vec(),
        ..elastic(law, values)
    }
}

fn elastic(law: LawName, values: &[f64]) -> Tissue {
    let parameters: Vec<_> = values.iter().map(|&value| value.into()).collect();
    Tissue::new(Elasticity::new(law, &parameters).unwrap())
}

fn mooney_rivlin() -> Tissue {
    tissue(LawName::MooneyRivlin, &[322.96, 161.47])
}

/// (C₁₀ + C₀₁) G(t)/G₀ [Pa] of the tissue.
fn expected(time: f64) -> f64 {
    let relaxed: f64 = TERMS
        .iter()
        .map(|(g, tau)| g * (1.0 - (-time / tau).exp()))
        .sum();
    (322.96 + 161.47) * (1.0 - relaxed)
}

fn numbers(line: &str) -> Vec<f64> {
    line.split(',').map(|n| n.trim().parse().unwrap()).collect()
}

/// Abaqus' manual: `MODULI=INSTANTANEOUS`, G(t) = G₀ (1 − Σ gᵢ (1 − exp(−t/τᵢ))). To rounding.
#[test]
fn abaqus_reads_the_same_relaxation() {
    let card = mooney_rivlin().to_abaqus().unwrap();
    let after = |keyword: &str| {
        let lines = card
            .lines()
            .skip_while(|line| !line.starts_with(keyword))
            .skip(1);
        lines
            .take_while(|line| !line.starts_with('*'))
            .map(numbers)
            .collect::<Vec<_>>()
    };
    assert!(
        card.contains("*HYPERELASTIC, MOONEY-RIVLIN, MODULI=INSTANTANEOUS"),
        "{card}"
    );
    assert!(card.contains("*MATERIAL, NAME=pig_s_liver"), "{card}");
    let law = &after("*HYPERELASTIC")[0];
    assert_eq!(law[2], 0.0);
    for time in [0.0, 1.0, 50.0] {
        let relaxed: f64 = after("*VISCOELASTIC")
            .iter()
            .map(|term| term[0] * (1.0 - (-time / term[2]).exp()))
            .sum();
        let modulus = (law[0] + law[1]) * (1.0 - relaxed);
        assert!(
            (modulus / expected(time) - 1.0).abs() < 1e-12,
            "{time}: {modulus}"
        );
    }
}

/// FEBio's manual: moduli after relaxation, times 1 + Σ γᵢ exp(−t/τᵢ). To rounding.
#[test]
fn febio_reads_the_same_relaxation() {
    let card = mooney_rivlin().to_febio().unwrap();
    let value = |name: &str| -> f64 {
        let from = card.split(&format!("<{name}>")).nth(1).unwrap();
        from.split('<').next().unwrap().parse().unwrap()
    };
    for time in [0.0, 1.0, 50.0] {
        let terms =
            (1..=2).map(|i| value(&format!("g{i}")) * (-time / value(&format!("t{i}"))).exp());
        let modulus = (value("c1") + value("c2")) * (1.0 + terms.sum::<f64>());
        assert!(
            (modulus / expected(time) - 1.0).abs() < 1e-12,
            "{time}: {modulus}"
        );
    }
    assert!(card.contains("type=\"uncoupled viscoelastic\""), "{card}");
}

#[test]
fn an_elastic_tissue_has_no_relaxation() {
    let tissue = elastic(LawName::Linear, &[1e4, 0.45]);
    let abaqus = tissue.to_abaqus().unwrap();
    assert!(abaqus.contains("*ELASTIC\n10000.0, 0.45\n"), "{abaqus}");
    let febio = tissue.to_febio().unwrap();
    assert!(
        febio.contains("type=\"isotropic elastic\"") && !febio.contains("<g1>"),
        "{febio}"
    );
}

/// Compressible tissue relaxes in bulk as well: one relaxation for the whole body.
#[test]
fn linear_tissue_relaxes_in_bulk() {
    let card = tissue(LawName::Linear, &[1e4, 0.45]);
    assert!(card.to_abaqus().unwrap().contains("0.2866, 0.2866, 1.537"));
}

#[test]
fn a_law_that_a_package_has_not_is_refused() {
    let tissue = tissue(LawName::Exponential, &[500.0, 1.0]);
    let said = tissue.to_abaqus().unwrap_err().to_string();
    assert_eq!(
        said,
        "Abaqus has no law like `exponential` of its own; write the card of another law, such as neo_hookean"
    );
    assert!(
        tissue
            .to_febio()
            .unwrap_err()
            .to_string()
            .starts_with("FEBio has no law")
    );
}

/// Abaqus' manual: `OGDEN, N` with μ₁, α₁, μ₂, …, D₁, …, eight on a line; FEBio's manual: c = 2 μ, m = α.
#[test]
fn ogden_cards_hold_each_package_s_coefficients() {
    let values = [500.0, 2.5, -60.0, -4.0, 30.0, 9.0];
    let tissue = elastic(LawName::Ogden, &values);
    let abaqus = tissue.to_abaqus().unwrap();
    let own = "*HYPERELASTIC, OGDEN, N=3\n500.0, 2.5, -60.0, -4.0, 30.0, 9.0, 0.0, 0.0\n0.0\n";
    assert!(abaqus.contains(own), "{abaqus}");
    let febio = tissue.to_febio().unwrap();
    assert!(febio.contains("type=\"Ogden\""), "{febio}");
    for (i, [mu, alpha]) in (1..).zip(values.as_chunks().0) {
        assert!(
            febio.contains(&format!("<c{i}>{:?}</c{i}>", 2.0 * mu)),
            "{febio}"
        );
        assert!(
            febio.contains(&format!("<m{i}>{alpha:?}</m{i}>")),
            "{febio}"
        );
    }
    // A thousand times the sum of μ.
    assert!(febio.contains("<k>470000.0</k>"), "{febio}");
}

/// Abaqus' manual: `REDUCED POLYNOMIAL, N` with C₁₀, …, D₁, …; FEBio's: Yeoh with c₁, … of the same invariant.
#[test]
fn reduced_polynomial_cards_hold_each_package_s_coefficients() {
    let tissue = elastic(LawName::ReducedPolynomial, &[500.0, -20.0]);
    let abaqus = tissue.to_abaqus().unwrap();
    let own = "*HYPERELASTIC, REDUCED POLYNOMIAL, N=2\n500.0, -20.0, 0.0, 0.0\n";
    assert!(abaqus.contains(own), "{abaqus}");
    let febio = tissue.to_febio().unwrap();
    let own = "<c1>500.0</c1>\n\t\t\t<c2>-20.0</c2>\n\t\t\t<k>1000000.0</k>";
    assert!(
        febio.contains("type=\"Yeoh\"") && febio.contains(own),
        "{febio}"
    );
}

/// Abaqus' manual: `HOLZAPFEL` with C₁₀, D, k₁, k₂, κ and two directions in an orientation. FEBio's manual: c = 2 C₁₀, the
/// angle in degrees from the first material axis; of c and k₁ what is left after relaxation.
#[test]
fn fibre_cards_hold_each_package_s_coefficients_and_directions() {
    let values = [3820.0, 996_600.0, 524.6, 0.226, 60.0];
    let abaqus = tissue(LawName::HolzapfelGasserOgden, &values)
        .to_abaqus()
        .unwrap();
    let own = "*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2, MODULI=INSTANTANEOUS\n\
               3820.0, 0.0, 996600.0, 524.6, 0.226\n";
    assert!(abaqus.contains(own), "{abaqus}");
    let (_, directions) = abaqus
        .split_once("*ORIENTATION, NAME=fibres_of_pig_s_liver, LOCAL DIRECTIONS=2\n1.0, 0.0, 0.0, 0.0, 1.0, 0.0\n3, 0.0\n")
        .unwrap();
    let directions: Vec<_> = directions.lines().map(numbers).collect();
    for (found, side) in directions.iter().zip([1.0, -1.0]) {
        let exact = [0.5, side * 0.75_f64.sqrt(), 0.0];
        assert!(
            (0..3).all(|i| (found[i] - exact[i]).abs() < 1e-15),
            "{found:?}"
        );
    }
    assert_eq!(directions.len(), 2);
    let left = 1.0 - TERMS[0].0 - TERMS[1].0;
    let febio = tissue(LawName::HolzapfelGasserOgden, &values)
        .to_febio()
        .unwrap();
    let value = |name: &str| -> f64 {
        let from = febio.split(&format!("<{name}>")).nth(1).unwrap();
        from.split('<').next().unwrap().parse().unwrap()
    };
    assert!(
        febio.contains("<elastic type=\"Holzapfel-Gasser-Ogden\">"),
        "{febio}"
    );
    for (name, exact) in [
        ("c", 7640.0 * left),
        ("k1", 996_600.0 * left),
        ("k2", 524.6),
        ("kappa", 0.226),
        ("gamma", 60.0),
    ] {
        assert!(
            (value(name) / exact - 1.0).abs() < 1e-14,
            "{name}: {}",
            value(name)
        );
    }
    let axes = "<mat_axis type=\"vector\">\n\t\t\t\t\t<a>1,0,0</a>\n\t\t\t\t\t<d>0,1,0</d>\n\t\t\t\t</mat_axis>\n\t\t\t</elastic>";
    assert!(febio.contains(axes), "{febio}");
    // An isotropic law needs none.
    assert!(!mooney_rivlin().to_febio().unwrap().contains("mat_axis"));
    assert!(
        !mooney_rivlin()
            .to_abaqus()
            .unwrap()
            .contains("*ORIENTATION")
    );
}
