use super::cavity::Cavity;
use super::model::FiniteElementModel;
use super::relaxation::RelaxationStep;

/// What holds a body and what loads it.
#[derive(Debug, Clone)]
pub struct Supports<'a> {
    /// Displacement that each displacement unknown is to have [m]; `None` where it is free.
    pub held: Vec<Option<f64>>,
    /// Nodes that slide on a rigid sphere, in an axisymmetric body; their unknowns must not be held.
    pub sliding: Vec<OnSphere>,
    /// A pressure on walls that follows them.
    pub pressure: Option<(&'a Cavity, f64)>,
    /// History of a body that relaxes; without it the body is elastic.
    pub relaxing: Option<&'a RelaxationStep>,
}

/// A node of an axisymmetric body on a sphere around a point of the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnSphere {
    /// The node.
    pub node: usize,
    /// Height of the sphere's centre [m].
    pub center: f64,
    /// Its radius [m].
    pub radius: f64,
}

impl<'a> Supports<'a> {
    /// A body that nothing holds.
    pub fn none(model: &FiniteElementModel) -> Self {
        Self {
            held: vec![None; model.displacements()],
            sliding: Vec::new(),
            pressure: None,
            relaxing: None,
        }
    }

    /// Holds the component `axis` of `nodes` at the displacement `at` [m].
    pub fn hold(
        mut self,
        model: &FiniteElementModel,
        nodes: impl IntoIterator<Item = usize>,
        axis: usize,
        at: f64,
    ) -> Self {
        for node in nodes {
            self.held[node * model.dimension() + axis] = Some(at);
        }
        self
    }

    /// With `pressure` [Pa] on the walls of `cavity`.
    pub fn press(mut self, cavity: &'a Cavity, pressure: f64) -> Self {
        self.pressure = Some((cavity, pressure));
        self
    }
}
