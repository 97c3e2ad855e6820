//! The esophagus of section 6.4.5.

use palpate_mechanics::PronySeries;
use palpate_mechanics::finite_elements::tube::Tube;

use crate::Error;
use crate::published::SECTION_6_4_5;

/// The source gives a diameter of about 15 mm (section 7.1) and no wall; 2.5 mm is a reading.
const INNER_RADIUS: f64 = 5e-3;
const OUTER_RADIUS: f64 = 7.5e-3;

/// What the source prints of it.
pub(super) struct Printed {
    pub(super) modulus_kpa: f64,
    pub(super) g: f64,
    /// [s]
    pub(super) tau: f64,
    pub(super) pressure_mmhg: f64,
    pub(super) tube: Tube,
}

/// The printed numbers.
pub(super) fn printed() -> Result<Printed, Error> {
    let cell = |column| {
        let missing = || Error::failed("section 6.4.5 cannot be read; please report this");
        SECTION_6_4_5.first(column).ok_or_else(missing)
    };
    Ok(Printed {
        modulus_kpa: cell("youngs_modulus_kpa")?,
        g: cell("prony_g1")?,
        tau: cell("relaxation_time_s")?,
        pressure_mmhg: cell("internal_pressure_mmhg")?,
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
