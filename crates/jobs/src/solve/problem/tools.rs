//! Rigid tools that press a solid.

use std::ops::Bound::Included;

use nalgebra::Rotation3;
use palpate_files::{Domain, Error, Key, Keys, Word};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::{Friction, FrictionLaw};
use palpate_mechanics::finite_elements::rigid_tool::{RigidShape, RigidTool};

use super::{BOND_MEANINGS, BONDS};

/// A rigid tool, which may have two jaws.
#[derive(Debug, Clone)]
pub(crate) struct Tool {
    pub(crate) name: String,
    pub(crate) bodies: Vec<RigidTool>,
}

/// The shapes of a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Sphere,
    FlatPunch,
    Cone,
    Cylinder,
    Bar,
    Plate,
    Jaws,
}

const SHAPES: &[(&str, Shape)] = &[
    ("sphere", Shape::Sphere),
    ("flat_punch", Shape::FlatPunch),
    ("cone", Shape::Cone),
    ("cylinder", Shape::Cylinder),
    ("bar", Shape::Bar),
    ("plate", Shape::Plate),
    ("jaws", Shape::Jaws),
];

const SHAPE_MEANINGS: &[Word] = &[
    ("sphere", "A ball of `radius_m`; its place is its centre."),
    (
        "flat_punch",
        "The flat end of a cylinder of `radius_m`, with an edge of `edge_radius_m`; its place is the middle of its face.",
    ),
    (
        "cone",
        "A cone of `half_angle_deg`, with an apex of `edge_radius_m`; its place is its apex.",
    ),
    (
        "cylinder",
        "A cylinder of `radius_m` and `length_m` with round ends that lies along `along`; its place is its middle.",
    ),
    (
        "bar",
        "A cuboid of `lengths_m`: along `along`, across it, and along `direction`, with edges of `edge_radius_m`; its place is \
         its middle.",
    ),
    (
        "plate",
        "All that is behind a plane, larger than the body; its place is a point of the plane.",
    ),
    (
        "jaws",
        "Two bars of `lengths_m`: along `direction`, across the plane in which they close, and thick, with edges of \
         `edge_radius_m`. They close along `along`, `opening_m` apart; their place is the middle between them.",
    ),
];

/// Lengths that a shape may lack [m].
pub(super) const ROUNDING: Domain =
    Domain::quantity("a radius", "m", [Included(0.0), Included(1.0)]);
const OPENING: Domain = Domain::quantity("a length", "m", [Included(0.0), Included(1.0)]);

/// Tolerance within which a vector is parallel to a direction [-].
const ALONG: f64 = 1e-6;

