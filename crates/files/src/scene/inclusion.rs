use std::f64::consts::PI;
use std::ops::Bound::{Excluded, Included};
use std::path::{Path, PathBuf};

use super::part::CAVITY;
use super::{CavityContent, LengthUnit, PartContent, Shape, TissueChoice};
use crate::{Domain, Error, Key, Keys};

/// A part of an organ with a tissue of its own, such as a tumour or a vessel, which the hybrid and the nonlinear
/// model solve and the local one estimates, or a cavity, which only the nonlinear model has.
#[derive(Debug, Clone, PartialEq)]
pub struct Inclusion {
    /// Its name, for people.
    pub name: String,
    /// Its location.
    pub place: InclusionPlace,
    /// Its material.
    pub content: PartContent,
}

/// An inclusion with a stiffness ratio to the tissue around it, whose effect on the force is estimated: it needs no
/// preparation, and may be drawn for each attempt.
#[derive(Debug, Clone, PartialEq)]
pub struct EstimatedInclusion {
    /// Its name, for people.
    pub name: String,
    /// Its location.
    pub shape: InclusionShape,
    /// Its modulus over that of the tissue around it [-].
    pub stiffness_ratio: f64,
}

/// The location of an inclusion.
#[derive(Debug, Clone, PartialEq)]
pub enum InclusionPlace {
    /// In a shape.
    Shape(InclusionShape),
    /// Inside of a closed surface in a file.
    Mesh {
        /// The file.
        path: PathBuf,
        /// The unit of its coordinates; none: its own, or a guess from its size.
        unit: Option<LengthUnit>,
    },
}

/// The shape of an inclusion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InclusionShape {
    /// A ball.
    Ball {
        /// Its centre [m].
        center_m: [f64; 3],
        /// Its radius [m].
        radius_m: f64,
    },
    /// An ellipsoid.
    Ellipsoid {
        /// Its centre [m].
        center_m: [f64; 3],
        /// Its semi-axes [m].
        radii_m: [f64; 3],
        /// Rotation about x, then y, then z of the scene, counter-clockwise [rad].
        turn_rad: [f64; 3],
    },
    /// All points within a distance of a line segment.
    Capsule {
        /// One end of the segment [m].
        from_m: [f64; 3],
        /// The other end [m].
        to_m: [f64; 3],
        /// The distance [m].
        radius_m: f64,
    },
}

impl Inclusion {
    /// Its tissue; none of a cavity.
    pub fn tissue(&self) -> Option<&TissueChoice> {
        match &self.content {
            PartContent::Tissue(tissue) => Some(tissue),
            PartContent::Cavity(_) => None,
        }
    }

    /// The content of a cavity.
    pub fn cavity(&self) -> Option<CavityContent> {
        match self.content {
            PartContent::Tissue(_) => None,
            PartContent::Cavity(content) => Some(content),
        }
    }

    /// The keys of an inclusion.
    pub const KEYS: &'static [Key] = &[
        Key::text("name", "What people call it.").optional("\"tumour\"", "its number"),
        Key::table(
            "ball",
            BALL,
            "A ball. One of the three shapes or `mesh` has to be there.",
        )
        .optional("", "another shape is there")
        .in_template(),
        Key::table("ellipsoid", ELLIPSOID, "An ellipsoid.").optional("", "another shape is there"),
        Key::table(
            "capsule",
            CAPSULE,
            "All points within a distance of a line segment.",
        )
        .optional("", "another shape is there"),
        Key::path(
            "mesh",
            "A mesh file with a closed surface in the organ, as of a tumour or a vessel.",
        )
        .optional("\"tumour.stl\"", "another shape is there"),
        Shape::KEYS[1],
        TissueChoice::KEYS[0],
        TissueChoice::KEYS[1]
            .optional(
                "\"pig-liver\"",
                "`tissue`, `cavity` or `stiffness_ratio` is there",
            )
            .in_template(),
        CAVITY,
        STIFFNESS_RATIO,
    ];

    /// The inclusion of a table with these keys, the `number`th from 0; paths begin in `folder`.
    ///
    /// # Errors
    /// When the table has no shape or two, or neither a tissue nor a cavity or both.
    pub fn from_keys(keys: &Keys<'_>, number: usize, folder: &Path) -> Result<Self, Error> {
        let name = keys.text("name")?;
        Ok(Self {
            name: name.unwrap_or_else(|| format!("inclusion {}", number + 1)),
            place: InclusionPlace::from_keys(keys, folder)?,
            content: PartContent::from_keys(keys, folder)?,
        })
    }
}

