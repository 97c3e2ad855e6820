use palpate_measure::phantom::{ForceMatrix, Machine, StateMatrix};

/// (7.6) as printed, in time: a mass on a spring and a damper, to which the force of the motor comes through two
/// undamped oscillators, at 26.8 Hz and 9.35 kHz. What once swings in them never decays.
pub(super) fn printed_machine(step: f64) -> Machine {
    let (mass, damping, stiffness) = (0.09641, 2.6, 32.0);
    let [quartic, square, constant]: [f64; 3] = [3.97e-9, 13.71, 3.9e5];
    // c₄ s⁴ + c₂ s² + c₀ = c₄ (s² + ω₁²)(s² + ω₂²); the smaller root without cancellation.
    let root = (square * square - 4.0 * quartic * constant).sqrt();
    let fast = (square + root) / (2.0 * quartic);
    let slow = constant / (quartic * fast);
    let gain = constant / quartic / (fast - slow);
    let mut rates = StateMatrix::zeros();
    let mut forces = ForceMatrix::zeros();
    rates[(0, 1)] = 1.0;
    rates[(1, 0)] = -stiffness / mass;
    rates[(1, 1)] = -damping / mass;
    forces[(1, 0)] = 1.0 / mass;
    for (first, square, sign) in [(2, slow, 1.0), (4, fast, -1.0)] {
        // q̈ = −ω² q + gain F as q and q̇/ω, which have the same size.
        let omega: f64 = f64::sqrt(square);
        rates[(first, first + 1)] = omega;
        rates[(first + 1, first)] = -omega;
        forces[(first + 1, 1)] = gain / omega;
        rates[(1, first)] = sign / mass;
    }
    Machine::linear(rates, forces, step)
}
