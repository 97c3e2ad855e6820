use std::f64::consts::TAU;

use crate::{Domain, Error, Key, Keys};

/// Points of a circle: the middle of a chord is 0.05 % of the radius off it.
const AROUND: u32 = 96;

/// A line along which to cut: points on the surface at rest, joined by straight pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct CutLine {
    points_m: Vec<[f64; 3]>,
}

impl CutLine {
    /// The straight line between two points [m], which differ.
    pub fn straight(from_m: [f64; 3], to_m: [f64; 3]) -> Self {
        Self {
            points_m: vec![from_m, to_m],
        }
    }

    /// A circle about a centre [m] with a radius [m] above zero, counter-clockwise seen from where the normal, which is
    /// not zero, points to.
    pub fn circle(center_m: [f64; 3], radius_m: f64, normal: [f64; 3]) -> Self {
        let length = dot(normal, normal).sqrt();
        let normal = normal.map(|x| x / length);
        let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()));
        let mut other = [0.0; 3];
        other[least.unwrap_or(0)] = 1.0;
        let first = cross(other, normal);
        let length = dot(first, first).sqrt();
        let first = first.map(|x| x / length);
        let second = cross(normal, first);
        let point = |number: u32| {
            let (sine, cosine) = (TAU * f64::from(number) / f64::from(AROUND)).sin_cos();
            std::array::from_fn(|k| center_m[k] + radius_m * (cosine * first[k] + sine * second[k]))
        };
        // The last point is the first one, to the last bit.
        let points_m = (0..=AROUND).map(|number| point(number % AROUND)).collect();
        Self { points_m }
    }

    /// At least two [m]; the last one of a closed line is the first one.
    pub fn points_m(&self) -> &[[f64; 3]] {
        &self.points_m
    }

    /// Whether it ends where it begins.
    pub fn is_closed(&self) -> bool {
        self.points_m.first() == self.points_m.last()
    }

    pub(super) const FROM: Key = Key::vector(
        "from_m",
        Domain::POSITION,
        "Where a straight line should begin.",
    )
    .required_without("center_m", "[0.0, -0.01, 0.015]");
    pub(super) const TO: Key = Key::vector("to_m", Domain::POSITION, "Where it should end.")
        .required_without("center_m", "[0.0, -0.01, -0.015]");
    pub(super) const CENTER: Key = Key::vector(
        "center_m",
        Domain::POSITION,
        "The centre of a circle, which takes the place of a straight line.",
    )
    .optional("[0.0, 0.0, 0.015]", "the line is straight");
    pub(super) const RADIUS: Key =
        Key::number("radius_m", Domain::LENGTH, "The radius of the circle.")
            .optional("0.014", "the line is straight");
    pub(super) const NORMAL: Key = Key::direction(
        "normal",
        "The normal of the circle's plane, out of the organ.",
    )
    .optional("[0.0, 0.0, 1.0]", "the line is straight");

    pub(super) fn from_keys(cut: &Keys<'_>) -> Result<Self, Error> {
        let straight = ["from_m", "to_m"].into_iter().find(|key| cut.contains(key));
        let circle = ["center_m", "radius_m", "normal"];
        let circle = circle.into_iter().find(|key| cut.contains(key));
        match (straight, circle) {
            (Some(straight), Some(circle)) => Err(cut.given_twice(straight, circle)),
            (None, None) => Err(cut.missing(
                "from_m",
                "a straight line, by `from_m` and `to_m`, or a circle, by `center_m`, `radius_m` and `normal`",
            )),
            (Some(_), None) => {
                let [from_m, to_m] =
                    [cut.required_vector("from_m")?, cut.required_vector("to_m")?];
                if from_m == to_m {
                    return Err(cut.invalid("to_m", "another place than `from_m`"));
                }
                Ok(Self::straight(from_m, to_m))
            }
            (None, Some(_)) => {
                let center_m = cut.required_vector("center_m")?;
                let radius_m = cut.required_number("radius_m")?;
                let normal = cut.direction("normal")?.ok_or_else(|| {
                    cut.missing("normal", "a direction, such as [0.0, 0.0, 1.0]")
                })?;
                Ok(Self::circle(center_m, radius_m, normal))
            }
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}
