//! The meridian of a ball's half: a quarter of a disc in three blocks, with its axis on r = 0 and its
//! base on z = 0.
//!
//! A square block stands in the corner at the centre; the other two reach from it to the arc, one at
//! the axis and one at the base. Lines across the square run on to the base and to the arc, so a line
//! of intervals that is fine in one place of the rim is fine along a whole strip.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::super::element::ElementKind;
use super::super::graded::{Grading, halved};
use super::super::mesh::ElementMesh;
use crate::Vec3;

/// Side of the square block [-], in radii.
pub(super) const SQUARE: f64 = 0.5;
/// Distance of its far corner from the centre [-], in radii.
const FAR_CORNER: f64 = 0.62;

/// Ends of the intervals, each from 0 to 1, before they are halved.
#[derive(Debug, Clone)]
pub(in super::super) struct Lines {
    /// Along the base from the centre, and along the arc from the axis.
    pub(super) across: Vec<f64>,
    /// Along the axis from the centre, and along the arc from the base.
    pub(super) up: Vec<f64>,
    /// From the square block to the arc.
    pub(super) out: Vec<f64>,
    /// Polar angle where the blocks meet the arc [rad].
    pub(super) seam: f64,
}

/// The mesh and the nodes of its rim.
#[derive(Debug)]
pub(in super::super) struct QuarterDisc {
    pub(in super::super) mesh: ElementMesh,
    /// Nodes of the axis.
    pub(in super::super) axis: Vec<usize>,
    /// Nodes of the base, from the centre outward.
    pub(in super::super) base: Vec<usize>,
    /// Nodes of the arc with their polar angles [rad], from the axis to the base.
    pub(in super::super) arc: Vec<(usize, f64)>,
}

impl Lines {
    /// Fine along the arc around the edge of a patch in the pole that reaches to the angle `rim` [rad], and below it:
    /// intervals of `edge` [-] of the patch at its edge that grow by `within` [-] toward the pole; `joined` in pairs
    /// where that is −1.
    pub(in super::super) fn at_pole(rim: f64, edge: f64, within: f64, joined: i32) -> Self {
        let grading = Grading {
            first: edge * rim.min(FRAC_PI_2 - rim),
            growth: 1.25,
            near: 3.0 * rim,
            far_growth: 1.7,
        };
        let inward = Grading {
            growth: within,
            ..grading
        };
        let mut arc: Vec<f64> = inward
            .line(rim, joined)
            .iter()
            .rev()
            .map(|x| rim - x)
            .collect();
        arc[0] = 0.0;
        arc.extend(
            grading.line(FRAC_PI_2 - rim, joined)[1..]
                .iter()
                .map(|x| rim + x),
        );
        // The blocks meet at the node nearest to the middle.
        let off = |i: &usize| (arc[*i] - FRAC_PI_4).abs();
        let seam = (1..arc.len() - 1)
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .expect("there is an interval on either side of the edge");
        let middle = arc[seam];
        let down = grading.line(1.0 - SQUARE, joined);
        Self {
            across: arc[..=seam].iter().map(|x| x / middle).collect(),
            up: arc[seam..]
                .iter()
                .rev()
                .map(|x| (FRAC_PI_2 - x) / (FRAC_PI_2 - middle))
                .collect(),
            out: down
                .iter()
                .rev()
                .map(|x| 1.0 - x / (1.0 - SQUARE))
                .collect(),
            seam: middle,
        }
    }
}

impl QuarterDisc {
    /// Of this radius [m], with every interval halved `halvings` times.
    pub(in super::super) fn new(radius: f64, lines: &Lines, halvings: u32) -> Self {
        let nodes_of = |line: &[f64]| (0..=halvings).fold(line.to_vec(), |line, _| halved(&line));
        let (across, up, out) = (
            nodes_of(&lines.across),
            nodes_of(&lines.up),
            nodes_of(&lines.out),
        );
        let (width, height) = (across.len(), up.len());
        // The rim of the square: from the axis to its far corner, then down to the base.
        let rim: Vec<(usize, usize)> = (0..width)
            .map(|i| (i, height - 1))
            .chain((0..height - 1).rev().map(|j| (width - 1, j)))
            .collect();
        let far = [lines.seam.sin(), lines.seam.cos()].map(|x| FAR_CORNER * x);
        let square = |i: usize, j: usize| {
            let (p, q) = (across[i], up[j]);
            [
                p * (SQUARE + q * (far[0] - SQUARE)),
                q * (SQUARE + p * (far[1] - SQUARE)),
            ]
        };
        let angle = |(i, j): (usize, usize)| {
            if j == height - 1 {
                lines.seam * across[i]
            } else {
                FRAC_PI_2 - (FRAC_PI_2 - lines.seam) * up[j]
            }
        };
        let mut nodes = Vec::with_capacity(width * height + rim.len() * (out.len() - 1));
        let mut put = |[r, z]: [f64; 2]| nodes.push(radius * Vec3::new(r, z, 0.0));
        for j in 0..height {
            (0..width).for_each(|i| put(square(i, j)));
        }
        for t in &out[1..] {
            for &(i, j) in &rim {
                let (inner, (sine, cosine)) = (square(i, j), angle((i, j)).sin_cos());
                // cos(π/2) is not quite zero.
                let cosine = if j == 0 { 0.0 } else { cosine };
                put([
                    inner[0] + t * (sine - inner[0]),
                    inner[1] + t * (cosine - inner[1]),
                ]);
            }
        }
        let inside = |i: usize, j: usize| i + j * width;
        let ring = |along: usize, k: usize| match k {
            0 => inside(rim[along].0, rim[along].1),
            _ => width * height + (k - 1) * rim.len() + along,
        };
        let mut elements = Vec::new();
        add_block(&mut elements, width, height, inside);
        add_block(&mut elements, rim.len(), out.len(), ring);
        let outward = |along: usize| (1..out.len()).map(move |k| ring(along, k));
        Self {
            axis: (0..height)
                .map(|j| inside(0, j))
                .chain(outward(0))
                .collect(),
            base: (0..width)
                .map(|i| inside(i, 0))
                .chain(outward(rim.len() - 1))
                .collect(),
            arc: rim
                .iter()
                .enumerate()
                .map(|(along, &place)| (ring(along, out.len() - 1), angle(place)))
                .collect(),
            mesh: ElementMesh {
                kind: ElementKind::Quad9,
                nodes,
                elements,
            },
        }
    }
}

/// Elements on a grid of nodes that `node` numbers.
fn add_block(
    elements: &mut Vec<u32>,
    width: usize,
    height: usize,
    node: impl Fn(usize, usize) -> usize,
) {
    for j in (0..height - 1).step_by(2) {
        for i in (0..width - 1).step_by(2) {
            elements.extend((0..9).map(|n| node(i + n % 3, j + n / 3) as u32));
        }
    }
}
