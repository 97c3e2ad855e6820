use std::ops::ControlFlow;

use palpate_geometry::{AabbTree, Surface, TriangleId, cores, on_all_cores};

use super::super::mesh::ElementMesh;
use super::super::model::{
    FiniteElementModel, FiniteElementState, FiniteElementWorkspace, Formulation,
};
use super::super::newton;
use super::super::supports::Supports;
use super::filling::Filling;
use super::projection::{Boundary, Projection};
use crate::boundary_elements::{Precision, Progress, ResponseMemory, Stage, fixed_triangles};
use crate::linear::sparse::Factors;
use crate::regions::RegionMap;
use crate::surface_response::{ResponseParts, Sampling, SurfaceResponse, TouchableTriangle};
use crate::{Error, LinearElastic, Vec3};

/// Touchable triangles whose columns a core solves for at once.
const AT_ONCE: usize = 16;

/// Memory of a tetrahedron with its part of the factors in a wall of two of them [bytes].
const OF_A_TETRAHEDRON: f64 = 40e3;

/// A linear solid that is fixed in some triangles of its surface and can be touched in others, to
/// be filled with tetrahedra.
#[derive(Debug, Clone, Copy)]
pub struct CondensedProblem<'a> {
    /// Its surface.
    pub surface: &'a Surface,
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// Triangles that cannot move.
    pub fixed: &'a [TriangleId],
    /// Triangles that a contact may load, ascending; none of them fixed.
    pub touchable: &'a [TriangleId],
    /// Longest edge of the tetrahedra [m]; seven tenths of a wall are short enough.
    pub edge: f64,
    /// Its tissues, where it has several; then `poissons_ratio` is that of the one with Young's modulus 1.
    pub regions: Option<RegionLaws<'a>>,
}

/// The tissues of a solid.
#[derive(Debug, Clone, Copy)]
pub struct RegionLaws<'a> {
    /// Their map.
    pub map: &'a RegionMap,
    /// The law of each region, from number 0 on, with Young's moduli in parts of that to which the response is scaled [-].
    pub laws: &'a [LinearElastic],
}

/// K in factors, and the projection of its unknowns onto the triangles.
struct Condensed {
    factors: Factors,
    projection: Projection,
    /// Number of unknowns.
    size: usize,
    /// Places of each node's displacements in the order of elimination; none of a fixed node.
    rows: Vec<Option<[usize; 3]>>,
}

