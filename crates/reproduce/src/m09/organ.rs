//! The esophagus of section 6.4.5.

use palpate_mechanics::PronySeries;
use palpate_mechanics::finite_elements::tube::Tube;

use crate::Error;
use crate::published::cell;

/// The source gives a diameter of about 15 mm (section 7.1) and no wall; 2.5 mm is a reading.
const INNER_RADIUS: f64 = 5e-3;
const OUTER_RADIUS: f64 = 7.5e-3;

/// What the source prints of it.
pub(super) struct Printed {
    pub(super) modulus_kpa: f64,
    pub(super) g: f64,
    /// [s]
    pub(super) tau: f64,
    pub(super) tube: Tube,
}

/// The printed numbers.
pub(super) fn printed() -> Result<Printed, Error> {
    let cell = |column| cell(&format!("section-6-4-5 {column}"));
    Ok(Printed {
        modulus_kpa: cell("youngs_modulus_kpa")?,
        g: cell("prony_g1")?,
        tau: cell("relaxation_time_s")?,
        tube: Tube {
            length: 1e-3 * cell("length_mm")?,
            inner_radius: INNER_RADIUS,
            outer_radius: OUTER_RADIUS,
        },
    })
}

impl Printed {
    /// How it relaxes.
    pub(super) fn series(&self) -> Result<PronySeries, Error> {
        Ok(PronySeries::new(&[(self.g, self.tau)])?)
    }
}
