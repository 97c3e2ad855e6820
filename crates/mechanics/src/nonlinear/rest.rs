//! The stiffness of the body at rest, in factors: made once, turned with the body in every step.

use super::drag::Drag;
use super::elements::{NODES, Nodal, Pack};
use super::kernel::Deformed;
use super::lanes::{LANES, Lanes};
use crate::Error;
use crate::linear::sparse::{Factors, Pattern, SmallFactors};

/// Right sides that go through the factors at once.
const AT_ONCE: usize = 48;

/// Factors of the stiffness at rest, without the fixed nodes.
#[derive(Debug, Clone)]
pub(super) struct RestFactors {
    factors: SmallFactors,
    /// Places of the three displacements of each node in the order of elimination; none of a fixed node.
    places: Vec<Option<[u32; 3]>>,
    unknowns: usize,
}

/// Displacements of all nodes from a unit force on one, in each direction.
#[derive(Debug, Clone)]
pub(super) struct Influence {
    /// 3 × nodes × 3 [m/N]: from a force along each direction those of all nodes.
    values: Vec<f32>,
}

impl Influence {
    /// Displacements of all nodes, one after the other, from a unit force along each direction [m/N].
    #[inline(always)]
    pub(super) fn columns(&self) -> [&[f32]; 3] {
        let size = self.values.len() / 3;
        [0, 1, 2].map(|j| &self.values[j * size..][..size])
    }
}

impl RestFactors {
    /// For the elements `packs` over `is_fixed.len()` nodes; and the [`Influence`] of each of the nodes `loaded`.
    pub(super) fn new(
        packs: &[Pack<f64>],
        is_fixed: &[bool],
        drag: &Drag,
        loaded: &[u32],
    ) -> Result<(Self, Vec<Influence>), Error> {
        let mut unknowns = 0;
        let numbers: Vec<Option<u32>> = is_fixed
            .iter()
            .map(|&fixed| {
                (!fixed).then(|| {
                    unknowns += 3;
                    unknowns as u32 - 3
                })
            })
            .collect();
        let no_factors = |_| Error::InvalidResponse {
            fault: "its stiffness has no factors",
        };
        let pattern = Pattern::new(unknowns, couplings(packs, &numbers));
        let mut values = vec![0.0; pattern.entries()];
        assemble(packs, &numbers, &pattern, &mut values);
        for (node, stiffness) in drag.at_rest() {
            if let Some(number) = numbers[node as usize] {
                for k in [0, 1, 2].map(|axis| number as usize + axis) {
                    values[pattern.index(k, k)] += stiffness;
                }
            }
        }
        let mut factors = Factors::new(&pattern).map_err(no_factors)?;
        factors.factor(&pattern, &values).map_err(no_factors)?;
        if factors.negative_eigenvalues() > 0 {
            return Err(Error::InvalidResponse {
                fault: "its stiffness at rest is not positive",
            });
        }
        // The influences of tools and contacts have to be those of the preconditioner.
        factors.round();
        let order = factors.places();
        let place = |number: Option<u32>| {
            number.map(|n| [0, 1, 2].map(|axis| order[n as usize + axis] as u32))
        };
        let rest = Self {
            places: numbers.into_iter().map(place).collect(),
            factors: SmallFactors::new(&factors),
            unknowns,
        };
        let influences = rest.influences(&factors, loaded);
        Ok((rest, influences))
    }

    pub(super) fn is_fixed(&self, node: u32) -> bool {
        self.places[node as usize].is_none()
    }

