//! Inclusions: whether they lie in the organ, and clear of each other.

use palpate_files::scene::{Inclusion, InclusionShape};
use palpate_geometry::{AabbTree, Surface, Vec3};

use crate::Error;

/// Points around a sphere, and spheres along a capsule.
const AROUND: usize = 200;
const ALONG: usize = 9;

/// Refuses inclusions that reach out of the organ or into each other.
pub(crate) fn check(
    inclusions: &[Inclusion],
    (surface, tree): (&Surface, &AabbTree),
) -> Result<(), Error> {
    for (number, inclusion) in inclusions.iter().enumerate() {
        let outside = |point: Vec3| surface.signed_distance(tree, &point).1;
        let farthest = border(&inclusion.shape).map(outside).fold(0.0, f64::max);
        if farthest > 0.0 {
            return Err(Error::InclusionOutside {
                name: inclusion.name.clone(),
                outside: farthest,
            });
        }
        for other in &inclusions[..number] {
            let meets = |one: &InclusionShape, other: &InclusionShape| {
                border(one).any(|point| other.holds(point.into()))
            };
            if meets(&inclusion.shape, &other.shape) || meets(&other.shape, &inclusion.shape) {
                return Err(Error::InclusionsOverlap {
                    one: other.name.clone(),
                    other: inclusion.name.clone(),
                });
            }
        }
    }
    Ok(())
}

/// Points of the border of a shape [m], spread evenly, and some within a capsule.
fn border(shape: &InclusionShape) -> impl Iterator<Item = Vec3> + '_ {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let parts = match shape {
        InclusionShape::Capsule { .. } => ALONG,
        _ => 1,
    };
    (0..parts).flat_map(move |k| {
        let part = k as f64 / (ALONG - 1) as f64;
        (0..AROUND).map(move |i| {
            let height = 1.0 - (2 * i + 1) as f64 / AROUND as f64;
            let (sine, cosine) = (golden * i as f64).sin_cos();
            let around = (1.0 - height * height).sqrt();
            let unit = [around * cosine, around * sine, height];
            Vec3::from(shape.point(unit, part))
        })
    })
}
