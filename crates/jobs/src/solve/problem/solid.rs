use std::ops::Bound::Included;
use std::path::Path;

use palpate_files::scene::{Region, RegionBox, RegionSphere, Shape};
use palpate_files::tissue::LawName;
use palpate_files::{Domain, Error, Key, Keys, Place};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::Friction;
use palpate_mechanics::finite_elements::solid::{LoadPlace, SurfaceLoad};

use super::fibres::Fibres;
use super::regions::{self, SolidPart};
use super::tools::Tool;
use super::{BOND_MEANINGS, BONDS, required_table};
use crate::Error as JobError;

/// An organ of any shape, fixed somewhere, and moved or loaded elsewhere.
#[derive(Debug, Clone)]
pub(crate) struct Solid {
    pub(crate) shape: Shape,
    /// The fixed region; none: the attachment of a built-in organ.
    pub(crate) anchor: Option<Region>,
    /// Directions of the fibres of the tissue, if it has any.
    pub(crate) fibres: Option<Box<Fibres>>,
    pub(crate) patch: Option<Patch>,
    pub(crate) tools: Vec<Tool>,
    /// [m/s²]
    pub(crate) gravity: Option<Vec3>,
    pub(crate) loads: Vec<Load>,
    pub(crate) points: Vec<Point>,
    /// Layers, inclusions and regions of the file.
    pub(crate) parts: Vec<SolidPart>,
    /// Whether the stiffness is fitted to the measured displacements of the points.
    pub(crate) fits: bool,
}

/// The part of the surface that is moved.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    /// Points of the surface within the radius [m] of the centre [m] move.
    pub(crate) center: Vec3,
    /// [m]
    pub(crate) radius: f64,
    /// [m]
    pub(crate) displacement: Vec3,
    pub(crate) contact: Friction,
}

/// A force or a pressure on the surface.
#[derive(Debug, Clone)]
pub(crate) struct Load {
    pub(crate) load: SurfaceLoad,
    /// Its place in the document, and the full name of the key of its location.
    pub(crate) place: Place,
    pub(crate) key: String,
}

/// A point of the body whose displacement is requested.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) name: String,
    /// [m]
    pub(crate) at: Vec3,
    /// Whether it is replaced by the nearest material point.
    pub(crate) is_nearest: bool,
    /// Measured displacement [m], along a direction of length one [-].
    pub(crate) measured: Option<(Vec3, f64)>,
    /// Its place in the document, and the full name of its key.
    pub(crate) place: Place,
    pub(crate) key: String,
}

const DISPLACEMENT: Domain =
    Domain::quantity("a displacement", "m", [Included(-1.0), Included(1.0)]).usually(-0.1, 0.1);

const FORCE: Domain =
    Domain::quantity("a force", "n", [Included(-1e4), Included(1e4)]).usually(-200.0, 200.0);

const EXAMPLE: &str =
    "anchor = { planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }] }";

