//! The document of a problem: a body, its tissue and its loads.
//!
//! Reading checks the problem: a `Problem` has a solution, as far as its numbers show.

mod fibres;
mod hemisphere;
mod indentation;
mod regions;
mod solid;
mod tools;
mod tube;
mod uniaxial;

use std::ops::Bound::Included;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use palpate_files::scene::TissueChoice;
use palpate_files::tissue::LawName;
use palpate_files::{Document, Domain, Key, Keys, Tissue, Word};
use palpate_mechanics::Material;
use palpate_mechanics::contact::Friction;

pub(crate) use hemisphere::Hemisphere;
pub(crate) use indentation::{Indentation, Loading, Ramp};
pub(crate) use regions::{SolidContent, SolidPart};
pub(crate) use solid::{Patch, Point, Solid};
pub(crate) use tube::{Tube, TubeIndent};
pub(crate) use uniaxial::Uniaxial;

use crate::Error;

/// A checked problem, with its accuracy.
#[derive(Debug)]
pub struct Problem {
    path: PathBuf,
    pub(crate) case: Case,
    pub(crate) tissue: Tissue,
    pub(crate) material: Material,
    /// Requested relative error [-].
    pub(crate) accuracy: f64,
    /// Warnings about its numbers.
    pub(crate) warnings: Vec<String>,
}

/// The kinds of problems.
#[derive(Debug)]
pub(crate) enum Case {
    Indentation(Indentation),
    Hemisphere(Hemisphere),
    Tube(Tube),
    Uniaxial(Uniaxial),
    Solid(Box<Solid>),
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Indentation,
    Hemisphere,
    Tube,
    Uniaxial,
    Solid,
}

const KINDS: &[(&str, Kind)] = &[
    ("indentation", Kind::Indentation),
    ("hemisphere", Kind::Hemisphere),
    ("tube", Kind::Tube),
    ("uniaxial", Kind::Uniaxial),
    ("solid", Kind::Solid),
];

const DEFAULT_ACCURACY: f64 = 0.01;

const ACCURACY: Domain = Domain::number("a relative error", [Included(1e-4), Included(0.2)]);

/// The boundary condition of a surface.
const BONDS: &[(&str, Friction)] = &[
    ("stick", Friction::Bonded),
    ("slip", Friction::Frictionless),
    ("bonded", Friction::Bonded),
];

const BOND_MEANINGS: &[Word] = &[
    ("stick", "It does not move along the indenter."),
    ("slip", "It slides along the indenter without friction."),
    ("bonded", "As `stick`."),
];

/// The keys of every kind.
const SHARED: &[Key] = &[
    Key::word("kind", KIND_MEANINGS, "What is solved.").required("\"indentation\""),
    TissueChoice::KEYS[0],
    TissueChoice::KEYS[1],
    Key::number(
        "accuracy",
        ACCURACY,
        "The relative error that is asked for.",
    )
    .default("0.01"),
];

const KIND_MEANINGS: &[Word] = &[
    ("indentation", "A rigid indenter is pressed into a block."),
    (
        "hemisphere",
        "A patch at the pole of a hemisphere is pressed towards its fixed base.",
    ),
    (
        "tube",
        "A tube with fixed ends is under pressure, and perhaps indented.",
    ),
    (
        "uniaxial",
        "A bar is pulled or pressed along its axis, free to widen.",
    ),
    (
        "solid",
        "A body of any shape, fixed at one part, and moved or loaded at others.",
    ),
];

