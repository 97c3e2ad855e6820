use super::super::element::ElementKind;
use super::super::graded::{Grading, resampled};
use super::super::mesh::ElementMesh;
use super::super::surface::Surface;
use super::indenter::Indenter;
use super::mesh::Block;
use crate::Vec3;

/// Half the width of the rings around the edge, in radii of the punch [-].
const WIDE: f64 = 0.25;
/// Elements along that half-width on the mesh from which the lines of all meshes come.
const PARTS: f64 = 2.0;

/// A block with rings of rectangles around the edge of a flat punch, with `parts` elements along their half-width.
///
/// At the edge stretch is infinite, about as 1/√distance, and tissue comes from there to line the whole side of the
/// punch: the rings shrink towards it, so that the smallest elements are WIDE/`parts`² radii long. Tissue under the
/// face is drawn out sideways in thin layers, so elements are even there; outside they grow.
pub(super) fn edge_block(block: &Block, indenter: &Indenter, parts: usize) -> ElementMesh {
    let radius = indenter.radius;
    let wide = (WIDE * radius)
        .min(0.5 * (block.radius - radius))
        .min(0.5 * block.height);
    let line = |length: f64, growth: f64| {
        let grading = Grading {
            first: wide / PARTS,
            growth,
            near: 3.0 * radius,
            far_growth: 2.5,
        };
        resampled(&grading.line(length, 0), parts as f64 / PARTS)
    };
    let mut inner: Vec<f64> = line(radius - wide, 1.0)
        .iter()
        .rev()
        .map(|x| radius - wide - x)
        .collect();
    inner[0] = 0.0;
    let outer: Vec<f64> = line(block.radius - radius - wide, 1.3)
        .iter()
        .map(|x| radius + wide + x)
        .collect();
    let mut lower: Vec<f64> = line(block.height - wide, 1.3)
        .iter()
        .rev()
        .map(|z| -wide - z)
        .collect();
    lower[0] = -block.height;
    let middle = even(radius - wide, radius + wide, 2 * parts);
    let upper = even(-wide, 0.0, parts);
    let mut surface = Surface::new(1e-9 * radius);
    let as_is = |r: f64, z: f64| [r, z];
    for columns in [&inner, &middle, &outer] {
        surface.add(columns, &lower, as_is);
    }
    surface.add(&inner, &upper, as_is);
    surface.add(&outer, &upper, as_is);
    // Half-widths of the rings, from the edge outward; a single element has none.
    let rings = if parts > 1 { parts } else { 0 };
    let last = 1.0 / parts as f64;
    let widths: Vec<f64> = (0..=rings)
        .map(|ring| wide * last.powf(1.0 - ring as f64 / parts as f64))
        .collect();
    let least = widths[0];
    let narrowing: Vec<f64> = widths.iter().rev().map(|width| -width).collect();
    let (beside, around) = (even(-1.0, 0.0, parts), even(-1.0, 1.0, 2 * parts));
    surface.add(&widths, &beside, |x, part| [radius + x, x * part]);
    surface.add(&narrowing, &beside, |x, part| [radius + x, -x * part]);
    surface.add(&around, &narrowing, |part, z| [radius - part * z, z]);
    surface.add(
        &even(radius - least, radius + least, 2 * parts),
        &even(-least, 0.0, parts),
        as_is,
    );
    let nodes = surface.points.iter();
    ElementMesh {
        kind: ElementKind::Quad9,
        nodes: nodes.map(|&[r, z]| Vec3::new(r, z, 0.0)).collect(),
        elements: surface.faces.into_iter().flatten().collect(),
    }
}

/// Ends at `to` to the last bit where that is 0: nodes of the surface are found by their height.
fn even(from: f64, to: f64, parts: usize) -> Vec<f64> {
    let at = |part: usize| from + (to - from) * (part as f64 / parts as f64);
    (0..=parts).map(at).collect()
}
