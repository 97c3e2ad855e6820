use nalgebra::Complex;
use palpate_measure::phantom::TwoMass;

use super::transfer::Transfer;

/// A device between a hand and the force that it displays:
///
/// ```text
/// F_h = G₁ x_h + G₂ F_e         (7.1)      x_h, F_h: position and force of the hand
/// Z_h = G₁ + G₂ Z_tissue        (7.2)      F_e: force of the motors, against the hand
/// ```
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TwoPort {
    /// G₁ [N/m].
    pub(super) input_impedance: Transfer,
    /// G₂ [-].
    pub(super) force_transmission: Transfer,
}

impl TwoPort {
    /// G₁, the hand's force over its position without the motor, and G₂, the force on a hand that keeps still over the
    /// motor's, of two masses.
    pub(super) fn of(machine: &TwoMass) -> Self {
        let [ml, mm] = [machine.link_mass, machine.rotor_mass];
        let [ks, bs] = [machine.structure_stiffness, machine.structure_damping];
        let [k, b] = [machine.stiffness, machine.damping];
        // (m_l s² + b_s s + k_s) − (b_s s + k_s)²/(m_m s² + (b + b_s) s + k + k_s).
        let rotor = vec![k + ks, b + bs, mm];
        Self {
            input_impedance: Transfer {
                above: vec![
                    ks * k,
                    ks * b + bs * k,
                    ks * (mm + ml) + bs * b + ml * k,
                    bs * (mm + ml) + ml * b,
                    ml * mm,
                ],
                below: rotor.clone(),
            },
            force_transmission: Transfer {
                above: vec![ks, bs],
                below: rotor,
            },
        }
    }

    /// Impedance displayed to the hand for an impedance `tissue` [N/m] at `frequency` [Hz] (7.2), over the tissue's own
    /// [-]: one for a transparent device. The source asks for Z_h to be one, which has a unit.
    pub(super) fn transparency(&self, frequency: f64, tissue: Complex<f64>) -> Complex<f64> {
        let displayed =
            self.input_impedance.at(frequency) + self.force_transmission.at(frequency) * tissue;
        displayed / tissue
    }
}

#[cfg(test)]
mod tests {
    use super::super::frequency_response::{Port, inject};
    use super::super::printed::Printed;
    use super::*;
    use palpate_measure::phantom::{MECHANICS_STEP, Machine};
    use std::f64::consts::TAU;

    fn decibels(value: Complex<f64>) -> f64 {
        20.0 * value.norm().log10()
    }

    /// A difference in decibels and in degrees is small: 0.05 dB are asked for; a held sine is flatter by (ω T)²/24,
    /// 1e-6 here, so that 0.001 would do.
    fn assert_alike(found: Complex<f64>, expected: Complex<f64>, what: &str) {
        let apart = decibels(found / expected).abs();
        assert!(apart < 1e-3, "{what}: {apart} dB");
        let turned = (found / expected).arg().to_degrees().abs();
        assert!(turned < 0.1, "{what}: {turned} degrees");
    }

    /// Judge: (7.6), and the two-mass closed forms. A sine is injected at the hand and at the motor, and what the
    /// handle answers is read as from a recording.
    #[test]
    fn sine_injection_meets_the_closed_form() {
        let printed = Printed::read().unwrap();
        let two_masses = TwoMass::consistent();
        let machines = [
            ("as printed", printed.port(), printed.machine()),
            (
                "two masses",
                TwoPort::of(&two_masses),
                Machine::of_two_masses(&two_masses, MECHANICS_STEP),
            ),
        ];
        for (name, port, machine) in machines {
            for frequency in [1.0, 8.0, 15.0, 100.0] {
                let hand = inject(&machine, Port::HandImpedance, frequency);
                let motor = inject(&machine, Port::Motor, frequency);
                let impedance = port.input_impedance.at(frequency);
                assert_alike(hand.inv(), impedance, &format!("G1 {name} {frequency} Hz"));
                let transmission = port.force_transmission.at(frequency);
                assert_alike(
                    motor / hand,
                    transmission,
                    &format!("G2 {name} {frequency} Hz"),
                );
            }
        }
    }

    /// What the printed numbers come to, computed by hand from (7.6): magnitudes at 1, 8 and 15 Hz, in N/mm for G₁.
    #[test]
    fn the_printed_numbers_are_read_as_they_stand() {
        let port = Printed::read().unwrap().port();
        for (frequency, g1, g2) in [
            (1.0, 0.03258, 1.00139),
            (8.0, 0.24870, 1.09748),
            (15.0, 0.86002, 1.45403),
        ] {
            let found = [
                1e-3 * port.input_impedance.at(frequency).norm(),
                port.force_transmission.at(frequency).norm(),
            ];
            // Five digits.
            assert!((found[0] / g1 - 1.0).abs() < 3e-4, "{frequency}: {found:?}");
            assert!((found[1] / g2 - 1.0).abs() < 3e-5, "{frequency}: {found:?}");
        }
        // A liver of 0.009 N/mm is felt 3.6 times over at rest: the device's own spring.
        let displayed = port.transparency(0.0, Complex::new(9.0, 0.0)).re;
        assert!((displayed - (32.0 + 9.0) / 9.0).abs() < 1e-12);
    }

    /// Link and rotor swing at 151 Hz; at low frequency both are one mass.
    #[test]
    fn two_masses_have_their_mode() {
        let machine = TwoMass::consistent();
        assert!(
            (machine.structural_frequency() - 151.0).abs() < 1.0,
            "{}",
            machine.structural_frequency()
        );
        let frequency = 5.0;
        let omega = TAU * frequency;
        let whole = machine.link_mass + machine.rotor_mass;
        let rigid = Complex::new(
            machine.stiffness - whole * omega * omega,
            machine.damping * omega,
        );
        let found = TwoPort::of(&machine).input_impedance.at(frequency);
        // The spring between gives way by k/k_s, a hundredth.
        assert!((found / rigid - 1.0).norm() < 0.03, "{}", found / rigid);
    }
}
