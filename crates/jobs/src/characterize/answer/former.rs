//! Keys of the first version (laws and lumped models at the top of a specimen), for one release alongside those that
//! replace them. They are written and never read.

use palpate_characterize::lumped::MeanModulus;
use serde::{Serialize, Serializer};

use super::{LawAnswer, Named, Specimen};

#[derive(Serialize)]
struct WithFormerKeys<'a> {
    #[serde(flatten)]
    specimen: &'a Specimen,
    mean_elastic_modulus: Option<&'a MeanModulus>,
    /// Why the mean modulus is null.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a String>,
    neo_hookean: Option<&'a LawAnswer>,
    mooney_rivlin: Option<&'a LawAnswer>,
    exponential: Option<&'a LawAnswer>,
    kelvin: Option<&'a Named>,
    /// The column model, which never was the law of this name.
    blatz: Option<&'a Named>,
    nonlinear_springs: Option<&'a Named>,
}

impl<'a> WithFormerKeys<'a> {
    fn of(specimen: &'a Specimen) -> Self {
        let law = |name: &str| specimen.laws.get(name);
        let lumped = &specimen.lumped;
        Self {
            mean_elastic_modulus: lumped.mean_elastic_modulus.as_ref(),
            reason: specimen.reasons.get("mean_elastic_modulus"),
            neo_hookean: law("neo_hookean"),
            mooney_rivlin: law("mooney_rivlin"),
            exponential: law("exponential"),
            kelvin: lumped.kelvin.as_ref(),
            blatz: lumped.column.as_ref(),
            nonlinear_springs: lumped.nonlinear_springs.as_ref(),
            specimen,
        }
    }
}

/// A specimen with the former keys.
pub(crate) fn of_one<S: Serializer>(specimen: &Specimen, serializer: S) -> Result<S::Ok, S::Error> {
    WithFormerKeys::of(specimen).serialize(serializer)
}

/// Specimens with the former keys.
pub(super) fn of_all<S: Serializer>(
    specimens: &[Specimen],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(specimens.iter().map(WithFormerKeys::of))
}
