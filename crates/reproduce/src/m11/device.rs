//! The device as it is printed, and of two masses with one unit for everything: formulas, and the same in time.

use nalgebra::Complex;
use palpate_measure::phantom::{MECHANICS_STEP, Machine, TwoMass};

use super::frequency_response::{Port, inject};
use super::printed::Printed;
use super::two_port::TwoPort;
use crate::Error;

/// A device by its formulas and as a machine that moves.
pub(super) struct Device {
    /// For rows.
    pub(super) name: &'static str,
    /// For pictures.
    pub(super) words: &'static str,
    /// G₁ and G₂.
    pub(super) port: TwoPort,
    machine: Machine,
}

impl Device {
    /// (7.6), its G₁ in N/mm.
    pub(super) fn printed(printed: &Printed) -> Self {
        Self {
            name: "printed",
            words: "(7.6) as printed",
            port: printed.port(),
            machine: printed.machine(),
        }
    }

    /// Two masses of the same parts.
    pub(super) fn consistent() -> Self {
        let masses = TwoMass::consistent();
        Self {
            name: "two_masses",
            words: "two masses",
            port: TwoPort::of(&masses),
            machine: Machine::of_two_masses(&masses, MECHANICS_STEP),
        }
    }

    /// Both.
    pub(super) fn both() -> Result<[Self; 2], Error> {
        Ok([Self::printed(&Printed::read()?), Self::consistent()])
    }

    /// G₁ [N/m] and G₂ [-] at `frequency` [Hz] from what the moving machine answers to sines of its two forces.
    pub(super) fn injected(&self, frequency: f64) -> [Complex<f64>; 2] {
        let [hand, motor] =
            [Port::HandImpedance, Port::Motor].map(|port| inject(&self.machine, port, frequency));
        [hand.inv(), motor / hand]
    }
}

/// The lowest frequency [Hz] at which a response is `decibels` off what it is at rest.
pub(super) fn first_off(response: impl Fn(f64) -> f64, decibels: f64) -> Option<f64> {
    let rest = response(0.0);
    let is_off = |f: &f64| (20.0 * (response(*f) / rest).log10()).abs() > decibels;
    let mut frequencies = (1..1_000_000).map(|i| 0.01 * f64::from(i));
    frequencies.find(is_off)
}

/// Magnitude of `value` over `unit` [dB].
pub(super) fn decibels(value: Complex<f64>, unit: f64) -> f64 {
    20.0 * (value.norm() / unit).log10()
}
