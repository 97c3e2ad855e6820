//! A slit in an organ whose response was solved beforehand: its faces become free of traction.
//!
//! A slit is a row of facets k. In the uncut body a force f makes a traction on facet k; its work on a jump of
//! the displacement across it is T_k f. By Betti's theorem Tᵀ D is the displacement of the surface by jumps
//! D. With −H the tractions of jumps on all facets, the facets are free of traction when
//!
//! ```text
//! D = H⁻¹ T f/E,   u E = Ξ f + Tᵀ H⁻¹ T f
//! ```
//!
//! which adds compliance only. A facet in a solid has three jumps: opening, sliding and tearing, with half an
//! ellipse over its depth. One in a wall has five: opening and sliding evenly through the wall; opening of the
//! outer face against the inner, a hinge; and the deflection of one side against the other, by shear and by
//! bending. T follows from the stresses of the table's displacements (`gradient`), and near a force from closed forms
//! (`traction`, `near`, `plate`); H from closed forms (`kernel`), with springs where a wall is cut to a part of it
//! (`spring`). The effect of a tube's curvature on both is that of a shell less that of a plate
//! (`curvature`, `shell`).
//!
//! *How we know*: `slit::the_rim_is_that_of_finite_elements`, `other_slits_are_those_of_finite_elements`,
//! `facets_of_any_length_are_one_slit`, `a_slit_may_be_cut_from_either_end`. Derivation, numbers:
//! `docs/theory/cutting.md`.
//!
//! *Limits*: small strain; sides that meet pass through one another; facets of a wall and of a solid in one slit do
//! not interact; H ignores borders, and takes curvature across a facet as that of a whole tube. Compared with finite
//! elements that no constant was fitted to, a rim cut over uncut is 36 % too stiff through a wall with a radius of 5.5
//! times its thickness and 33 % along a slit of 6 √(R w) through a tube ([`Slit::warnings`]).

mod cholesky;
mod curvature;
mod facet;
mod gradient;
mod kernel;
mod load;
mod near;
mod plate;
mod shell;
mod spring;
mod traction;
mod warnings;

use palpate_geometry::TriangleId;

use super::response::SurfaceResponse;
use crate::boundary_elements::Precision;
use crate::{Error, Vec3};
use cholesky::{Block, GrowingCholesky};
use curvature::{Curvature, Medium};
use facet::Facet;
pub use facet::{CutBody, SlitFacet};
use gradient::{Gradient, MOST};
pub use load::{SlitJumps, SlitLoad};
pub use traction::{DiscForce, RIM_COMPLIANCE};
use traction::{Loaded, MODES, Near, Part, triangles_near};

/// Near triangles that are known to a facet at most.
const MAX_NEAR: usize = 320;

/// Jumps of a facet whose T is smooth far from it: the first.
const SMOOTH: usize = 3;

/// A slit in an organ, and the compliance that it adds.
#[derive(Debug)]
pub struct Slit<T = f32> {
    most: usize,
    /// Numbers of a row: three for each triangle of the mesh.
    width: usize,
    poissons_ratio: f64,
    facets: Vec<Cut>,
    /// T without the near triangles, row after row; modes that deflect a wall have near triangles
    /// alone.
    rows: Vec<T>,
    near: Vec<Near>,
    h: GrowingCholesky,
    curvature: Curvature,
    gradients: [Gradient; 2],
    /// B of the last facet.
    parts: Vec<Part>,
    found: Vec<TriangleId>,
    scratch: [Vec<T>; 2],
}

/// A facet with what belongs to it.
#[derive(Debug, Clone, Copy)]
struct Cut {
    facet: Facet,
    /// Reach of the closed forms [m].
    reach: f64,
    /// Its near triangles begin and end here.
    near: [usize; 2],
    /// Its rows of H without those before it.
    block: Block,
    /// Increments of H's diagonal where one end is free, and where both are.
    ends: [[f64; MODES]; 2],
    /// Its ends that meet earlier facets.
    met: [bool; 2],
}

