//! Effect of a specimen's thickness on its force, for recordings that do not state it.
//!
//! A bonded layer pushes back more than a half-space, at small strain by a factor of the thickness over the radius
//! of the contact alone, for ν = ½ (two radii thick: 1.94 without friction [Hayes et al. 1972]). A modulus that was found as if the specimen were large is too high by it.
//!
//! *How we know*: `thickness::…`, runs of finite elements; for spheres [Dimitriadis et al. 2002].
//!
//! *Limits*: small strain; at depths near the thickness the factor is larger.

use palpate_files::recording::{RecordingHeader, Specimen, StimulusKind};
use palpate_mechanics::finite_elements::indentation::IndenterShape;

use super::body::{Body, LayerBase};

/// Thicknesses that a result mentions, in radii [-].
pub const THICKNESSES: [f64; 3] = [2.0, 5.0, 10.0];
/// Force on a bonded layer of each of [`THICKNESSES`] over that on a layer of [`BLOCK`](super::BLOCK) [-], under a
/// punch that sticks, and under a cone (radii of its contact), at small strain.
pub const PUNCH_ON_LAYER: [f64; 3] = [1.956, 1.282, 1.126];
/// See [`PUNCH_ON_LAYER`].
pub const CONE_ON_LAYER: [f64; 3] = [2.326, 1.308, 1.129];

/// The force of a sphere on a bonded layer over that on a half-space [-], χ = √(R d)/h, ν = ½
/// [Dimitriadis et al. 2002, eq. 13].
pub fn sphere_on_layer(chi: f64) -> f64 {
    1.0 + chi * (1.133 + chi * (1.283 + chi * (0.769 + chi * 0.0975)))
}

/// The sentence on what was assumed of the specimen's size, where a recording does not say it; `deepest` [m] is how
/// far it was pressed.
pub fn assumption(header: &RecordingHeader, body: &Body, deepest: f64) -> Option<String> {
    let (block, indenter) = match body {
        Body::Block { block, indenter } => (block, indenter),
        Body::Layer { base, .. } => return Some(on_base(header, base)),
        Body::Tube { .. } => return None,
    };
    let is_piece = header.stimulus.is_some_and(StimulusKind::is_of_piece);
    if header.specimen == Some(Specimen::Tube) || is_piece {
        return None;
    }
    if let Some(thickness) = header.thickness_m {
        let mut assumed = Vec::new();
        if header.support.is_none() {
            assumed.push("bonded to a rigid plate (`support`)".to_owned());
        }
        if header.specimen_radius_m.is_none() && header.specimen_width_m.is_none() {
            let times = block.radius / thickness;
            assumed.push(format!(
                "{times:.0} times as wide as thick (`specimen_radius_m`)"
            ));
        }
        return (!assumed.is_empty()).then(|| {
            format!(
                "the recording does not state all of the specimen, which is taken as {}",
                assumed.join(" and ")
            )
        });
    }
    let (of, factors) = match indenter.shape {
        IndenterShape::Flat { .. } | IndenterShape::RoundedPunch { .. } => {
            ("radii of the indenter", PUNCH_ON_LAYER)
        }
        IndenterShape::Cone { .. } => ("radii of the contact", CONE_ON_LAYER),
        IndenterShape::Sphere => {
            let chi = |radii: f64| (deepest / indenter.radius).sqrt() / radii;
            let large = sphere_on_layer(chi(block.height / indenter.radius));
            (
                "radii of the indenter",
                THICKNESSES.map(|radii| sphere_on_layer(chi(radii)) / large),
            )
        }
    };
    let falls = factors.map(|factor| format!("{:.0}", 100.0 * (1.0 - 1.0 / factor)));
    Some(format!(
        "the recording does not state the specimen's thickness (`thickness_m`), which is taken as {:.0} {of} on a \
         rigid plate; were it 2, 5 or 10 {of}, the modulus would be {}, {} or {} % lower",
        block.height / indenter.radius,
        falls[0],
        falls[1],
        falls[2]
    ))
}

/// Assumption on the base of a layer.
fn on_base(header: &RecordingHeader, base: &LayerBase) -> String {
    let mut assumed = vec!["neo-Hookean, bonded to the layer and relaxing as it does".to_owned()];
    if header.base_thickness_m.is_none() {
        let thickness = 1e3 * base.thickness;
        assumed.push(format!("{thickness:.0} mm thick (`base_thickness_m`)"));
    }
    if header.base_modulus_error.is_none() {
        assumed.push("of exactly the stated modulus (`base_modulus_error`)".to_owned());
    }
    format!(
        "the base is taken as {}, and the thickness of the layer as exact",
        assumed.join(", ")
    )
}