impl Solid {
    pub(crate) const KEYS: &'static [Key] = &[
        Shape::KEYS[0],
        Shape::KEYS[1],
        Shape::KEYS[2],
        Shape::KEYS[3],
        Key::table("anchor", Region::KEYS, "The fixed part.")
            .optional("", "where a built-in shape grows"),
        Key::table(
            "fibres",
            Fibres::KEYS,
            "Where the fibres of the tissue point to at rest; the law `holzapfel_gasser_ogden` needs it.",
        )
        .optional("", "the tissue has no fibres"),
        Key::table(
            "patch",
            Patch::KEYS,
            "The part of the surface that is moved. A patch, a tool, gravity or a load has to be there.",
        )
        .optional("", "nothing is moved")
        .in_template(),
        Key::tables(
            "tool",
            Tool::KEYS,
            "Rigid tools that press the body where they meet it, and are dragged along it. They move when gravity, loads and \
             the patch have come to their full size.",
        )
        .optional("", "none"),
        Key::vector(
            "gravity_m_per_s2",
            Domain::ACCELERATION,
            "The acceleration by which the body hangs under its own weight; `tissue.density_kg_m3` is its density.",
        )
        .optional("[0.0, 0.0, -9.81]", "it has no weight"),
        Key::tables(
            "load",
            Load::KEYS,
            "Forces on the surface that keep their direction while the body turns, and pressures that stay normal to it.",
        )
        .optional("", "none"),
        Key::tables(
            "point",
            Point::KEYS,
            "Points of the body whose displacement is asked for, with names and measurements.",
        )
        .optional("", "none"),
        Key::vectors(
            "points_m",
            Domain::POSITION,
            "Points whose nearest material points' `displacement_m` is asked for; they come after those of `point`.",
        )
        .optional("[[0.0, 0.015, 0.03]]", "none"),
        regions::KEYS[0],
        regions::KEYS[1],
        regions::KEYS[2],
        Key::boolean(
            "fit_stiffness",
            "Whether the moduli of all tissues are multiplied by the factor with which the points move as measured, by \
             least squares.",
        )
        .default("false"),
    ];

    /// A solid from its table; the body outside of its parts is of `law`.
    pub(crate) fn from_keys(
        keys: &Keys<'_>,
        folder: &Path,
        law: LawName,
    ) -> Result<Self, JobError> {
        let shape = Shape::from_keys(keys, folder)?;
        let anchor = anchor(keys, &shape)?;
        let patch = keys.table("patch")?;
        let gravity = keys.vector("gravity_m_per_s2")?.map(Vec3::from);
        if gravity == Some(Vec3::zeros()) {
            let expected =
                "an acceleration that is not zero, or leave the key out for a body without weight";
            return Err(keys.invalid("gravity_m_per_s2", expected).into());
        }
        let loads = keys.tables("load")?;
        let tools = keys.tables("tool")?;
        let tools = tools.iter().enumerate();
        let tools = tools.map(|(number, keys)| Tool::from_keys(keys, number));
        let named = keys.tables("point")?;
        let points = named.iter().enumerate();
        let points = points.map(|(number, keys)| Point::from_keys(keys, number));
        let mut points: Vec<Point> = points.collect::<Result<_, _>>()?;
        points.extend(Point::nearest(keys, points.len())?);
        let fits = keys.boolean("fit_stiffness")?.unwrap_or(false);
        let solid = Self {
            shape,
            anchor,
            fibres: Fibres::from_keys(keys, folder)?.map(Box::new),
            patch: patch.map(|keys| Patch::from_keys(&keys)).transpose()?,
            tools: tools.collect::<Result<_, _>>()?,
            gravity,
            loads: loads
                .iter()
                .map(Load::from_keys)
                .collect::<Result<_, _>>()?,
            points,
            parts: regions::from_keys(keys, folder, law)?,
            fits,
        };
        let is_loaded = solid.gravity.is_some() || !solid.loads.is_empty();
        let is_moved = solid.patch.is_some() || !solid.tools.is_empty();
        if !is_moved && !is_loaded && !solid.parts.iter().any(SolidPart::presses) {
            return Err(keys.missing(
                "patch",
                "what moves or loads the body: `patch = { center_m = [0.0, 0.0, 0.05], radius_m = 0.003, \
                 displacement_m = [0.0, 0.0, -0.001] }`, a `[[tool]]`, `gravity_m_per_s2 = [0.0, 0.0, -9.81]`, a `[[load]]` or the \
                 pressure of a `cavity`",
            )
            .into());
        }
        if fits {
            solid.can_fit(keys)?;
        }
        Ok(solid)
    }

    /// Whether there are measurements to fit the stiffness to.
    fn can_fit(&self, keys: &Keys<'_>) -> Result<(), Error> {
        let measured = self.points.iter().filter_map(|point| point.measured);
        if self.patch.is_some() || !self.tools.is_empty() {
            let expected =
                "false with a patch or a tool, whose displacement does not depend on the stiffness";
            return Err(keys.invalid("fit_stiffness", expected));
        }
        if measured.map(|(_, way)| way.abs()).sum::<f64>() == 0.0 {
            let expected = "false, or points with `along` and a `measured_m` that is not zero";
            return Err(keys.invalid("fit_stiffness", expected));
        }
        Ok(())
    }
}

impl Patch {
    const KEYS: &[Key] = &[
        Key::vector("center_m", Domain::POSITION, "Its centre.").required("[0.0, 0.0, 0.05]"),
        Key::number(
            "radius_m",
            Domain::LENGTH,
            "Points of the surface within this distance of the centre move.",
        )
        .required("0.003"),
        Key::vector("displacement_m", DISPLACEMENT, "How far they move.")
            .required("[0.0, 0.0, -0.001]"),
        Key::word(
            "contact",
            BOND_MEANINGS,
            "Their tangential boundary condition.",
        )
        .default("\"stick\""),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            center: keys.required_vector("center_m")?.into(),
            radius: keys.required_number("radius_m")?,
            displacement: keys.required_vector("displacement_m")?.into(),
            contact: keys.word("contact", BONDS)?.unwrap_or(Friction::Bonded),
        })
    }
}

