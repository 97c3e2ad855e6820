use super::super::graded::Grading;
use super::super::mesh::ElementMesh;
use super::indenter::Indenter;
use crate::Error;

/// A cylinder of tissue: bottom held, outer side free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Radius [m].
    pub radius: f64,
    /// Height [m].
    pub height: f64,
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

/// A grid with its smallest elements, `edge` [m] long before halving, around the radius `contact` [m]
/// of the top (z = 0).
pub(super) fn graded_block(block: &Block, contact: f64, edge: f64, halvings: u32) -> ElementMesh {
    let grading = Grading {
        first: edge,
        growth: 1.25,
        near: 3.0 * contact,
        far_growth: 1.7,
    };
    let inward = grading.line(contact, halvings);
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
