//! A closed envelope around triangles of any kind, with warnings.

use std::ops::ControlFlow;

use palpate_geometry::{TriangleMesh, WrapSettings, Wrapped, wrap_with_progress};

use crate::{Error, ProgressCallback};

/// An envelope, and warnings about it.
#[derive(Debug, Clone)]
pub struct Envelope {
    /// The envelope, the closed surfaces inside, and how far both are from the triangles.
    pub wrapped: Wrapped,
    /// Warnings, in sentences.
    pub warnings: Vec<String>,
}

/// A rim is wide above this part of the envelope's diagonal [-].
const WIDE_RIM: f64 = 0.25;

/// The envelope of `mesh`.
///
/// # Errors
/// When a setting is invalid, the mesh encloses nothing or is too large for the distance, or `watch` asks to stop.
pub fn envelope(
    mesh: &TriangleMesh,
    settings: &WrapSettings,
    watch: &dyn ProgressCallback,
) -> Result<Envelope, Error> {
    watch.report_step("making the envelope");
    let wrapped = wrap_with_progress(mesh, settings, &mut |part| {
        watch.report_fraction(part);
        match watch.should_stop() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    })?;
    let warnings = warnings(&wrapped, settings);
    Ok(Envelope { wrapped, warnings })
}

fn warnings(wrapped: &Wrapped, settings: &WrapSettings) -> Vec<String> {
    let mut warnings = Vec::new();
    if wrapped.to_input.max > settings.distance {
        warnings.push(format!(
            "the envelope is up to {:.2} mm from the triangles, where it closes a gap or rounds an edge; {:.2} mm was \
             asked for",
            1e3 * wrapped.to_input.max,
            1e3 * settings.distance
        ));
    }
    let (low, high) = wrapped.surface.mesh().bounds();
    if wrapped.widest_rim > WIDE_RIM * (high - low).norm() {
        warnings.push(format!(
            "a hole that is {:.1} mm wide was capped by a fan, which knows nothing of the organ's shape there; look at it",
            1e3 * wrapped.widest_rim
        ));
    }
    if let Some(width) = wrapped.opening {
        warnings.push(format!(
            "the body is open: an opening of {:.0} mm was closed where it is narrowest. If the wall around it is the organ, as that of a \
             tube, ask for a smaller distance and smaller gaps to close: the wall must be several times as thick",
            1e3 * width
        ));
    }
    if wrapped.other_pieces > 0 {
        warnings.push(format!(
            "{} pieces other than the largest were left out; close wider gaps to join them",
            wrapped.other_pieces
        ));
    }
    warnings
}
