use std::time::Instant;

use palpate_geometry::{Organ, SimplifySettings, TriangleMesh, inspect, simplify};

use crate::Error;
use crate::machine::processor;
use crate::published::cell;
use crate::real_mesh::real_mesh;
use crate::row::Rows;

/// The real esophagus with as many triangles as the source's.
const REAL: &str = "bp3d_esophagus_21146";

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let before = cell("section-7-4 original triangles")?;
    let after = cell("section-7-4 simplified triangles")?;
    let (mesh, whose) = esophagus(before as usize)?;
    let start = Instant::now();
    let simplified = simplify(&mesh, &SimplifySettings::to(after as usize))?;
    let seconds = start.elapsed().as_secs_f64();
    let body = format!("{whose}, {} triangles", mesh.triangles().len());
    let (low, high) = mesh.bounds();
    let length = format!("{:.0}", 1e3 * (high - low).max());
    let meeting_before = inspect(&mesh).self_intersections;
    let mut add = |name: &str, ours: f64| {
        rows.row(name)
            .with("body", &body)
            .with("length", &length)
            .with("before", meeting_before)
            .with("machine", processor())
            .is(ours);
    };
    let simple = &simplified.mesh;
    add("triangles", simple.triangles().len() as f64);
    add("vertices", simple.vertices().len() as f64);
    let (there, back) = (simplified.of_original, simplified.of_result);
    add("deviation_max", 1e3 * f64::max(there.max, back.max));
    add("deviation_mean", 1e3 * f64::max(there.mean, back.mean));
    let change = simple.volume() / mesh.volume() - 1.0;
    add("volume_change", 100.0 * change);
    let meeting = simplified.self_intersections;
    add("self_intersections", meeting as f64);
    add("simplify_s", seconds);
    Ok(())
}

/// The mesh that is simplified, and what the notes call it.
pub(super) fn esophagus(triangles: usize) -> Result<(TriangleMesh, &'static str), Error> {
    Ok(match real_mesh(REAL)? {
        Some(mesh) => (mesh, "a real esophagus of BodyParts3D"),
        None => (
            Organ::Esophagus.surface_mesh(triangles)?,
            "the built-in esophagus in place of a real one",
        ),
    })
}