impl Problem {
    /// Reads a problem and the tissue that it names.
    ///
    /// # Errors
    /// When it cannot be read, or describes a problem without a solution.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::understand(&Document::read(path)?, path)
    }

    /// Reads a problem from `text`. Paths in it are relative to the folder of `path`, which errors show as its name.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, path: &Path) -> Result<Self, Error> {
        Self::understand(&Document::parse(text, path)?, path)
    }

    fn understand(document: &Document, path: &Path) -> Result<Self, Error> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let keys = document.open_keys(SHARED);
        let kind = match keys.word("kind", KINDS)? {
            Some(kind) => kind,
            None => {
                // The error for a misspelt `kind` helps more than that for a missing one.
                let of_all = KINDS.iter().flat_map(|(_, kind)| kind.keys());
                keys.only(&of_all.map(|key| key.name).collect::<Vec<_>>())?;
                let words: Vec<_> = KINDS.iter().map(|(word, _)| format!("{word:?}")).collect();
                return Err(keys
                    .missing("kind", format!("one of {}", words.join(", ")))
                    .into());
            }
        };
        let keys = document.keys(kind.keys())?;
        let accuracy = keys.number("accuracy")?;
        let tissue = TissueChoice::from_keys(&keys, folder)?.read()?;
        let case = match kind {
            Kind::Indentation => {
                let why = "the block is axisymmetric about its indenter and knows no direction";
                fibres::refuse(&keys, &tissue, why)?;
                Case::Indentation(Indentation::from_keys(&keys)?)
            }
            Kind::Hemisphere => {
                refuse_large_strain(&keys, &tissue)?;
                Case::Hemisphere(Hemisphere::from_keys(&keys)?)
            }
            Kind::Tube => Case::Tube(Tube::from_keys(&keys)?),
            Kind::Uniaxial => Case::Uniaxial(Uniaxial::from_keys(&keys, &tissue)?),
            Kind::Solid => {
                let law = tissue.elasticity.law();
                let solid = Solid::from_keys(&keys, folder, law)?;
                let tissues = std::iter::once(&tissue);
                let parts = solid.parts.iter().filter_map(SolidPart::tissue);
                fibres::check(&keys, solid.fibres.as_deref(), tissues.chain(parts))?;
                Case::Solid(Box::new(solid))
            }
        };
        Ok(Self {
            path: path.to_owned(),
            case,
            material: Material::from_tissue(&tissue)?,
            tissue,
            accuracy: accuracy.unwrap_or(DEFAULT_ACCURACY),
            warnings: keys.warnings(),
        })
    }

    /// The kinds of problems: word, meaning and keys, without `format`, of each.
    pub fn kinds() -> impl Iterator<Item = (&'static str, &'static str, &'static [Key])> {
        let each = KINDS.iter().zip(KIND_MEANINGS);
        each.map(|((word, kind), (_, meaning))| (*word, *meaning, kind.keys()))
    }

    /// The error of the solver, for this problem.
    pub(crate) fn refused(&self, error: palpate_mechanics::Error) -> Error {
        Error::from(error).about(&self.path)
    }

    /// The word of its kind.
    pub fn kind(&self) -> &'static str {
        self.case.word()
    }

    /// Whether the solution has a deformed body.
    pub fn has_field(&self) -> bool {
        matches!(self.case, Case::Indentation(_) | Case::Solid(_))
    }

    /// Whether the load varies in time.
    pub fn has_recording(&self) -> bool {
        matches!(&self.case, Case::Indentation(case) if matches!(case.loading, Loading::Ramp(_)))
    }

    /// Whether the stiffness of the tissue is fitted.
    pub fn fits_stiffness(&self) -> bool {
        matches!(&self.case, Case::Solid(case) if case.fits)
    }

    /// Whether the law is for small strain only.
    pub(crate) fn is_small_strain(&self) -> bool {
        self.tissue.elasticity.law() == LawName::Linear
    }

    /// The tissue, its law and its parameters on one line.
    pub(crate) fn tissue_in_words(&self) -> String {
        let name = self.tissue.name.as_deref().unwrap_or("tissue");
        let parameters = self.tissue.elasticity.parameters();
        let parameters = parameters
            .iter()
            .map(|(key, estimate)| format!(", {key} = {}", estimate.value));
        let law = self.tissue.elasticity.law();
        format!("{name}: {law}{}", parameters.collect::<String>())
    }
}

