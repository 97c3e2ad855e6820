use nalgebra::{Matrix6, Vector6};

use super::cavity::Cavity;
use super::mismatch::Mismatch;
use super::model::FiniteElementModel;
use super::pressed_faces::PressedFaces;
use super::relaxation::RelaxationStep;
use super::rigid_tool::{Contacts, MeridianDistance, RigidShape};
use crate::Vec3;

/// Boundary conditions and loads of a body. The solvers check it against the model first.
#[derive(Debug, Clone)]
pub struct Supports<'a> {
    /// Prescribed (Dirichlet) value of each displacement unknown [m]; `None` where it is free.
    pub prescribed: Vec<Option<f64>>,
    /// Nodes that slide on a rigid surface, in an axisymmetric body; their unknowns must not be
    /// prescribed.
    pub sliding: Vec<Sliding>,
    /// Pressures on the walls of cavities that follow them [Pa].
    pub pressures: Vec<(&'a Cavity, f64)>,
    /// Pressures on parts of a solid's boundary that follow them [Pa].
    pub(super) pressed: Vec<(&'a PressedFaces, f64)>,
    /// By how much fluids have made their cavities larger [m³], in the order of the cavities; zero of those beyond.
    pub growths: Vec<f64>,
    /// Rigid tools that a solid is in contact with.
    pub(super) contacts: Option<&'a Contacts<'a>>,
    /// Forces at the unknowns that do not turn with the body [N], of
    /// [`FiniteElementModel::body_load`], and how many times they act.
    pub dead_load: Option<(&'a [f64], f64)>,
    /// History of a body that relaxes; without it the body is elastic.
    pub relaxing: Option<&'a RelaxationStep>,
    /// Node and component of the first one that was to be fixed and does not exist.
    pub(super) stray: Option<(usize, usize)>,
}

/// A node of an axisymmetric body that slides on a rigid surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sliding {
    /// The node.
    pub node: usize,
    /// The surface.
    pub surface: RigidSurface,
    /// The tangential over the normal force on the node [-], along the tangent (−n_z, n_r) of the outward normal n: ±μ
    /// where it slips with Coulomb friction, 0 without friction.
    pub force_ratio: f64,
}

/// A rigid surface of revolution about the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigidSurface {
    /// A plane across the axis, above the body.
    Plane {
        /// Its height [m].
        height: f64,
    },
    /// A cylinder inside the body.
    Cylinder {
        /// Its radius [m].
        radius: f64,
    },
    /// A shape of revolution about the axis, with the origin of its frame at a height.
    Revolved {
        /// The shape.
        shape: RigidShape,
        /// [m]
        height: f64,
    },
}

impl RigidSurface {
    /// Whether its numbers are those of a surface.
    fn exists(&self) -> bool {
        match *self {
            Self::Plane { height } => height.is_finite(),
            Self::Cylinder { radius } => radius > 0.0 && radius.is_finite(),
            Self::Revolved { shape, height } => {
                height.is_finite() && shape.exists() && shape.meridian(0.0, 0.0).is_some()
            }
        }
    }

    /// A length that rounding of the distance is relative to [m].
    pub(super) fn size(&self) -> f64 {
        match *self {
            Self::Plane { height } => height.abs(),
            Self::Cylinder { radius } => radius,
            Self::Revolved {
                shape: RigidShape::Sphere { radius },
                ..
            } => radius,
            Self::Revolved { height, .. } => height.abs(),
        }
    }

    /// The point at radius `r` and height `z` [m].
    pub(super) fn signed_distance(&self, r: f64, z: f64) -> MeridianDistance {
        let shape = match *self {
            Self::Plane { height } => return MeridianDistance::straight(height - z, [0.0, -1.0]),
            Self::Cylinder { radius } => {
                return MeridianDistance::straight(r - radius, [1.0, 0.0]);
            }
            Self::Revolved { shape, height } => shape.meridian(r, z - height),
        };
        shape.expect("checked: a shape of revolution")
    }
}

impl<'a> Supports<'a> {
    /// A body that nothing holds.
    pub fn none(model: &FiniteElementModel) -> Self {
        Self {
            prescribed: vec![None; model.displacements()],
            sliding: Vec::new(),
            pressures: Vec::new(),
            pressed: Vec::new(),
            growths: Vec::new(),
            contacts: None,
            dead_load: None,
            relaxing: None,
            stray: None,
        }
    }

    /// Fixes the component `axis` of `nodes` at the displacement `at` [m]. For a node or a component that the model
    /// does not have, the solver returns an error.
    pub fn fix(
        mut self,
        model: &FiniteElementModel,
        nodes: impl IntoIterator<Item = usize>,
        axis: usize,
        at: f64,
    ) -> Self {
        let dimension = model.dimension();
        for node in nodes {
            let place = node.checked_mul(dimension).map(|first| first + axis);
            match place.and_then(|place| self.prescribed.get_mut(place)) {
                Some(prescribed) if axis < dimension => *prescribed = Some(at),
                _ => self.stray = self.stray.or(Some((node, axis))),
            }
        }
        self
    }

