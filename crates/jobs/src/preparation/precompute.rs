use std::path::PathBuf;
use std::time::Instant;

use palpate_files::Scene;
use palpate_files::scene::ModelKind;
use palpate_simulate::Resources;
use serde::Serialize;

use crate::{Error, ProgressCallback, VERSION};

/// The answer that `precompute --json` prints.
#[derive(Debug, Serialize)]
pub struct Precomputed {
    palpate: &'static str,
    triangles: usize,
    /// Triangles with mechanics.
    pub mechanical_triangles: usize,
    /// How they are solved.
    pub method: &'static str,
    /// Triangles that tools may touch.
    pub touchable_triangles: usize,
    /// Of the answers.
    pub memory_bytes: usize,
    /// Whether it came from the cache.
    pub was_kept: bool,
    /// Its file in the cache.
    #[serde(serialize_with = "crate::lossy")]
    pub file: Option<PathBuf>,
    /// Duration [s].
    pub seconds: f64,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Computes the global response of `scene` and stores it in the cache of `resources`.
///
/// # Errors
/// As [`super::simulation`].
pub fn precompute(
    mut scene: Scene,
    resources: &Resources,
    watch: &dyn ProgressCallback,
) -> Result<Precomputed, Error> {
    if scene.model.kind == ModelKind::Nonlinear {
        return Err(Error::input(
            "nothing is cached for `model.kind = \"nonlinear\"`: it is ready in seconds; simulate the scene",
        ));
    }
    scene.model.kind = ModelKind::Hybrid;
    let begin = Instant::now();
    let simulation = super::simulation(&scene, resources, watch)?;
    let Some(response) = simulation.response() else {
        return Err(Error::failed(
            "the scene has no response; report it as a defect",
        ));
    };
    Ok(Precomputed {
        palpate: VERSION,
        triangles: simulation.surface().mesh().triangles().len(),
        mechanical_triangles: response.triangles,
        method: response.method,
        touchable_triangles: response.touchable,
        memory_bytes: response.bytes,
        was_kept: response.was_cached,
        file: response.file.clone(),
        seconds: begin.elapsed().as_secs_f64(),
        warnings: simulation.warnings().to_vec(),
    })
}
