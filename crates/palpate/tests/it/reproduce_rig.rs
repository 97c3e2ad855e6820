//! The rows of the device and of the rig: chapter 5 again, section 7.3.

use crate::readme_numbers::range;
use crate::reproduce::{find, reproduce};
use crate::reproduce_recordings::{assert_complete, number, printed};

/// Judge: (7.6) by its printed coefficients, worked out here; the device is asked in time, by sines. Tolerance: what a
/// sine that is held over steps of 50 µs is flatter, (ω T)²/24, is below 1e-5; the five digits of the printed numbers
/// come back from two sines.
#[test]
#[ignore = "long"]
fn equation_7_6_is_met_by_sines_in_time() {
    let (folder, rows) = reproduce(&["equation-7-6", "figure-7-7", "figure-7-8"]);
    assert_complete(&folder, &rows);
    let file = "device_7_6.csv";
    for (row, column) in [("mass", "m"), ("damping", "b"), ("stiffness", "k")] {
        let row = find(&rows, &format!("equation-7-6/g1/{row}"));
        assert_eq!(number(row, "published"), printed(file, &[], column));
        assert!((number(row, "ratio") - 1.0).abs() < 1e-4, "{row}");
    }
    let [m, b, k] = ["m", "b", "k"].map(|column| printed(file, &[], column));
    for frequency in [1.0_f64, 8.0, 15.0] {
        let omega = std::f64::consts::TAU * frequency;
        let magnitude = (k - m * omega * omega).hypot(b * omega);
        for of in ["g1", "g2"] {
            let row = find(&rows, &format!("equation-7-6/{of}/{frequency}_hz"));
            assert!((number(row, "ratio") - 1.0).abs() < 1e-4, "{row}");
            if of == "g1" {
                let published = number(row, "published");
                assert!((published / magnitude - 1.0).abs() < 1e-12, "{row}");
            }
        }
    }
}

/// Judge: arithmetic on the printed function. The caption's 3.1 % hold at 1 Hz to the 5 % by which damping adds to the
/// stiffness, and not at 8 Hz; the claim of section 5.2.2 fails for (7.6), whose mode lies at 26.8 Hz, and holds for two
/// masses with one unit.
#[test]
#[ignore = "long"]
fn claims_about_the_device_are_told_apart() {
    let (folder, rows) = reproduce(&["figure-7-7", "figure-7-8", "figure-5-6", "section-7-3"]);
    assert_complete(&folder, &rows);
    let file = "rig_and_device.csv";
    let share = find(&rows, "figure-7-7/printed/1_hz");
    let percent = printed(file, &["figure-7-7", "share"], "value");
    assert!(
        (number(share, "published") - 1e-2 * percent).abs() < 1e-12,
        "{share}"
    );
    assert!((number(share, "ratio") - 1.05).abs() < 0.01, "{share}");
    assert!(number(find(&rows, "figure-7-7/printed/8_hz"), "ratio") > 8.0);
    assert!((number(find(&rows, "figure-7-8/printed/8_hz"), "ratio") - 1.097).abs() < 1e-3);
    let below = ["printed", "two_masses"].map(|name| {
        let row = find(&rows, &format!("figure-5-6/{name}/unaffected_below"));
        let published = printed(file, &["section-5-2-2", "unaffected_below"], "value");
        assert_eq!(number(row, "published"), published);
        number(row, "ratio")
    });
    assert!(below[0] < 0.4 && below[1] > 1.0, "{below:?}");
    // (32 + 8.975)/8.975: the device's own spring beside the liver's 71.8 mN at 8 mm.
    let felt = find(&rows, "section-7-3/liver/printed/rest");
    assert!(
        (number(felt, "ratio") - 40.975 / 8.975).abs() < 1e-9,
        "{felt}"
    );
}

/// Judge: the spring that was put in, of 10 N/m and without a phase. Tolerance: sensor noise of 0.4 mN on swings of
/// 10 mN over ten cycles is below 0.5 %; encoder steps of 30 µm at 1 kHz are below that too.
#[test]
#[ignore = "long"]
fn the_rig_reads_a_spring_as_it_is() {
    let (folder, rows) = reproduce(&["section-5-2-2", "figure-5-8"]);
    assert_complete(&folder, &rows);
    for frequency in ["0.5", "1", "2", "5", "7"] {
        let off = find(&rows, &format!("section-5-2-2/stiffness/{frequency}_hz"));
        assert!(number(off, "ours").abs() < 1.0, "{off}");
        let turned = find(&rows, &format!("section-5-2-2/phase/{frequency}_hz"));
        assert!(number(turned, "ours").abs() < 1.0, "{turned}");
    }
    // A bound: the rig stops a faster swing.
    let below = find(&rows, "section-5-2-2/unaffected_below");
    assert!(
        number(below, "ratio") >= 1.0 && below["mark"] == "at_least",
        "{below}"
    );
    for frequency in ["0.5", "1", "2", "4", "8"] {
        let row = find(
            &rows,
            &format!("figure-5-8/tracking/{frequency}_hz/amplitude"),
        );
        // As asked of the tuned preset.
        assert!((number(row, "ours") - 1.0).abs() < 0.035, "{row}");
    }
}

/// Judge: the printed means, which were put in. Tolerance: the heart moves the surface by 0.4 mm either way, so that a
/// depth may be off by as much, and a force by that times the steepest slope of the table beside it; 3 % from press to
/// press, over eight presses, and the sensor's 0.4 mN are 2 %.
#[test]
#[ignore = "long"]
fn chapter_5_comes_back_through_the_rig() {
    let (folder, rows) = reproduce(&["chapter-5/spleen"]);
    assert_complete(&folder, &rows);
    let depths = ["1", "2", "4", "5", "6"];
    let mean = |depth| printed("table_5_1_static_force.csv", &["spleen", depth], "mean_n");
    let number_of = |depth: &str| depth.parse::<f64>().unwrap();
    let slopes = depths.map(|depth| {
        let apart = depths.windows(2).filter(|pair| pair.contains(&depth));
        apart
            .map(|pair| (mean(pair[1]) - mean(pair[0])) / (number_of(pair[1]) - number_of(pair[0])))
            .fold(0.0, f64::max)
    });
    for (depth, slope) in depths.into_iter().zip(slopes) {
        let row = find(&rows, &format!("chapter-5/spleen/{depth}_mm/mean"));
        assert_eq!(number(row, "published"), mean(depth));
        let off = (number(row, "ours") - mean(depth)).abs();
        assert!(off < 0.4 * slope + 0.02 * mean(depth), "{row}");
    }
    assert_eq!(
        number(find(&rows, "chapter-5/spleen/animals"), "ratio"),
        1.0
    );
    let missed = number(find(&rows, "chapter-5/spleen/contact/mean"), "ours");
    assert!(missed.abs() < 0.4, "{missed}");
    let [least, largest] = range("through heart, contact and sensor to ");
    let error = number(find(&rows, "chapter-5/spleen/given_back"), "ours").round();
    assert!((least..=largest).contains(&error), "{error}");
}