    /// With `pressure` [Pa] on the walls of `cavity`.
    pub fn press(mut self, cavity: &'a Cavity, pressure: f64) -> Self {
        self.pressures.push((cavity, pressure));
        self
    }

    /// The growth of each cavity that is full of a fluid [m³], endlessly.
    pub(super) fn growths(&self) -> impl Iterator<Item = f64> + '_ {
        self.growths.iter().copied().chain(std::iter::repeat(0.0))
    }

    /// Adds the forces of all pressures, `factor` times, to `out` [N].
    pub(super) fn add_pressures(
        &self,
        model: &FiniteElementModel,
        unknowns: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        for (cavity, pressure) in &self.pressures {
            cavity.add_gradient(model, unknowns, factor * pressure, out);
        }
        for (faces, pressure) in &self.pressed {
            faces.add_force(model, unknowns, factor * pressure, out);
        }
    }

    /// With `load` [N] at the unknowns.
    pub fn load(mut self, load: &'a [f64]) -> Self {
        self.dead_load = Some((load, 1.0));
        self
    }

    /// Every support is one of the model.
    pub(super) fn check(&self, model: &FiniteElementModel) -> Result<(), Mismatch> {
        let (nodes, dimension) = (model.mesh.nodes.len(), model.dimension());
        let beyond = |what, node| Mismatch::NodeBeyondMesh { what, node, nodes };
        match self.stray {
            Some((node, _)) if node >= nodes => return Err(beyond("a fixed displacement", node)),
            Some((node, axis)) => {
                return Err(Mismatch::ComponentOutOfRange {
                    axis,
                    node,
                    dimension,
                });
            }
            None => {}
        }
        let lengths = |what, found: usize, expected: usize| match found == expected {
            true => Ok(()),
            false => Err(Mismatch::WrongLength {
                what,
                found,
                expected,
            }),
        };
        let displacements = model.displacements();
        lengths(
            "the list of fixed displacements",
            self.prescribed.len(),
            displacements,
        )?;
        if let Some((load, _)) = self.dead_load {
            lengths("the dead load", load.len(), model.size())?;
        }
        if let Some(step) = self.relaxing {
            let [points, pressures] = step.lengths();
            let expected = model.mapping.weights.len();
            lengths("the history of stresses", points, expected)?;
            lengths("the history of pressures", pressures, model.pressures())?;
        }
        for (cavity, _) in &self.pressures {
            cavity.check(model)?;
        }
        for (faces, _) in &self.pressed {
            faces.check(model)?;
        }
        let mut slides = vec![false; nodes];
        for &Sliding {
            node,
            surface,
            force_ratio,
        } in &self.sliding
        {
            if dimension != 2 {
                return Err(Mismatch::CannotSlide { node });
            }
            if node >= nodes {
                return Err(beyond("a rigid surface", node));
            }
            if !surface.exists() {
                return Err(Mismatch::SurfaceOutOfRange { node, surface });
            }
            if !force_ratio.is_finite() {
                return Err(Mismatch::ForceRatioOutOfRange { node, force_ratio });
            }
            let fixed = [0, 1].map(|axis| self.prescribed[2 * node + axis].is_some());
            if fixed[0] || fixed[1] || std::mem::replace(&mut slides[node], true) {
                return Err(Mismatch::SlidesAndIsFixed { node });
            }
        }
        Ok(())
    }

    /// Whether the supports leave a rigid motion of the whole body free. It does not detect a free
    /// piece of several.
    pub(super) fn leave_free(&self, model: &FiniteElementModel) -> bool {
        let dimension = model.dimension();
        if dimension == 2 {
            // Along the axis; a ring that widens is strained.
            let along = self
                .prescribed
                .iter()
                .skip(1)
                .step_by(2)
                .any(Option::is_some);
            return !along && self.sliding.is_empty();
        }
        let nodes = &model.mesh.nodes;
        let center = nodes.iter().sum::<Vec3>() / nodes.len() as f64;
        let extent = nodes
            .iter()
            .map(|x| (x - center).norm())
            .fold(0.0, f64::max);
        // Projections of the prescribed unknowns onto three translations and three rotations.
        let mut seen = Matrix6::zeros();
        for (i, _) in self
            .prescribed
            .iter()
            .enumerate()
            .filter(|(_, h)| h.is_some())
        {
            let axis = Vec3::ith(i % dimension, 1.0);
            let turn = ((nodes[i / dimension] - center) / extent).cross(&axis);
            let row = Vector6::new(axis.x, axis.y, axis.z, turn.x, turn.y, turn.z);
            seen += row * row.transpose();
        }
        // One fixed node is a part of their number, squared lengths are below 1.
        seen.symmetric_eigenvalues().min() <= 1e-10 * seen.trace()
    }
}
