use palpate_files::{Error, FibreDirection, FibreDirections};

const HEAD: &str = "# format = 1\nx_mm,y_m,z_m,axis_x,axis_y,axis_z,across_x,across_y,across_z\n";

fn parse(text: &str) -> Result<FibreDirections, Error> {
    FibreDirections::parse(text, "fibres.csv")
}

#[test]
fn directions_have_their_places_and_units() {
    let read = parse(&format!(
        "{HEAD}1,0.002,0,0,0,3,1,0,0\n# a comment\n2,0,0,1,1,0,0,0,1\n"
    ))
    .unwrap();
    assert_eq!(
        read.rows[0],
        FibreDirection {
            position_m: [0.001, 0.002, 0.0],
            axis: [0.0, 0.0, 3.0],
            across: Some([1.0, 0.0, 0.0]),
        }
    );
    assert_eq!(read.rows.len(), 2);
    let axes = parse("# format = 1\nx_m,y_m,z_m,axis_x,axis_y,axis_z\n0,0,0,1,0,0\n").unwrap();
    assert_eq!(axes.rows[0].across, None);
}

#[test]
fn what_gives_no_direction_is_refused() {
    for (rows, words) in [
        (
            "",
            "fibres.csv: found no rows below the names of the columns",
        ),
        (
            "1,0,0,0,0,0,1,0,0\n",
            "fibres.csv line 3: `axis_x` is \"0\"; give a direction, of which a component is not zero",
        ),
        (
            "1,0,0,1,0,0,-2,0,0\n",
            "line 3: `across_x` is \"-2\"; give a direction that is not that of the axis",
        ),
        ("1,0,0,nan,0,0,1,0,0\n", "line 3: `axis_x` is \"nan\""),
        ("1,0,0,1,0,0,1,0\n", "line 3"),
    ] {
        let said = parse(&format!("{HEAD}{rows}")).unwrap_err().to_string();
        assert!(said.contains(words), "{said}");
    }
    let said = parse("# format = 1\nx_m,y_m,z_m,axis_x,axis_y\n0,0,0,1,0\n")
        .unwrap_err()
        .to_string();
    assert!(said.contains("axis_z"), "{said}");
    let said = parse("# format = 1\nx_m,y_m,z_m,axis_x,axis_y,axis_z,acros_x\n0,0,0,1,0,0,1\n")
        .unwrap_err();
    assert!(said.to_string().contains("across_x"), "{said}");
}