impl EstimatedInclusion {
    /// That of the `number`th table, from 0, of a `list`; none of a table without a `stiffness_ratio`.
    pub(super) fn from_keys(
        keys: &Keys<'_>,
        list: &str,
        number: usize,
    ) -> Result<Option<Self>, Error> {
        let Some(stiffness_ratio) = keys.number("stiffness_ratio")? else {
            return Ok(None);
        };
        for key in ["tissue", "builtin_tissue", "cavity"] {
            if keys.contains(key) {
                return Err(keys.given_twice("stiffness_ratio", key));
            }
        }
        for key in ["mesh", "mesh_unit", "surface", "layer", "label"] {
            keys.refuse(
                key,
                "nothing together with `stiffness_ratio`, for only the effect of a ball, an ellipsoid or a capsule is estimated; give it a \
                 `tissue`",
            )?;
        }
        let name = keys.text("name")?;
        Ok(Some(Self {
            name: name.unwrap_or_else(|| format!("{list} {}", number + 1)),
            shape: InclusionShape::from_keys(keys)?,
            stiffness_ratio,
        }))
    }

    /// Keys of a ball by the name that these inclusions had first.
    pub(super) const BALL_KEYS: &[Key] = &[
        BALL[0],
        BALL[1],
        Key::number(
            "stiffness_ratio",
            STIFFER,
            "Its modulus over that of the organ.",
        )
        .required("6.0"),
    ];

    /// The ball of a table with these keys, the `number`th from 0.
    pub(super) fn from_ball_keys(keys: &Keys<'_>, number: usize) -> Result<Self, Error> {
        Ok(Self {
            name: format!("nodule {}", number + 1),
            shape: InclusionShape::ball(keys)?,
            stiffness_ratio: keys.required_number("stiffness_ratio")?,
        })
    }

    /// Its middle [m].
    pub fn middle(&self) -> [f64; 3] {
        self.shape.point([0.0; 3], 0.5)
    }
}

const STIFFER: Domain =
    Domain::number("a number", [Excluded(1.0), Included(1e9)]).usually(1.0, 1000.0);

pub(super) const STIFFNESS_RATIO: Key = Key::number(
    "stiffness_ratio",
    STIFFER,
    "In place of a tissue: of a ball, an ellipsoid or a capsule of the organ's tissue so many times as stiff. Its effect on the force \
     is estimated and needs no preparation, so that it may be drawn for each attempt; where it stays, a tissue is more accurate.",
)
.optional("6.0", "it is of a tissue");

/// A radius [m].
const RADIUS: Domain = Domain::quantity("a radius", "m", [Included(1e-6), Included(1e3)]);

pub(super) const BALL: &[Key] = &[
    Key::vector("center_m", Domain::POSITION, "Its centre.").required("[0.02, 0.01, 0.03]"),
    Key::number("radius_m", RADIUS, "Its radius.").required("0.005"),
];

pub(super) const ELLIPSOID: &[Key] = &[
    Key::vector("center_m", Domain::POSITION, "Its centre.").required("[0.0, 0.0, 0.03]"),
    Key::vector("radii_m", RADIUS, "Its semi-axes.").required("[0.01, 0.005, 0.005]"),
    Key::vector(
        "turn_rad",
        Domain::TURN,
        "How it is turned about x, then y, then z of the scene, counter-clockwise.",
    )
    .default("[0.0, 0.0, 0.0]"),
];

