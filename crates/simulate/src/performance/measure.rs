//! The measures of a score as a list, for tables, records and comparisons.

use super::{Outcome, Score};

/// A number that a score has.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Its key, with its unit at the end where it has one, after the tool that it belongs to:
    /// `left.path_m`.
    pub key: String,
    /// In SI units.
    pub value: f64,
    /// Which is better.
    pub better: Better,
}

/// Which of two values is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// The smaller one.
    Less,
    /// The larger one.
    More,
    /// Neither: the target is the experts' value.
    Neither,
}

impl Score {
    /// All measures, in the order of the documentation.
    pub fn measures(&self) -> Vec<Measure> {
        let mut all = Vec::new();
        let mut add = |key: String, value: Option<f64>, better| {
            if let Some(value) = value.filter(|value| value.is_finite()) {
                all.push(Measure { key, value, better });
            }
        };
        use Better::{Less, More, Neither};
        let own = |key: &str| key.to_owned();
        add(own("time_s"), Some(self.duration), Less);
        for (hand, force) in self.hands.iter().zip(&self.forces) {
            let of = |key: &str| format!("{}.{key}", hand.tool);
            add(of("path_m"), Some(hand.path), Less);
            add(of("angular_path_rad"), Some(hand.angular_path), Less);
            add(of("path_along_shaft_m"), Some(hand.path_along_shaft), Less);
            add(of("economy"), hand.economy, More);
            add(of("jerk"), hand.jerk, Less);
            add(of("contact_time_s"), Some(force.contact_time), Neither);
            add(of("peak_force_n"), Some(force.peak), Less);
            add(of("mean_force_n"), force.mean, Less);
            add(of("force_time_n_s"), Some(force.force_time), Less);
            add(
                of("peak_grip_force_n"),
                (force.grip_peak > 0.0).then_some(force.grip_peak),
                Less,
            );
            add(of("time_above_limit_s"), force.time_above_limit, Less);
            add(of("damage_n_s"), force.damage, Less);
        }
        let errors = &self.errors;
        for (key, count) in [
            ("force_limit_errors", errors.force_limit),
            ("perforations", errors.perforations),
            ("drops", errors.drops),
            ("shaft_contacts", errors.shaft_contacts),
            ("undone_cuts", errors.undone),
        ] {
            add(own(key), Some(count as f64), Less);
        }
        if let Some(cut) = &self.cut {
            add(own("cut_length_m"), Some(cut.length), Neither);
            if let Some(line) = &cut.along_line {
                add(own("cut_part"), Some(line.covered / line.wanted), More);
                add(own("cut_mean_deviation_m"), Some(line.mean_deviation), Less);
                add(
                    own("cut_largest_deviation_m"),
                    Some(line.largest_deviation),
                    Less,
                );
                add(
                    own("cut_deviation_area_m2"),
                    Some(line.deviation_area),
                    Less,
                );
            }
        }
        match self.outcome {
            Outcome::Free | Outcome::Cut { .. } => {}
            Outcome::Find {
                target_distance,
                found,
                size,
            } => {
                add(own("beside_m"), target_distance, Less);
                // Without a found target there is no estimate of its size: a guess earns nothing.
                let error = size.filter(|_| found).and_then(|own| {
                    let stated = own.stated?;
                    Some(own.truth.error_of(stated).abs())
                });
                add(own("diameter_error_m"), error, Less);
            }
            Outcome::Touch {
                within,
                target_distance,
                ..
            } => {
                add(own("held_s"), Some(within), More);
                add(own("beside_m"), target_distance, Less);
            }
            Outcome::Traction { within, error, .. } => {
                add(own("held_s"), Some(within), More);
                add(own("traction_error_n"), error, Less);
            }
        }
        all
    }
}
