use std::path::PathBuf;

use palpate_geometry::{
    MeshReport, Organ, ProblemKind, Repairs, Surface, TriangleMesh, inspect, repair,
};
use serde::Serialize;

use crate::output::VERSION;

/// The report of `mesh info`.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    palpate: &'static str,
    pub(super) warnings: Vec<String>,
    #[serde(flatten)]
    pub(super) origin: Origin,
    #[serde(flatten)]
    pub(super) report: MeshReport,
    /// Counts of the repairs.
    pub(super) repair: Repairs,
    /// As it is, or after the repair.
    pub(super) can_be_simulated: bool,
    /// Why, or why not, as half a sentence.
    pub(super) because: String,
}

/// The source of the mesh.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Origin {
    File {
        #[serde(serialize_with = "palpate_jobs::lossy")]
        file: PathBuf,
        format: String,
        /// That the coordinates were read in.
        unit: &'static str,
    },
    #[serde(serialize_with = "description")]
    Builtin(Organ),
}

impl Answer {
    pub(super) fn new(origin: Origin, mesh: &TriangleMesh, warnings: Vec<String>) -> Self {
        let report = inspect(mesh);
        let (repaired, repair) = match repair(mesh) {
            Ok((repaired, repairs)) => (Some(repaired), repairs),
            Err(_) => (None, Repairs::default()),
        };
        let repaired = repaired.filter(|_| repair != Repairs::default());
        let (can_be_simulated, because) = verdict(mesh, repaired, &report);
        Self {
            palpate: VERSION,
            warnings,
            origin,
            report,
            repair,
            can_be_simulated,
            because,
        }
    }
}

/// Whether the mesh bounds a solid, as it is or after a repair that changes it, and why.
fn verdict(
    mesh: &TriangleMesh,
    repaired: Option<TriangleMesh>,
    report: &MeshReport,
) -> (bool, String) {
    let refusal = match Surface::new(mesh.clone()) {
        Ok(_) => {
            return (
                true,
                format!("it bounds one solid{}", expected_errors(report)),
            );
        }
        Err(refusal) => refusal,
    };
    match repaired.map(Surface::new) {
        Some(Ok(surface)) => {
            let spoiled = expected_errors(&inspect(surface.mesh()));
            (
                true,
                format!("after the repair it bounds one solid{spoiled}"),
            )
        }
        Some(Err(refusal)) => (false, format!("even after the repair {refusal}")),
        None => (false, refusal.to_string()),
    }
}

/// Defects that allow a simulation but make its forces wrong.
fn expected_errors(report: &MeshReport) -> String {
    let spoils = report
        .problems
        .iter()
        .filter_map(|problem| match problem.kind {
            ProblemKind::SelfIntersecting => Some("it passes through itself"),
            ProblemKind::DoubleWall => Some("that solid is a thin sheet with two sides"),
            ProblemKind::ImplausibleSize => Some("its size is that of no organ"),
            _ => None,
        });
    let spoils: Vec<&str> = spoils.collect();
    match spoils.is_empty() {
        true => String::new(),
        false => format!(", but expect wrong forces: {}", spoils.join(", and ")),
    }
}

fn description<S: serde::Serializer>(organ: &Organ, serializer: S) -> Result<S::Ok, S::Error> {
    use serde::ser::SerializeMap;
    let described = organ.description();
    let mut map = serializer.serialize_map(None)?;
    map.serialize_entry("builtin", organ.name())?;
    map.serialize_entry("summary", described.summary)?;
    map.serialize_entry("axes", described.axes)?;
    map.serialize_entry("origin", described.origin)?;
    map.serialize_entry("lengths", described.lengths)?;
    map.serialize_entry("held", described.fixed)?;
    map.end()
}
