//! Scenes with random numbers: a table `[draw]` names distributions, and `{ draw = "NAME" }` stands for a drawn value
//! anywhere else in the scene.
//!
//! A value depends on the seed, its name and nothing else: the uniform numbers of a draw are the first 53 bits of
//! SHA-256 of the seed (8 bytes, little-endian), the name (UTF-8) and their index (8 bytes, little-endian), over 2⁵³.
//! So a new draw changes no other one, and the same seed gives the same bits everywhere.
//!
//! *How we know*: `draw::…`.

mod distribution;
mod substitute;

use std::path::PathBuf;

use sha2::{Digest, Sha256};

use super::Scene;
use crate::toml_document::{Table, Value};
use crate::{Domain, Error, Key, Keys};
pub(super) use distribution::KEYS as DRAW;
pub use distribution::OnSurface;
use distribution::{Distribution, Recipe};

/// The largest seed: every seed is exact in TOML, JSON and a floating-point number.
pub const LARGEST_SEED: u64 = (1 << 53) - 1;

/// The draws of a scene before it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Draws {
    path: PathBuf,
    /// The document without its draws.
    root: Table,
    each: Vec<Distribution>,
}

/// The identity of a variant of a task.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// The seed that it was drawn with.
    pub seed: u64,
    /// Names and values, in alphabetical order.
    pub drawn: Vec<(String, Drawn)>,
}

/// A value that was drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawn {
    /// A number [unit of the key that takes it].
    Number(f64),
    /// Three numbers [unit of the key that takes them].
    Vector([f64; 3]),
    /// A text.
    Text(String),
}

/// A point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Where it is [m].
    pub point_m: [f64; 3],
    /// The outward unit normal there [-].
    pub normal: [f64; 3],
}

/// Finds a point of a surface from three uniform numbers in [0, 1); none where the surface has no such
/// point.
pub type FindOnSurface<'f> = &'f dyn Fn(&OnSurface, [f64; 3]) -> Option<SurfacePoint>;

/// Uniform numbers of one draw.
struct Uniform<'n> {
    seed: u64,
    name: &'n str,
    next: u64,
}

impl Uniform<'_> {
    /// In [0, 1).
    fn next(&mut self) -> f64 {
        let mut hash = Sha256::new();
        hash.update(self.seed.to_le_bytes());
        hash.update(self.name);
        hash.update(self.next.to_le_bytes());
        self.next += 1;
        let bytes: [u8; 32] = hash.finalize().into();
        let first = bytes[..8]
            .iter()
            .rev()
            .fold(0, |bits: u64, byte| bits << 8 | u64::from(*byte));
        (first >> 11) as f64 / (1_u64 << 53) as f64
    }
}

impl Draws {
    /// Takes the draws out of a document; none where it has no `[draw]`. The document then has provisional values in
    /// their places, with which all other keys can be checked: those of seed 0, and for a location on the surface the
    /// middle of its box.
    pub(super) fn take(root: &mut Table, keys: &Keys<'_>) -> Result<Option<Self>, Error> {
        let Some(entry) = root.remove("draw") else {
            return Ok(None);
        };
        let each = Distribution::all(&entry, keys)?;
        let draws = Self {
            path: keys.place().path.clone(),
            root: root.clone(),
            each,
        };
        let in_box = |on: &OnSurface, _| Some(on.middle());
        let provisional = draws.values(0, &in_box)?;
        *root = substitute::in_table(root, &provisional, &draws.path)?;
        Ok(Some(draws))
    }

    /// Rejects surfaces of neighbours that a scene with so many does not have.
    pub(super) fn check_neighbours(&self, count: usize) -> Result<(), Error> {
        self.each
            .iter()
            .try_for_each(|own| own.check_neighbour(count))
    }

    /// The parts of surfaces on which locations are drawn; if there are any, those surfaces must be known.
    pub fn surfaces(&self) -> impl Iterator<Item = &OnSurface> {
        self.each.iter().filter_map(|own| match &own.recipe {
            Recipe::OnSurface(on) => Some(on),
            _ => None,
        })
    }

