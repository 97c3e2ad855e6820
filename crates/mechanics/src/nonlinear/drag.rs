//! Pieces of a body that nothing fixes, such as one that was cut off.
//!
//! They have no equilibrium of their own: they are dragged through a viscous fluid, and have no weight. So they stay where
//! tools leave them.

use nalgebra::Matrix3;
use palpate_geometry::TetrahedronMesh;

use super::elements::NODES;
use crate::Vec3;

/// Resistance of the fluid, per volume of a piece [N s/m⁴]: tissue as dense as water would sink at 0.1 m/s.
const RESISTANCE: f64 = 1e5;

/// Length of a step for the stiffness at rest [s].
const STEP: f64 = 5e-3;

/// Drag on the nodes of unfixed pieces.
#[derive(Debug, Clone, Default)]
pub(super) struct Drag {
    /// Each such node, and its resistance [N s/m].
    nodes: Vec<(u32, f32)>,
    /// Of each node the unfixed piece that it belongs to, from 1 on, or zero; empty without such pieces.
    pieces: Vec<u32>,
    /// Number of unfixed pieces.
    pub(super) count: usize,
}

impl Drag {
    /// For the pieces of `mesh`, connected by faces, none of whose nodes `is_fixed`; `elements` are the ten nodes of each
    /// tetrahedron.
    pub(super) fn new(mesh: &TetrahedronMesh, elements: &[u32], is_fixed: &[bool]) -> Self {
        let pieces = mesh.pieces();
        let mut has_fixed_node = vec![false; pieces.iter().max().map_or(0, |last| last + 1)];
        for (piece, nodes) in pieces.iter().zip(elements.chunks_exact(NODES)) {
            has_fixed_node[*piece] |= nodes.iter().any(|node| is_fixed[*node as usize]);
        }
        let mut count = 0;
        let mut number = |is_fixed: &bool| {
            count += usize::from(!is_fixed);
            if *is_fixed { 0 } else { count as u32 }
        };
        let numbers: Vec<u32> = has_fixed_node.iter().map(&mut number).collect();
        if count == 0 {
            return Self::default();
        }
        let mut of_node = vec![0; is_fixed.len()];
        let mut resistances = vec![0.0; is_fixed.len()];
        for (element, nodes) in elements.chunks_exact(NODES).enumerate() {
            let piece = numbers[pieces[element]];
            if piece > 0 {
                let [a, b, c, d] = mesh.positions(element);
                let volume = (b - a).dot(&(c - a).cross(&(d - a))) / 6.0;
                for node in nodes {
                    of_node[*node as usize] = piece;
                    resistances[*node as usize] += RESISTANCE * volume / NODES as f64;
                }
            }
        }
        let nodes = resistances.into_iter().enumerate();
        Self {
            nodes: nodes
                .filter(|(_, own)| *own > 0.0)
                .map(|(node, own)| (node as u32, own as f32))
                .collect(),
            pieces: of_node,
            count,
        }
    }

    /// The unfixed piece of a node, from 1 on; zero for others.
    pub(super) fn piece(&self, node: u32) -> u32 {
        self.pieces.get(node as usize).copied().unwrap_or(0)
    }

    /// Its stiffness in a step of usual length: of each node [N/m].
    pub(super) fn at_rest(&self) -> impl Iterator<Item = (u32, f64)> {
        let nodes = self.nodes.iter();
        nodes.map(|(node, own)| (*node, f64::from(*own) / STEP))
    }

    /// Compliance of the weighted mean of `nodes` against the drag of their piece [m/N], in a step of usual length: that of a
    /// rigid body whose nodes are at `places` [m]. With the resistances d, their middle c and ρ from there to the mean
    ///
    /// ```text
    /// 1/Σd − [ρ] J⁻¹ [ρ],   J = Σ d (r² − r rᵀ),   r from c
    /// ```
    pub(super) fn compliance(
        &self,
        places: impl Fn(u32) -> Vec3,
        nodes: &[(u32, f64)],
    ) -> Matrix3<f64> {
        let piece = nodes.first().map_or(0, |(node, _)| self.piece(*node));
        if piece == 0 {
            return Matrix3::zeros();
        }
        let own = || {
            let own = self
                .at_rest()
                .filter(|(node, _)| self.piece(*node) == piece);
            own.map(|(node, d)| (places(node), d))
        };
        let all: f64 = own().map(|(_, d)| d).sum();
        let middle = own().map(|(at, d)| d * at).sum::<Vec3>() / all;
        let mut inertia = Matrix3::zeros();
        for (at, d) in own() {
            let r = at - middle;
            inertia += d * (Matrix3::from_diagonal_element(r.norm_squared()) - r * r.transpose());
        }
        let mean: Vec3 = nodes.iter().map(|(node, w)| *w * places(*node)).sum();
        let arm = (mean - middle).cross_matrix();
        let turns = inertia.try_inverse().unwrap_or_default();
        Matrix3::from_diagonal_element(1.0 / all) - arm * turns * arm
    }

    /// Stiffness of a resistance of one in a step of this length [s], where zero is a jump of usual length [1/s].
    pub(super) fn rate(elapsed: f64) -> f32 {
        let elapsed = if elapsed > 0.0 { elapsed } else { STEP };
        (1.0 / elapsed) as f32
    }

    /// Adds its forces where nodes have moved from `before` to `now` in a step.
    #[inline(always)]
    pub(super) fn add_forces(&self, rate: f32, now: &[f64], before: &[f64], forces: &mut [f32]) {
        for (node, own) in &self.nodes {
            for k in 3 * *node as usize..3 * *node as usize + 3 {
                forces[k] += rate * own * (now[k] - before[k]) as f32;
            }
        }
    }

    /// Adds the product of its stiffness with `vector`.
    #[inline(always)]
    pub(super) fn add_product(&self, rate: f32, vector: &[f32], product: &mut [f32]) {
        for (node, own) in &self.nodes {
            for k in 3 * *node as usize..3 * *node as usize + 3 {
                product[k] += rate * own * vector[k];
            }
        }
    }
}
