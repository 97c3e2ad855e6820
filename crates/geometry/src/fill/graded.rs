//! A lattice that is finer in some places: its tetrahedra are bisected before there is a surface.

use super::background::{Background, Cut, Place, crossing, find_cut};
use super::lattice::Lattice;
use crate::mesh::tetrahedra::six_fold_volume;
use crate::{AabbTree, NodeId, Surface, TetrahedronError, Vec3, refine_to};

/// Part of an edge: a cut nearer to its end than that moves the end.
const ALPHA: f64 = 0.3;

/// Least part of its volume that a tetrahedron retains when an end moves [-].
const MIN_VOLUME: f64 = 0.2;

/// Bisected tetrahedra, points moved onto the surface, and cuts.
pub(super) struct GradedLattice {
    vertices: Vec<Vec3>,
    tetrahedra: Vec<[NodeId; 4]>,
    places: Vec<Place>,
    /// In ascending order of their ends.
    cuts: Vec<Cut>,
}

impl GradedLattice {
    /// Of cells of this `edge` [m], with edges no longer than `longest_edge` [m].
    pub(super) fn new(
        surface: &Surface,
        tree: &AabbTree,
        edge: f64,
        longest_edge: impl Fn(&Vec3) -> f64,
    ) -> Result<Self, TetrahedronError> {
        let mesh = refine_to(&Lattice::tetrahedra(surface, edge)?, None, longest_edge)?;
        let edges = mesh.edges();
        let (vertices, tetrahedra) = mesh.into_parts();
        let place = |point: &Vec3| Place::at(surface.signed_distance(tree, point).1, edge);
        let mut lattice = Self {
            places: vertices.iter().map(place).collect(),
            vertices,
            tetrahedra,
            cuts: Vec::new(),
        };
        lattice.find_cuts(surface, tree, &edges);
        lattice.warp();
        Ok(lattice)
    }

    fn find_cuts(&mut self, surface: &Surface, tree: &AabbTree, edges: &[[NodeId; 2]]) {
        for &[a, b] in edges {
            let ends = match [a, b].map(|end| self.places[end.index()]) {
                [Place::Inside, Place::Outside] => [a, b],
                [Place::Outside, Place::Inside] => [b, a],
                _ => continue,
            };
            let [from, to] = ends.map(|end| self.vertices[end.index()]);
            self.cuts.push(Cut {
                ends: ends.map(|end| end.0),
                position: crossing(surface, tree, from, to),
            });
        }
        self.cuts.sort_unstable_by_key(|cut| cut.ends);
    }

    /// Moves each point that a cut comes too near to, unless a tetrahedron would be flat. The cuts of its edges are
    /// then no more.
    fn warp(&mut self) {
        let mut nearest: Vec<Option<(f64, Vec3)>> = vec![None; self.vertices.len()];
        for cut in &self.cuts {
            let [from, to] = cut.ends.map(|end| self.vertices[end as usize]);
            for (end, here) in cut.ends.into_iter().zip([from, to]) {
                let part = (cut.position - here).norm() / (to - from).norm();
                let known = &mut nearest[end as usize];
                if part < ALPHA && known.is_none_or(|(least, _)| part < least) {
                    *known = Some((part, cut.position));
                }
            }
        }
        let mut around = vec![Vec::new(); self.vertices.len()];
        for (number, corners) in self.tetrahedra.iter().enumerate() {
            for corner in corners {
                if nearest[corner.index()].is_some() {
                    around[corner.index()].push(number);
                }
            }
        }
        for (point, found) in nearest.into_iter().enumerate() {
            let Some((_, target)) = found else { continue };
            let volumes = |vertices: &[Vec3]| -> Vec<f64> {
                let all = around[point].iter();
                let corners = all.map(|&t: &usize| self.tetrahedra[t].map(|n| vertices[n.index()]));
                corners.map(|corners| six_fold_volume(&corners)).collect()
            };
            let before = volumes(&self.vertices);
            let here = std::mem::replace(&mut self.vertices[point], target);
            let after = volumes(&self.vertices);
            if before
                .iter()
                .zip(&after)
                .all(|(before, after)| *after > MIN_VOLUME * before)
            {
                self.places[point] = Place::On;
            } else {
                self.vertices[point] = here;
            }
        }
    }
}

impl Background for GradedLattice {
    fn points(&self) -> usize {
        self.vertices.len()
    }

    fn cuts(&self) -> usize {
        self.cuts.len()
    }

    fn place(&self, number: u32) -> Place {
        self.places[number as usize]
    }

    fn position(&self, number: u32) -> Vec3 {
        self.vertices[number as usize]
    }

    fn cut(&self, inside: u32, outside: u32) -> Option<(u32, Vec3)> {
        find_cut(&self.cuts, inside, outside)
    }

    /// An order of all points follows nothing around.
    fn diagonal_from_first(&self, p: u32, q: u32, _: u32) -> bool {
        p < q
    }

    fn visit(&self, see: &mut dyn FnMut([u32; 4])) {
        for corners in &self.tetrahedra {
            see(corners.map(|corner| corner.0));
        }
    }
}