impl Case {
    /// The word of its kind.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::Indentation(_) => "indentation",
            Self::Hemisphere(_) => "hemisphere",
            Self::Tube(_) => "tube",
            Self::Uniaxial(_) => "uniaxial",
            Self::Solid(_) => "solid",
        }
    }
}

impl Kind {
    /// The keys that a problem of this kind may have, without `format`.
    fn keys(self) -> &'static [Key] {
        static KEYS: LazyLock<Vec<Vec<Key>>> = LazyLock::new(|| {
            let of_kind = |(word, kind): &(&'static str, Kind)| {
                let mut keys = [SHARED, kind.own_keys()].concat();
                // As all declarations, it lives as long as the program.
                keys[0].example = format!("{word:?}").leak();
                if matches!(kind, Kind::Hemisphere) {
                    // It is solved at small strain.
                    keys[2].example = "\"pig-spleen\"";
                }
                keys
            };
            KINDS.iter().map(of_kind).collect()
        });
        &KEYS[self as usize]
    }

    fn own_keys(self) -> &'static [Key] {
        match self {
            Self::Indentation => Indentation::KEYS,
            Self::Hemisphere => Hemisphere::KEYS,
            Self::Tube => Tube::KEYS,
            Self::Uniaxial => Uniaxial::KEYS,
            Self::Solid => Solid::KEYS,
        }
    }
}

fn refuse_large_strain(keys: &Keys<'_>, tissue: &Tissue) -> Result<(), palpate_files::Error> {
    let law = tissue.elasticity.law();
    match law {
        LawName::Linear => Ok(()),
        _ => Err(palpate_files::Error::BadValue {
            place: keys.place_of_key("tissue"),
            key: keys.full_name("tissue.law"),
            found: format!("\"{law}\""),
            expected: "\"linear\", for the hemisphere is solved at small strain".into(),
        }),
    }
}

/// The error for an entry of a list, counted from zero.
fn bad_entry(
    keys: &Keys<'_>,
    key: &'static str,
    entry: (usize, f64),
    expected: String,
) -> palpate_files::Error {
    let (number, value) = entry;
    palpate_files::Error::BadValue {
        place: keys.place_of_key(key),
        key: keys.full_name(&format!("{key}[{number}]")),
        found: value.to_string(),
        expected: expected.into(),
    }
}

/// A list with at least one number, each of a `domain` and below `limit` if there is one.
fn some_numbers(
    keys: &Keys<'_>,
    key: &'static str,
    limit: Option<(f64, &str)>,
) -> Result<Vec<f64>, palpate_files::Error> {
    let numbers = keys.required_numbers(key)?;
    if numbers.is_empty() {
        return Err(keys.invalid(key, "at least one number in the list"));
    }
    if let Some((limit, what)) = limit
        && let Some(entry) = numbers.iter().position(|number| *number >= limit)
    {
        let expected = format!("less than {what}, {limit} m");
        return Err(bad_entry(keys, key, (entry, numbers[entry]), expected));
    }
    Ok(numbers)
}

/// A length above zero [m] that must be less than `limit` [m], which is named `what`.
fn length_below(
    keys: &Keys<'_>,
    key: &'static str,
    limit: f64,
    what: &str,
) -> Result<f64, palpate_files::Error> {
    let length = keys.required_number(key)?;
    match length < limit {
        true => Ok(length),
        false => Err(keys.invalid(key, format!("less than {what}, {limit} m"))),
    }
}

/// A table that must be there.
fn required_table<'d>(
    keys: &Keys<'d>,
    key: &'static str,
    example: &'static str,
) -> Result<Keys<'d>, palpate_files::Error> {
    keys.table(key)?
        .ok_or_else(|| keys.missing(key, format!("a table such as `{example}`")))
}
