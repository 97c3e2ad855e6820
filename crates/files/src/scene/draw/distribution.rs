use super::{DEPTH, Drawn, SurfacePoint, Uniform};
use crate::error::Place;
use crate::toml_document::{Entry, Table, Value};
use crate::{Domain, Error, Key, Keys};

/// A named random variable.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Distribution {
    pub(super) name: String,
    place: Place,
    pub(super) recipe: Recipe,
}

/// The distribution of a value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Recipe {
    /// Uniform between two numbers.
    Uniform([f64; 2]),
    /// Uniform in a box.
    UniformVector([[f64; 3]; 2]),
    /// One of several values, with equal probability.
    OneOf(Vec<Drawn>),
    /// Uniform over a part of a surface.
    OnSurface(OnSurface),
    /// A depth below a draw on the surface, against the normal there.
    Below { name: String, depth: Depth },
}

/// A depth below the surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Depth {
    /// [m]
    Fixed(f64),
    /// The name of a draw.
    Drawn(String),
}

/// A part of a surface: within a box, and facing a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnSurface {
    /// The corner of the box with the smallest coordinates [m].
    pub min_m: [f64; 3],
    /// The corner of the box with the largest coordinates [m].
    pub max_m: [f64; 3],
    /// The normals there are within 60° of this direction; none for all [-].
    pub facing: Option<[f64; 3]>,
    /// The neighbour whose surface it is, from 0; none for the organ's.
    pub neighbour: Option<usize>,
}

/// No scene has more neighbours.
const MAX_NEIGHBOURS: u64 = 1000;

/// The keys of a draw, of which one says how.
pub(crate) const KEYS: &[Key] = &[
    Key::other(
        "uniform",
        "two numbers, or two vectors",
        "Evenly between the two numbers, or in the box of which the vectors are corners.",
    )
    .optional("[0.004, 0.008]", "another key says how")
    .in_template(),
    Key::other(
        "one_of",
        "a list of numbers, of vectors or of texts",
        "Each of these as often as the others.",
    )
    .optional("[4.0, 8.0]", "another key says how"),
    Key::table(
        "on_surface",
        OnSurface::KEYS,
        "A place, evenly over a part of the surface of the organ or of a neighbour.",
    )
    .optional("", "another key says how"),
    Key::text(
        "below",
        "A place below that of the draw `on_surface` with this name.",
    )
    .optional("\"place\"", "another key says how"),
    Key::number_or_draw("depth_m", DEPTH, "How far below, against the normal there.")
        .optional("0.01", "nothing but `below` has it"),
];

impl OnSurface {
    const KEYS: &'static [Key] = &[
        Key::vector(
            "min_m",
            Domain::POSITION,
            "The corner of a box with the smallest coordinates.",
        )
        .required("[-0.05, -0.05, 0.0]"),
        Key::vector(
            "max_m",
            Domain::POSITION,
            "The corner with the largest coordinates.",
        )
        .required("[0.05, 0.05, 0.05]"),
        Key::direction(
            "facing",
            "The normals there are within 60 degrees of this direction.",
        )
        .optional("[0.0, 0.0, 1.0]", "all"),
        Key::integer(
            "neighbour",
            1,
            MAX_NEIGHBOURS,
            "The surface is that of the `[[neighbour]]` with this number, from 1 in the order of the file.",
        )
        .optional("1", "it is the organ's"),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            min_m: keys.required_vector("min_m")?,
            max_m: keys.required_vector("max_m")?,
            facing: keys.direction("facing")?,
            neighbour: keys.integer("neighbour")?.map(|number| number as usize - 1),
        })
    }

    /// Whether a point [m] with an outward unit normal belongs to it.
    pub fn contains(&self, point: [f64; 3], normal: [f64; 3]) -> bool {
        let inside =
            (0..3).all(|axis| (self.min_m[axis]..=self.max_m[axis]).contains(&point[axis]));
        inside
            && self.facing.is_none_or(|facing| {
                let length = facing.iter().map(|c| c * c).sum::<f64>().sqrt();
                let along: f64 = (0..3).map(|axis| facing[axis] * normal[axis]).sum();
                along >= 0.5 * length
            })
    }

    /// The middle of the box, with the direction that it faces.
    pub fn middle(&self) -> SurfacePoint {
        let facing = self.facing.unwrap_or([0.0, 0.0, 1.0]);
        let length = facing.iter().map(|c| c * c).sum::<f64>().sqrt();
        SurfacePoint {
            point_m: std::array::from_fn(|axis| 0.5 * (self.min_m[axis] + self.max_m[axis])),
            normal: facing.map(|c| c / length),
        }
    }
}

