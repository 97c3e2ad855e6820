//! Where the frames of a segmentation lie: on a lattice, of which some slices may be missing.

use dicom_dictionary_std::tags;
use nalgebra::Matrix3;

use super::Values;
use crate::{ReadFault, Vec3};

/// How far a frame may lie off the lattice, in its steps [-]: positions are written with few digits.
const OFF: f64 = 0.05;

/// Lengths in a file [m].
const MILLIMETRE: f64 = 1e-3;

/// The lattice, and the slice of each frame.
pub(super) struct Lattice {
    /// Steps from voxel to voxel, as columns [m]: along a row, down a column, from slice to slice.
    pub(super) steps: Matrix3<f64>,
    /// Middle of the first voxel [m].
    pub(super) origin: Vec3,
    /// By frame.
    pub(super) slices: Vec<usize>,
    /// How many slices there are, with those that are missing.
    pub(super) count: usize,
}

/// A frame's own group of values before the one that all share.
struct Groups<'o> {
    own: Values<'o>,
    shared: Option<Values<'o>>,
}

impl<'o> Groups<'o> {
    fn find<T>(&self, read: impl Fn(&Values<'o>) -> Option<T>) -> Option<T> {
        read(&self.own).or_else(|| read(self.shared.as_ref()?))
    }

    fn position(&self) -> Option<Vec3> {
        let position = self.find(|group| {
            let plane = group.first(tags::PLANE_POSITION_SEQUENCE)?;
            plane.numbers(tags::IMAGE_POSITION_PATIENT)
        });
        position.map(|own: [f64; 3]| MILLIMETRE * Vec3::from(own))
    }

    fn orientation(&self) -> Option<[f64; 6]> {
        self.find(|group| {
            let plane = group.first(tags::PLANE_ORIENTATION_SEQUENCE)?;
            plane.numbers(tags::IMAGE_ORIENTATION_PATIENT)
        })
    }

    /// From row to row and from column to column [mm].
    fn spacing(&self) -> Option<[f64; 2]> {
        self.find(|group| {
            let measures = group.first(tags::PIXEL_MEASURES_SEQUENCE)?;
            measures.numbers(tags::PIXEL_SPACING)
        })
    }

    /// From slice to slice, else the thickness of a slice [mm].
    fn slice_spacing(&self) -> Option<f64> {
        self.find(|group| {
            let measures = group.first(tags::PIXEL_MEASURES_SEQUENCE)?;
            let apart = measures.numbers::<1>(tags::SPACING_BETWEEN_SLICES);
            let apart = apart.or_else(|| measures.numbers(tags::SLICE_THICKNESS))?;
            Some(apart[0]).filter(|apart| *apart > 0.0)
        })
    }
}

impl Lattice {
    pub(super) fn of(object: &Values<'_>) -> Result<Self, ReadFault> {
        let groups: Vec<_> = object
            .items(tags::PER_FRAME_FUNCTIONAL_GROUPS_SEQUENCE)
            .iter()
            .map(|own| Groups {
                own: Values(own),
                shared: object.first(tags::SHARED_FUNCTIONAL_GROUPS_SEQUENCE),
            })
            .collect();
        let Some(first) = groups.first() else {
            return Err(missing("per-frame functional groups"));
        };
        let orientation = first
            .orientation()
            .ok_or_else(|| missing("image orientation"))?;
        let spacing = first.spacing().ok_or_else(|| missing("pixel spacing"))?;
        if groups
            .iter()
            .any(|own| own.orientation() != Some(orientation) || own.spacing() != Some(spacing))
        {
            return Err(ReadFault::BadHeader {
                what: "orientation and pixel spacing",
                found: "different from frame to frame".to_owned(),
                expected: "one for all frames",
            });
        }
        let [a, b, c, d, e, f] = orientation;
        let (along, down) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
        let is_frame = (along.norm() - 1.0).abs() < 1e-3
            && (down.norm() - 1.0).abs() < 1e-3
            && along.dot(&down).abs() < 1e-3;
        if !is_frame {
            return Err(ReadFault::BadHeader {
                what: "image orientation",
                found: format!("{orientation:?}"),
                expected: "two directions at a right angle",
            });
        }
        let normal = along.cross(&down);
        let positions = groups.iter().map(Groups::position);
        let positions: Option<Vec<_>> = positions.collect();
        let positions = positions.ok_or_else(|| missing("image position"))?;
        let mut heights: Vec<f64> = positions.iter().map(|at| normal.dot(at)).collect();
        let apart = slice_spacing(
            &heights,
            first.slice_spacing().map(|apart| MILLIMETRE * apart),
        )?;
        let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let origin = positions
            .iter()
            .zip(&heights)
            .find(|(_, height)| **height == lowest)
            .map_or(positions[0], |(at, _)| *at);
        heights.iter_mut().for_each(|height| *height -= lowest);
        let widths = spacing.map(|width| MILLIMETRE * width);
        let slices = positions.iter().zip(&heights).map(|(at, height)| {
            let slice = (height / apart).round();
            let off = at - (origin + slice * apart * normal);
            let least = widths[0].min(widths[1]).min(apart);
            (off.norm() <= OFF * least).then_some(slice as usize)
        });
        let slices: Option<Vec<_>> = slices.collect();
        let slices = slices.ok_or_else(|| ReadFault::BadHeader {
            what: "positions of the frames",
            found: format!(
                "off a lattice of {:.3} mm from slice to slice",
                apart / MILLIMETRE
            ),
            expected: "frames at equal distances, one behind the other",
        })?;
        Ok(Self {
            steps: Matrix3::from_columns(&[widths[1] * along, widths[0] * down, apart * normal]),
            origin,
            count: 1 + slices.iter().copied().max().unwrap_or(0),
            slices,
        })
    }
}

/// From slice to slice [m]: as stated, or the least distance of two frames that are not in one slice. A stated distance
/// that the frames contradict is not believed.
fn slice_spacing(heights: &[f64], stated: Option<f64>) -> Result<f64, ReadFault> {
    let mut sorted = heights.to_vec();
    sorted.sort_by(f64::total_cmp);
    let span = sorted[sorted.len() - 1] - sorted[0];
    let noise = 1e-6 * span.max(MILLIMETRE);
    let gaps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let gaps: Vec<f64> = gaps.filter(|gap| *gap > noise).collect();
    let least = gaps.iter().copied().reduce(f64::min);
    let fits = |apart: &f64| {
        gaps.iter().all(|gap| {
            (gap / apart).round() >= 1.0 && (gap / apart - (gap / apart).round()).abs() < OFF
        })
    };
    stated
        .filter(fits)
        .or(least)
        .ok_or_else(|| missing("spacing between slices"))
}

fn missing(what: &'static str) -> ReadFault {
    ReadFault::BadHeader {
        what,
        found: "missing".to_owned(),
        expected: "an entry",
    }
}
