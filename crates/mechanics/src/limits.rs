//! Bounds of the models under a tip: which of them changed an answer, and by how much.
//!
//! A model that bounds a quantity reports it in its answer. Nothing here allocates; the caller counts
//! the steps and informs the user.

/// A bound of a model of a tip.
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
    /// Nonlinear model: points of the organ next to neighbours in a step [-], and those that it was solved
    /// with.
    NeighbourContacts,
    /// Nonlinear model: how deep a point lies in another place of the body, without a force that pushes it out [m].
    LostContact,
}

/// The change of an answer by a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// The unbounded value, in the unit of the [`Limit`]; may be infinite.
    pub unbounded: f64,
    /// The bounded value, which the answer uses.
    pub used: f64,
}

/// The bounds that changed one answer, or the worst case of each over several.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    reached: [Option<Reached>; Limit::ALL.len()],
}

impl Limit {
    /// All of them, in the order of reports.
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

    /// The change by one of them; none where it did not act.
    pub fn reached(&self, limit: Limit) -> Option<Reached> {
        self.reached[limit as usize]
    }

    /// Adds a bound that acted; of two cases the one with the larger unbounded value stays.
    pub fn add(&mut self, limit: Limit, reached: Reached) {
        let known = &mut self.reached[limit as usize];
        if known.is_none_or(|known| reached.unbounded > known.unbounded) {
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