impl Tool {
    pub(crate) const KEYS: &'static [Key] = &[
        Key::text("name", "What people call it.").optional("\"probe\"", "its number"),
        Key::word("shape", SHAPE_MEANINGS, "Its shape.").required("\"sphere\""),
        Key::number("radius_m", Domain::LENGTH, "Its radius.")
            .optional("0.004", "its shape has none")
            .in_template(),
        Key::number(
            "edge_radius_m",
            ROUNDING,
            "The radius to which edges, or the apex of a cone, are rounded; sharp ones need fine meshes.",
        )
        .optional("0.0005", "edges are sharp"),
        Key::number(
            "half_angle_deg",
            Domain::HALF_ANGLE,
            "The angle between a cone's axis and its side.",
        )
        .optional("70.3", "it is no cone"),
        Key::number("length_m", Domain::LENGTH, "The length of a cylinder, with its ends.")
            .optional("0.03", "it is no cylinder"),
        Key::vector("lengths_m", Domain::LENGTH, "The three lengths of a bar or of each jaw.")
            .optional("[0.02, 0.005, 0.003]", "it is neither"),
        Key::direction("direction", "Where it points to, into the body.")
            .default("[0.0, 0.0, -1.0]"),
        Key::direction(
            "along",
            "A second direction, across the first: in which a cylinder or a bar lies, or jaws close.",
        )
        .optional("[1.0, 0.0, 0.0]", "any"),
        Key::word(
            "contact",
            BOND_MEANINGS,
            "How it holds tissue while it presses it; nothing holds what is pulled away.",
        )
        .default("\"slip\""),
        Key::number(
            "friction",
            Domain::FRICTION,
            "Coulomb's coefficient, in place of `contact`: tissue sticks below this part of the normal force, and slips at it.",
        )
        .optional("0.3", "`contact` says how it holds tissue")
        .in_template(),
        Key::vector("from_m", Domain::POSITION, "Where it is at the beginning, off the body or just on it.")
            .required("[0.0, 0.0, 0.054]"),
        Key::vectors(
            "path_m",
            Domain::POSITION,
            "Where it goes, on straight lines; forces are answered for at each of these places. All tools move together.",
        )
        .required("[[0.0, 0.0, 0.052], [0.005, 0.0, 0.052]]"),
        Key::numbers(
            "opening_m",
            OPENING,
            "How far jaws are apart at the beginning, and at each place of the path.",
        )
        .optional("[0.012, 0.008, 0.008]", "it has no jaws"),
    ];

    pub(crate) fn from_keys(keys: &Keys<'_>, number: usize) -> Result<Self, Error> {
        let shape = keys.word("shape", SHAPES)?.ok_or_else(|| {
            keys.missing("shape", "the tool's shape, such as `shape = \"sphere\"`")
        })?;
        refuse_foreign(keys, shape)?;
        let edge_radius = keys.number("edge_radius_m")?.unwrap_or(0.0);
        let lengths = || keys.required_vector("lengths_m");
        let rigid = match shape {
            Shape::Sphere => RigidShape::Sphere {
                radius: keys.required_number("radius_m")?,
            },
            Shape::FlatPunch => RigidShape::FlatPunch {
                radius: keys.required_number("radius_m")?,
                edge_radius,
            },
            Shape::Cone => RigidShape::Cone {
                half_angle: keys.required_number("half_angle_deg")?.to_radians(),
                apex_radius: edge_radius,
            },
            Shape::Cylinder => RigidShape::Cylinder {
                radius: keys.required_number("radius_m")?,
                length: keys.required_number("length_m")?,
            },
            Shape::Bar | Shape::Jaws => RigidShape::Bar {
                lengths: lengths()?,
                edge_radius,
            },
            Shape::Plate => RigidShape::Plate,
        };
        if !rigid.exists() {
            let key = match shape {
                Shape::Cylinder => "length_m",
                _ => "edge_radius_m",
            };
            let expected = match shape {
                Shape::Cylinder => "at least twice the radius, for the ends are half balls",
                _ => "less than half of the least length that it rounds",
            };
            return Err(keys.invalid(key, expected));
        }
        let direction = keys.direction("direction")?.map_or(-Vec3::z(), Vec3::from);
        let axes = Axes::new(keys, direction)?;
        let mut path = vec![Vec3::from(keys.required_vector("from_m")?)];
        let places = keys.vectors("path_m")?.unwrap_or_default();
        if places.is_empty() {
            return Err(keys.missing("path_m", "where it goes: `path_m = [[x, y, z], ...]`"));
        }
        path.extend(places.into_iter().map(Vec3::from));
        let body = RigidTool {
            shape: rigid,
            orientation: axes.orientation(shape),
            friction: friction(keys)?,
            path,
        };
        let bodies = match shape {
            Shape::Jaws => jaws(keys, &body, lengths()?[2])?,
            _ => vec![body],
        };
        let name = keys.text("name")?;
        Ok(Self {
            name: name.unwrap_or_else(|| format!("tool {}", number + 1)),
            bodies,
        })
    }

    /// The name of each of its bodies.
    pub(crate) fn names(&self) -> impl Iterator<Item = String> + '_ {
        let count = self.bodies.len();
        (0..count).map(move |body| match count {
            1 => self.name.clone(),
            _ => format!("{}, jaw {}", self.name, body + 1),
        })
    }
}

