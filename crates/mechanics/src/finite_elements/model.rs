use std::sync::Arc;

use super::cavity::Cavity;
use super::mapping::Mapping;
use super::mesh::ElementMesh;
use super::mismatch::Mismatch;
use crate::linear::sparse::{Factors, Pattern};
use crate::material::law::Law;
use crate::{Error, FibreFrame, Vec3};

/// Which fields an element has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formulation {
    /// Displacements alone; locks near incompressibility and refuses it.
    Displacement,
    /// Displacements and a pressure, continuous, of one degree less [Taylor and Hood 1973]; right for
    /// every compressibility.
    Mixed,
}

/// Largest Poisson's ratio [-] at which elements without a pressure field are still good for a force.
const LOCKING: f64 = 0.49;

/// A body divided into elements: all that does not change with its displacement.
#[derive(Debug)]
pub struct FiniteElementModel {
    pub(crate) mesh: ElementMesh,
    pub(crate) law: Arc<dyn Law>,
    /// Laws of the elements, or of all points of integration, where they are not all `law`.
    laws: Vec<Arc<dyn Law>>,
    pub(crate) mapping: Mapping,
    /// Unknowns of an element: displacements node by node, then pressures; elements × local unknowns.
    pub(crate) unknowns: Vec<u32>,
    pub(crate) pattern: Pattern,
    /// Places of an element's lower triangle among the matrix values.
    pub(crate) scatter: Vec<u32>,
    /// The largest shear modulus at rest [Pa]: the scale of stress.
    pub(crate) shear_modulus: f64,
    /// Cavities full of a fluid of constant volume, whose pressures are the last unknowns.
    fluids: Vec<Cavity>,
}

impl FiniteElementModel {
    /// A body on `mesh` of `law`.
    ///
    /// # Errors
    /// When an element is inverted or names no node, or when displacements alone would lock.
    pub fn new(
        mesh: ElementMesh,
        law: Arc<dyn Law>,
        formulation: Formulation,
    ) -> Result<Self, Error> {
        let regions = vec![0; mesh.len()];
        Self::with_regions(mesh, &[law], &regions, formulation)
    }

    /// As [`Self::new`], with a law for each region and the region of each element. Pressures jump from region to region.
    ///
    /// # Errors
    /// As [`Self::new`], and when there is not one region for each element, a region has no law, or some laws are for small
    /// and others for finite strain.
    pub fn with_regions(
        mesh: ElementMesh,
        laws: &[Arc<dyn Law>],
        regions: &[u32],
        formulation: Formulation,
    ) -> Result<Self, Error> {
        mesh.check()?;
        let wrong = |found| Mismatch::WrongLength {
            what: "the list of the elements' laws",
            found,
            expected: mesh.len(),
        };
        let each = regions
            .iter()
            .map_while(|region| laws.get(*region as usize));
        let each: Vec<_> = each.cloned().collect();
        let law = each.first().ok_or(wrong(0))?.clone();
        let strain = law.volume().strain;
        let alike = each.iter().filter(|law| law.volume().strain == strain);
        let alike = alike.count();
        if alike != mesh.len() {
            return Err(wrong(alike).into());
        }
        let mut shear_modulus: f64 = 0.0;
        for law in laws {
            let own = law.distortion_tangent(&nalgebra::Matrix3::identity())[(3, 3)];
            shear_modulus = shear_modulus.max(own);
            if formulation == Formulation::Displacement {
                let softness = own / law.volume().bulk_modulus;
                let poissons_ratio = (3.0 - 2.0 * softness) / (2.0 * (3.0 + softness));
                if poissons_ratio > LOCKING {
                    return Err(Error::Locking { poissons_ratio });
                }
            }
        }
        let mapping = Mapping::new(&mesh, formulation == Formulation::Mixed)?;
        let unknowns = number(&mesh, regions, mapping.pressures_per_element);
        let local = unknowns.len() / mesh.len();
        let (pattern, scatter) = couple(&unknowns, local, &[], &[]);
        Ok(Self {
            mesh,
            law,
            laws: if laws.len() > 1 { each } else { Vec::new() },
            mapping,
            unknowns,
            pattern,
            scatter,
            shear_modulus,
            fluids: Vec::new(),
        })
    }