impl<T: Precision> Slit<T> {
    /// No slit, with room for up to `most` facets in the organ that `response` is of.
    pub fn new(response: &SurfaceResponse<T>, most: usize) -> Self {
        let width = 3 * response.parts().triangles;
        Self {
            most,
            width,
            poissons_ratio: response.parts().poissons_ratio,
            facets: Vec::with_capacity(most),
            rows: vec![T::of(0.0); most * SMOOTH * width],
            near: Vec::with_capacity(MAX_NEAR * most),
            h: GrowingCholesky::new(most * MODES),
            curvature: Curvature::new(response.parts().poissons_ratio),
            gradients: [Gradient::new(), Gradient::new()],
            parts: Vec::with_capacity(2 * MOST),
            found: Vec::with_capacity(MAX_NEAR),
            scratch: [0, 1].map(|_| vec![T::of(0.0); width]),
        }
    }

    /// Number of its facets.
    pub fn facets(&self) -> usize {
        self.facets.len()
    }

    /// Opens one more facet, in the same organ each time.
    ///
    /// # Errors
    /// When there is no room, or the facet has no length, depth, place on the surface or direction. Nothing has
    /// changed then.
    pub fn open(&mut self, body: &CutBody<'_, T>, asked: &SlitFacet) -> Result<(), Error> {
        if self.facets.len() == self.most {
            return Err(Error::SlitTooLarge { most: self.most });
        }
        let triangles = body.response.parts().triangles;
        if 3 * triangles != self.width || body.surface.mesh().triangles().len() != triangles {
            return Err(Error::InvalidSlit {
                fault: "its organ has another number of triangles",
            });
        }
        let first = self.facets.last().map_or(0, |cut| cut.facet.rows().end);
        let mut facet = Facet::new(body, asked, first)?;
        let met = self.facets.iter().fold([false; 2], |met, other| {
            let meets = facet.meets(&other.facet);
            [met[0] || meets[0], met[1] || meets[1]]
        });
        let reach = self.work(body, &mut facet);
        self.parts.clear();
        for (gradient, face) in self.gradients.iter().zip([1.0, -1.0]) {
            facet.parts(gradient, face, &mut self.parts);
        }
        let near = self.put_near(body, &facet, reach);
        // The end of the previous one may have become none, which changes those that follow.
        self.factor(Some(&facet));
        let (block, ends) = self.put_matrix(&facet);
        self.facets.push(Cut {
            facet,
            reach,
            near,
            block,
            ends,
            met,
        });
        self.factor(None);
        Ok(())
    }

    /// Goes back to its first facets.
    pub fn truncate(&mut self, facets: usize) {
        if facets >= self.facets.len() {
            return;
        }
        self.facets.truncate(facets);
        let near = self.facets.last().map_or(0, |cut| cut.near[1]);
        self.near.truncate(near);
        let rows = self.facets.last().map_or(0, |cut| cut.facet.rows().end);
        self.h.truncate(rows);
        self.factor(None);
    }

    /// Closes it.
    pub fn clear(&mut self) {
        self.truncate(0);
    }

    /// Number of its jumps.
    fn size(&self) -> usize {
        self.facets.last().map_or(0, |cut| cut.facet.rows().end)
    }

    /// The smooth rows of a facet, one after the other.
    fn smooth(&self, facet: usize) -> &[T] {
        &self.rows[facet * SMOOTH * self.width..][..SMOOTH * self.width]
    }