impl Distribution {
    /// All of a table `[draw]`.
    pub(super) fn all(entry: &Entry, keys: &Keys<'_>) -> Result<Vec<Self>, Error> {
        let Value::Table(table) = &entry.value else {
            return Err(keys.invalid_entry("draw", entry, "a table of distributions"));
        };
        let each = table
            .iter()
            .map(|(name, entry)| Self::one(name, entry, keys));
        let each: Vec<Self> = each.collect::<Result<_, _>>()?;
        for own in &each {
            own.check_names(table)?;
        }
        Ok(each)
    }

    fn one(name: &str, entry: &Entry, keys: &Keys<'_>) -> Result<Self, Error> {
        let expected = "a distribution, such as { uniform = [1.0, 2.0] }";
        let Value::Table(table) = &entry.value else {
            return Err(keys.invalid_entry(name, entry, expected));
        };
        let own = keys.of_entry(&format!("draw.{name}"), entry, table, KEYS);
        own.only_declared()?;
        let recipe = Recipe::from_keys(&own)?;
        Ok(Self {
            name: name.to_owned(),
            place: own.place().clone(),
            recipe: recipe.ok_or_else(|| own.missing("uniform", expected))?,
        })
    }

    /// Checks that the draws that this one refers to exist, and are of the right kind.
    fn check_names(&self, all: &Table) -> Result<(), Error> {
        let Recipe::Below { name, depth } = &self.recipe else {
            return Ok(());
        };
        let has = |name: &str, kind: &str| match all.get(name).map(|entry| &entry.value) {
            Some(Value::Table(table)) => table.contains_key(kind),
            _ => false,
        };
        if !has(name, "on_surface") {
            return Err(self.invalid("below", name, "the name of a draw `on_surface`"));
        }
        match depth {
            Depth::Drawn(name) if !has(name, "uniform") && !has(name, "one_of") => Err(self
                .invalid(
                    "depth_m",
                    name,
                    "a length, or the name of a draw of numbers",
                )),
            _ => Ok(()),
        }
    }

    fn invalid(&self, key: &str, found: &str, expected: &'static str) -> Error {
        Error::BadValue {
            place: self.place.clone(),
            key: format!("draw.{}.{key}", self.name),
            found: format!("{found:?}"),
            expected: expected.into(),
        }
    }

    /// Rejects the surface of a neighbour that a scene with so many does not have.
    pub(super) fn check_neighbour(&self, count: usize) -> Result<(), Error> {
        let neighbour = match &self.recipe {
            Recipe::OnSurface(on) => on.neighbour,
            _ => None,
        };
        match neighbour.filter(|number| *number >= count) {
            None => Ok(()),
            Some(number) => Err(Error::BadValue {
                place: self.place.clone(),
                key: format!("draw.{}.on_surface.neighbour", self.name),
                found: (number + 1).to_string(),
                expected: format!("the number of a `[[neighbour]]`, of which there are {count}")
                    .into(),
            }),
        }
    }

    /// The error for a part of the surface that is empty.
    pub(super) fn no_surface(&self) -> Error {
        Error::BadValue {
            place: self.place.clone(),
            key: format!("draw.{}.on_surface", self.name),
            found: "a box without a part of the surface that faces that way".to_owned(),
            expected: "a box around a part of the surface".into(),
        }
    }