    /// The same body whose `cavities` are full of a fluid that keeps its volume; the pressure in each is a further unknown
    /// [Pa], positive on the wall.
    ///
    /// # Errors
    /// When the sides of a cavity are none of the model.
    pub fn with_fluids(self, cavities: Vec<Cavity>) -> Result<Self, Error> {
        self.with_couplings(cavities, std::iter::empty())
    }

    /// As [`Self::with_fluids`], with displacements of `coupled` nodes that something other than the elements
    /// couples.
    pub(super) fn with_couplings<'n>(
        mut self,
        cavities: Vec<Cavity>,
        coupled: impl Iterator<Item = &'n [u32]>,
    ) -> Result<Self, Error> {
        let dimension = self.dimension() as u32;
        let mut walls = Vec::with_capacity(cavities.len());
        for cavity in &cavities {
            cavity.check(&self)?;
            let nodes = cavity.sides.iter().flatten();
            walls.push(
                nodes
                    .flat_map(|n| (0..dimension).map(move |i| n * dimension + i))
                    .collect(),
            );
        }
        let coupled = coupled.map(|nodes| {
            let each = nodes.iter();
            each.flat_map(|n| (0..dimension).map(move |i| n * dimension + i))
                .collect()
        });
        let coupled: Vec<Vec<u32>> = coupled.collect();
        let local = self.local_unknowns();
        (self.pattern, self.scatter) = couple(&self.unknowns, local, &walls, &coupled);
        self.fluids = cavities;
        Ok(self)
    }

    /// Its cavities that are full of a fluid, each with the number of the unknown that is its pressure.
    pub(super) fn fluids(&self) -> impl ExactSizeIterator<Item = (&Cavity, usize)> {
        let first = self.size() - self.fluids.len();
        let numbered = self.fluids.iter().enumerate();
        numbered.map(move |(at, cavity)| (cavity, first + at))
    }

    /// The same body with the fibres of its laws in the `frame` of each place at rest [m], which is that of the mesh: (r, z, 0)
    /// in an axisymmetric body, whose directions are (r, z, hoop). Laws without fibres are as they were.
    #[must_use]
    pub fn in_frames(mut self, frame: impl Fn(&Vec3) -> FibreFrame) -> Self {
        let any = std::iter::once(&self.law).chain(&self.laws);
        if !any.into_iter().any(|law| law.has_fibres()) {
            return self;
        }
        let mut laws = Vec::with_capacity(self.mapping.weights.len());
        self.at_points(|index, place, _| {
            let law = self.shared_law(index);
            laws.push(law.in_frame(&frame(place)).unwrap_or_else(|| law.clone()));
        });
        self.laws = laws;
        self
    }

    /// The law at a point of integration, counted over all elements.
    pub(crate) fn law_at(&self, index: usize) -> &dyn Law {
        self.shared_law(index).as_ref()
    }

    /// The same, shared, so that laws can be compared by identity.
    pub(crate) fn shared_law(&self, index: usize) -> &Arc<dyn Law> {
        let is_of_point = self.laws.len() == self.mapping.weights.len();
        let place = if is_of_point {
            index
        } else {
            index / self.mapping.points
        };
        self.laws.get(place).unwrap_or(&self.law)
    }

    /// Calls `each` at every point of integration with its number, its place at rest [m] and the shape functions there.
    fn at_points(&self, mut each: impl FnMut(usize, &Vec3, &[f64])) {
        let kind = self.mesh.kind;
        let mut shape = vec![0.0; kind.nodes()];
        for index in 0..self.mapping.weights.len() {
            let nodes = self.mesh.element(index / self.mapping.points);
            kind.shape(self.mapping.at[index % self.mapping.points], &mut shape);
            let parts = nodes.iter().zip(&shape);
            let place = parts.map(|(&node, part)| *part * self.mesh.nodes[node as usize]);
            each(index, &place.sum(), &shape);
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &ElementMesh {
        &self.mesh
    }

    /// Number of unknowns, displacements and pressures.
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// Number of displacements; they come first among the unknowns, node by node.
    pub fn displacements(&self) -> usize {
        self.mesh.nodes.len() * self.dimension()
    }

    /// Number of displacements at a node.
    pub fn dimension(&self) -> usize {
        self.mesh.kind.dimension()
    }

    /// Number of pressures, of elements and of fluids.
    pub fn pressures(&self) -> usize {
        self.size() - self.displacements()
    }

    /// Forces at the unknowns [N] of a load per undeformed volume [N/m³] that depends on the element and on the place at
    /// rest [m]; a weight, for one.
    pub fn body_load(&self, density: impl Fn(usize, &Vec3) -> Vec3) -> Vec<f64> {
        let dimension = self.dimension();
        let mut load = vec![0.0; self.size()];
        self.at_points(|index, place, shape| {
            let element = index / self.mapping.points;
            let force = self.mapping.weights[index] * density(element, place);
            let nodes = self.mesh.element(element);
            for (&node, part) in nodes.iter().zip(shape) {
                for i in 0..dimension {
                    load[node as usize * dimension + i] += part * force[i];
                }
            }
        });
        load
    }

    /// A list of so many numbers must have one for each unknown.
    pub(super) fn check_length(&self, what: &'static str, found: usize) -> Result<(), Mismatch> {
        let expected = self.size();
        match found == expected {
            true => Ok(()),
            false => Err(Mismatch::WrongLength {
                what,
                found,
                expected,
            }),
        }
    }

    pub(crate) fn local_unknowns(&self) -> usize {
        self.unknowns.len() / self.mesh.len()
    }
}

/// The state of a deformed body, from which a solution continues.
#[derive(Debug, Clone, PartialEq)]
pub struct FiniteElementState {
    /// Displacements [m] node by node, then pressures [Pa], tension positive, then those of fluids, positive on the wall.
    pub unknowns: Vec<f64>,
}

impl FiniteElementState {
    /// The body at rest.
    pub fn at_rest(model: &FiniteElementModel) -> Self {
        Self {
            unknowns: vec![0.0; model.size()],
        }
    }

    /// Displacement of a node [m]; (u_r, u_z, 0) in an axisymmetric body.
    pub fn displacement(&self, model: &FiniteElementModel, node: usize) -> Vec3 {
        let dimension = model.dimension();
        let mut displacement = Vec3::zeros();
        for i in 0..dimension {
            displacement[i] = self.unknowns[dimension * node + i];
        }
        displacement
    }
}

/// Scratch of a solution.
#[derive(Debug)]
pub struct FiniteElementWorkspace {
    pub(crate) factors: Factors,
    /// The largest size of forces in contact so far [J]; relative to it a body without contact is at
    /// rest.
    pub(super) largest_reactions: f64,
    /// Whether the factors of an earlier tangent are near enough to the present one.
    pub(super) factors_serve: bool,
    /// The tangent, lower triangle, as assembled.
    pub(crate) tangent: Vec<f64>,
    /// The tangent with its supports, as factored.
    pub(crate) supported: Vec<f64>,
    /// Internal less external force [N], then dilation less its law [m³].
    pub(crate) residual: Vec<f64>,
    pub(crate) step: Vec<f64>,
    pub(crate) trial: Vec<f64>,
    pub(crate) element: ElementScratch,
    /// Strain energy [J] of the last assembly.
    pub(crate) energy: f64,
}

/// Scratch of one element.
#[derive(Debug)]
pub(crate) struct ElementScratch {
    pub(crate) values: Vec<f64>,
    pub(crate) sums: ElementSums,
}

/// Residual of an element, and its tangent column by column, of which the lower triangle is filled.
#[derive(Debug)]
pub(crate) struct ElementSums {
    pub(crate) force: Vec<f64>,
    pub(crate) matrix: Vec<f64>,
}

impl FiniteElementWorkspace {
    /// Scratch for `model`; orders its elimination.
    ///
    /// # Errors
    /// When there is not enough memory for the factors.
    pub fn new(model: &FiniteElementModel) -> Result<Self, Error> {
        let (size, entries) = (model.size(), model.pattern.entries());
        let local = model.local_unknowns();
        let factors = Factors::new(&model.pattern)
            .map_err(|_| Error::NoMemoryForFactors { unknowns: size })?;
        Ok(Self {
            factors,
            largest_reactions: 0.0,
            factors_serve: false,
            tangent: vec![0.0; entries],
            supported: vec![0.0; entries],
            residual: vec![0.0; size],
            step: vec![0.0; size],
            trial: vec![0.0; size],
            element: ElementScratch {
                values: vec![0.0; local],
                sums: ElementSums {
                    force: vec![0.0; local],
                    matrix: vec![0.0; local * local],
                },
            },
            energy: 0.0,
        })
    }

    /// It must be that of `model`, or of one with the same couplings.
    pub(super) fn check(&self, model: &FiniteElementModel) -> Result<(), Mismatch> {
        model.check_length("the workspace", self.residual.len())?;
        let (found, expected) = (self.tangent.len(), model.pattern.entries());
        match found == expected {
            true => Ok(()),
            false => Err(Mismatch::WrongLength {
                what: "the matrix of the workspace",
                found,
                expected,
            }),
        }
    }

    /// Force that the supports put on the body at `node` in the last equilibrium [N]; in an axisymmetric
    /// body (r, z, 0), over the whole ring.
    pub fn reaction(&self, model: &FiniteElementModel, node: usize) -> Vec3 {
        let dimension = model.dimension();
        let mut reaction = Vec3::zeros();
        for i in 0..dimension {
            reaction[i] = self.residual[dimension * node + i];
        }
        reaction
    }

    /// Strain energy of the last equilibrium [J].
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// Numbers in the factors: their memory is eight bytes each.
    pub fn factor_entries(&self) -> usize {
        self.factors.entries()
    }
}

/// Unknowns of every element. There is a pressure at each corner for each region that has it.
fn number(mesh: &ElementMesh, regions: &[u32], pressures: usize) -> Vec<u32> {
    let dimension = mesh.kind.dimension() as u32;
    let first = mesh.nodes.len() as u32 * dimension;
    let corners = |element: usize| {
        let nodes = mesh.element(element);
        let corners = mesh.kind.corners().iter().take(pressures);
        corners.map(move |&corner| (nodes[corner], regions[element]))
    };
    let mut places: Vec<(u32, u32)> = (0..mesh.len()).flat_map(corners).collect();
    places.sort_unstable();
    places.dedup();
    let place = |corner| places.partition_point(|other| *other < corner) as u32;
    let mut unknowns = Vec::new();
    for element in 0..mesh.len() {
        let nodes = mesh.element(element).iter();
        unknowns.extend(nodes.flat_map(|n| (0..dimension).map(move |i| n * dimension + i)));
        unknowns.extend(corners(element).map(|corner| first + place(corner)));
    }
    unknowns
}

/// The couplings of unknowns within elements of `local` ones, and the places of each element's lower triangle; a further
/// unknown is coupled with those of each of the `walls`, and unknowns of each of `coupled` with one another.
fn couple(
    unknowns: &[u32],
    local: usize,
    walls: &[Vec<u32>],
    coupled: &[Vec<u32>],
) -> (Pattern, Vec<u32>) {
    let first = unknowns.iter().max().map_or(0, |&last| last + 1);
    let mut entries = Vec::with_capacity(unknowns.len() * (local + 1) / 2);
    for element in unknowns.chunks_exact(local) {
        entries.extend(lower(element).map(|(row, column)| (column, row)));
    }
    for own in coupled {
        entries.extend(lower(own).map(|(row, column)| (column, row)));
    }
    for (wall, row) in walls.iter().zip(first..) {
        entries.push((row, row));
        entries.extend(wall.iter().map(|&column| (column, row)));
    }
    let pattern = Pattern::new(first as usize + walls.len(), entries);
    let mut scatter = Vec::with_capacity(unknowns.len() * (local + 1) / 2);
    for element in unknowns.chunks_exact(local) {
        let places = lower(element);
        scatter.extend(
            places.map(|(row, column)| pattern.index(row as usize, column as usize) as u32),
        );
    }
    (pattern, scatter)
}

/// Pairs (row, column) of an element's lower triangle, column by column of its own numbering, turned so
/// that row ≥ column in the body's.
fn lower(element: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    element.iter().enumerate().flat_map(move |(j, &column)| {
        element[j..]
            .iter()
            .map(move |&row| (row.max(column), row.min(column)))
    })
}
