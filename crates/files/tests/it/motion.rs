use palpate_files::Motion;
use palpate_files::motion::Cursor;

use crate::{MOTION, SESSION};

#[test]
fn tools_move_apart_from_each_other() {
    let motion = Motion::parse(MOTION, "motion.csv").unwrap();
    assert_eq!((motion.first_time_s(), motion.final_time_s()), (0.0, 1.0));
    let right = motion.pose("right", 0.5).unwrap();
    assert_eq!(right.position_m, [0.0, 0.0, 0.0075]);
    assert_eq!((right.grip, right.cut), (0.5, false));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let [_, y, _, w] = right.orientation.unwrap();
    assert!((y - half).abs() < 1e-15 && (w - half).abs() < 1e-15);
    assert_eq!(
        motion.pose("left", 0.4),
        None,
        "nothing before the first row"
    );
    assert_eq!(
        motion.pose("left", 0.9).unwrap().position_m,
        [1.0, 2.0, 3.0]
    );
    assert_eq!(motion.pose("third", 0.5), None);
}

#[test]
fn optional_columns_may_be_left_out() {
    let text = "# format = 1\n\n  # a comment\ntime_ms,tool,x_mm,y_m,z_m\n0,a,1,0,0\n# ten steps\n5,a,2,0,0\n";
    let motion = Motion::parse(text, "motion.csv").unwrap();
    let pose = motion.pose("a", 0.005).unwrap();
    assert_eq!(pose.position_m, [0.002, 0.0, 0.0]);
    assert_eq!((pose.orientation, pose.grip, pose.cut), (None, 0.0, false));
}

#[test]
fn a_session_is_a_motion() {
    let motion = Motion::parse(SESSION, "session.csv").unwrap();
    assert_eq!(motion.tools().len(), 2);
    assert!(motion.pose("right", 0.005).unwrap().cut);
}

#[test]
fn a_cursor_finds_what_a_search_finds() {
    let motion = Motion::parse(MOTION, "motion.csv").unwrap();
    let right = motion.tool("right").unwrap();
    let mut cursor = Cursor::default();
    for step in (0..=300).chain([5, 250, 0]) {
        let time = f64::from(step) * 0.005 - 0.1;
        let searched = right.pose(time, &mut Cursor::default());
        assert_eq!(right.pose(time, &mut cursor), searched);
    }
}

/// A motion that was cut in its last number would press 50 mm deep; one whose last line only lacks its end is played.
#[test]
fn a_last_line_without_an_end_counts_where_the_tool_has_been() {
    let rows = "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0,tip,0,0,0.054\n1,tip,0,0,0.0495\n2,tip,0,0,0.0521";
    let motion = Motion::parse(rows, "motion.csv").unwrap();
    assert_eq!(motion.tools()[0].rows().len(), 3);
    let said = motion.incomplete().unwrap().to_string();
    assert!(
        said.contains("line 5") && said.contains("no line end"),
        "{said}"
    );
    let refused = Motion::parse(&rows[..rows.len() - 4], "motion.csv").unwrap_err();
    assert!(
        refused.to_string().contains("cut in its middle"),
        "{refused}"
    );
}
