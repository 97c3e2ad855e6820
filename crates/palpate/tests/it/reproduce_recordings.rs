//! The tables and figures of chapters 5 and 6.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::reproduce::{find, reproduce};

/// The cell of a printed table in the first row that begins with `row`.
pub(crate) fn printed(file: &str, row: &[&str], column: &str) -> f64 {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../published");
    let text = fs::read_to_string(path.join(file)).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names = lines.next().unwrap().split(',');
    let at = names.clone().position(|name| name == column).unwrap();
    let found = lines.find(|line| line.split(',').take(row.len()).eq(row.iter().copied()));
    found.unwrap().split(',').nth(at).unwrap().parse().unwrap()
}

pub(crate) fn number(row: &Value, key: &str) -> f64 {
    row[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} of {row}"))
}

/// Whatever has a file has it, and whatever has no number says why.
pub(crate) fn assert_complete(folder: &tempfile::TempDir, rows: &[Value]) {
    for row in rows {
        let missing = row["ours"].is_null() && row["file"].is_null();
        assert!(
            !missing || !row["note"].as_str().unwrap().is_empty(),
            "{row}"
        );
        if let Some(file) = row["file"].as_str() {
            let bytes = fs::read(folder.path().join(file)).unwrap();
            assert!(
                !file.ends_with("png") || bytes.starts_with(b"\x89PNG"),
                "{row}"
            );
        }
    }
}

/// Judge: the printed numbers. Tolerance: the rounding of the three, 0.1 mN together, and the tenth of a per cent that
/// has not relaxed after 40 s, twice.
#[test]
fn table_5_1_is_what_the_analysis_returns() {
    let (folder, rows) = reproduce(&["table-5-1", "figure-5-1"]);
    assert_complete(&folder, &rows);
    let file = "table_5_1_static_force.csv";
    let mut impossible = 0;
    for row in rows.iter().filter(|row| row["unit"] == "N") {
        let parts: Vec<&str> = row["row"].as_str().unwrap().split('/').collect();
        let &[_, organ, depth, number_of] = parts.as_slice() else {
            continue;
        };
        let depth = depth.trim_end_matches("_mm");
        let cell = |column: &str| printed(file, &[organ, depth], column);
        assert_eq!(
            number(row, "published"),
            cell(&format!("{number_of}_n")),
            "{row}"
        );
        let mark = match row["ours"].is_null() {
            true => "not_computed",
            false => "pipeline_only",
        };
        assert_eq!(row["mark"], mark, "{row}");
        match row["ours"].as_f64() {
            Some(ours) => {
                let published = number(row, "published");
                assert!((ours - published).abs() < 1e-4 + 2e-3 * published, "{row}");
            }
            None => {
                impossible += 1;
                assert!(cell("min_n") > cell("mean_n"), "{row}");
            }
        }
    }
    assert_eq!(impossible, 9);
    // By arithmetic: 59 (0.0544 - 0.0402) = 0.8761 - 0.0402, to the rounding.
    let responses = find(&rows, "table-5-1/esophagus/5_mm/responses");
    assert_eq!(number(responses, "ours"), 59.0);
}

/// Judge: a series of positive terms stiffens with the frequency.
#[test]
#[ignore = "long"]
fn swings_stiffen_and_lose_energy() {
    let (folder, rows) = reproduce(&["figure-5-14", "figure-5-15", "figure-5-16"]);
    assert_complete(&folder, &rows);
    for organ in ["liver", "kidney", "esophagus"] {
        assert!(
            number(
                find(&rows, &format!("figure-5-15/{organ}/hysteresis")),
                "ours"
            ) > 0.0
        );
        assert!(number(find(&rows, &format!("figure-5-15/{organ}/phase")), "ours") > 0.0);
    }
    assert!(number(find(&rows, "figure-5-16/kidney/rise"), "ours") > 1.0);
}