    /// Makes the smooth rows of a facet; the reach of its closed forms [m].
    fn work(&mut self, body: &CutBody<'_, T>, facet: &mut Facet) -> f64 {
        let (surface, response) = (body.surface, body.response);
        let start = self.facets.len() * SMOOTH * self.width;
        let rows = &mut self.rows[start..][..SMOOTH * self.width];
        let [outer, inner] = &mut self.gradients;
        outer.prepare(surface, response, facet.outer, &facet.middle, facet);
        facet.bend(outer);
        inner.parts.clear();
        let (of_outer, of_inner) = facet.of_faces(facet.curvature);
        let (one, rest) = rows.split_at_mut(self.width);
        let (two, three) = rest.split_at_mut(self.width);
        outer.stress(response, one, two);
        let Some(below) = facet.inner else {
            three.fill(T::of(0.0));
            let [a, b, _] = of_outer.map(T::of);
            one.iter_mut().for_each(|value| *value *= a);
            two.iter_mut().for_each(|value| *value *= b);
            return facet.reach(outer.reach);
        };
        let under = facet.middle - facet.frame.column(2) * facet.depth();
        inner.prepare(surface, response, below, &under, facet);
        let [across, along] = &mut self.scratch;
        inner.stress(response, across, along);
        let (o, i) = (of_outer.map(T::of), of_inner.map(T::of));
        for ((one, three), &inner) in one.iter_mut().zip(three).zip(across.iter()) {
            let outer = *one;
            *one = o[0] * outer + i[0] * inner;
            *three = o[2] * outer + i[2] * inner;
        }
        for (two, &inner) in two.iter_mut().zip(along.iter()) {
            *two = o[1] * *two + i[1] * inner;
        }
        facet.reach(outer.reach)
    }

    /// Lists what is near.
    fn put_near(&mut self, body: &CutBody<'_, T>, facet: &Facet, reach: f64) -> [usize; 2] {
        let (mesh, start) = (body.surface.mesh(), self.near.len());
        let size = self.gradients[0].size;
        triangles_near(body.surface, facet, reach, size, &mut self.found);
        for &triangle in &self.found {
            if body.response.is_fixed(triangle) {
                continue;
            }
            let centroid = mesh.positions(triangle).iter().sum::<Vec3>() / 3.0;
            let outward = mesh.area_vector(triangle);
            let area = outward.norm();
            let loaded = Loaded {
                place: centroid,
                normal: outward / area,
                area,
            };
            let medium = Medium {
                nu: self.poissons_ratio,
                tube: &self.curvature,
            };
            let known = &self.smooth(self.facets.len())[3 * triangle.index()..][..3];
            let known = Vec3::from_fn(|axis, _| known[axis].into());
            if let Some([more, resolved]) =
                facet.of_triangle(medium, reach, &loaded, &self.parts, &known)
            {
                self.near.push(Near {
                    triangle,
                    more,
                    resolved,
                });
            }
        }
        self.near[start..].sort_unstable_by_key(|near| near.triangle);
        [start, self.near.len()]
    }

    /// Eliminates the rows of H of a facet; what is left, and what its diagonal is raised by at free ends.
    fn put_matrix(&mut self, facet: &Facet) -> (Block, [[f64; MODES]; 2]) {
        let columns = self.h.new_columns();
        let medium = Medium {
            nu: self.poissons_ratio,
            tube: &self.curvature,
        };
        for cut in &self.facets {
            let block = kernel::coupling(medium, facet, &cut.facet);
            for (column, values) in columns[cut.facet.rows()]
                .iter_mut()
                .zip(block.column_iter())
            {
                column.copy_from_slice(values.as_slice());
            }
        }
        let (block, ends) = kernel::own(medium, facet);
        for (column, values) in columns[facet.rows()].iter_mut().zip(block.column_iter()) {
            column.copy_from_slice(values.as_slice());
        }
        let alone = kernel::pivots(&block, facet.modes());
        (self.h.eliminate(facet.rows(), alone), ends)
    }

    /// Factors the last facet's own block as it is when `next` follows. Where an end that has become none would
    /// lock a row, it stays one: else the slit could become stiffer.
    fn factor(&mut self, next: Option<&Facet>) {
        let Some(cut) = self.facets.last().copied() else {
            return;
        };
        let meets = next.map_or([false; 2], |next| cut.facet.meets(next));
        if !self.factor_facet(&cut, meets) {
            self.factor_facet(&cut, [false; 2]);
        }
    }

    /// Factors the rows of a facet whose ends meet the next one or not. Whether none is locked.
    fn factor_facet(&mut self, cut: &Cut, next: [bool; 2]) -> bool {
        let free = (0..2).filter(|&end| !cut.met[end] && !next[end]).count();
        let more = match free {
            0 => [0.0; MODES],
            free => cut.ends[free - 1],
        };
        self.h.factor(cut.facet.rows(), &cut.block, &more)
    }
}