impl Load {
    const KEYS: &[Key] = &[
        Key::vector("force_n", FORCE, "The whole force.")
            .optional("[0.0, 0.0, -0.5]", "it is a pressure")
            .in_template(),
        Key::number(
            "pressure_pa",
            Domain::PRESSURE_OR_SUCTION,
            "A pressure towards the inside, in place of `force_n`; it stays normal to the surface while the body deforms. It \
             acts on all of the outer surface where no key says where.",
        )
        .optional("1600.0", "it is a force"),
        Key::table(
            "region",
            Region::KEYS,
            "It acts evenly on the part of the surface in these regions.",
        )
        .optional("", "another key says where it acts")
        .in_template(),
        Key::vectors(
            "box_m",
            Domain::COORDINATE,
            "It acts evenly on the part of the surface in a box along the axes, of which two opposite corners are given.",
        )
        .optional(
            "[[-0.01, -0.01, 0.02], [0.01, 0.01, 0.04]]",
            "another key says where it acts",
        ),
        Key::vector(
            "center_m",
            Domain::COORDINATE,
            "It acts evenly on the part of the surface in a ball about this centre, of `radius_m`.",
        )
        .optional("[0.0, 0.0, 0.03]", "another key says where it acts"),
        Key::number("radius_m", RADIUS, "The radius of the ball about `center_m`.")
            .optional("0.01", "another key says where it acts"),
        Key::table("line", LINE, "It acts evenly along a straight line on the surface, such as an edge.")
            .optional("", "another key says where it acts"),
    ];

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let pressure = keys.number("pressure_pa")?;
        let force = keys.vector("force_n")?.map(Vec3::from);
        if force == Some(Vec3::zeros()) {
            return Err(keys.invalid("force_n", "a force that is not zero"));
        }
        if pressure == Some(0.0) {
            return Err(keys.invalid("pressure_pa", "a pressure that is not zero"));
        }
        let place = Self::place(keys)?;
        // Without a location it is a pressure.
        let key = place.as_ref().map_or("pressure_pa", |(key, _)| key);
        let load = match (force, pressure, place) {
            (Some(_), Some(_), _) => return Err(keys.given_twice("force_n", "pressure_pa")),
            (None, None, _) => {
                let expected = "how large the load is: `force_n = [x, y, z]`, the whole force, or `pressure_pa`";
                return Err(keys.missing("force_n", expected));
            }
            (Some(force), None, Some((_, place))) => SurfaceLoad::Force { place, force },
            (Some(_), None, None) => {
                let expected = "where the force acts: `box_m = [[x, y, z], [x, y, z]]`, `center_m` with `radius_m`, \
                                `region` with planes, boxes or spheres, or `line = { from_m, to_m }`";
                return Err(keys.missing("box_m", expected));
            }
            (None, Some(_), Some((_, LoadPlace::Line(_)))) => {
                return Err(keys.invalid(
                    "line",
                    "a part of the surface for a pressure, by `box_m`, `center_m` or `region`",
                ));
            }
            (None, Some(pressure), Some((_, LoadPlace::Faces(region)))) => SurfaceLoad::Pressure {
                region: Some(region),
                pressure,
            },
            (None, Some(pressure), None) => SurfaceLoad::Pressure {
                region: None,
                pressure,
            },
        };
        Ok(Self {
            load,
            place: keys.place_of_key(key),
            key: keys.full_name(key),
        })
    }

    /// Its location, and the key of that location.
    fn place(keys: &Keys<'_>) -> Result<Option<(&'static str, LoadPlace)>, Error> {
        let places = ["region", "box_m", "center_m", "line"];
        let mut given = places.into_iter().filter(|key| keys.contains(key));
        let key = given.next();
        if let (Some(key), Some(other)) = (key, given.next()) {
            return Err(keys.given_twice(key, other));
        }
        if key != Some("center_m") {
            keys.refuse("radius_m", "`center_m` too, for it is the radius of a ball")?;
        }
        let Some(key) = key else { return Ok(None) };
        let place = match key {
            "box_m" => LoadPlace::Faces(box_of(keys)?),
            "center_m" => LoadPlace::Faces(Region {
                spheres: vec![RegionSphere {
                    center_m: keys.required_vector("center_m")?,
                    radius_m: keys.required_number("radius_m")?,
                }],
                ..Region::default()
            }),
            "line" => LoadPlace::Line(line_of(keys)?),
            _ => {
                let region = required_table(keys, "region", "region = { planes, boxes, spheres }")?;
                LoadPlace::Faces(Region::from_keys(&region)?)
            }
        };
        Ok(Some((key, place)))
    }
}