impl CondensedProblem<'_> {
    /// About how many tetrahedra fill the solid.
    fn tetrahedra(&self) -> f64 {
        12.0 * self.surface.mesh().volume() / self.edge.powi(3)
    }

    /// Memory that a solution in `T` takes, about; a thick solid takes more, which `solve` computes
    /// before it makes the factors.
    pub fn memory<T: Precision>(&self) -> ResponseMemory {
        let rows = 3 * self.surface.mesh().triangles().len();
        let response = rows * 3 * self.touchable.len() * size_of::<T>();
        ResponseMemory {
            response,
            most: response.saturating_add((OF_A_TETRAHEDRON * self.tetrahedra()) as usize),
        }
    }

    /// Solves for a unit force on each touchable triangle in each direction. `memory` [bytes] is the
    /// limit. One core makes the factors, all cores use them.
    ///
    /// # Errors
    /// When the memory does not suffice or the surface cannot be filled with tetrahedra of this size; as
    /// [`BoundaryProblem::solve`](crate::boundary_elements::BoundaryProblem::solve) before that; and when `progress`
    /// cancels, which it cannot while the factors are made.
    pub fn solve<T: Precision>(
        &self,
        memory: usize,
        progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<SurfaceResponse<T>, Error> {
        let triangles = self.surface.mesh().triangles().len();
        let is_fixed = fixed_triangles(triangles, self.fixed, self.touchable)?;
        LinearElastic::new(1.0, self.poissons_ratio)?;
        if !(self.edge > 0.0 && self.edge.is_finite()) {
            let name = "the longest edge of the tetrahedra";
            return Err(Error::NotALength {
                name,
                found: self.edge,
            });
        }
        let touchable: Vec<_> = self
            .touchable
            .iter()
            .map(|&triangle| {
                TouchableTriangle::of(self.surface, triangle).ok_or(Error::SliverTriangle {
                    triangle: triangle.index(),
                })
            })
            .collect::<Result<_, _>>()?;
        let needed = self.memory::<T>();
        if needed.most > memory {
            return Err(Error::NotEnoughMemory {
                needed: needed.most,
                memory,
            });
        }
        let condensed = self.condense(&is_fixed, needed.response, memory, progress)?;
        let mut parts = ResponseParts::zeros(
            self.poissons_ratio,
            touchable,
            triangles,
            self.fixed,
            Sampling::Means,
        )?;
        match self.columns(&condensed, &mut parts.displacements, progress) {
            ControlFlow::Continue(()) => SurfaceResponse::new(parts),
            ControlFlow::Break(()) => Err(Error::Cancelled),
        }
    }

    fn condense(
        &self,
        is_fixed: &[bool],
        response: usize,
        memory: usize,
        progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<Condensed, Error> {
        report_progress(progress, Stage::Assembly, 0.0)?;
        let Filling { mesh, laws } = Filling::of(self)?;
        report_progress(progress, Stage::Assembly, 0.01)?;
        let boundary = Boundary::new(&mesh)?;
        let projection = Projection::new(self.surface, &boundary);
        let elements = ElementMesh::from_tetrahedra(&mesh);
        let fixed = self.fixed_nodes(is_fixed, &elements.nodes, &boundary, &projection);
        let regions: Vec<u32> = (0..mesh.tetrahedra().len())
            .map(|number| mesh.region(number))
            .collect();
        let model =
            FiniteElementModel::with_regions(elements, &laws, &regions, Formulation::Mixed)?;
        report_progress(progress, Stage::Assembly, 0.05)?;
        let mut workspace = FiniteElementWorkspace::new(&model)?;
        let size = model.size();
        let at_once = 3 * AT_ONCE * cores() * size;
        let numbers = workspace.factor_entries() + 4 * model.pattern.entries() + at_once;
        let needed = response + size_of::<f64>() * numbers;
        if needed > memory {
            return Err(Error::NotEnoughMemory { needed, memory });
        }
        report_progress(progress, Stage::Factors, 0.1)?;
        factor(&model, &fixed, &mut workspace)?;
        report_progress(progress, Stage::Columns, COLUMNS_BEGIN)?;
        let places = workspace.factors.places();
        let row = |(node, &fixed): (usize, &bool)| {
            (!fixed).then(|| [0, 1, 2].map(|axis| places[3 * node + axis]))
        };
        Ok(Condensed {
            rows: fixed.iter().enumerate().map(row).collect(),
            factors: workspace.factors,
            projection,
            size,
        })
    }

    /// Whether each node is fixed: nodes of the boundary nearest to a fixed triangle are, unless a
    /// touchable triangle has no others.
    fn fixed_nodes(
        &self,
        is_fixed: &[bool],
        nodes: &[Vec3],
        boundary: &Boundary,
        projection: &Projection,
    ) -> Vec<bool> {
        let mesh = self.surface.mesh();
        let tree = AabbTree::new(mesh);
        let mut fixed = vec![false; nodes.len()];
        for node in boundary.nodes() {
            fixed[node] = is_fixed[tree.nearest(mesh, &nodes[node]).triangle.index()];
        }
        for &triangle in self.touchable {
            let own = projection.of(triangle);
            if own.iter().all(|(node, _)| fixed[*node]) {
                for (node, _) in own {
                    fixed[*node] = false;
                }
            }
        }
        fixed
    }

    fn columns<T: Precision>(
        &self,
        condensed: &Condensed,
        displacements: &mut [T],
        progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let rows = 3 * self.surface.mesh().triangles().len();
        let mut solved = 0;
        while solved < self.touchable.len() {
            let many = (AT_ONCE * cores()).min(self.touchable.len() - solved);
            let loaded = self.touchable[solved..solved + many].chunks(AT_ONCE);
            let columns = displacements[3 * rows * solved..].chunks_mut(3 * rows * AT_ONCE);
            on_all_cores(loaded.zip(columns), |(loaded, columns)| {
                condensed.solve(
                    loaded,
                    self.surface,
                    &mut columns[..3 * rows * loaded.len()],
                );
            });
            solved += many;
            let part = solved as f64 / self.touchable.len() as f64;
            progress(Progress {
                stage: Stage::Columns,
                part: COLUMNS_BEGIN + (1.0 - COLUMNS_BEGIN) * part,
            })?;
        }
        ControlFlow::Continue(())
    }
}

/// Part of all the work that is done before the first column, where thousands of triangles can be
/// touched [-].
const COLUMNS_BEGIN: f64 = 0.2;

fn report_progress(
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    stage: Stage,
    part: f64,
) -> Result<(), Error> {
    match progress(Progress { stage, part }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled),
    }
}

/// Makes the factors of the stiffness with `fixed` nodes.
fn factor(
    model: &FiniteElementModel,
    fixed: &[bool],
    workspace: &mut FiniteElementWorkspace,
) -> Result<(), Error> {
    let mut supports = Supports::none(model);
    for axis in 0..3 {
        let nodes = (0..fixed.len()).filter(|&node| fixed[node]);
        supports = supports.fix(model, nodes, axis, 0.0);
    }
    if supports.leave_free(model) {
        return Err(Error::NothingFixed);
    }
    let rest = FiniteElementState::at_rest(model).unknowns;
    let rows = newton::prescribed_rows(model, &supports);
    newton::assemble(model, &supports, &rest, workspace)
        .and_then(|()| {
            workspace.supported.copy_from_slice(&workspace.tangent);
            workspace.step.fill(0.0);
            newton::eliminate(model, &rows, workspace, &mut vec![0.0; model.size()]);
            newton::factor(model, workspace)
        })
        .map_err(|_| Error::InvalidResponse {
            fault: "its stiffness has no factors",
        })
}

impl Condensed {
    /// Writes the columns of unit forces on `loaded` to `columns`.
    fn solve<T: Precision>(&self, loaded: &[TriangleId], surface: &Surface, columns: &mut [T]) {
        let width = 3 * loaded.len();
        let mut sides = vec![0.0; self.size * width];
        for (number, &triangle) in loaded.iter().enumerate() {
            self.projection
                .load(triangle, &self.rows, &mut sides, width, 3 * number);
        }
        self.factors.solve_many(&mut sides, width);
        let mut means = vec![0.0; 3 * width];
        let height = columns.len() / width;
        for triangle in surface.mesh().triangle_ids() {
            self.projection
                .mean(triangle, &self.rows, &sides, &mut means);
            for (axis, means) in means.chunks_exact(width).enumerate() {
                let row = 3 * triangle.index() + axis;
                for (column, mean) in means.iter().enumerate() {
                    columns[column * height + row] = T::of(*mean);
                }
            }
        }
    }
}
