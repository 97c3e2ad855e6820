//! `palpate characterize --report`. Judge: a reader of XML, and what the page must not be without.

use std::fs;
use std::path::Path;

use roxmltree::{Document, ParsingOptions};

use crate::errors::assert_refused;
use crate::recordings::{folder, recording};
use crate::{palpate_in, stderr};

/// Writes a page of all in `folder`.
fn page(folder: &Path, arguments: &[&str]) -> String {
    let command = [
        &["characterize"],
        arguments,
        &["--report", "page.html", "--overwrite"],
    ]
    .concat();
    let output = palpate_in(folder, &command);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    fs::read_to_string(folder.join("page.html")).unwrap()
}

pub(crate) fn parse(page: &str) -> Document<'_> {
    let options = ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(page, options).unwrap()
}

pub(crate) fn texts(document: &Document<'_>, element: &str) -> Vec<String> {
    let named = document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/1999/xhtml", element)));
    named
        .map(|node| {
            node.descendants()
                .filter_map(|own| own.text().filter(|_| own.is_text()))
                .collect()
        })
        .collect()
}

/// A page of two specimens and a file that is no recording stands alone, has all its parts, and the same
/// bytes from what a study has kept.
#[test]
fn a_page_has_all_its_parts() {
    let folder = folder();
    let said = [
        ".",
        "--law",
        "mooney_rivlin",
        "--draws",
        "0",
        "--study",
        "kept",
    ];
    let page = page(folder.path(), &said);
    let document = parse(&page);
    let parts = texts(&document, "h3");
    for part in [
        "Over all specimens",
        "Specimens",
        "Which law",
        "Parameters",
        "Without geometry",
        "Provenance",
    ] {
        assert!(parts.iter().any(|own| own == part), "{part}: {parts:?}");
    }
    let figures = texts(&document, "h4");
    let expected = [
        "Recordings",
        "Force over time",
        "Force over depth",
        "What the Mooney-Rivlin law leaves",
        "Relaxation",
        "Convergence: Mooney-Rivlin",
        "Mean elastic modulus",
    ];
    // Two depths tell the parameters of Mooney and Rivlin apart. At one radius what one gains the other loses, and all
    // parts say so.
    let apart = page.matches("known by itself from these recordings");
    assert_eq!(apart.count(), 1, "{page}");
    let verdict = "on two parameters are known together and not each by itself";
    assert!(
        page.contains(verdict) && page.contains("tied to "),
        "{page}"
    );
    for part in expected {
        assert!(figures.iter().any(|own| own == part), "{part}: {figures:?}");
    }
    let rules = [
        "prefers-color-scheme: dark",
        "@media print",
        "break-before: page",
    ];
    for text in rules.into_iter().chain(["broken.csv line 4"]) {
        assert!(page.contains(text), "{text}");
    }
    // The file that is no recording says NaN itself.
    let drawn = page.replace("&quot;NaN&quot;", "");
    assert!(!drawn.contains("NaN") && !drawn.contains("inf"));
    let links = document.descendants().flat_map(|node| node.attributes());
    for link in links.filter(|own| ["href", "src"].contains(&own.name())) {
        let target = link
            .value()
            .strip_prefix('#')
            .expect("leads out of the page");
        let is_there = |node: roxmltree::Node<'_, '_>| node.attribute("id") == Some(target);
        assert!(document.descendants().any(is_there), "{target}");
    }
    assert_eq!(self::page(folder.path(), &said), page, "from what was kept");
}

/// What a file says, and what it is called, is text and nothing else.
#[test]
fn hostile_names_are_text() {
    let folder = tempfile::tempdir().unwrap();
    let keys = "# organ = \"<img src=x onerror=alert(1)>&\"\n# site = \"\\\"><script>\"\n# indenter_radius_m = 0.001\n";
    let name = "<script>alert('x')&amp;.csv";
    fs::write(folder.path().join(name), recording(0.001, 8.0, keys)).unwrap();
    let page = page(folder.path(), &[".", "--law", "neo_hookean"]);
    let document = parse(&page);
    for name in ["script", "img"] {
        assert!(texts(&document, name).is_empty(), "{name}");
    }
    assert!(!page.contains("<script") && !page.contains("<img"));
    let title = texts(&document, "h1").concat();
    assert_eq!(title, "<img src=x onerror=alert(1)>&, \"><script>");
    assert!(
        texts(&document, "code")
            .iter()
            .any(|own| own.contains(name))
    );
}

/// A piece that is pressed has stress over stretch; without the indenter's radius there is a page with reasons.
#[test]
fn pieces_and_what_has_no_law_have_pages_too() {
    let folder = tempfile::tempdir().unwrap();
    let mut piece = "# format = 1\n# stimulus = \"uniaxial\"\n# area_m2 = 0.0004\n# height_m = 0.01\ntime_s,depth_m,force_n\n".to_owned();
    for sample in 0..200 {
        let depth = 1.5e-5 * f64::from(sample);
        let stretch = 1.0 - depth / 0.01;
        // Neo-Hookean, C₁₀ = 800 Pa, and what a sensor adds.
        let force = 4e-4 * 1600.0 * (stretch.powi(-2) - stretch)
            + 1e-4 * (12.9898 * f64::from(sample)).sin();
        piece += &format!("{},{depth},{force}\n", 0.1 * f64::from(sample));
    }
    fs::write(folder.path().join("piece.csv"), piece).unwrap();
    let figures = texts(&parse(&page(folder.path(), &["piece.csv"])), "h4");
    assert!(
        figures.iter().any(|own| own == "Stress over stretch"),
        "{figures:?}"
    );
    fs::write(folder.path().join("bare.csv"), recording(0.001, 8.0, "")).unwrap();
    let bare = page(folder.path(), &["bare.csv", "--law", "neo_hookean"]);
    assert!(texts(&parse(&bare), "h3").contains(&"What was not found, and why".to_owned()));
    assert!(bare.contains("indenter_radius_m"));
}

#[test]
fn a_page_that_cannot_be_written_is_refused_before_the_work() {
    let folder = folder();
    let said = ["characterize", "a1.csv", "--report", "nowhere/page.html"];
    assert_refused(folder.path(), &said, &["nowhere"]);
}