/// A radius [m].
const RADIUS: Domain = Domain::quantity("a radius", "m", [Included(1e-9), Included(1e6)]);

/// A box is larger by this part of its largest coordinate, or of a metre [-], so that rounding does not lose the surface in a
/// flat one.
const ROUNDING: f64 = 1e-9;

/// The box between two opposite corners.
fn box_of(keys: &Keys<'_>) -> Result<Region, Error> {
    let corners = keys.vectors("box_m")?.unwrap_or_default();
    let [one, other] = corners[..] else {
        return Err(keys.invalid("box_m", "two opposite corners, [[x, y, z], [x, y, z]]"));
    };
    let largest = one
        .iter()
        .chain(&other)
        .fold(1.0, |size: f64, x| size.max(x.abs()));
    let slack = ROUNDING * largest;
    let region = RegionBox {
        min_m: [0, 1, 2].map(|axis| one[axis].min(other[axis]) - slack),
        max_m: [0, 1, 2].map(|axis| one[axis].max(other[axis]) + slack),
    };
    Ok(Region {
        boxes: vec![region],
        ..Region::default()
    })
}

fn line_of(keys: &Keys<'_>) -> Result<[Vec3; 2], Error> {
    let line = required_table(keys, "line", "line = { from_m, to_m }")?;
    let ends = [
        line.required_vector("from_m")?,
        line.required_vector("to_m")?,
    ];
    if ends[0] == ends[1] {
        return Err(line.invalid("to_m", "another point than `from_m`"));
    }
    Ok(ends.map(Vec3::from))
}

const LINE: &[Key] = &[
    Key::vector("from_m", Domain::POSITION, "One end.").required("[0.0, 0.0, 0.03]"),
    Key::vector("to_m", Domain::POSITION, "The other end.").required("[0.0, 0.03, 0.03]"),
];

impl Point {
    const KEYS: &[Key] = &[
        Key::text("name", "What people call it.").optional("\"tip\"", "its number"),
        Key::vector("at_m", Domain::POSITION, "Where it is at rest.")
            .required("[0.0, 0.015, 0.03]"),
        Key::direction("along", "The direction along which it was measured.")
            .optional("[0.0, 0.0, 1.0]", "it was not"),
        Key::number(
            "measured_m",
            DISPLACEMENT,
            "How far along that direction it was measured to move.",
        )
        .optional("-0.0067", "it was not"),
    ];

    fn from_keys(keys: &Keys<'_>, number: usize) -> Result<Self, Error> {
        let name = keys.text("name")?;
        let measured = match (keys.direction("along")?, keys.number("measured_m")?) {
            (Some(along), Some(measured)) => Some((Vec3::from(along).normalize(), measured)),
            (None, None) => None,
            (Some(_), None) => {
                return Err(keys.missing("measured_m", "how far the point moved along `along`"));
            }
            (None, Some(_)) => {
                return Err(keys.missing(
                    "along",
                    "the direction of `measured_m`, such as [0.0, 0.0, 1.0]",
                ));
            }
        };
        Ok(Self {
            name: name.unwrap_or_else(|| format!("point {}", number + 1)),
            at: keys.required_vector("at_m")?.into(),
            is_nearest: false,
            measured,
            place: keys.place_of_key("at_m"),
            key: keys.full_name("at_m"),
        })
    }

    /// The points of the list `points_m`, after so many of `point`.
    fn nearest(keys: &Keys<'_>, before: usize) -> Result<Vec<Self>, Error> {
        let points = keys.vectors("points_m")?.unwrap_or_default();
        let each = points.into_iter().enumerate();
        let point = |(number, at): (usize, [f64; 3])| Self {
            name: format!("point {}", before + number + 1),
            at: at.into(),
            is_nearest: true,
            measured: None,
            place: keys.place_of_key("points_m"),
            key: keys.full_name(&format!("points_m[{number}]")),
        };
        Ok(each.map(point).collect())
    }
}

fn anchor(keys: &Keys<'_>, shape: &Shape) -> Result<Option<Region>, Error> {
    let anchor = keys.table("anchor")?;
    let expected = format!("fixed regions, such as `{EXAMPLE}`");
    match anchor.map(|keys| Region::from_keys(&keys)).transpose()? {
        Some(anchor) if !anchor.is_empty() => Ok(Some(anchor)),
        Some(_) => Err(keys.invalid("anchor", expected)),
        None if matches!(shape, Shape::Builtin { .. }) => Ok(None),
        None => Err(keys.missing("anchor", expected)),
    }
}