/// The directions of a tool.
struct Axes {
    /// Into the body [-].
    direction: Vec3,
    /// Across that [-].
    along: Vec3,
}

impl Axes {
    fn new(keys: &Keys<'_>, direction: Vec3) -> Result<Self, Error> {
        let direction = direction.normalize();
        let along = keys
            .direction("along")?
            .map(|along| Vec3::from(along).normalize());
        let given = along.is_some();
        let least = direction.iamin();
        let along = along.unwrap_or_else(|| Vec3::ith(least, 1.0));
        let across = along - along.dot(&direction) * direction;
        match across.try_normalize(ALONG) {
            Some(along) => Ok(Self { direction, along }),
            None if given => Err(keys.invalid("along", "another direction than `direction`")),
            None => unreachable!("the least component of a direction is below 0.6"),
        }
    }

    /// From the axes of a shape: the third points out of the body, the first along the tool. Of a jaw the first points into
    /// the body, and the third to the side to which it closes.
    fn orientation(&self, shape: Shape) -> Rotation3<f64> {
        let (first, third) = match shape {
            Shape::Jaws => (self.direction, self.along),
            _ => (self.along, -self.direction),
        };
        let second = third.cross(&first);
        Rotation3::from_basis_unchecked(&[first, second, third])
    }
}

/// Rejects keys that the shape does not have.
fn refuse_foreign(keys: &Keys<'_>, shape: Shape) -> Result<(), Error> {
    use Shape::{Bar, Cone, Cylinder, FlatPunch, Jaws, Sphere};
    let own: [(&'static str, &[Shape], &'static str); 6] = [
        (
            "radius_m",
            &[Sphere, FlatPunch, Cylinder],
            "no radius, for only spheres, flat punches and cylinders have one",
        ),
        (
            "edge_radius_m",
            &[FlatPunch, Cone, Bar, Jaws],
            "no radius of edges, for the shape has none",
        ),
        (
            "half_angle_deg",
            &[Cone],
            "no angle, for only a cone has one",
        ),
        (
            "length_m",
            &[Cylinder],
            "no length, for only a cylinder has one",
        ),
        (
            "lengths_m",
            &[Bar, Jaws],
            "no lengths, for only bars and jaws have them",
        ),
        ("opening_m", &[Jaws], "no opening, for only jaws have one"),
    ];
    for (key, shapes, expected) in own {
        if !shapes.contains(&shape) {
            keys.refuse(key, expected)?;
        }
    }
    Ok(())
}

fn friction(keys: &Keys<'_>) -> Result<FrictionLaw, Error> {
    let contact = keys.word("contact", BONDS)?;
    match (contact, keys.number("friction")?) {
        (Some(_), Some(_)) => Err(keys.given_twice("contact", "friction")),
        (_, Some(coefficient)) => Ok(FrictionLaw::Coulomb(coefficient)),
        (contact, None) => Ok(contact.unwrap_or(Friction::Frictionless).into()),
    }
}

/// The two jaws, each of this `thickness` [m], of a tool whose middle moves as `body`.
fn jaws(keys: &Keys<'_>, body: &RigidTool, thickness: f64) -> Result<Vec<RigidTool>, Error> {
    let openings = keys.required_numbers("opening_m")?;
    if openings.len() != body.path.len() {
        return Err(keys.invalid(
            "opening_m",
            format!(
                "{} numbers: at the beginning, and at each place of `path_m`",
                body.path.len()
            ),
        ));
    }
    let closing = body.orientation * Vec3::z();
    let jaw = |side: f64| {
        let places = body.path.iter().zip(&openings);
        let places =
            places.map(|(middle, opening)| middle + side * 0.5 * (opening + thickness) * closing);
        RigidTool {
            path: places.collect(),
            ..body.clone()
        }
    };
    Ok(vec![jaw(-1.0), jaw(1.0)])
}
