use std::ops::ControlFlow;

use palpate_geometry::{Surface, TriangleId, cores, on_all_cores};

use super::assembly::Influences;
use super::factors::Factors;
use super::precision::Precision;
use super::rotations::TractionColumns;
use crate::surface_response::{ResponseParts, Sampling, SurfaceResponse, TouchableTriangle, zeros};
use crate::{Error, LinearElastic};

/// A linear solid that is fixed in some triangles of its surface and can be touched in others.
#[derive(Debug, Clone, Copy)]
pub struct BoundaryProblem<'a> {
    /// Its surface.
    pub surface: &'a Surface,
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// Triangles that cannot move.
    pub fixed: &'a [TriangleId],
    /// Triangles that a contact may load, ascending; none of them fixed.
    pub touchable: &'a [TriangleId],
}

/// Memory that a solution takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ResponseMemory {
    /// The response itself [bytes].
    pub response: usize,
    /// The peak, the response included [bytes].
    pub most: usize,
}

/// Touchable triangles whose columns a core solves for at once.
const AT_ONCE: usize = 64;

/// What is being done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The influences of triangles on triangles.
    Assembly,
    /// The factors of their matrix.
    Factors,
    /// The columns of the touchable triangles.
    Columns,
}

/// The progress of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// Part of all the work that is done [-].
    pub part: f64,
}

impl BoundaryProblem<'_> {
    /// Memory that a solution in `T` takes: with n triangles, t of them touchable, 9 n t numbers for the
    /// response and 9 n² for the factors.
    pub fn memory<T: Precision>(&self) -> ResponseMemory {
        let (n, t) = (self.size(), 3 * self.touchable.len());
        let response = t * n * size_of::<T>();
        ResponseMemory {
            response,
            most: response + n * n * size_of::<T>(),
        }
    }

    /// Solves for a unit force on each touchable triangle in each direction. `memory` [bytes] is the
    /// limit. On all cores.
    ///
    /// # Errors
    /// Before the first large matrix: when the memory does not suffice, nothing is fixed or touchable, a triangle is
    /// none of the surface, or the touchable ones do not ascend or are fixed. Later when `progress` cancels.
    pub fn solve<T: Precision>(
        &self,
        memory: usize,
        progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<SurfaceResponse<T>, Error> {
        let law = LinearElastic::new(1.0, self.poissons_ratio)?;
        let triangles = self.surface.mesh().triangles().len();
        let fixed = fixed_triangles(triangles, self.fixed, self.touchable)?;
        let needed = self.memory::<T>().most;
        if needed > memory {
            return Err(Error::NotEnoughMemory { needed, memory });
        }
        let influences = Influences::new(self.surface, &law)?;
        let touchable = self.touchable.iter().map(|&triangle| {
            let panel = &influences.panels[triangle.index()];
            TouchableTriangle {
                triangle,
                centroid: panel.centroid,
                normal: panel.normal,
                area: panel.area,
            }
        });
        // Both before the long work, so that it fails early.
        let mut parts = ResponseParts::zeros(
            self.poissons_ratio,
            touchable.collect(),
            triangles,
            self.fixed,
            Sampling::Centroids,
        )?;
        let system = zeros(self.size() * self.size())?;
        let solved = self.fill(&influences, &fixed, system, &mut parts, progress);
        match solved {
            ControlFlow::Continue(()) => SurfaceResponse::new(parts),
            ControlFlow::Break(()) => Err(Error::Cancelled),
        }
    }

    fn size(&self) -> usize {
        3 * self.surface.mesh().triangles().len()
    }

    /// Computes the response by the `system`, which is zero on entry.
    fn fill<T: Precision>(
        &self,
        influences: &Influences<'_>,
        fixed: &[bool],
        mut system: Vec<T>,
        parts: &mut ResponseParts<T>,
        progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let size = self.size() as f64;
        // In multiplications; a pair of panels takes some four hundred.
        let assembly = 400.0 / 9.0 * size.powi(2);
        let factors = size.powi(3) / 3.0;
        let columns = size.powi(2) * 3.0 * self.touchable.len() as f64;
        let mut report = |stage, work: f64| {
            let part = work / (assembly + factors + columns);
            progress(Progress { stage, part })
        };
        assemble(influences, fixed, &mut system, &mut |part| {
            report(Stage::Assembly, part * assembly)
        })?;
        influences.free_rotations(TractionColumns {
            columns: &mut system,
            fixed,
        });
        let factored = Factors::new(self.size(), system, &mut |part| {
            report(Stage::Factors, assembly + part * factors)
        })?;
        self.columns(influences, &factored, parts, &mut |part| {
            report(Stage::Columns, assembly + factors + part * columns)
        })
    }

    /// A₀⁻¹ U of the touchable triangles, over their areas.
    fn columns<T: Precision>(
        &self,
        influences: &Influences<'_>,
        factors: &Factors<T>,
        parts: &mut ResponseParts<T>,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let rows = self.size();
        let mut solved = 0;
        while solved < self.touchable.len() {
            let many = (AT_ONCE * cores()).min(self.touchable.len() - solved);
            let loaded = self.touchable[solved..solved + many].chunks(AT_ONCE);
            let columns = parts.displacements[3 * rows * solved..].chunks_mut(3 * rows * AT_ONCE);
            on_all_cores(loaded.zip(columns), |(loaded, columns)| {
                let columns = &mut columns[..3 * rows * loaded.len()];
                load(influences, loaded, columns);
                factors.solve(columns);
                for triangle in self.fixed {
                    for column in columns.chunks_exact_mut(rows) {
                        // Its unknowns are tractions.
                        column[3 * triangle.index()..][..3].fill(T::of(0.0));
                    }
                }
            });
            solved += many;
            progress(solved as f64 / self.touchable.len() as f64)?;
        }
        ControlFlow::Continue(())
    }
}

