use nalgebra::Rotation3;

use crate::Vec3;

/// Directions of fibres at rest: two unit vectors at right angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FibreFrame {
    axis: Vec3,
    across: Vec3,
}

/// Errors of fibres or of their directions.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FibreError {
    /// The numbers of a law with fibres are those of no solid.
    #[error(
        "C10 is {c10} Pa, k1 {k1} Pa, k2 {k2}, the dispersion {dispersion} and the angle of the fibres {angle_deg} degrees; \
         give a positive C10, k1 and k2 of at least 0, a dispersion from 0 to 1/3 and an angle from 0 to 90 degrees"
    )]
    OutOfRange {
        /// The value given [Pa].
        c10: f64,
        /// The value given [Pa].
        k1: f64,
        /// The value given [-].
        k2: f64,
        /// The value given [-].
        dispersion: f64,
        /// The value given [degrees].
        angle_deg: f64,
    },
    /// A model of isotropic tissue was given fibres.
    #[error(
        "the tissue has fibres, whose direction {model} does not know; give it an isotropic law, such as neo_hookean"
    )]
    NoDirection {
        /// The model.
        model: &'static str,
    },
}

impl FibreFrame {
    /// The first axis along x, the second along y.
    pub const ALONG_AXES: Self = Self {
        axis: Vec3::new(1.0, 0.0, 0.0),
        across: Vec3::new(0.0, 1.0, 0.0),
    };

    /// The reference axis along `axis`, and the plane of the fibres through it and `across`, vectors of any length; none
    /// where they are parallel or zero.
    pub fn new(axis: &Vec3, across: &Vec3) -> Option<Self> {
        let axis = axis.try_normalize(0.0)?;
        let rest = across - across.dot(&axis) * axis;
        // Less is what rounding leaves of parallel vectors.
        let across = rest.try_normalize(1e-9 * across.norm())?;
        let numbers = axis.iter().chain(&across).all(|entry| entry.is_finite());
        numbers.then_some(Self { axis, across })
    }

    /// The same with an arbitrary plane of the fibres through `axis`.
    pub fn along(axis: &Vec3) -> Option<Self> {
        let mut across = Vec3::zeros();
        across[axis.iamin()] = 1.0;
        Self::new(axis, &across)
    }

    /// At a place [m] of a tube around the line through `point` [m] along `line`: the reference axis runs around the line, the
    /// second axis along it. On the line itself, where no direction runs around it, any does; none where `line` is zero.
    pub fn around(point: &Vec3, line: &Vec3, place: &Vec3) -> Option<Self> {
        let around = line.cross(&(place - point));
        Self::new(&around, line).or_else(|| {
            let Self { axis, across } = Self::along(line)?;
            Some(Self {
                axis: across,
                across: axis,
            })
        })
    }

    /// The reference axis, of length one [-].
    pub fn axis(&self) -> &Vec3 {
        &self.axis
    }

    /// The second axis of the plane of the fibres, of length one [-].
    pub fn across(&self) -> &Vec3 {
        &self.across
    }

    /// The same, turned.
    pub fn turned(&self, turn: &Rotation3<f64>) -> Self {
        Self {
            axis: turn * self.axis,
            across: turn * self.across,
        }
    }
}

/// Directions of fibres all over a body at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct FibreField(Directions);

#[derive(Debug, Clone, PartialEq)]
enum Directions {
    Constant(FibreFrame),
    Around {
        point: Vec3,
        line: Vec3,
    },
    /// Ascending by x.
    Nearest(Vec<FibreSample>),
}

/// Directions of fibres at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FibreSample {
    /// The place at rest [m].
    pub place: Vec3,
    /// The directions there.
    pub frame: FibreFrame,
}

impl FibreField {
    /// The same directions everywhere.
    pub fn constant(frame: FibreFrame) -> Self {
        Self(Directions::Constant(frame))
    }

    /// Those of a tube around the line through `point` [m] along `line`: see [`FibreFrame::around`]. None where `line` is zero.
    pub fn around(point: Vec3, line: Vec3) -> Option<Self> {
        FibreFrame::along(&line)?;
        Some(Self(Directions::Around { point, line }))
    }

    /// Those of the nearest of `samples`; none where there is no sample, or one at no place.
    pub fn nearest(mut samples: Vec<FibreSample>) -> Option<Self> {
        let sound = samples
            .iter()
            .flat_map(|sample| sample.place.iter())
            .all(|x| x.is_finite());
        if samples.is_empty() || !sound {
            return None;
        }
        samples.sort_by(|a, b| a.place.x.total_cmp(&b.place.x));
        Some(Self(Directions::Nearest(samples)))
    }

    /// The directions at a place at rest [m].
    pub fn at(&self, place: &Vec3) -> FibreFrame {
        match &self.0 {
            Directions::Constant(frame) => *frame,
            Directions::Around { point, line } => {
                FibreFrame::around(point, line, place).unwrap_or(FibreFrame::ALONG_AXES)
            }
            Directions::Nearest(samples) => nearest(samples, place).frame,
        }
    }
}

/// The nearest of samples that ascend by x.
fn nearest<'a>(samples: &'a [FibreSample], place: &Vec3) -> &'a FibreSample {
    let start = samples.partition_point(|sample| sample.place.x < place.x);
    let (mut best, mut distance) = (&samples[start.min(samples.len() - 1)], f64::INFINITY);
    let mut search = |side: &mut dyn Iterator<Item = &'a FibreSample>| {
        for sample in side {
            let apart = sample.place - place;
            if apart.x * apart.x > distance {
                break;
            }
            if apart.norm_squared() < distance {
                (best, distance) = (sample, apart.norm_squared());
            }
        }
    };
    search(&mut samples[start..].iter());
    search(&mut samples[..start].iter().rev());
    best
}
