//! Deadlines: a force that a device had to keep too long, or a silent model.

use crate::Fault;

/// The consequence of the last gap between two commands for the next force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// No consequence.
    InTime,
    /// The next force is zero.
    NoForce,
    /// Forces go off.
    Faulted(Fault),
}

/// Judges a `gap` [s] between two commands with the nominal `period` [s]: beyond the period by more than `tolerance` [s] the
/// next force is zero, by more than `fault_threshold` [s] it is a fault.
pub fn check_deadline(gap: f64, period: f64, tolerance: f64, fault_threshold: f64) -> Verdict {
    let beyond = gap - period;
    if beyond > fault_threshold {
        let limit = period + fault_threshold;
        return Verdict::Faulted(Fault::Late { gap, limit });
    }
    if beyond > tolerance {
        return Verdict::NoForce;
    }
    Verdict::InTime
}

/// Judges for how long the model's answer has been `overdue` [s].
pub fn check_model_age(overdue: f64, limit: f64) -> Verdict {
    if overdue > limit {
        return Verdict::Faulted(Fault::StaleModel { overdue, limit });
    }
    Verdict::InTime
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn late_is_no_force_and_much_too_late_is_a_fault() {
        let judge = |gap| check_deadline(gap, 1e-3, 5e-3, 20e-3);
        assert_eq!(judge(1e-3), Verdict::InTime);
        assert_eq!(judge(5.9e-3), Verdict::InTime);
        assert_eq!(judge(6.1e-3), Verdict::NoForce);
        assert!(matches!(judge(22e-3), Verdict::Faulted(Fault::Late { .. })));
        assert_eq!(check_model_age(0.009, 0.01), Verdict::InTime);
        assert!(matches!(check_model_age(0.011, 0.01), Verdict::Faulted(_)));
    }
}
