//! `palpate analyze --report`. Judge: a reader of XML, and what the page must not be without.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use crate::errors::assert_refused;
use crate::recordings::folder;
use crate::report::{parse, texts};
use crate::{palpate_in, stderr};

fn page(folder: &Path) -> String {
    let output = palpate_in(
        folder,
        &["analyze", ".", "--report", "page.html", "--overwrite"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    fs::read_to_string(folder.join("page.html")).unwrap()
}

/// A swing of 1 mm about 2 mm in a spring of 10 N/m, after a ramp and a rest; `turns` of it until a time [s].
fn swing(keys: &str, turns: impl Fn(f64) -> f64) -> String {
    let mut text = format!(
        "# format = 1\n# organ = \"liver\"\n# subject = \"A\"\n{keys}time_s,depth_m,force_n\n"
    );
    for sample in 0..=2000 {
        let time = 0.005 * f64::from(sample);
        let swung = if time > 2.0 {
            (TAU * turns(time - 2.0)).sin()
        } else {
            0.0
        };
        let depth = 2e-3 * (time / 0.5).min(1.0) + 1e-3 * swung;
        let noise = 1e-5 * (12.9898 * f64::from(sample)).sin();
        text += &format!("{time},{depth},{}\n", 10.0 * depth + noise);
    }
    text
}

/// A page of holds, a sine and a chirp of two subjects, and of a file that is no recording, has all its parts and
/// stands alone; of the spring of 10 N/m it says so.
#[test]
fn a_page_shows_what_is_seen() {
    let folder = folder();
    let write = |name: &str, text: String| fs::write(folder.path().join(name), text).unwrap();
    write(
        "sine.csv",
        swing("# stimulus = \"sine\"\n", |time| 2.0 * time),
    );
    let chirp = "# stimulus = \"chirp_linear\"\n";
    write("chirp.csv", swing(chirp, |time| (0.5 + 0.3 * time) * time));
    let page = page(folder.path());
    let document = parse(&page);
    let figures = texts(&document, "h4");
    let expected = [
        "Static response",
        "Force over depth",
        "Relaxation",
        "Hysteresis",
        "Stiffness over frequency",
        "Phase over frequency",
        "Coherence of the chirps",
    ];
    for part in expected {
        assert!(figures.iter().any(|own| own == part), "{part}: {figures:?}");
    }
    let parts = texts(&document, "h3");
    for part in [
        "Static response",
        "Relaxation",
        "Swings",
        "Warnings",
        "Provenance",
    ] {
        assert!(parts.iter().any(|own| own == part), "{part}: {parts:?}");
    }
    let cells = texts(&document, "td").join(" ");
    assert!(
        cells.contains("10.0") && cells.contains("2.000 Hz"),
        "{cells}"
    );
    for text in [
        "prefers-color-scheme: dark",
        "@media print",
        "broken.csv line 4",
    ] {
        assert!(page.contains(text), "{text}");
    }
    assert!(!page.contains("<script") && !page.contains("inf"));
    let mut attributes = document.descendants().flat_map(|node| node.attributes());
    assert!(!attributes.any(|own| ["href", "src"].contains(&own.name())));
    assert_eq!(self::page(folder.path()), page, "the same bytes again");
}

/// What a file says, and what it is called, is text and nothing else.
#[test]
fn hostile_names_are_text() {
    let folder = tempfile::tempdir().unwrap();
    let keys = "# subject = \"<script>alert(2)</script>\"\n";
    let text =
        swing("# stimulus = \"sine\"\n", |time| 2.0 * time).replace("# subject = \"A\"\n", keys);
    fs::write(folder.path().join("<script>alert('x')&amp;.csv"), text).unwrap();
    let page = page(folder.path());
    assert!(texts(&parse(&page), "script").is_empty() && !page.contains("<script"));
}

#[test]
fn a_page_that_cannot_be_written_is_refused_before_the_work() {
    let folder = folder();
    let said = ["analyze", "a1.csv", "--report", "nowhere/page.html"];
    assert_refused(folder.path(), &said, &["nowhere"]);
}
