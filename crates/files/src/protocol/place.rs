use crate::{Domain, Error, Keys};

/// The indented location on a specimen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredPlace {
    /// Where the indenter moves before it approaches, from the rig's start position, in the rig's axes: x right, y
    /// away from the user, z up [m].
    pub place_m: [f64; 3],
    /// The direction out of the tissue, along which the indenter approaches, presses and withdraws, in the rig's axes
    /// [-].
    pub normal: [f64; 3],
    /// Whether the rig first probes the surface around the location, and uses the measured normal.
    pub measure_normal: bool,
}

/// The surface of a virtual specimen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualSurface {
    /// Its normal where the rig begins [-].
    pub normal: [f64; 3],
    /// The radius of its curvature [m]; none for a plane.
    pub radius_m: Option<f64>,
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];

impl MeasuredPlace {
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            place_m: keys.vector("place_m")?.unwrap_or_default(),
            normal: upward(keys, "normal")?.unwrap_or(UP),
            measure_normal: keys.boolean("measure_normal")?.unwrap_or(false),
        })
    }
}

impl VirtualSurface {
    pub(super) fn from_keys(keys: &Keys<'_>) -> Result<Self, Error> {
        Ok(Self {
            normal: upward(keys, "surface_normal")?.unwrap_or(UP),
            radius_m: keys.number("surface_radius_m")?,
        })
    }
}

/// A location on a specimen [m].
pub(super) const PLACE: Domain = Domain::POSITION.usually(-0.2, 0.2);

/// A direction with an upward component.
pub(super) fn upward(keys: &Keys<'_>, key: &'static str) -> Result<Option<[f64; 3]>, Error> {
    match keys.direction(key)? {
        Some(direction) if direction[2] <= 0.0 => Err(keys.invalid(
            key,
            "a direction whose z is above 0, such as [0.0, 0.2, 1.0]: tissue lies below, and the tip hangs from its device",
        )),
        direction => Ok(direction),
    }
}
