use super::super::graded::Grading;
use super::super::hemisphere::{Lines, QuarterDisc};
use super::super::mesh::ElementMesh;
use super::edge::edge_block;
use super::indenter::{Indenter, IndenterShape};
use super::run::IndentationSettings;
use crate::{Error, Vec3};

/// Support of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Base {
    /// Glued to a rigid plate.
    #[default]
    Bonded,
    /// On a rigid plate, along which it slides without friction.
    Lubricated,
}

/// A cylinder of tissue on a rigid plate, its outer side free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Radius [m].
    pub radius: f64,
    /// Height [m].
    pub height: f64,
    /// Its support.
    pub base: Base,
}

impl Block {
    /// A block must be larger than what is pressed into it.
    pub(super) fn check(&self, indenter: &Indenter) -> Result<(), Error> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let wide = self.radius > indenter.radius && self.radius.is_finite();
        if positive(self.height) && positive(indenter.radius) && wide {
            Ok(())
        } else {
            Err(Error::BlockTooSmall {
                radius: self.radius,
                height: self.height,
                indenter: indenter.radius,
            })
        }
    }
}

/// Smallest elements of the usual mesh, in radii of the contact [-].
const EDGE: f64 = 0.1;
/// The same in widths of the ring in which a rounded edge touches [-].
const ACROSS_EDGE: f64 = 0.3;
/// Growth of the elements from there [-].
const GROWTH: f64 = 1.25;

/// A meshed body whose highest point is at z = 0, and the numbers of its nodes.
#[derive(Debug)]
pub(super) struct Body {
    pub(super) mesh: ElementMesh,
    /// The surface that can touch, from the axis outward.
    pub(super) top: Vec<usize>,
    pub(super) bottom: Vec<usize>,
    pub(super) axis: Vec<usize>,
    /// 0 for each element of the tissue, 1 for those of an elastic base.
    pub(super) regions: Vec<u32>,
}

impl Body {
    pub(super) fn block(settings: &IndentationSettings) -> Self {
        let block = &settings.block;
        let mesh = graded_block(
            block,
            &settings.indenter,
            settings.deepest,
            settings.halvings,
            0.0,
        );
        Self::of_block(mesh, block)
    }

    /// A block with a base of this `thickness` [m] below it.
    pub(super) fn on_base(settings: &IndentationSettings, thickness: f64) -> Self {
        let block = &settings.block;
        let (deepest, halvings) = (settings.deepest, settings.halvings);
        let mesh = graded_block(block, &settings.indenter, deepest, halvings, thickness);
        let whole = Block {
            height: block.height + thickness,
            ..*block
        };
        let is_below = |element: usize| {
            let highest = mesh.element(element).iter();
            let highest = highest.map(|&node| mesh.nodes[node as usize].y);
            u32::from(highest.fold(f64::NEG_INFINITY, f64::max) <= -block.height)
        };
        let regions = (0..mesh.len()).map(is_below).collect();
        Self {
            regions,
            ..Self::of_block(mesh, &whole)
        }
    }

    /// A block with elements that shrink towards the edge of a flat punch.
    pub(super) fn around_edge(settings: &IndentationSettings, parts: usize) -> Self {
        let mesh = edge_block(&settings.block, &settings.indenter, parts);
        Self::of_block(mesh, &settings.block)
    }

    fn of_block(mesh: ElementMesh, block: &Block) -> Self {
        let mut top = mesh.nodes_where(|x| x.y == 0.0);
        top.sort_by(|&a, &b| mesh.nodes[a].x.total_cmp(&mesh.nodes[b].x));
        Self {
            top,
            bottom: mesh.nodes_where(|x| x.y == -block.height),
            axis: mesh.nodes_where(|x| x.x == 0.0),
            regions: vec![0; mesh.len()],
            mesh,
        }
    }

    /// As high as the block.
    pub(super) fn hemisphere(settings: &IndentationSettings) -> Self {
        let radius = settings.block.height;
        let rim = settings.indenter.scale(settings.deepest) / radius;
        let edge = edge_size(&settings.indenter, settings.deepest);
        let within = settings.indenter.shape.growth_within();
        let lines = Lines::at_pole(rim, edge, within, settings.halvings.min(0));
        let halvings = settings.halvings.max(0).unsigned_abs();
        let mut disc = QuarterDisc::new(radius, &lines, halvings);
        for node in &mut disc.mesh.nodes {
            *node -= Vec3::new(0.0, radius, 0.0);
        }
        Self {
            regions: vec![0; disc.mesh.len()],
            mesh: disc.mesh,
            top: disc.arc.iter().map(|&(node, _)| node).collect(),
            bottom: disc.base,
            axis: disc.axis,
        }
    }
}

/// Size of the elements at the edge of the contact at the depth `deepest` [m] on the usual mesh, in radii of the contact [-]: of a
/// punch with a rounded edge several lie across what is touched of that.
fn edge_size(indenter: &Indenter, deepest: f64) -> f64 {
    match indenter.shape {
        IndenterShape::RoundedPunch { edge_radius } => {
            let contact = indenter.scale(deepest);
            let rounded = contact - (indenter.radius - edge_radius);
            EDGE.min(ACROSS_EDGE * rounded / contact)
        }
        _ => EDGE,
    }
}

impl IndenterShape {
    /// Growth of the elements from the edge of the contact inward [-]: the edge of one that grows passes over all.
    fn growth_within(self) -> f64 {
        match self {
            Self::Flat { .. } | Self::RoundedPunch { .. } => GROWTH,
            Self::Sphere | Self::Cone { .. } => 1.0,
        }
    }
}

/// A grid with its smallest elements around the contact of `indenter` at the depth `deepest` [m] on the top
/// (z = 0), and a base of the thickness `below` [m] under it; of the usual mesh where `halvings` is 0.
fn graded_block(
    block: &Block,
    indenter: &Indenter,
    deepest: f64,
    halvings: i32,
    below: f64,
) -> ElementMesh {
    let contact = indenter.scale(deepest);
    let edge = contact * edge_size(indenter, deepest);
    let grading = Grading {
        first: edge,
        growth: GROWTH,
        near: 3.0 * contact,
        far_growth: 1.7,
    };
    let within = Grading {
        growth: indenter.shape.growth_within(),
        ..grading
    };
    let inward = within.line(contact, halvings);
    // Tissue outside the edge is drawn out along the side, so it needs the finest elements.
    let outward = Grading {
        first: 0.5 * edge,
        ..grading
    }
    .line(block.radius - contact, halvings);
    let mut down = grading.line(block.height, halvings);
    if below > 0.0 {
        // Elements go on to grow in the base.
        let unhalved = grading.line(block.height, 0);
        let last = unhalved.windows(2).last();
        let base = Grading {
            first: last.map_or(edge, |two| two[1] - two[0]),
            near: (grading.near - block.height).max(0.0),
            ..grading
        };
        let base = base.line(below, halvings);
        down.extend(base[1..].iter().map(|z| block.height + z));
    }
    let mut columns: Vec<f64> = inward.iter().rev().map(|x| contact - x).collect();
    columns[0] = 0.0;
    columns.extend(outward[1..].iter().map(|x| contact + x));
    let rows: Vec<f64> = down.iter().rev().map(|z| 0.0 - z).collect();
    ElementMesh::grid(&columns, &rows, |r, z| [r, z])
}
