use palpate_files::Scene;
use palpate_files::scene::{CutMode, Layer, ToolKind};
use palpate_geometry::{CutMethod, Surface};

use crate::Error;
use crate::walls::typical_wall;

/// Depth of a cut without layers [m], and in parts of the organ's wall [-], whichever is less.
const DEPTH: f64 = 0.002;
const OF_THE_WALL: f64 = 0.5;

/// A cut through this part of the wall counts as one through all of it; it parts the sides to this many times the
/// wall's thickness, since a wall is not everywhere as thick [-].
const THROUGH: f64 = 0.9;
const BEYOND: f64 = 1.5;

/// Rounding of depths that are sums of decimal numbers [m].
const ROUNDING: f64 = 1e-9;

/// The cutting model of an organ.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CuttingModel {
    pub(crate) method: CutMethod,
    /// Whether cuts change the forces.
    pub(crate) changes_force: bool,
    /// Whether the scene has layers; else the organ is one layer, which a blade always cuts to its depth.
    pub(crate) is_layered: bool,
    /// From outside to inside; at least one.
    pub(crate) layers: Vec<CutLayer>,
    /// The names of the layers in the scene.
    pub(crate) names: Vec<String>,
    /// Largest depth of a blade [m].
    deepest: f64,
    /// Thickness of the organ's wall [m].
    wall: f64,
    /// Gape of an opening [m].
    pub(crate) width: f64,
}

/// A layer, for a blade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CutLayer {
    /// Depth of its upper face below the surface at rest [m].
    top: f64,
    /// Depth of its lower face [m].
    pub(crate) bottom: f64,
    /// Work of a cut per area of its face [J/m²].
    toughness: f64,
    /// The normal force at which it gives way to any tool where it is exposed [N].
    pub(crate) limit: Option<f64>,
}

impl CuttingModel {
    /// The model of `scene`; none if nothing can cut and no layer can give way.
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
        let whole = settings.depth_m.unwrap_or(DEPTH.min(OF_THE_WALL * wall));
        if whole > wall && settings.depth_m.is_some() {
            return Err(Error::CutTooDeep { depth: whole, wall });
        }
        let mut top = 0.0;
        let mut of_layer = |thickness: f64, toughness: Option<f64>, limit| {
            let bottom = top + thickness;
            CutLayer {
                top: std::mem::replace(&mut top, bottom),
                bottom,
                toughness: toughness.unwrap_or(settings.toughness_j_per_m2),
                limit,
            }
        };
        let mut cut_layers: Vec<CutLayer> = layers
            .iter()
            .map(|l| of_layer(l.thickness_m, l.toughness_j_per_m2, l.perforation_force_n))
            .collect();
        if cut_layers.is_empty() {
            cut_layers.push(of_layer(whole, None, None));
        }
        cut_layers[0].limit = settings.force_limit_n.or(cut_layers[0].limit);
        let model = Self {
            method: match settings.mode {
                CutMode::Split => CutMethod::SplitTriangles,
                CutMode::Snap => CutMethod::SnapVertices,
            },
            changes_force: settings.mode == CutMode::Split,
            is_layered: !layers.is_empty(),
            layers: cut_layers,
            names: layers.iter().map(|layer| layer.name.clone()).collect(),
            deepest: settings.depth_m.unwrap_or(wall),
            wall,
            width: settings.width_m,
        };
        Ok(wanted.then_some(model))
    }

    /// Number of layers that a blade opens whose edge is `depth` [m] below the surface at rest: those whose lower faces
    /// it has reached.
    pub(super) fn reached(&self, depth: f64) -> usize {
        if !self.is_layered {
            return 1;
        }
        let edge = depth.min(self.deepest) + ROUNDING;
        let opened = self.layers.iter().take_while(|layer| layer.bottom <= edge);
        opened.count()
    }

    /// The resistance to an edge at `depth` [m] where `open` layers are already cut [N]: R d of each layer, d being the
    /// depth of the edge within it.
    pub(super) fn resistance(&self, open: usize, depth: f64) -> f64 {
        let edge = if self.is_layered {
            depth.min(self.deepest)
        } else {
            self.layers[0].bottom
        };
        let uncut = self.layers.iter().skip(open);
        let each = uncut.map(|l| l.toughness * (edge.min(l.bottom) - l.top).max(0.0));
        each.sum()
    }

    /// Depth of a cut through `layers` of them [m].
    pub(crate) fn depth_of(&self, layers: usize) -> f64 {
        match layers.checked_sub(1).and_then(|last| self.layers.get(last)) {
            Some(layer) => layer.bottom,
            None => 0.0,
        }
    }

    /// Depth of the parted sides of a cut through `layers` of them [m]: beyond the wall if nearly all of it is cut.
    pub(crate) fn slit_depth(&self, layers: usize) -> f64 {
        let depth = self.depth_of(layers);
        match depth > THROUGH * self.wall {
            true => BEYOND * self.wall,
            false => depth,
        }
    }

    /// A warning about a blade that can open nothing.
    pub(crate) fn warning(&self) -> Option<String> {
        let outer = self.layers[0].bottom;
        (self.is_layered && self.reached(f64::INFINITY) == 0).then(|| {
            format!(
                "no blade opens the organ: `cutting.depth_m` is {:.2} mm, and the outermost layer is {:.2} mm thick",
                1e3 * self.deepest,
                1e3 * outer
            )
        })
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
