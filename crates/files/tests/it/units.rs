use palpate_files::units::{UNITS, Unit, split};
use palpate_files::{Document, Domain, Key, Recording, Tissue};

use crate::{RECORDING, TISSUE};

#[test]
fn the_table_of_units_holds_no_name_twice() {
    for unit in UNITS {
        assert_eq!(Unit::named(unit.suffix), Some(unit));
        // A density has two suffixes with one spelling.
        let spelled = Unit::named(unit.spelling).unwrap();
        let size = |unit: &Unit| (unit.si, unit.multiply, unit.divide);
        assert_eq!(size(spelled), size(unit));
        assert!(Unit::named(unit.si).is_some(), "{unit:?}");
        let name = format!("x_{}", unit.suffix);
        assert_eq!(split(&name), Some(("x", unit)));
    }
}

#[test]
fn columns_and_keys_of_a_recording_are_converted() {
    let recording = Recording::parse(RECORDING, "a.csv").unwrap();
    assert_eq!(recording.time_s(), [0.0, 0.001, 0.002]);
    assert_eq!(recording.depth_m(), [0.0, 0.0005, 0.001]);
    assert_eq!(recording.force_n(), [0.0, 0.0048, 0.0079]);
    let header = &recording.header;
    assert_eq!(header.post_mortem_s, Some(1800.0));
    assert_eq!(header.ramp_s, Some(0.5));
    assert_eq!(header.amplitude_m, Some(0.006));
    assert_eq!(header.indenter_radius_m, Some(0.001));
    assert_eq!(header.indenter_half_angle_deg, Some(30.0));
    assert_eq!(header.area_m2, Some(2e-5));
    assert_eq!(header.pressure_pa, Some(3999.67162245));
    assert_eq!(header.subject.as_deref(), Some("3"));
    let names = recording.extra_columns().iter().map(|c| c.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["temperature_c", "note"]);
    let [temperature, note] = recording.extra_columns() else {
        unreachable!()
    };
    assert_eq!(temperature.numbers(), Some(vec![37.5, 37.4, 37.4]));
    assert_eq!(note.values, ["start", "", "a, b"]);
    assert_eq!(header.extra[0].key, "operator");
    assert_eq!(header.extra[0].value, "J. Doe");
}

#[test]
fn keys_of_a_tissue_are_converted_with_their_errors() {
    let tissue = Tissue::parse(TISSUE, "tissue.toml").unwrap();
    let c01 = tissue.elasticity.parameters()[1].1;
    assert_eq!((c01.value, c01.standard_error), (500.0, Some(62.5)));
    assert_eq!(tissue.lumped.kelvin.unwrap().k1_n_per_m, 8.0.into());
    assert_eq!(tissue.lumped.column.unwrap().effective_area_m2, 3e-6.into());
}

/// What the first version called `blatz` is read, and written under the law's one name; a column is no law.
#[test]
fn former_names_are_read_and_written_as_the_present_ones() {
    let column =
        "gamma_pa = 7403.0\nalpha = 2.0\neffective_area_m2 = 3e-6\neffective_length_m = 0.01\n";
    let text = |law: &str, table: &str| {
        format!(
            "format = 1\n[tissue]\nlaw = \"{law}\"\ngamma_pa = 1005.0\nalpha = 0.0\n[tissue.lumped.{table}]\n{column}"
        )
    };
    let of = |law: &str, table: &str| Tissue::parse(&text(law, table), "tissue.toml").unwrap();
    let former = of("blatz", "blatz");
    assert_eq!(former, of("exponential", "column"));
    let written = former.to_toml();
    assert!(
        written.contains("law = \"exponential\"") && !written.contains("blatz"),
        "{written}"
    );
    assert_eq!(Tissue::parse(&written, "written.toml").unwrap(), former);
    let both = format!("{}[tissue.lumped.blatz]\n{column}", text("blatz", "column"));
    let refused = Tissue::parse(&both, "tissue.toml").unwrap_err().to_string();
    assert!(
        refused.contains("column") && refused.contains("blatz"),
        "{refused}"
    );
}

#[test]
fn other_documents_can_be_read_with_the_same_care() {
    const BLOCK: &[Key] =
        &[Key::number("radius_m", Domain::POSITIVE, "Its radius.").required("0.05")];
    const KEYS: &[Key] = &[
        Key::table("block", BLOCK, "What is pressed.").required(""),
        Key::numbers("depths_m", Domain::POSITIVE, "How deep.").required("[0.001]"),
    ];
    let text = "format = 1\nblock = { radius_mm = 2 }\ndepths_mm = [1, 2.5]\n";
    let document = Document::parse(text, "problem.toml").unwrap();
    let keys = document.keys(KEYS).unwrap();
    let depths = keys.numbers("depths_m").unwrap();
    assert_eq!(depths, Some(vec![0.001, 0.0025]));
    let block = keys.table("block").unwrap().unwrap();
    assert_eq!(block.required_number("radius_m").unwrap(), 0.002);
}
