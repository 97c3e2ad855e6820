use nalgebra::{DMatrix, Matrix3};

use super::constraints::Turned;
use super::model::NonlinearModel;
use crate::Vec3;

/// The condition of a tool in a step: it moves the weighted mean of some nodes through its own compliance,
///
/// ```text
/// Σ w u + C F + o = d
/// ```
///
/// along all directions, or along one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coupling<'a> {
    /// Nodes with their weights w [-], whose sum is one. The model must list them as loadable.
    pub nodes: &'a [(u32, f64)],
    /// The only direction along which it acts, of length one; `None` is all.
    pub along: Option<Vec3>,
    /// Displacement d [m] of the tool since it touched the body at rest.
    pub displacement: Vec3,
    /// C [m/N], symmetric and not negative.
    pub compliance: Matrix3<f64>,
    /// Expected motion of the mean in this step [m]: the last step is continued as far.
    pub advance: Vec3,
    /// o [m]: the tool's own deformation under the last force less C times it.
    pub offset: Vec3,
}

impl Coupling<'_> {
    /// The directions along which it acts, the first so many of three.
    fn axes(&self) -> ([Vec3; 3], usize) {
        match self.along {
            Some(along) => ([along; 3], 1),
            None => ([Vec3::x(), Vec3::y(), Vec3::z()], 3),
        }
    }
}

/// A direction in which one of the tools acts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) tool: usize,
    pub(super) direction: Vec3,
}

/// The rows of all tools and their influences on the body.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    /// Z = Q K⁻¹ Qᵀ W, row after row; each has three values a node [m/N].
    influences: Vec<f32>,
    /// C [m/N].
    pub(super) own: DMatrix<f64>,
    size: usize,
}

impl Rows {
    pub(super) fn new(model: &NonlinearModel, tools: usize) -> Self {
        let (rows, size) = (3 * tools, 3 * model.nodes().len());
        Self {
            rows: Vec::with_capacity(rows),
            influences: vec![0.0; rows * size],
            own: DMatrix::zeros(rows, rows),
            size,
        }
    }

    /// Lists the rows of `couplings`.
    pub(super) fn list(&mut self, couplings: &[Option<Coupling<'_>>]) {
        self.rows.clear();
        for (tool, coupling) in couplings.iter().enumerate() {
            if let Some(coupling) = coupling {
                let (axes, count) = coupling.axes();
                let directions = axes.into_iter().take(count);
                self.rows
                    .extend(directions.map(|direction| Row { tool, direction }));
            }
        }
    }

    /// Makes Z and C with the `rotations` of the nodes.
    #[inline(always)]
    pub(super) fn prepare(&mut self, body: Turned<'_>, couplings: &[Option<Coupling<'_>>]) {
        let mut first = 0;
        for coupling in couplings.iter().flatten() {
            let (directions, count) = coupling.axes();
            let columns = &mut self.influences[first * self.size..(first + count) * self.size];
            influence(body, coupling.nodes, &directions[..count], columns);
            first += count;
        }
        for (i, row) in self.rows.iter().enumerate() {
            for (j, column) in self.rows.iter().enumerate() {
                self.own[(i, j)] = match (row.tool == column.tool, &couplings[row.tool]) {
                    (true, Some(coupling)) => {
                        row.direction.dot(&(coupling.compliance * column.direction))
                    }
                    _ => 0.0,
                };
            }
        }
    }

