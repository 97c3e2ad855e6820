use std::ops::Bound::Included;

use crate::{Domain, Error, Key, Keys};

/// A part of space: planes, boxes and spheres together. A triangle of an organ belongs to it when its
/// centroid lies in one of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Region {
    /// Half-spaces.
    pub planes: Vec<RegionPlane>,
    /// Boxes along the axes.
    pub boxes: Vec<RegionBox>,
    /// Balls.
    pub spheres: Vec<RegionSphere>,
}

/// The half-space that a normal points away from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionPlane {
    /// A point of its border [m].
    pub point_m: [f64; 3],
    /// The direction away from it, of any length but zero [-].
    pub normal: [f64; 3],
}

/// A box along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionBox {
    /// The corner with the smallest coordinates [m].
    pub min_m: [f64; 3],
    /// The corner with the largest coordinates [m].
    pub max_m: [f64; 3],
}

/// A ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegionSphere {
    /// Its centre [m].
    pub center_m: [f64; 3],
    /// Its radius [m].
    pub radius_m: f64,
}

/// A radius of a region [m].
const RADIUS: Domain = Domain::quantity("a radius", "m", [Included(1e-9), Included(1e6)]);

impl Region {
    /// The keys of a region's table.
    pub const KEYS: &'static [Key] = &[
        Key::tables(
            "planes",
            RegionPlane::KEYS,
            "Half-spaces, each of which its normal points away from.",
        )
        .optional("", "none"),
        Key::tables("boxes", RegionBox::KEYS, "Boxes along the axes.").optional("", "none"),
        Key::tables("spheres", RegionSphere::KEYS, "Balls.").optional("", "none"),
    ];

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.planes.is_empty() && self.boxes.is_empty() && self.spheres.is_empty()
    }

    /// Whether a point [m] lies in it or on its border.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        self.planes.iter().any(|plane| plane.contains(point))
            || self.boxes.iter().any(|region| region.contains(point))
            || self.spheres.iter().any(|sphere| sphere.contains(point))
    }

    /// A region from its table, which was opened with [`Region::KEYS`].
    ///
    /// # Errors
    /// When the table does not describe a region.
    pub fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let planes = keys.tables("planes")?;
        let boxes = keys.tables("boxes")?;
        let spheres = keys.tables("spheres")?;
        Ok(Self {
            planes: planes
                .iter()
                .map(RegionPlane::from_keys)
                .collect::<Result<_, _>>()?,
            boxes: boxes
                .iter()
                .map(RegionBox::from_keys)
                .collect::<Result<_, _>>()?,
            spheres: spheres
                .iter()
                .map(RegionSphere::from_keys)
                .collect::<Result<_, _>>()?,
        })
    }
}

impl RegionPlane {
    const KEYS: &[Key] = &[
        Key::vector("point_m", Domain::COORDINATE, "A point of its border.")
            .required("[0.0, 0.0, 0.0]"),
        Key::direction(
            "normal",
            "The direction away from it, of any length but zero.",
        )
        .required("[0.0, 0.0, 1.0]"),
    ];

    /// Whether a point [m] lies in it or on its border.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        (0..3)
            .map(|axis| (point[axis] - self.point_m[axis]) * self.normal[axis])
            .sum::<f64>()
            <= 0.0
    }

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let expected = "a direction, three numbers such as [0.0, 0.0, 1.0]";
        Ok(Self {
            point_m: keys.required_vector("point_m")?,
            normal: keys
                .direction("normal")?
                .ok_or_else(|| keys.missing("normal", expected))?,
        })
    }
}

impl RegionBox {
    const KEYS: &[Key] = &[
        Key::vector(
            "min_m",
            Domain::COORDINATE,
            "The corner with the smallest coordinates.",
        )
        .required("[-0.1, -0.1, -0.1]"),
        Key::vector(
            "max_m",
            Domain::COORDINATE,
            "The corner with the largest coordinates.",
        )
        .required("[0.1, 0.1, 0.0]"),
    ];

    /// Whether a point [m] lies in it or on its border.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        (0..3).all(|axis| (self.min_m[axis]..=self.max_m[axis]).contains(&point[axis]))
    }

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        let region = Self {
            min_m: keys.required_vector("min_m")?,
            max_m: keys.required_vector("max_m")?,
        };
        if (0..3).all(|axis| region.min_m[axis] <= region.max_m[axis]) {
            return Ok(region);
        }
        Err(Error::BadValue {
            place: keys.place().clone(),
            key: keys.full_name("max_m"),
            found: format!("{:?}", region.max_m),
            expected: format!(
                "numbers that are not below those of min_m, {:?}",
                region.min_m
            )
            .into(),
        })
    }
}

impl RegionSphere {
    const KEYS: &[Key] = &[
        Key::vector("center_m", Domain::COORDINATE, "Its centre.").required("[0.0, 0.0, 0.0]"),
        Key::number("radius_m", RADIUS, "Its radius.").required("0.02"),
    ];

    /// Whether a point [m] lies in it or on its border.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        let squares = (0..3).map(|axis| (point[axis] - self.center_m[axis]).powi(2));
        squares.sum::<f64>() <= self.radius_m.powi(2)
    }

    fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            center_m: keys.required_vector("center_m")?,
            radius_m: keys.required_number("radius_m")?,
        })
    }
}