    fn values(&self, seed: u64, find: FindOnSurface<'_>) -> Result<Vec<(String, Drawn)>, Error> {
        // Draws below the surface come after those on it.
        let (below, first): (Vec<_>, Vec<_>) = self
            .each
            .iter()
            .partition(|own| matches!(own.recipe, Recipe::Below { .. }));
        let mut points: Vec<(&str, SurfacePoint)> = Vec::new();
        let mut values: Vec<(String, Drawn)> = Vec::new();
        for own in first {
            let mut uniform = Uniform {
                seed,
                name: &own.name,
                next: 0,
            };
            let value = match &own.recipe {
                Recipe::OnSurface(on) => {
                    let numbers = [uniform.next(), uniform.next(), uniform.next()];
                    let point = find(on, numbers).ok_or_else(|| own.no_surface())?;
                    points.push((&own.name, point));
                    Drawn::Vector(point.point_m)
                }
                recipe => recipe.value(&mut uniform),
            };
            values.push((own.name.clone(), value));
        }
        for own in below {
            values.push((own.name.clone(), own.below(&points, &values)?));
        }
        values.sort_by(|one, other| one.0.cmp(&other.0));
        Ok(values)
    }
}

impl Scene {
    /// The variant of this scene that belongs to a seed; `find` finds points of surfaces, if any draw
    /// needs them ([`Draws::surfaces`]). A scene that draws nothing, or was drawn, is its only variant.
    ///
    /// # Errors
    /// The seed is larger than [`LARGEST_SEED`], the surface has no point of the requested kind, or a drawn value is
    /// outside the domain of its key.
    pub fn drawn(&self, seed: u64, find: FindOnSurface<'_>) -> Result<Self, Error> {
        let Some(draws) = &self.draws else {
            return Ok(self.clone());
        };
        let drawn = draws.values(seed.min(LARGEST_SEED), find)?;
        let mut root = substitute::in_table(&draws.root, &drawn, &draws.path)?;
        root.insert("variant".to_owned(), substitute::entry(seed, &drawn));
        let text = format!("format = 1\n{}", substitute::text(root));
        // Lines of the text are none of the file's.
        let name = format!("{} (variant {seed})", draws.path.display());
        let mut scene = Self::parse(&text, name)?;
        // It may have been named elsewhere than in the document.
        scene.task.expert.clone_from(&self.task.expert);
        scene.task.picture.clone_from(&self.task.picture);
        Ok(scene)
    }
}

impl Variant {
    pub(super) const KEYS: &'static [Key] = &[
        Key::integer("seed", 0, LARGEST_SEED, "The seed that it was drawn with.").required("1"),
        Key::named("drawn", &[], "What was drawn, by name.").optional("", "nothing"),
    ];

    /// As [`Scene::drawn`] writes it.
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Option<Self>, Error> {
        let Some(own) = keys.table("variant")? else {
            return Ok(None);
        };
        let seed = own.integer("seed")?;
        let expected = format!("a whole number from 0 to {LARGEST_SEED}");
        let seed = seed.ok_or_else(|| own.missing("seed", expected))?;
        let mut drawn = Vec::new();
        for (name, entry) in own.any_table("drawn")?.into_iter().flatten() {
            let expected = "a number, three numbers or a text";
            let value =
                Drawn::of(&entry.value).ok_or_else(|| own.invalid_entry(name, entry, expected))?;
            drawn.push((name.clone(), value));
        }
        Ok(Some(Self { seed, drawn }))
    }
}

impl Drawn {
    fn of(value: &Value) -> Option<Self> {
        let number = |value: &Value| match value {
            Value::Integer(value, _) => Some(*value as f64),
            Value::Number(value, _) => Some(*value),
            _ => None,
        };
        match value {
            Value::Text(text) => Some(Self::Text(text.clone())),
            Value::List(values) => {
                let numbers: Option<Vec<f64>> = values.iter().map(number).collect();
                numbers
                    .and_then(|numbers| numbers.try_into().ok())
                    .map(Self::Vector)
            }
            other => number(other).map(Self::Number),
        }
    }
}

/// A depth below the surface [m].
const DEPTH: Domain = Domain::LENGTH;
