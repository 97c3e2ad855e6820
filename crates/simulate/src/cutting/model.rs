use palpate_files::Scene;
use palpate_files::scene::{CutMode, Layer, ToolKind};
use palpate_geometry::{CutMethod, Surface};

use crate::Error;
use crate::walls::typical_wall;

/// How deep a cut goes without layers [m], and in parts of the organ's wall [-], whichever is less.
const DEPTH: f64 = 0.002;
const OF_THE_WALL: f64 = 0.5;

/// How an organ is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CuttingModel {
    pub(crate) method: CutMethod,
    /// Whether forces follow a cut.
    pub(crate) changes_force: bool,
    /// How deep a cut goes [m].
    pub(crate) depth: f64,
    /// Thickness of the organ under its surface [m].
    pub(crate) wall: f64,
    /// How far an opening gapes [m].
    pub(crate) width: f64,
    /// What holds back an edge that cuts [N].
    pub(crate) resistance: f64,
    /// The normal force at which any tool begins to cut [N].
    pub(crate) force_limit: Option<f64>,
    /// The normal force at which the innermost layer gives way [N].
    pub(crate) perforation: Option<f64>,
    /// Whether the innermost layer is the outermost, too.
    pub(crate) is_bare: bool,
}

impl CuttingModel {
    /// That of `scene`; none where nothing can cut and no layer can give way.
    ///
    /// # Errors
    /// When the layers or a cut are thicker than the organ.
    pub(crate) fn new(scene: &Scene, surface: &Surface) -> Result<Option<Self>, Error> {
        let layers = &scene.organ.layers;
        let settings = &scene.cutting;
        let has_blade = scene.tools.iter().any(|tool| cuts(tool.kind));
        let gives_way = layers.iter().any(|l| l.perforation_force_n.is_some());
        let wanted = has_blade || gives_way || settings.force_limit_n.is_some();
        if !wanted && layers.is_empty() {
            return Ok(None);
        }
        let wall = typical_wall(surface);
        check_layers(layers, wall)?;
        let depth = settings.depth_m.unwrap_or_else(|| match layers.as_slice() {
            [] => DEPTH.min(OF_THE_WALL * wall),
            [only] => only.thickness_m,
            [above @ .., _] => above.iter().map(|layer| layer.thickness_m).sum(),
        });
        if depth > wall {
            return Err(Error::CutTooDeep { depth, wall });
        }
        let outer = match layers.as_slice() {
            [outer, _, ..] => outer.perforation_force_n,
            _ => None,
        };
        let model = Self {
            method: match settings.mode {
                CutMode::Split => CutMethod::SplitTriangles,
                CutMode::Snap => CutMethod::SnapVertices,
            },
            changes_force: settings.mode == CutMode::Split,
            depth,
            wall,
            width: settings.width_m,
            resistance: settings.toughness_j_per_m2 * depth,
            force_limit: settings.force_limit_n.or(outer),
            perforation: layers.last().and_then(|layer| layer.perforation_force_n),
            is_bare: layers.len() == 1,
        };
        Ok(wanted.then_some(model))
    }
}

/// Whether a tool has a blade.
pub(crate) fn cuts(kind: ToolKind) -> bool {
    matches!(kind, ToolKind::Scissors | ToolKind::Hook)
}

fn check_layers(layers: &[Layer], wall: f64) -> Result<(), Error> {
    let mut sum = 0.0;
    for layer in layers {
        sum += layer.thickness_m;
        // A millionth: thicknesses are decimal numbers.
        if sum > wall * (1.0 + 1e-6) {
            return Err(Error::LayersTooThick {
                layer: layer.name.clone(),
                sum,
                wall,
            });
        }
    }
    Ok(())
}
