//! The rotation of every node: that of the mean deformation gradient of the elements around it.
//!
//! A = Q S with S symmetric and positive: Q is the limit of Q ← ½ (Q + Q⁻ᵀ) from A [Higham 1986], eight nodes side by
//! side. Seven rounds suffice for stretches from 0.2 to 5.

use super::elements::Pack;
use super::kernel::Deformed;
use super::lanes::{Columns, LANES, Lanes, cofactors, dot, plus, scaled};

const ROUNDS: usize = 7;

/// Smallest determinant of a mean gradient whose rotation is taken [-]; the node keeps its last one below.
const FLATTEST: f32 = 1e-3;

/// Adds V F, summed over the integration points, of each element to its nodes.
#[inline(always)]
pub(super) fn add_gradients(
    packs: &[Pack<f32>],
    deformed: &[Deformed<f32>],
    gradients: &mut [[f32; 9]],
) {
    gradients.fill([0.0; 9]);
    for (pack, deformed) in packs.iter().zip(deformed) {
        let mut mean = Columns::default();
        for gradient in &deformed.gradients {
            for (own, column) in mean.iter_mut().zip(gradient) {
                *own = plus(own, &scaled(column, pack.quarter));
            }
        }
        for nodes in &pack.nodes {
            for (lane, &node) in nodes.iter().enumerate() {
                let own = &mut gradients[node as usize];
                for (entry, value) in own.iter_mut().enumerate() {
                    *value += mean[entry / 3][entry % 3].0[lane];
                }
            }
        }
    }
}

/// Takes the rotations of the `gradients`, each over the `volumes` [m³] around its node, into `rotations`.
#[inline(always)]
pub(super) fn rotate(gradients: &[[f32; 9]], inverse_volumes: &[f32], rotations: &mut [[f32; 9]]) {
    let nodes = gradients.chunks(LANES).zip(inverse_volumes.chunks(LANES));
    for ((gradients, inverse), rotations) in nodes.zip(rotations.chunks_mut(LANES)) {
        let mut q = Columns::<f32>::default();
        for (lane, (gradient, inverse)) in gradients.iter().zip(inverse).enumerate() {
            for (entry, value) in gradient.iter().enumerate() {
                q[entry / 3][entry % 3].0[lane] = value * inverse;
            }
        }
        let first = dot(&q[0], &cofactors(&q)[0]);
        let half = Lanes::splat(0.5);
        for _ in 0..ROUNDS {
            let minors = cofactors(&q);
            let inverse = half / dot(&q[0], &minors[0]);
            for (own, minor) in q.iter_mut().zip(&minors) {
                *own = plus(&scaled(own, half), &scaled(minor, inverse));
            }
        }
        for (lane, rotation) in rotations.iter_mut().enumerate() {
            if first.0[lane] > FLATTEST {
                *rotation = std::array::from_fn(|entry| q[entry / 3][entry % 3].0[lane]);
            }
        }
    }
}
