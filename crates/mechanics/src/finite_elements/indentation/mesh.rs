use super::super::graded::Grading;
use super::super::mesh::ElementMesh;
use super::indenter::{Indenter, IndenterShape};
use crate::Error;

/// What a block rests on.
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
    /// What it rests on.
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

/// A grid with its smallest elements around the contact of `indenter` at the depth `deepest` [m] on the top
/// (z = 0); of the usual mesh where `halvings` is 0.
pub(super) fn graded_block(
    block: &Block,
    indenter: &Indenter,
    deepest: f64,
    halvings: i32,
) -> ElementMesh {
    let contact = indenter.scale(deepest);
    let edge = EDGE * contact;
    let grading = Grading {
        first: edge,
        growth: 1.25,
        near: 3.0 * contact,
        far_growth: 1.7,
    };
    // The edge of a contact that grows passes over all elements within.
    let within = match indenter.shape {
        IndenterShape::Flat { .. } => grading,
        IndenterShape::Sphere | IndenterShape::Cone { .. } => Grading {
            growth: 1.0,
            ..grading
        },
    };
    let inward = within.line(contact, halvings);
    // Tissue outside the edge is drawn out along the side, so it needs the finest elements.
    let outward = Grading {
        first: 0.5 * edge,
        ..grading
    }
    .line(block.radius - contact, halvings);
    let down = grading.line(block.height, halvings);
    let mut columns: Vec<f64> = inward.iter().rev().map(|x| contact - x).collect();
    columns[0] = 0.0;
    columns.extend(outward[1..].iter().map(|x| contact + x));
    let rows: Vec<f64> = down.iter().rev().map(|z| 0.0 - z).collect();
    ElementMesh::grid(&columns, &rows, |r, z| [r, z])
}