    /// A point below one of `points`, as deep as is stated or among the `values`.
    pub(super) fn below(
        &self,
        points: &[(&str, SurfacePoint)],
        values: &[(String, Drawn)],
    ) -> Result<Drawn, Error> {
        let Recipe::Below { name, depth } = &self.recipe else {
            return Err(self.no_surface());
        };
        let above = points.iter().find(|(own, _)| own == name);
        let (_, above) = above.ok_or_else(|| self.no_surface())?;
        let depth = match depth {
            Depth::Fixed(depth) => *depth,
            Depth::Drawn(depth) => match values.iter().find(|(own, _)| own == depth) {
                Some((_, Drawn::Number(depth))) => *depth,
                _ => return Err(self.invalid("depth_m", depth, "the name of a draw of numbers")),
            },
        };
        let point = std::array::from_fn(|axis| above.point_m[axis] - depth * above.normal[axis]);
        Ok(Drawn::Vector(point))
    }
}

impl Recipe {
    fn from_keys(keys: &Keys<'_>) -> Result<Option<Self>, Error> {
        const KINDS: [&str; 4] = ["uniform", "one_of", "on_surface", "below"];
        let mut given = KINDS.into_iter().filter(|kind| keys.contains(kind));
        let kind = given.next();
        if let (Some(first), Some(second)) = (kind, given.next()) {
            return Err(keys.given_twice(first, second));
        }
        Ok(Some(match kind {
            None => return Ok(None),
            Some("uniform") => Self::uniform(keys)?,
            Some("one_of") => {
                let expected = "a list of numbers, of vectors or of texts";
                let values = keys.values_of("one_of", expected, Drawn::of)?;
                if values.is_empty() {
                    return Err(keys.invalid("one_of", expected));
                }
                Self::OneOf(values)
            }
            Some("on_surface") => match keys.table("on_surface")? {
                Some(on) => Self::OnSurface(OnSurface::from_keys(&on)?),
                None => return Ok(None),
            },
            Some(_) => {
                let depth = match keys.is_text("depth_m") {
                    true => keys.text("depth_m")?.map(Depth::Drawn),
                    false => keys.number("depth_m")?.map(Depth::Fixed),
                };
                let expected = "a length, or the name of a draw of numbers";
                Self::Below {
                    name: keys.text("below")?.unwrap_or_default(),
                    depth: depth.ok_or_else(|| keys.missing("depth_m", expected))?,
                }
            }
        }))
    }

    fn uniform(keys: &Keys<'_>) -> Result<Self, Error> {
        let expected = "two numbers [least, most], or two vectors that are corners of a box";
        let ends = keys.values_of("uniform", expected, Drawn::of)?;
        let finite = |all: &[f64]| all.iter().all(|one| one.is_finite());
        match ends.as_slice() {
            [Drawn::Number(least), Drawn::Number(most)]
                if least <= most && finite(&[*least, *most]) =>
            {
                Ok(Self::Uniform([*least, *most]))
            }
            [Drawn::Vector(least), Drawn::Vector(most)]
                if (0..3).all(|axis| least[axis] <= most[axis])
                    && finite(least)
                    && finite(most) =>
            {
                Ok(Self::UniformVector([*least, *most]))
            }
            _ => Err(keys.invalid("uniform", expected)),
        }
    }

    /// A value; `on_surface` and `below` have none of their own.
    pub(super) fn value(&self, uniform: &mut Uniform<'_>) -> Drawn {
        let mut between = |[least, most]: [f64; 2]| least + (most - least) * uniform.next();
        match self {
            Self::Uniform(ends) => Drawn::Number(between(*ends)),
            Self::UniformVector([least, most]) => Drawn::Vector(std::array::from_fn(|axis| {
                between([least[axis], most[axis]])
            })),
            Self::OneOf(values) => {
                let at = between([0.0, values.len() as f64]) as usize;
                values[at.min(values.len() - 1)].clone()
            }
            Self::OnSurface(on) => Drawn::Vector(on.middle().point_m),
            Self::Below { .. } => Drawn::Vector([0.0; 3]),
        }
    }
}
