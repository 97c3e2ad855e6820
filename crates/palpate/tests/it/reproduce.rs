use serde_json::Value;

use crate::{json, palpate_in, stdout};

/// The keys of the contract, all of them and no others.
const KEYS: [&str; 8] = [
    "row",
    "published",
    "ours",
    "unit",
    "ratio",
    "file",
    "note",
    "seconds",
];

fn reproduce(words: &[&str]) -> (tempfile::TempDir, Vec<Value>) {
    let folder = tempfile::tempdir().unwrap();
    let line = [&["reproduce"], words, &["--json"]].concat();
    let answer = json(&palpate_in(folder.path(), &line));
    let rows = answer.as_array().unwrap().clone();
    for row in &rows {
        let keys: Vec<&str> = row
            .as_object()
            .unwrap()
            .keys()
            .map(String::as_str)
            .collect();
        assert_eq!(keys.len(), KEYS.len(), "{row}");
        assert!(KEYS.iter().all(|key| keys.contains(key)), "{row}");
    }
    (folder, rows)
}

fn find<'r>(rows: &'r [Value], name: &str) -> &'r Value {
    let row = rows.iter().find(|row| row["row"] == name);
    row.unwrap_or_else(|| panic!("there is no row {name}"))
}

#[test]
fn table_3_1_stands_beside_its_published_values() {
    let (_folder, rows) = reproduce(&["table-3-1"]);
    assert_eq!(find(&rows, "table-3-1/nodes")["ratio"], 1.0);
    assert_eq!(
        find(&rows, "table-3-1/degrees_of_freedom")["published"],
        102.0
    );
    for name in ["solution_s", "total_s", "solution_s/strong_gmres"] {
        let row = find(&rows, &format!("table-3-1/{name}"));
        let (ours, published) = (
            row["ours"].as_f64().unwrap(),
            row["published"].as_f64().unwrap(),
        );
        assert!((row["ratio"].as_f64().unwrap() - ours / published).abs() < 1e-12);
        assert!(row["note"].as_str().unwrap().contains("Pentium II"));
    }
    let elements = find(&rows, "table-3-1/finite_elements/total_s");
    assert_eq!(elements["published"], 18.32);
    assert!(elements["ours"].as_f64().unwrap() > 0.0);
    let solution = find(&rows, "table-3-1/finite_elements/solution_s");
    assert_eq!(solution["ours"], Value::Null);
}

/// The order of the three is that of their closed forms on a spring; numbers are judged in crate servo.
#[test]
fn section_3_4_prefers_the_local_model() {
    let (folder, rows) = reproduce(&["section-3-4"]);
    for case in ["model_200_hz/hand_2_hz", "model_60_hz/hand_5_hz"] {
        for what in ["error", "energy"] {
            let [hold, linear, local] = ["hold", "linear", "local_model"].map(|name| {
                let row = find(&rows, &format!("section-3-4/{what}/{name}/{case}"));
                assert!(row["published"].is_null() && row["unit"] == "%");
                row["ours"].as_f64().unwrap()
            });
            assert!(
                hold > linear && linear > local && local > 0.0,
                "{what} {case}"
            );
        }
    }
    let figure = find(&rows, "section-3-4")["file"].as_str().unwrap();
    assert!(folder.path().join(figure).is_file());
}

#[test]
fn figure_4_5_sums_to_one_and_is_a_picture() {
    let (folder, rows) = reproduce(&["figure-4-5"]);
    let errors = rows
        .iter()
        .filter(|row| row["unit"] == "1" && row["row"].as_str().unwrap().contains("unity"));
    // Rounding.
    let errors: Vec<f64> = errors.map(|row| row["ours"].as_f64().unwrap()).collect();
    assert!(
        errors.len() == 4 && errors.iter().all(|error| *error < 1e-14),
        "{errors:?}"
    );
    // Neighbours weigh w(2/3) = 1/9: the peak is 1 / (1 + 2/9).
    let peak = find(&rows, "figure-4-5/peak/shepard/radius_1.5_h")["ours"]
        .as_f64()
        .unwrap();
    assert!((peak - 9.0 / 11.0).abs() < 1e-14, "{peak}");
    let figure = find(&rows, "figure-4-5")["file"].as_str().unwrap();
    assert!(
        std::fs::read(folder.path().join(figure))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
}

/// Forces of the weak form with any number of particles, judged by finite elements; the tolerance is the
/// 1 % that curvature and an odd number of particles leave. The strong form is shown as it is.
#[test]
fn figure_3_4_shows_what_fails_too() {
    let (_folder, rows) = reproduce(&["figure-3-4"]);
    let weak: Vec<&Value> = rows
        .iter()
        .filter(|row| {
            row["row"]
                .as_str()
                .unwrap()
                .starts_with("figure-3-4/force_error/weak")
        })
        .collect();
    assert_eq!(weak.len(), 16);
    for row in weak {
        assert!(row["ours"].as_f64().unwrap().abs() < 1.0, "{row}");
    }
    let missing: Vec<&Value> = rows
        .iter()
        .filter(|row| row["ours"].is_null() && row["file"].is_null())
        .collect();
    assert!(
        missing
            .iter()
            .all(|row| !row["note"].as_str().unwrap().is_empty())
    );
    let radius = |particles| {
        let row = find(
            &rows,
            &format!("figure-3-4/implied_tool_radius/{particles}"),
        );
        row["ours"].as_f64().unwrap()
    };
    assert!(radius(34) > radius(93) && radius(93) > radius(300));
}

#[test]
fn rows_are_chosen_by_how_they_begin_and_told_to_a_person() {
    let (_folder, rows) = reproduce(&["table-3-1/finite"]);
    assert_eq!(rows.len(), 8);
    let folder = tempfile::tempdir().unwrap();
    let text = stdout(&palpate_in(folder.path(), &["reproduce", "figure-4-5"]));
    assert!(
        text.contains("published") && text.contains("figure-4-5.png"),
        "{text}"
    );
}
