use std::time::Instant;

use palpate_geometry::{Organ, Simplified, SimplifySettings, TriangleMesh, inspect, simplify};

use crate::failure::Failure;
use crate::reproduce::machine::processor;
use crate::reproduce::published::SECTION_7_4 as PUBLISHED;
use crate::reproduce::real_mesh::real_mesh;
use crate::reproduce::row::Value;
use crate::reproduce::{Item, Rows};

pub(crate) const SECTION_7_4: Item = Item {
    name: "section-7-4",
    title: "an esophagus with fewer triangles",
    seconds: 0.69,
    run,
};

/// The real esophagus with as many triangles as the source's.
const REAL: &str = "bp3d_esophagus_21146";

fn run(rows: &mut Rows<'_>) -> Result<(), Failure> {
    let counts = ["original", "simplified"].map(|row| PUBLISHED.value(row, "triangles"));
    let [Some(before), Some(after)] = counts else {
        rows.add_missing("triangles", "1", "the published values cannot be read");
        return Ok(());
    };
    let (mesh, whose) = esophagus(before as usize)?;
    let start = Instant::now();
    let simplified =
        simplify(&mesh, &SimplifySettings::to(after as usize)).map_err(Failure::input)?;
    let seconds = start.elapsed().as_secs_f64();
    let body = format!("{whose}, {} triangles", mesh.triangles().len());
    add_counts(rows, &simplified, &body);
    add_likeness(rows, &mesh, &simplified, &body);
    let note = format!(
        "{body}; with the distances both ways, on {}, one thread; the source does not tell its time in \
         3D Studio Max",
        processor()
    );
    rows.add("simplify_s", own(seconds, "s"), note);
    Ok(())
}

/// The mesh that is simplified, and what the notes call it.
pub(super) fn esophagus(triangles: usize) -> Result<(TriangleMesh, &'static str), Failure> {
    Ok(match real_mesh(REAL)? {
        Some(mesh) => (mesh, "a real esophagus of BodyParts3D"),
        None => (
            Organ::Esophagus.surface_mesh(triangles)?,
            "the built-in esophagus in place of a real one",
        ),
    })
}

fn add_counts(rows: &mut Rows<'_>, simplified: &Simplified, body: &str) {
    let ours = [
        ("triangles", simplified.mesh.triangles().len()),
        ("vertices", simplified.mesh.vertices().len()),
    ];
    let note = format!(
        "{body}; a closed surface in one piece and without handles has half as many vertices as triangles, \
         and two: the source's counts are of no such surface"
    );
    for ((name, ours), column) in ours.into_iter().zip(["triangles", "points"]) {
        let value = Value {
            published: PUBLISHED.value("simplified", column),
            ours: Some(ours as f64),
            unit: "1",
        };
        rows.add(name, value, note.clone());
    }
}

/// How like the original it is; the source shows a picture of it.
fn add_likeness(
    rows: &mut Rows<'_>,
    mesh: &TriangleMesh,
    Simplified {
        mesh: simple,
        of_original,
        of_result,
        self_intersections,
    }: &Simplified,
    body: &str,
) {
    let (low, high) = mesh.bounds();
    let length = 1e3 * (high - low).max();
    let note = format!(
        "{body}, {length:.0} mm long; the farther of original to result and back; the source shows a picture"
    );
    let farthest = f64::max(of_original.max, of_result.max);
    rows.add("deviation_max", own(1e3 * farthest, "mm"), note.clone());
    let mean = f64::max(of_original.mean, of_result.mean);
    rows.add("deviation_mean", own(1e3 * mean, "mm"), note);
    let change = 100.0 * (simple.volume() / mesh.volume() - 1.0);
    rows.add("volume_change", own(change, "%"), body.to_owned());
    let note = format!(
        "{body}; triangles of the result that meet others, {} of the original do",
        inspect(mesh).self_intersections
    );
    let meeting = *self_intersections as f64;
    rows.add("self_intersections", own(meeting, "1"), note);
}

fn own(ours: f64, unit: &'static str) -> Value {
    Value {
        published: None,
        ours: Some(ours),
        unit,
    }
}