/// Whether each of so many triangles is fixed. Refuses numbers that the surface does not have and an order that
/// [`SurfaceResponse`] would refuse after the factorization.
pub(crate) fn fixed_triangles(
    triangles: usize,
    fixed: &[TriangleId],
    touchable: &[TriangleId],
) -> Result<Vec<bool>, Error> {
    if fixed.is_empty() {
        return Err(Error::NothingFixed);
    }
    for (what, numbers) in [("fixed", fixed), ("touchable", touchable)] {
        if let Some(stray) = numbers.iter().find(|t| t.index() >= triangles) {
            return Err(Error::TriangleOutOfRange {
                what,
                triangle: stray.index(),
                triangles,
            });
        }
    }
    if touchable.is_empty() {
        return Err(Error::NothingTouchable);
    }
    if let Some(pair) = touchable.windows(2).find(|pair| pair[0] >= pair[1]) {
        return Err(Error::TouchableNotAscending {
            triangle: pair[1].index(),
            before: pair[0].index(),
        });
    }
    let mut is_fixed = vec![false; triangles];
    for triangle in fixed {
        is_fixed[triangle.index()] = true;
    }
    let both = touchable.iter().filter(|t| is_fixed[t.index()]).count();
    if both > 0 {
        return Err(Error::TouchableIsFixed { triangles: both });
    }
    Ok(is_fixed)
}

/// [½ 1 + T of free panels, −U of fixed ones]. The unknowns of fixed panels are tractions over E and
/// the size of a panel, so that all are of like size.
fn assemble<T: Precision>(
    influences: &Influences<'_>,
    fixed: &[bool],
    system: &mut [T],
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let count = influences.panels.len();
    let area: f64 = influences.panels.iter().map(|panel| panel.area).sum();
    let scale = (count as f64 / area).sqrt();
    let share = count.div_ceil(50);
    for (k, columns) in system.chunks_mut(9 * count * share).enumerate() {
        let sources = columns.chunks_exact_mut(9 * count).enumerate();
        on_all_cores(sources, |(source, columns)| {
            let source = k * share + source;
            if fixed[source] {
                influences.displacement_columns(source, -scale, columns);
            } else {
                influences.traction_columns(source, columns);
            }
        });
        progress(((k + 1) * share).min(count) as f64 / count as f64)?;
    }
    ControlFlow::Continue(())
}

/// Fills the columns of unit forces on `loaded`: their effect if nothing else moved.
fn load<T: Precision>(influences: &Influences<'_>, loaded: &[TriangleId], columns: &mut [T]) {
    let size = 3 * influences.panels.len();
    for (columns, source) in columns.chunks_exact_mut(3 * size).zip(loaded) {
        let area = influences.panels[source.index()].area;
        influences.displacement_columns(source.index(), 1.0 / area, columns);
    }
}