pub(super) const CAPSULE: &[Key] = &[
    Key::vector("from_m", Domain::POSITION, "One end of the segment.")
        .required("[-0.02, 0.0, 0.03]"),
    Key::vector("to_m", Domain::POSITION, "The other end.").required("[0.02, 0.0, 0.03]"),
    Key::number("radius_m", RADIUS, "The distance.").required("0.003"),
];

impl InclusionPlace {
    fn from_keys(keys: &Keys<'_>, folder: &Path) -> Result<Self, Error> {
        let Some(mesh) = keys.text("mesh")? else {
            keys.refuse("mesh_unit", "no unit without `mesh`")?;
            return Ok(Self::Shape(InclusionShape::from_keys(keys)?));
        };
        for shape in ["ball", "ellipsoid", "capsule"] {
            if keys.contains(shape) {
                return Err(keys.given_twice("mesh", shape));
            }
        }
        Ok(Self::Mesh {
            path: folder.join(mesh),
            unit: keys.word("mesh_unit", LengthUnit::WORDS)?,
        })
    }
}

impl InclusionShape {
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let ball = keys.table("ball")?;
        let ellipsoid = keys.table("ellipsoid")?;
        let capsule = keys.table("capsule")?;
        match (ball, ellipsoid, capsule) {
            (Some(keys), None, None) => Self::ball(&keys),
            (None, Some(keys), None) => Ok(Self::Ellipsoid {
                center_m: keys.required_vector("center_m")?,
                radii_m: keys.required_vector("radii_m")?,
                turn_rad: keys.vector("turn_rad")?.unwrap_or_default(),
            }),
            (None, None, Some(keys)) => Ok(Self::Capsule {
                from_m: keys.required_vector("from_m")?,
                to_m: keys.required_vector("to_m")?,
                radius_m: keys.required_number("radius_m")?,
            }),
            (None, None, None) => Err(keys.missing(
                "ball",
                "one shape: `ball = { center_m, radius_m }`, `ellipsoid = { center_m, radii_m }`, \
                 `capsule = { from_m, to_m, radius_m }` or `mesh = \"file.stl\"`",
            )),
            (Some(_), Some(_), _) => Err(keys.given_twice("ball", "ellipsoid")),
            (Some(_), _, Some(_)) => Err(keys.given_twice("ball", "capsule")),
            (_, Some(_), Some(_)) => Err(keys.given_twice("ellipsoid", "capsule")),
        }
    }

    fn ball(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self::Ball {
            center_m: keys.required_vector("center_m")?,
            radius_m: keys.required_number("radius_m")?,
        })
    }

    /// The point of the shape [m] with the coordinates `unit` [-] in a ball of radius one, which in a capsule is around the
    /// point at `part` [-], from 0 to 1, of its segment. All of these points are the shape.
    pub fn point(&self, unit: [f64; 3], part: f64) -> [f64; 3] {
        match *self {
            Self::Ball { center_m, radius_m } => sum(center_m, unit.map(|x| radius_m * x)),
            Self::Ellipsoid {
                center_m,
                radii_m,
                turn_rad,
            } => {
                let own = [0, 1, 2].map(|axis| radii_m[axis] * unit[axis]);
                sum(center_m, turned(own, turn_rad))
            }
            Self::Capsule {
                from_m,
                to_m,
                radius_m,
            } => {
                let way = less(to_m, from_m);
                let center = sum(from_m, way.map(|x| part * x));
                sum(center, unit.map(|x| radius_m * x))
            }
        }
    }

    /// Whether a point [m] lies in it or on its border.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        self.off(point) <= 0.0
    }

    /// How far outside a point lies [m], negative inside; for an ellipsoid a lower bound.
    pub fn off(&self, point: [f64; 3]) -> f64 {
        let norm = |v: [f64; 3]| dot(v, v).sqrt();
        match *self {
            Self::Ball { center_m, radius_m } => norm(less(point, center_m)) - radius_m,
            Self::Ellipsoid {
                center_m,
                radii_m,
                turn_rad,
            } => {
                let own = turned_back(less(point, center_m), turn_rad);
                let parts = [0, 1, 2].map(|axis| own[axis] / radii_m[axis]);
                (norm(parts) - 1.0) * self.smallest_radius()
            }
            Self::Capsule {
                from_m,
                to_m,
                radius_m,
            } => {
                let (way, own) = (less(to_m, from_m), less(point, from_m));
                let length = dot(way, way);
                let part = if length > 0.0 {
                    (dot(own, way) / length).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                norm(less(own, way.map(|x| part * x))) - radius_m
            }
        }
    }

    /// Its volume [m³], and its area [m²]; of an ellipsoid an upper bound of that.
    pub fn volume_and_area(&self) -> [f64; 2] {
        let ball = |radius: f64| [4.0 / 3.0 * PI * radius.powi(3), 4.0 * PI * radius * radius];
        match *self {
            Self::Ball { radius_m, .. } => ball(radius_m),
            Self::Ellipsoid { radii_m, .. } => {
                let volume = 4.0 / 3.0 * PI * radii_m.iter().product::<f64>();
                [volume, 3.0 * volume / self.smallest_radius()]
            }
            Self::Capsule {
                from_m,
                to_m,
                radius_m,
            } => {
                let (way, [volume, area]) = (less(to_m, from_m), ball(radius_m));
                let side = 2.0 * PI * radius_m * dot(way, way).sqrt();
                [volume + 0.5 * radius_m * side, area + side]
            }
        }
    }

    /// The smallest of its radii [m].
    pub fn smallest_radius(&self) -> f64 {
        match *self {
            Self::Ball { radius_m, .. } | Self::Capsule { radius_m, .. } => radius_m,
            Self::Ellipsoid { radii_m, .. } => radii_m.into_iter().fold(f64::INFINITY, f64::min),
        }
    }
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn less(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    sum(a, b.map(|x| -x))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// About x, then y, then z.
fn turned(v: [f64; 3], by: [f64; 3]) -> [f64; 3] {
    (0..3).fold(v, |v, axis| about(v, axis, by[axis]))
}

fn turned_back(v: [f64; 3], by: [f64; 3]) -> [f64; 3] {
    (0..3).rev().fold(v, |v, axis| about(v, axis, -by[axis]))
}

fn about(v: [f64; 3], axis: usize, angle: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turned = v;
    turned[j] = cosine * v[j] - sine * v[k];
    turned[k] = sine * v[j] + cosine * v[k];
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Judge: points of a shape's inside, border and outside, made by the map from the ball.
    #[test]
    fn a_shape_holds_the_image_of_the_ball() {
        let shapes = [
            InclusionShape::Ball {
                center_m: [0.1, -0.2, 0.3],
                radius_m: 0.05,
            },
            InclusionShape::Ellipsoid {
                center_m: [0.1, -0.2, 0.3],
                radii_m: [0.05, 0.02, 0.01],
                turn_rad: [0.3, -0.7, 1.1],
            },
            InclusionShape::Capsule {
                from_m: [0.1, -0.2, 0.3],
                to_m: [0.2, -0.1, 0.25],
                radius_m: 0.02,
            },
        ];
        for shape in shapes {
            for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
                let (height, turn) = (0.25 * f64::from(i) - 0.875, 0.7 * f64::from(j));
                let around = (1.0 - height * height).sqrt();
                let unit = [around * turn.cos(), around * turn.sin(), height];
                for part in [0.0, 0.3, 1.0] {
                    let inside = shape.point(unit.map(|x| 0.999 * x), part);
                    assert!(shape.contains(inside), "{shape:?}");
                }
                // The capsule's segment goes along (1, 1, −½).
                let end = f64::from(u8::from(unit[0] + unit[1] - 0.5 * unit[2] > 0.0));
                let outside = shape.point(unit.map(|x| 1.001 * x), end);
                assert!(!shape.contains(outside), "{shape:?}");
            }
        }
    }
}
