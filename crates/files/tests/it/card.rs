//! Material cards, read again as their package would and compared with the tissue: G(t) at three times.

use palpate_files::tissue::OgdenTerm;
use palpate_files::{Elasticity, PronyTerm, Tissue};

const TERMS: [(f64, f64); 2] = [(0.2866, 1.537), (0.2022, 6.09)];

fn tissue(elasticity: Elasticity) -> Tissue {
    let prony = TERMS.map(|(g, tau)| PronyTerm {
        g: g.into(),
        tau_s: tau.into(),
    });
    Tissue {
        name: Some("pig's liver".into()),
        prony: prony.to_vec(),
        ..Tissue::new(elasticity)
    }
}

fn mooney_rivlin() -> Tissue {
    tissue(Elasticity::MooneyRivlin {
        c10_pa: 322.96.into(),
        c01_pa: 161.47.into(),
    })
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
    let tissue = Tissue::new(Elasticity::Linear {
        youngs_modulus_pa: 1e4.into(),
        poissons_ratio: 0.45.into(),
    });
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
    let card = tissue(Elasticity::Linear {
        youngs_modulus_pa: 1e4.into(),
        poissons_ratio: 0.45.into(),
    });
    assert!(card.to_abaqus().unwrap().contains("0.2866, 0.2866, 1.537"));
}

#[test]
fn a_law_that_a_package_has_not_is_refused() {
    let tissue = tissue(Elasticity::Exponential {
        gamma_pa: 500.0.into(),
        alpha: 1.0.into(),
    });
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

fn ogden() -> Tissue {
    let term = |mu: f64, alpha: f64| {
        Some(OgdenTerm {
            mu_pa: mu.into(),
            alpha: alpha.into(),
        })
    };
    tissue(Elasticity::Ogden {
        terms: [term(2000.0, 4.3), term(500.0, -2.0), term(-100.0, 9.0)],
    })
}

/// The manuals: Abaqus has Σ 2 μᵢ/αᵢ² (…) and one Dᵢ for each term, at most eight numbers on a line; FEBio has
/// Σ cᵢ/mᵢ² (…), of what is left when all has relaxed. To rounding.
#[test]
fn ogden_and_polynomials_have_cards() {
    let card = ogden().to_abaqus().unwrap();
    let law = "*HYPERELASTIC, OGDEN, N=3, MODULI=INSTANTANEOUS\n\
               2000.0, 4.3, 500.0, -2.0, -100.0, 9.0, 0.0, 0.0,\n0.0\n";
    assert!(card.contains(law), "{card}");
    let polynomial = tissue(Elasticity::ReducedPolynomial {
        c10_pa: 450.0.into(),
        higher_pa: [Some((-20.0).into()), None],
    });
    let card = polynomial.to_abaqus().unwrap();
    let law =
        "*HYPERELASTIC, REDUCED POLYNOMIAL, N=2, MODULI=INSTANTANEOUS\n450.0, -20.0, 0.0, 0.0\n";
    assert!(card.contains(law), "{card}");
    let card = ogden().to_febio().unwrap();
    let value = |name: &str| -> f64 {
        let from = card.split(&format!("<{name}>")).nth(1).unwrap();
        from.split('<').next().unwrap().parse().unwrap()
    };
    let left = 1.0 - TERMS.iter().map(|(g, _)| g).sum::<f64>();
    for (name, expected) in [
        ("c1", 4000.0 * left),
        ("c2", 1000.0 * left),
        ("c3", -200.0 * left),
        ("m2", -2.0),
    ] {
        assert!(
            (value(name) / expected - 1.0).abs() < 1e-12,
            "{name}: {card}"
        );
    }
    assert!(polynomial.to_febio().is_err());
}

#[test]
fn new_laws_are_read_as_they_are_written() {
    let polynomial = tissue(Elasticity::ReducedPolynomial {
        c10_pa: 450.0.into(),
        higher_pa: [Some(20.0.into()), Some(7.0.into())],
    });
    for tissue in [ogden(), polynomial] {
        assert_eq!(Tissue::parse(&tissue.to_toml(), "t.toml").unwrap(), tissue);
    }
    let refused = |more: &str| {
        let text =
            format!("format = 1\n[tissue]\nlaw = \"ogden\"\nmu_1_pa = 1000\nalpha_1 = 4\n{more}");
        Tissue::parse(&text, "t.toml").unwrap_err().to_string()
    };
    for (more, said) in [
        ("mu_2_pa = 3\n", "alpha_2"),
        ("mu_3_pa = 3\nalpha_3 = 2\n", "mu_2_pa"),
        ("mu_2_pa = -1001\nalpha_2 = 2\n", "above 0"),
        ("mu_2_pa = 1\nalpha_2 = 0\n", "0.001"),
        ("c10_pa = 1\n", "c10_pa"),
    ] {
        let error = refused(more);
        assert!(error.contains(said), "{more}: {error}");
    }
}
