//! The report for a person.

use std::fmt::Write;

use palpate_geometry::{MeshReport, Repairs};

use super::answer::{Answer, Origin};

/// The whole report as text.
pub(super) fn of(answer: &Answer) -> String {
    let mut text = heading(&answer.origin);
    for (name, value) in facts(&answer.report) {
        line(&mut text, name, &value);
    }
    text.push_str(&problems(&answer.report));
    text.push_str(&repairs(&answer.repair));
    let word = if answer.can_be_simulated { "yes" } else { "no" };
    let because = &answer.because;
    text.push_str(&format!("\ncan be simulated: {word}, because {because}\n"));
    text
}

fn heading(origin: &Origin) -> String {
    match origin {
        Origin::File { file, format, unit } => {
            format!("{} ({format}, read in {unit})\n\n", file.display())
        }
        Origin::Builtin(organ) => format!("{organ}\n{}\n\n", organ.description()),
    }
}

fn facts(report: &MeshReport) -> Vec<(&'static str, String)> {
    let [x, y, z] = report.extent_m.map(|length| 1e3 * length);
    let genus = report.genus.map(|genus| genus.to_string());
    vec![
        ("vertices", report.vertices.to_string()),
        ("triangles", report.triangles.to_string()),
        ("closed", yes_or_no(report.closed)),
        ("manifold", yes_or_no(report.manifold)),
        ("oriented outward", yes_or_no(report.oriented)),
        ("pieces", report.components.to_string()),
        ("boundary edges", report.boundary_edges.to_string()),
        ("self-intersections", report.self_intersections.to_string()),
        ("handles (genus)", genus.unwrap_or("not defined".to_owned())),
        ("volume", format!("{:.4e} m³", report.volume_m3)),
        ("area", format!("{:.4e} m²", report.area_m2)),
        (
            "extent",
            format!("{x:.2} x {y:.2} x {z:.2} mm along x, y, z"),
        ),
        ("from", place(&report.low_m)),
        ("to", place(&report.high_m)),
    ]
}

/// Coordinates as a scene writes them.
fn place([x, y, z]: &[f64; 3]) -> String {
    format!("[{x:.5}, {y:.5}, {z:.5}] m")
}

fn problems(report: &MeshReport) -> String {
    if report.problems.is_empty() {
        return "\nproblems: none\n".to_owned();
    }
    let mut text = "\nproblems\n".to_owned();
    for problem in &report.problems {
        let kind = serde_json::to_value(problem.kind);
        let kind = kind
            .ok()
            .and_then(|word| word.as_str().map(|word| word.replace('_', " ")));
        let remedy = problem.remedy.replace("mesh_unit", "--unit");
        let count = format!("{} x", problem.count);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {:<22}{count:>9}  {remedy}",
            kind.unwrap_or_default()
        );
    }
    text
}

fn repairs(repair: &Repairs) -> String {
    if *repair == Repairs::default() {
        return "\na repair would change nothing\n".to_owned();
    }
    let mut text = "\na repair would\n".to_owned();
    for (count, deed) in [
        (repair.welded_vertices, "join vertices in the same place"),
        (repair.degenerate_triangles, "drop triangles without area"),
        (repair.unused_vertices, "drop vertices of no triangle"),
        (repair.flipped_triangles, "turn triangles over"),
    ] {
        if count > 0 {
            line(&mut text, deed, &count.to_string());
        }
    }
    text
}

fn line(text: &mut String, name: &str, value: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "  {name:<32}{value}");
}

fn yes_or_no(holds: bool) -> String {
    if holds { "yes" } else { "no" }.to_owned()
}
