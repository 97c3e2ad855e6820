//! Bounds of the models under a tip: which of them changed an answer, and by how much.
//!
//! A model that bounds a quantity says so in its answer. Nothing here allocates; whoever plays a motion
//! counts the steps and tells the user.

/// A bound that a model of a tip keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// Local model: largest principal curvature of the surface under the tip [1/m].
    Curvature,
    /// Local model: normal stiffness of the contact [half-spaces].
    LocalStiffness,
    /// Local model: stiffness of the contact along the surface [of the shells alone].
    LocalShearStiffness,
    /// Local model: relative residual of the iterative solver [-]; the step was solved by factors instead.
    Residual,
    /// Tip law: normal stiffness [half-spaces].
    TipStiffness,
    /// Tip law: stiffness along the surface [half-spaces].
    TipShearStiffness,
    /// Tip law: depth down to which the force is known [m]; beyond, it goes on along its tangent.
    TipDepth,
    /// Several tips, or one over an inclusion: change of a force in the last sweep or round [of the largest force].
    Coupling,
    /// Several tips: how far one moves the organ under another [of how far it moves it under itself].
    Carried,
    /// Nonlinear model: how far a tool was to move the organ in a step [m], and how far it did.
    Pace,
    /// Nonlinear model: points of the organ beside neighbours in a step [-], and those that it was solved with.
    NeighbourContacts,
    /// Nonlinear model: how deep a point lies in another place of the body, without a force that pushes it out [m].
    LostContact,
}

/// How far a bound changed an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// What the model found, in the unit of the [`Limit`]; infinite where nothing bounds it.
    pub asked: f64,
    /// What the answer is made with.
    pub used: f64,
}

/// The bounds that changed one answer, or several of which the worst case of each is kept.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    reached: [Option<Reached>; Limit::ALL.len()],
}

impl Limit {
    /// All of them, in the order in which they are told.
    pub const ALL: [Self; 12] = [
        Self::Curvature,
        Self::LocalStiffness,
        Self::LocalShearStiffness,
        Self::Residual,
        Self::TipStiffness,
        Self::TipShearStiffness,
        Self::TipDepth,
        Self::Coupling,
        Self::Carried,
        Self::Pace,
        Self::NeighbourContacts,
        Self::LostContact,
    ];
}

impl Limits {
    /// Nothing was bounded.
    pub const NONE: Self = Self {
        reached: [None; Limit::ALL.len()],
    };

    /// Whether nothing was bounded.
    pub fn is_empty(&self) -> bool {
        self.reached.iter().all(Option::is_none)
    }

    /// How far one of them acted; none where it did not.
    pub fn reached(&self, limit: Limit) -> Option<Reached> {
        self.reached[limit as usize]
    }

    /// Adds a bound that acted; of two cases the one that asked for more is kept.
    pub fn add(&mut self, limit: Limit, reached: Reached) {
        let known = &mut self.reached[limit as usize];
        if known.is_none_or(|known| reached.asked > known.asked) {
            *known = Some(reached);
        }
    }

    /// Adds those of another answer.
    pub fn merge(&mut self, other: &Self) {
        for limit in Limit::ALL {
            if let Some(reached) = other.reached(limit) {
                self.add(limit, reached);
            }
        }
    }
}