/// Judge: the printed numbers. Tolerance of the kidney: the four digits of both tables. Springs: their fit ends at
/// changes of 1e-8, Kelvin's law at noise of 0.225 mN with 3 % of b.
#[test]
#[ignore = "long"]
fn laws_without_geometry_are_found_again() {
    let words = [
        "table-6-1",
        "figure-6-3",
        "equation-6-3",
        "figure-6-4",
        "table-6-2",
        "figure-6-5",
    ];
    let (folder, rows) = reproduce(&words);
    assert_complete(&folder, &rows);
    let kidney = find(&rows, "table-6-1/kidney/modulus");
    assert!((number(kidney, "ratio") - 1.0).abs() < 2e-3, "{kidney}");
    assert_eq!(
        number(kidney, "published"),
        printed(
            "table_6_1_mean_elastic_modulus.csv",
            &["kidney"],
            "youngs_modulus_kpa"
        )
    );
    for (name, column) in [
        ("k1", "k1_n_per_mm"),
        ("k2", "k2_n_per_mm"),
        ("b", "b_n_s_per_mm"),
    ] {
        let row = find(&rows, &format!("equation-6-3/{name}"));
        assert_eq!(
            number(row, "published"),
            printed("kelvin_liver.csv", &[], column)
        );
        assert!((number(row, "ratio") - 1.0).abs() < 0.06, "{row}");
    }
    assert!(number(find(&rows, "equation-6-3/printed_form/left"), "ours") > 1.0);
    for name in ["k01", "k02", "k11", "k12", "k13", "k21", "k22", "k23"] {
        let row = find(&rows, &format!("table-6-2/liver/{name}"));
        let cell = printed("table_6_2_nonlinear_springs.csv", &["liver"], name);
        assert_eq!(number(row, "published"), cell);
        assert!((number(row, "ratio") - 1.0).abs() < 1e-4, "{row}");
    }
    assert_eq!(
        number(find(&rows, "table-6-2/esophagus/springs"), "ratio"),
        1.0
    );
}

/// Judge: the printed terms. Tolerance: two and a half of the largest standard error, which the notes tell as 2.2 %
/// (liver). Taken for a step, the ramp of 0.5 s hides a part of the fast term.
#[test]
fn table_6_3_is_found_again_with_the_ramp() {
    let (_folder, rows) = reproduce(&["table-6-3"]);
    for (organ, depth) in [("liver", "6"), ("kidney", "5"), ("kidney", "4")] {
        let row = |word: &str| find(&rows, &format!("table-6-3/{organ}_{depth}_mm/{word}"));
        assert_eq!(number(row("terms"), "ratio"), 1.0);
        for (word, column) in [
            ("g1", "g1"),
            ("g2", "g2"),
            ("tau1", "tau1_s"),
            ("tau2", "tau2_s"),
        ] {
            let cell = printed("table_6_3_prony.csv", &[organ, depth], column);
            assert_eq!(number(row(word), "published"), cell);
            assert!(
                (number(row(word), "ratio") - 1.0).abs() < 0.055,
                "{}",
                row(word)
            );
        }
        assert!(number(row("step/g1"), "ratio") < 0.95, "{}", row("step/g1"));
    }
}

/// Judge: force is proportional to all moduli at once, so that no common factor keeps either iteration from the
/// truth; the own one arrives from everywhere.
#[test]
#[ignore = "long"]
fn section_6_4_4_arrives_from_everywhere() {
    let (folder, rows) = reproduce(&["section-6-4-4", "figure-6-9", "figure-6-10"]);
    assert_complete(&folder, &rows);
    for organ in ["kidney", "liver"] {
        for case in [
            "neo_hookean/all",
            "mooney_rivlin/all",
            "mooney_rivlin/first",
            "mooney_rivlin/second",
        ] {
            for direction in ["above", "below"] {
                let row = find(
                    &rows,
                    &format!("section-6-4-4/{organ}/{case}/own/{direction}"),
                );
                assert!((number(row, "ours") - 10.0).abs() < 1e-9, "{row}");
            }
        }
        let name = format!("section-6-4-4/{organ}/neo_hookean/all/source/above");
        assert!((number(find(&rows, &name), "ours") - 10.0).abs() < 1e-9);
    }
    let start = find(&rows, "figure-6-9/liver/source/steps");
    let cell = printed("table_6_4_neo_hookean.csv", &["liver"], "iterations");
    assert_eq!(number(start, "published"), cell);
}

