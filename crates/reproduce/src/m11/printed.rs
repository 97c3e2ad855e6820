use palpate_measure::phantom::{ForceMatrix, MECHANICS_STEP, Machine, StateMatrix};

use super::transfer::Transfer;
use super::two_port::TwoPort;
use crate::Error;
use crate::published::cell;

/// Newtons per metre in a newton per millimetre, the unit of the printed G₁.
pub(super) const PER_MM: f64 = 1e3;

/// The coefficients of (7.6). G₁ is taken in N/mm, in which its mass is 96 g; with any other unit the device would be a
/// toy or a truck.
pub(super) struct Printed {
    /// m, b and k of G₁ [N s²/mm], [N s/mm], [N/mm].
    pub(super) g1: [f64; 3],
    /// Above the line of G₂.
    pub(super) above: f64,
    /// c₄, c₂ and c₀ below it.
    pub(super) below: [f64; 3],
}

impl Printed {
    pub(super) fn read() -> Result<Self, Error> {
        let cell = |name| cell(&format!("equation-7-6 {name}"));
        Ok(Self {
            g1: [cell("m")?, cell("b")?, cell("k")?],
            above: cell("g2_num")?,
            below: [cell("g2_c4")?, cell("g2_c2")?, cell("g2_c0")?],
        })
    }

    /// G₁ and G₂.
    pub(super) fn port(&self) -> TwoPort {
        let [m, b, k] = self.g1;
        let [c4, c2, c0] = self.below;
        TwoPort {
            input_impedance: Transfer {
                above: [k, b, m].map(|c| PER_MM * c).into(),
                below: vec![1.0],
            },
            force_transmission: Transfer {
                above: vec![self.above],
                below: vec![c0, 0.0, c2, 0.0, c4],
            },
        }
    }

    /// Squares of the angular frequencies [rad²/s²] at which c₄ s⁴ + c₂ s² + c₀ = c₄ (s² + ω₁²)(s² + ω₂²) is zero, the
    /// smaller one first, which is found without cancellation.
    pub(super) fn modes(&self) -> [f64; 2] {
        let [c4, c2, c0] = self.below;
        let root = (c2 * c2 - 4.0 * c4 * c0).sqrt();
        let fast = (c2 + root) / (2.0 * c4);
        [c0 / (c4 * fast), fast]
    }

    /// The same in time: a mass on a spring and a damper, to which the force of the motor comes through two undamped
    /// oscillators, at 26.8 Hz and 9.35 kHz. What once swings in them never decays.
    pub(super) fn machine(&self) -> Machine {
        let [mass, damping, stiffness] = self.g1.map(|c| PER_MM * c);
        let [slow, fast] = self.modes();
        let [quartic, _, constant] = self.below;
        let gain = constant / quartic / (fast - slow);
        let mut rates = StateMatrix::zeros();
        let mut forces = ForceMatrix::zeros();
        rates[(0, 1)] = 1.0;
        rates[(1, 0)] = -stiffness / mass;
        rates[(1, 1)] = -damping / mass;
        forces[(1, 0)] = 1.0 / mass;
        for (first, square, sign) in [(2, slow, 1.0), (4, fast, -1.0)] {
            // q̈ = −ω² q + gain F as q and q̇/ω, which have the same size.
            let omega = f64::sqrt(square);
            rates[(first, first + 1)] = omega;
            rates[(first + 1, first)] = -omega;
            forces[(first + 1, 1)] = gain / omega;
            rates[(1, first)] = sign / mass;
        }
        Machine::linear(rates, forces, MECHANICS_STEP)
    }
}
