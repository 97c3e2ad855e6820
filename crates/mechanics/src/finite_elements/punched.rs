//! Hexahedra under a quarter of a circle: the mesh of a body that a flat round punch meets, between two
//! planes of symmetry.
//!
//! The surface is made of blocks: a square in the middle of the circle, two sectors from there to the
//! circle, two from the circle to a square box, then rectangles. Its quadrilaterals are extruded and put
//! in place by a map, so that a flat block and a tube have the same surface.
//!
//! *How we know*: `hexahedra::…`: patch test, areas, the half-space's stiffness.
//!
//! *Limits*: the map's business where it folds; an element then is refused as inverted.

use super::element::ElementKind;
use super::graded::halved;
use super::mesh::ElementMesh;
use super::mismatch::Mismatch;
use super::surface::Surface;
use crate::{Error, Vec3};

/// Where the lines of the surface run. All places ascend.
#[derive(Debug, Clone, PartialEq)]
pub struct PunchedLines {
    /// Elements along a side of the middle square, which are half of those around the quarter circle.
    pub around: usize,
    /// Places between the middle square and the circle [m]: half the square's side, ..., the radius.
    pub inside: Vec<f64>,
    /// Places between the circle and the box [m]: the radius, ..., half the box's side.
    pub outside: Vec<f64>,
    /// Places beyond the box [m] along both axes: half the box's side, ..., the end.
    pub beyond: [Vec<f64>; 2],
    /// Heights, the last at the surface [m or as the map wants it].
    pub heights: Vec<f64>,
}

/// Places closer than this are one [m], far below any element.
const STEP: f64 = 1e-10;

/// A body of hexahedra with a circle on its surface.
#[derive(Debug, Clone)]
pub struct PunchedMesh {
    /// The elements.
    pub mesh: ElementMesh,
    /// Nodes in and on the quarter circle.
    pub face: Vec<usize>,
    /// Sides at the first height, numbered like [`ElementKind::Quad9`], the normal toward the heights.
    pub lower_sides: Vec<Vec<u32>>,
}

impl PunchedLines {
    /// The same with every interval cut into `parts` equal ones, at least one.
    pub fn split(&self, parts: usize) -> Self {
        let parts = parts.max(1);
        let split = |line: &Vec<f64>| split(line, parts);
        Self {
            around: self.around * parts,
            inside: split(&self.inside),
            outside: split(&self.outside),
            beyond: [split(&self.beyond[0]), split(&self.beyond[1])],
            heights: split(&self.heights),
        }
    }

    /// The body whose point (x, y) of the surface at a height stands at `place`, a map that keeps the
    /// handedness.
    ///
    /// # Errors
    /// When a line does not ascend or does not begin where the one before it ends.
    pub fn body(&self, place: impl Fn(f64, f64, f64) -> Vec3) -> Result<PunchedMesh, Error> {
        self.check()?;
        let surface = self.surface();
        let heights = halved(&self.heights);
        let layer = surface.points.len();
        let nodes = heights
            .iter()
            .flat_map(|&h| surface.points.iter().map(move |&[x, y]| (x, y, h)))
            .map(|(x, y, h)| place(x, y, h))
            .collect();
        let mut elements = Vec::new();
        for k in (0..heights.len() - 1).step_by(2) {
            for face in &surface.faces {
                let above = (0..3).flat_map(|up| face.iter().map(move |&n| (n, up)));
                elements.extend(above.map(|(n, up)| n + ((k + up) * layer) as u32));
            }
        }
        let radius = self.inside.last().copied().unwrap_or(0.0) * (1.0 + 1e-9);
        let top = (heights.len() - 1) * layer;
        let face = (0..layer)
            .filter(|&n| surface.points[n][0].hypot(surface.points[n][1]) <= radius)
            .map(|n| top + n)
            .collect();
        Ok(PunchedMesh {
            mesh: ElementMesh {
                kind: ElementKind::Hex27,
                nodes,
                elements,
            },
            face,
            lower_sides: surface.faces.iter().map(|face| face.to_vec()).collect(),
        })
    }

    fn check(&self) -> Result<(), Mismatch> {
        let [along_x, along_y] = &self.beyond;
        let last = |line: &[f64]| line.last().copied().unwrap_or(0.0);
        let (radius, side) = (last(&self.inside), last(&self.outside));
        let lines = [
            ("inside", &self.inside, None),
            ("outside", &self.outside, Some(radius)),
            ("first `beyond`", along_x, Some(side)),
            ("second `beyond`", along_y, Some(side)),
            ("heights", &self.heights, None),
        ];
        let fault = |line| Err(Mismatch::PunchedLinesOutOfOrder { line });
        for (name, line, start) in lines {
            let ascends = line.len() > 1 && line.windows(2).all(|pair| pair[0] < pair[1]);
            let finite = line.iter().all(|place| place.is_finite());
            // Neighbours may have come to their common place in different ways.
            let apart = |start: f64| line.first().map(|first| (first - start).abs() / start);
            let meets = start.and_then(apart).is_none_or(|apart| apart <= 1e-9);
            if !ascends || !finite || !meets {
                return fault(name);
            }
        }
        match self.around > 0 && self.inside[0] > 0.0 {
            true => Ok(()),
            false => fault("innermost"),
        }
    }

    fn surface(&self) -> Surface {
        let last = |line: &[f64]| line.last().copied().unwrap_or(0.0);
        let (core, radius) = (self.inside[0], last(&self.inside));
        let (wide, first) = (last(&self.outside), radius);
        let even: Vec<f64> = (0..=self.around)
            .map(|i| i as f64 / self.around as f64)
            .collect();
        let side: Vec<f64> = even.iter().map(|v| v * wide).collect();
        let [far_x, far_y] = &self.beyond;
        let on_circle = |v: f64| {
            let angle = v * std::f64::consts::FRAC_PI_4;
            [first * angle.cos(), first * angle.sin()]
        };
        let blend = |from: [f64; 2], to: [f64; 2], part: f64| {
            [0, 1].map(|i| from[i] + part * (to[i] - from[i]))
        };
        let to_circle =
            |r: f64, v: f64| blend([core, core * v], on_circle(v), (r - core) / (radius - core));
        let to_box = |r: f64, v: f64| {
            blend(
                on_circle(v),
                [wide, wide * v],
                (r - radius) / (wide - radius),
            )
        };
        let mut surface = Surface::new(STEP);
        surface.add(&even, &even, |u, v| [core * u, core * v]);
        surface.add(&self.inside, &even, to_circle);
        surface.add(&self.outside, &even, to_box);
        // The other two sectors are their mirror images.
        surface.add(&even, &self.inside, |v, r| mirrored(to_circle(r, v)));
        surface.add(&even, &self.outside, |v, r| mirrored(to_box(r, v)));
        surface.add(far_x, &side, |x, y| [x, y]);
        surface.add(&side, far_y, |x, y| [x, y]);
        surface.add(far_x, far_y, |x, y| [x, y]);
        surface
    }
}

fn mirrored([x, y]: [f64; 2]) -> [f64; 2] {
    [y, x]
}

fn split(line: &[f64], parts: usize) -> Vec<f64> {
    let mut all: Vec<f64> = line
        .windows(2)
        .flat_map(|w| {
            let step = (w[1] - w[0]) / parts as f64;
            (0..parts).map(move |i| w[0] + i as f64 * step)
        })
        .collect();
    all.extend(line.last());
    all
}
