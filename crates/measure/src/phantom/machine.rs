use nalgebra::{SMatrix, SVector};

use super::TwoMass;

/// Numbers of a machine's state.
pub const STATES: usize = 6;
/// Those and the two forces.
const ALL: usize = STATES + 2;

/// A of a linear machine.
pub type StateMatrix = SMatrix<f64, STATES, STATES>;
/// B of a linear machine.
pub type ForceMatrix = SMatrix<f64, STATES, 2>;

/// One axis of a device in time, linear. Between two changes of the forces it is exact, whatever the step: ẋ =
/// A x + B F is solved by the exponential of A.
#[derive(Debug, Clone)]
pub struct Machine {
    rates: StateMatrix,
    forces: ForceMatrix,
    /// Over one step.
    advance: StateMatrix,
    push: ForceMatrix,
    step: f64,
}

/// State of a machine: position [m] and velocity [m/s] of the handle, then internal states.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MachineState(pub SVector<f64, STATES>);

impl MachineState {
    /// A handle at rest at `position` [m].
    pub fn at(position: f64) -> Self {
        let mut state = SVector::zeros();
        state[0] = position;
        // Of two masses, the rotor is there too.
        state[2] = position;
        Self(state)
    }

    /// Where the handle is [m].
    pub fn position(&self) -> f64 {
        self.0[0]
    }

    /// How it moves [m/s].
    pub fn velocity(&self) -> f64 {
        self.0[1]
    }
}

impl Machine {
    /// Two masses, in steps of `step` [s].
    pub fn of_two_masses(machine: &TwoMass, step: f64) -> Self {
        let TwoMass {
            link_mass: ml,
            rotor_mass: mm,
            structure_stiffness: ks,
            structure_damping: bs,
            stiffness: k,
            damping: b,
        } = *machine;
        let mut rates = StateMatrix::zeros();
        rates[(0, 1)] = 1.0;
        rates[(2, 3)] = 1.0;
        let link = [-ks, -bs, ks, bs].map(|c| c / ml);
        let rotor = [ks, bs, -ks - k, -bs - b].map(|c| c / mm);
        for column in 0..4 {
            rates[(1, column)] = link[column];
            rates[(3, column)] = rotor[column];
        }
        let mut forces = ForceMatrix::zeros();
        forces[(1, 0)] = 1.0 / ml;
        forces[(3, 1)] = 1.0 / mm;
        Self::linear(rates, forces, step)
    }

    /// ẋ = A x + B F in steps of `step` [s]: `rates` is A, `forces` is B for the force of the hand and the one of the
    /// motor. The first two numbers of x are place [m] and velocity [m/s] of the handle.
    pub fn linear(rates: StateMatrix, forces: ForceMatrix, step: f64) -> Self {
        let mut both = SMatrix::<f64, ALL, ALL>::zeros();
        both.fixed_view_mut::<STATES, STATES>(0, 0)
            .copy_from(&(rates * step));
        both.fixed_view_mut::<STATES, 2>(0, STATES)
            .copy_from(&(forces * step));
        let over_step = both.exp();
        Self {
            rates,
            forces,
            advance: over_step.fixed_view::<STATES, STATES>(0, 0).into(),
            push: over_step.fixed_view::<STATES, 2>(0, STATES).into(),
            step,
        }
    }

    /// Its step [s].
    pub fn step(&self) -> f64 {
        self.step
    }

    /// One step on, under the force of the hand and the one of the motor [N].
    pub fn advance(&self, state: &mut MachineState, hand: f64, motor: f64) {
        state.0 = self.advance * state.0 + self.push * SVector::<f64, 2>::new(hand, motor);
    }

    /// Dry friction of up to `friction` [N] at the handle during a step: it takes speed and never turns it, so
    /// that what it can hold sticks.
    pub(crate) fn rub(&self, state: &mut MachineState, friction: f64) {
        let most = friction * self.forces[(1, 0)] * self.step;
        state.0[1] -= state.0[1].clamp(-most, most);
    }

    /// A.
    pub fn rates(&self) -> &StateMatrix {
        &self.rates
    }

    /// B.
    pub fn forces(&self) -> &ForceMatrix {
        &self.forces
    }
}
