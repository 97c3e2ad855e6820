use nalgebra::Complex;

use super::{Transfer, TwoMass};

/// A device between a hand and what it is to feel (7.1).
#[derive(Debug, Clone, PartialEq)]
pub struct TwoPort {
    /// G₁ [N/m].
    pub input_impedance: Transfer,
    /// G₂ [-].
    pub force_transmission: Transfer,
}

/// Newtons per metre in a newton per millimetre, the unit of the printed G₁.
const PER_MM: f64 = 1e3;

impl TwoPort {
    /// (7.6) as it is printed. G₁ is taken in N/mm, in which its mass is 96 g; with any other unit the device
    /// would be a toy or a truck.
    pub fn as_printed() -> Self {
        let g1 = [0.032, 0.0026, 9.641e-5];
        Self {
            input_impedance: Transfer {
                above: g1.map(|c| PER_MM * c).into(),
                below: vec![1.0],
            },
            force_transmission: Transfer {
                above: vec![3.9e5],
                below: vec![3.9e5, 0.0, 13.71, 0.0, 3.97e-9],
            },
        }
    }

    /// That of two masses.
    pub fn of(machine: &TwoMass) -> Self {
        Self {
            input_impedance: machine.input_impedance(),
            force_transmission: machine.force_transmission(),
        }
    }

    /// What the hand feels of an impedance `tissue` [N/m] at `frequency` [Hz] (7.2) [N/m].
    pub fn felt(&self, frequency: f64, tissue: Complex<f64>) -> Complex<f64> {
        self.input_impedance.at(frequency) + self.force_transmission.at(frequency) * tissue
    }

    /// The same over the tissue's own [-]: one of a device that is not felt. The source asks for Z_h to be
    /// one, which has a unit.
    pub fn transparency(&self, frequency: f64, tissue: Complex<f64>) -> Complex<f64> {
        self.felt(frequency, tissue) / tissue
    }
}

/// The frequency [Hz] up to which what is `felt` of an impedance [N/m] is that of the tissue within a part
/// `within` of it [-], read in steps of 1 % up to 1 kHz; none where it is not even nearly at rest.
pub fn transparent_up_to(
    felt: impl Fn(f64) -> Complex<f64>,
    tissue: Complex<f64>,
    within: f64,
) -> Option<f64> {
    let is_clear = |frequency: f64| (felt(frequency) / tissue - 1.0).norm() <= within;
    let steps = (0..1157).map(|step| 0.01 * 1.01_f64.powi(step));
    steps.take_while(|frequency| is_clear(*frequency)).last()
}