/// Judge: the errata's range of 0.3 to 0.8 of the measured means, a hair wider for the finite strain of the
/// Mooney-Rivlin law.
#[test]
fn published_laws_do_not_return_the_measured_means() {
    let (folder, rows) = reproduce(&["figure-6-7", "figure-6-11", "figure-7-17"]);
    assert_complete(&folder, &rows);
    let steady = rows
        .iter()
        .filter(|row| row["row"].as_str().unwrap().ends_with("/steady"));
    let ratios: Vec<f64> = steady.map(|row| number(row, "ratio")).collect();
    assert!(
        ratios.len() == 4 && ratios.iter().all(|r| (0.25..0.85).contains(r)),
        "{ratios:?}"
    );
    let card = find(&rows, "figure-6-7")["file"].as_str().unwrap();
    let card = fs::read_to_string(folder.path().join(card)).unwrap();
    let g = printed("table_6_3_prony.csv", &["liver", "6"], "g1");
    assert!(
        card.contains("MODULI=INSTANTANEOUS") && card.contains(&format!("{g}, ")),
        "{card}"
    );
    assert_eq!(number(find(&rows, "figure-7-17/animals"), "ratio"), 1.0);
}

/// Judge: the printed term. Tolerance: five standard deviations of a fit to 2000 samples.
#[test]
fn section_6_4_5_finds_its_term_again() {
    let (_folder, rows) = reproduce(&["section-6-4-5"]);
    for (name, column) in [("tau", "relaxation_time_s"), ("g", "prony_g1")] {
        let row = find(&rows, &format!("section-6-4-5/{name}"));
        assert_eq!(
            number(row, "published"),
            printed("esophagus_6_4_5.csv", &[], column)
        );
        assert!((number(row, "ratio") - 1.0).abs() < 0.01, "{row}");
    }
}

/// Judge: the printed parameters, through full viscoelastic runs. Tolerances: the 5 % by which a full run is stiffer
/// than a convolution at these depths, and 1.5 % for its mesh; the force that was fitted is met to 2 %.
#[test]
#[ignore = "slow: four viscoelastic runs"]
fn laws_are_found_again_from_full_runs() {
    let (_folder, rows) = reproduce(&["table-6-4", "table-6-5"]);
    for organ in ["kidney", "liver"] {
        for name in [
            format!("table-6-4/{organ}/c10"),
            format!("table-6-5/{organ}/sum"),
        ] {
            let row = find(&rows, &name);
            assert!((number(row, "ratio") - 1.0).abs() < 0.065, "{row}");
        }
        for table in ["table-6-4", "table-6-5"] {
            assert!(number(find(&rows, &format!("{table}/{organ}/misfit")), "ours") < 0.02);
        }
    }
}

/// Judge: a tube under a punch gives way as a whole, so that its tissue has to be stiffer than a half-space's.
#[test]
#[ignore = "slow: a tube on two meshes"]
fn the_tube_is_stiffer_than_the_half_space_says() {
    let (_folder, rows) = reproduce(&["figure-6-15"]);
    assert!(number(find(&rows, "figure-6-15/tube_modulus"), "ratio") > 2.0);
    let too_deep = find(&rows, "figure-6-15/8_mm");
    assert!(too_deep["ours"].is_null() && too_deep["mark"] == "not_computed");
}
