use std::f64::consts::TAU;

use nalgebra::{Complex, SMatrix};
use palpate_measure::phantom::{Machine, MachineState, STATES};

/// The port at which a sine is injected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Port {
    /// As a force of the hand.
    HandImpedance,
    /// As a force of the motor.
    Motor,
}

/// Periods that are evaluated.
const PERIODS: f64 = 8.0;

/// Response of the handle of `machine` to a sine of 1 N and `frequency` [Hz] in the steady state: its
/// position over the force [m/N], by correlation as from a recording.
///
/// G₁ is one over the answer to the hand, G₂ the answer to the motor over that to the hand.
pub(super) fn inject(machine: &Machine, port: Port, frequency: f64) -> Complex<f64> {
    let omega = TAU * frequency;
    let mut state = steady(machine, port, omega);
    let samples = (PERIODS / frequency / machine.step()).round() as usize;
    let mut answer = Complex::new(0.0, 0.0);
    for sample in 0..samples {
        let time = sample as f64 * machine.step();
        answer += Complex::from_polar(2.0 / samples as f64, -omega * time) * state.position();
        // Held over a step, a sine is late by half of one.
        let force = (omega * (time + 0.5 * machine.step())).cos();
        match port {
            Port::HandImpedance => machine.advance(&mut state, force, 0.0),
            Port::Motor => machine.advance(&mut state, 0.0, force),
        }
    }
    answer
}

/// The state at time zero of a machine that has always swung: Re (iω − A)⁻¹ B.
fn steady(machine: &Machine, port: Port, omega: f64) -> MachineState {
    let rates: SMatrix<Complex<f64>, STATES, STATES> =
        machine.rates().map(|rate| Complex::new(-rate, 0.0));
    let swinging = rates + SMatrix::from_diagonal_element(Complex::new(0.0, omega));
    let column = match port {
        Port::HandImpedance => 0,
        Port::Motor => 1,
    };
    let forces = machine.forces().column(column);
    let forces = forces.map(|force| Complex::new(force, 0.0));
    // What two masses have no use for stays at rest.
    let answer = swinging.lu().solve(&forces).unwrap_or_default();
    MachineState(answer.map(|value| value.re))
}