    fn influences(&self, factors: &Factors, loaded: &[u32]) -> Vec<Influence> {
        let mut influences = Vec::with_capacity(loaded.len());
        for nodes in loaded.chunks(AT_ONCE / 3) {
            let width = 3 * nodes.len();
            let mut sides = vec![0.0; self.unknowns * width];
            for (number, &node) in nodes.iter().enumerate() {
                for (axis, place) in self.places[node as usize].iter().flatten().enumerate() {
                    sides[*place as usize * width + 3 * number + axis] = 1.0;
                }
            }
            factors.solve_many(&mut sides, width);
            influences.extend((0..nodes.len()).map(|number| {
                let size = 3 * self.places.len();
                let mut values = vec![0.0; 3 * size];
                for (node, places) in self.places.iter().enumerate() {
                    for (i, place) in places.iter().flatten().enumerate() {
                        for j in 0..3 {
                            let side = *place as usize * width + 3 * number + j;
                            values[j * size + 3 * node + i] = sides[side] as f32;
                        }
                    }
                }
                Influence { values }
            }));
        }
        influences
    }

    /// Numbers of scratch that [`Self::apply`] needs.
    pub(super) fn scratch(&self) -> usize {
        self.unknowns + self.factors.scratch()
    }

    /// z = Q K⁻¹ Qᵀ r with the rotation of each node, its columns one after the other; zero where a node is fixed.
    #[inline(always)]
    pub(super) fn apply(
        &self,
        rotations: &[[f32; 9]],
        r: &[f32],
        z: &mut [f32],
        scratch: &mut [f32],
    ) {
        let (x, scratch) = scratch.split_at_mut(self.unknowns);
        for ((places, q), r) in self.places.iter().zip(rotations).zip(r.chunks_exact(3)) {
            if let Some(places) = places {
                for (i, &place) in places.iter().enumerate() {
                    x[place as usize] = q[3 * i] * r[0] + q[3 * i + 1] * r[1] + q[3 * i + 2] * r[2];
                }
            }
        }
        self.factors.solve(x, scratch);
        let nodes = self.places.iter().zip(rotations);
        for ((places, q), z) in nodes.zip(z.chunks_exact_mut(3)) {
            z.fill(0.0);
            if let Some(places) = places {
                for (j, &place) in places.iter().enumerate() {
                    for (i, z) in z.iter_mut().enumerate() {
                        *z += q[3 * j + i] * x[place as usize];
                    }
                }
            }
        }
    }
}

/// Column and row of every entry of the lower triangle, with repeats.
fn couplings(packs: &[Pack<f64>], numbers: &[Option<u32>]) -> Vec<(u32, u32)> {
    let mut entries = Vec::new();
    for pack in packs {
        for lane in 0..LANES {
            let own = pack.nodes.map(|nodes| numbers[nodes[lane] as usize]);
            for row in own.iter().flatten() {
                for column in own.iter().flatten().filter(|column| *column <= row) {
                    for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                        if row + i >= column + j {
                            entries.push((column + j, row + i));
                        }
                    }
                }
            }
        }
        // A third of a million pairs are put together at a time.
        if entries.len() > 1 << 22 {
            entries.sort_unstable();
            entries.dedup();
        }
    }
    entries
}

/// Adds the stiffness at rest, column by column of each element: the change of its forces with each unknown.
fn assemble(packs: &[Pack<f64>], numbers: &[Option<u32>], pattern: &Pattern, values: &mut [f64]) {
    for pack in packs {
        let mut at_rest = Deformed::default();
        pack.deform(&Nodal::default(), &mut at_rest);
        for (a, j) in (0..3 * NODES).map(|k| (k / 3, k % 3)) {
            let mut unit = Nodal::default();
            unit[a][j] = Lanes::splat(1.0);
            let column_forces = pack.change(&at_rest, &unit);
            for lane in (0..LANES).filter(|&lane| pack.quarter.0[lane] > 0.0) {
                let Some(column) = numbers[pack.nodes[a][lane] as usize] else {
                    continue;
                };
                let column = column as usize + j;
                for (b, forces) in column_forces.iter().enumerate() {
                    let Some(row) = numbers[pack.nodes[b][lane] as usize] else {
                        continue;
                    };
                    for (i, force) in forces.iter().enumerate() {
                        let row = row as usize + i;
                        if row >= column {
                            values[pattern.index(row, column)] += force.0[lane];
                        }
                    }
                }
            }
        }
    }
}
