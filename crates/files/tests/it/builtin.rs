//! The built-in tissues against the published tables, which are the judge.

use std::path::Path;

use palpate_files::tissue::LawName;
use palpate_files::{BuiltinTissue, Elasticity, Tissue};

/// The field `column` of the row of a published table that begins with `row`.
fn published(table: &str, row: &str, column: &str) -> f64 {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../published");
    let text = std::fs::read_to_string(folder.join(table)).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names = lines.next().unwrap().split(',');
    let column = names.into_iter().position(|name| name == column).unwrap();
    let row = lines.find(|line| line.starts_with(row)).unwrap();
    row.split(',').nth(column).unwrap().parse().unwrap()
}

#[test]
fn hyperelastic_organs_are_those_of_the_tables() {
    let rows = [
        (BuiltinTissue::PigLiver, "liver,6"),
        (BuiltinTissue::PigKidney, "kidney,5"),
    ];
    for (builtin, row) in rows {
        let tissue = Tissue::builtin(builtin);
        let c10 = published("table_6_4_neo_hookean.csv", row, "final_c10_pa");
        let expected = Elasticity::new(LawName::NeoHookean, &[c10.into()]);
        assert_eq!(Some(tissue.elasticity), expected);
        for (term, number) in tissue.prony.iter().zip(1..) {
            let of = |name: &str| published("table_6_3_prony.csv", row, &format!("{name}{number}"));
            assert_eq!(term.g.value, of("g"));
            let tau = published("table_6_3_prony.csv", row, &format!("tau{number}_s"));
            assert_eq!(term.tau_s.value, tau);
        }
        assert_eq!(tissue.prony.len(), 2);
    }
}

#[test]
fn linear_organs_are_those_of_the_tables() {
    let youngs_modulus = |tissue: &Tissue| {
        assert_eq!(tissue.elasticity.law(), LawName::Linear);
        tissue.elasticity.values()[0]
    };
    let spleen = Tissue::builtin(BuiltinTissue::PigSpleen);
    let kpa = published(
        "table_6_1_mean_elastic_modulus.csv",
        "spleen",
        "youngs_modulus_kpa",
    );
    assert!((youngs_modulus(&spleen) - 1e3 * kpa).abs() < 1e-9);
    assert!(spleen.prony.is_empty());

    let esophagus = Tissue::builtin(BuiltinTissue::PigEsophagus);
    let of = |column| published("esophagus_6_4_5.csv", "5.222", column);
    assert!((youngs_modulus(&esophagus) - 1e3 * of("youngs_modulus_kpa")).abs() < 1e-9);
    assert_eq!(esophagus.prony[0].g.value, of("prony_g1"));
    assert_eq!(esophagus.prony[0].tau_s.value, of("relaxation_time_s"));
}

#[test]
fn lumped_parameters_are_those_of_the_tables() {
    let liver = Tissue::builtin(BuiltinTissue::PigLiver);
    let kelvin = liver.lumped.kelvin.unwrap();
    let of = |column| 1e3 * published("kelvin_liver.csv", "0.008", column);
    assert_eq!(kelvin.k1_n_per_m.value, of("k1_n_per_mm"));
    assert_eq!(kelvin.k2_n_per_m.value, of("k2_n_per_mm"));
    assert_eq!(kelvin.b_n_s_per_m.value, of("b_n_s_per_mm"));

    let esophagus = Tissue::builtin(BuiltinTissue::PigEsophagus);
    for (tissue, row) in [(liver, "liver"), (esophagus, "esophagus")] {
        let springs = tissue.lumped.nonlinear_springs.unwrap();
        let of = |column| published("table_6_2_nonlinear_springs.csv", row, column);
        assert_eq!(springs.k01.value, of("k01"));
        assert_eq!(springs.k12.value, of("k12"));
        assert_eq!(springs.k23.value, of("k23"));
    }
}

#[test]
fn every_builtin_tissue_warns_of_its_source() {
    for (name, builtin) in BuiltinTissue::WORDS {
        let tissue = Tissue::builtin(*builtin);
        assert_eq!(tissue.density_kg_m3.value, 1060.0);
        let warnings = &tissue.source.warnings;
        let contradicts = warnings.iter().any(|w| w.contains("contradicts itself"));
        assert!(contradicts, "{name}: {warnings:?}");
    }
}
