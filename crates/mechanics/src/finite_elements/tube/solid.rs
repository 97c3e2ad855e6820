//! The quarter of a tube on one side of its middle and of the plane through its axis and a punch.
//!
//! The axis is z, the middle z = 0, the punch's axis x. A point of the surface has two coordinates: one
//! along the circumference, which within the box around the punch is the height y of the outer surface
//! (so that the punch's edge is a circle) and beyond it the arc, and one along the axis.

use super::super::cavity::Cavity;
use super::super::punched::{PunchedLines, PunchedMesh};
use super::Tube;
use super::mesh::from_the_end;
use crate::{Error, Vec3};

/// A quarter of a tube.
pub(super) struct Quarter {
    pub(super) body: PunchedMesh,
    /// The inner wall.
    pub(super) cavity: Cavity,
}

/// The largest punch that the mesh of a tube can have under it [m].
pub(super) fn largest_punch(tube: &Tube) -> f64 {
    0.8 * tube.outer_radius.min(0.5 * tube.length)
}

/// The quarter around a punch of this radius [m], coarse elements cut into `parts` along each edge.
pub(super) fn quarter(tube: &Tube, punch: f64, parts: usize) -> Result<Quarter, Error> {
    let (outer, half, wall) = (tube.outer_radius, 0.5 * tube.length, tube.wall());
    let wide = (2.4 * punch).min(0.5 * (punch + 0.95 * outer.min(half)));
    let edge = (wide / outer).asin();
    let around = outer * (std::f64::consts::PI - edge);
    let lines = PunchedLines {
        around: 1,
        inside: vec![0.5 * punch, punch],
        outside: vec![punch, punch + 0.35 * (wide - punch), wide],
        beyond: [
            from(wide, around, 0.8 * wide, 0.9 * outer),
            from(wide, half - wide, 0.8 * wide, 1.5 * outer),
        ],
        heights: from_the_end(wall, 0.5 * punch, 2.5, wall)
            .iter()
            .map(|h| tube.inner_radius + h)
            .collect(),
    };
    let placed = |across: f64, along: f64, radius: f64| {
        let angle = if across <= wide {
            (across / outer).asin()
        } else {
            edge + (across - wide) / outer
        };
        Vec3::new(radius * angle.cos(), radius * angle.sin(), along)
    };
    let body = lines.split(parts).body(placed)?;
    let cavity = Cavity {
        sides: body.lower_sides.clone(),
    };
    Ok(Quarter { body, cavity })
}

/// Places from `start`, `length` on, whose intervals grow from about `first` to at most `longest` [m].
fn from(start: f64, length: f64, first: f64, longest: f64) -> Vec<f64> {
    from_the_end(length, first, 2.5, longest)
        .iter()
        .rev()
        .map(|x| start + length - x)
        .collect()
}