    /// How far a unit force of row `from` moves row `to` [m/N]: Wᵀ Z.
    pub(super) fn shared(&self, couplings: &[Option<Coupling<'_>>], to: usize, from: usize) -> f64 {
        let row = &self.rows[to];
        let coupling = couplings[row.tool].as_ref();
        coupling.map_or(0.0, |coupling| {
            mean(coupling, &row.direction, self.influence(from))
        })
    }

    /// A row of Z [m/N].
    pub(super) fn influence(&self, row: usize) -> &[f32] {
        &self.influences[row * self.size..][..self.size]
    }

    /// Zᵀ r.
    #[inline(always)]
    pub(super) fn project(&self, r: &[f32], projected: &mut [f64]) {
        for (row, z) in self.influences.chunks_exact(self.size).enumerate() {
            if row < self.rows.len() {
                projected[row] = super::step::dot(z, r);
            }
        }
    }

    /// x ← x + Z t.
    #[inline(always)]
    pub(super) fn add_influence(&self, t: &[f64], x: &mut [f32]) {
        let columns = self.influences.chunks_exact(self.size);
        for (z, row) in columns.zip(0..self.rows.len()) {
            let factor = t[row] as f32;
            for (x, z) in x.iter_mut().zip(z) {
                *x += factor * z;
            }
        }
    }

    /// r ← r + W t.
    pub(super) fn add_load(&self, couplings: &[Option<Coupling<'_>>], t: &[f64], r: &mut [f32]) {
        for (number, row) in self.rows.iter().enumerate() {
            if let Some(coupling) = &couplings[row.tool] {
                for &(node, weight) in coupling.nodes {
                    let at = 3 * node as usize;
                    let force = row.direction * (weight * t[number]);
                    for axis in 0..3 {
                        r[at + axis] += force[axis] as f32;
                    }
                }
            }
        }
    }
}

/// The weighted mean of `values` over the nodes of a coupling, along `direction`.
fn mean(coupling: &Coupling<'_>, direction: &Vec3, values: &[f32]) -> f64 {
    let nodes = coupling.nodes.iter();
    nodes
        .map(|&(node, weight)| {
            let value = &values[3 * node as usize..][..3];
            let along: f64 = (0..3)
                .map(|axis| direction[axis] * f64::from(value[axis]))
                .sum();
            weight * along
        })
        .sum()
}

/// Columns of Z: Q_a Σ_b w_b K⁻¹_ab Q_bᵀ of the weighted `nodes`, along each of the `directions`.
#[inline(always)]
pub(super) fn influence(
    body: Turned<'_>,
    nodes: &[(u32, f64)],
    directions: &[Vec3],
    columns: &mut [f32],
) {
    let rotations = body.rotations;
    let size = rotations.len() * 3;
    match directions {
        [x, y, z] => sum_influences(body, nodes, [x, y, z], columns),
        directions => {
            for (column, direction) in columns.chunks_exact_mut(size).zip(directions) {
                sum_influences(body, nodes, [direction], column);
            }
        }
    }
    for column in columns.chunks_exact_mut(size) {
        for (own, q) in column.chunks_exact_mut(3).zip(rotations) {
            let [x, y, z] = [own[0], own[1], own[2]];
            for i in 0..3 {
                own[i] = q[i] * x + q[3 + i] * y + q[6 + i] * z;
            }
        }
    }
}

/// `columns` = Σ_b w_b K⁻¹_ab Q_bᵀ along each of the directions, which all go through an influence together: reading them is
/// what takes time.
#[inline(always)]
fn sum_influences<const N: usize>(
    body: Turned<'_>,
    nodes: &[(u32, f64)],
    directions: [&Vec3; N],
    columns: &mut [f32],
) {
    columns.fill(0.0);
    let size = columns.len() / N;
    for &(node, weight) in nodes {
        let Some(influence) = body.model.influence(node) else {
            continue;
        };
        let q = &body.rotations[node as usize];
        // w Qᵀ times each direction.
        let turned: [[f32; 3]; N] = directions.map(|direction| {
            std::array::from_fn(|i| {
                let sum: f64 = (0..3).map(|k| f64::from(q[3 * i + k]) * direction[k]).sum();
                (weight * sum) as f32
            })
        });
        let influences = influence.columns().map(|values| &values[..size]);
        let mut rest = &mut *columns;
        let mut sums: [&mut [f32]; N] = std::array::from_fn(|_| {
            let (own, others) = std::mem::take(&mut rest).split_at_mut(size);
            rest = others;
            own
        });
        for i in 0..size {
            let from = influences.map(|values| values[i]);
            for (sum, by) in sums.iter_mut().zip(&turned) {
                sum[i] += by[0] * from[0] + by[1] * from[1] + by[2] * from[2];
            }
        }
    }
}

impl Rows {
    /// A row of C t [m].
    pub(super) fn own_displacement(&self, row: usize, t: &[f64]) -> f64 {
        let columns = 0..self.rows.len();
        columns
            .map(|column| self.own[(row, column)] * t[column])
            .sum()
    }

    /// tᵀ C t [J].
    pub(super) fn own_curvature(&self, t: &[f64]) -> f64 {
        let rows = 0..self.rows.len();
        rows.map(|row| t[row] * self.own_displacement(row, t)).sum()
    }
}
