//! The regions of a body: layers from its outer surface inwards, and shapes inside of it.
//!
//! Depth is the distance to the outer surface: the triangles from which one of seven directions, within 35 degrees of the
//! normal, leads away from the body. So the wall of a tube is layered from outside, not from its lumen.

mod borders;

use std::f64::consts::PI;
use std::sync::Arc;

use palpate_files::scene::InclusionShape;
use palpate_geometry::{AabbTree, MeshError, Surface, TriangleMesh, Vec3};

pub use borders::Bordered;

/// Directions in which a triangle of the outer surface may look away: off its normal [-], and how many of these besides the normal.
const OFF_NORMAL: f64 = 0.7;
const DIRECTIONS: usize = 6;

/// Points around a sphere, and spheres along a capsule, that test whether a shape lies in a body.
const AROUND: usize = 200;
const ALONG: usize = 9;

/// A part of a body that has a tissue of its own.
#[derive(Debug, Clone)]
pub enum RegionPlace {
    /// The next layer from outside, of this thickness [m].
    Layer(f64),
    /// A shape inside; it is above layers.
    Shape(InclusionShape),
    /// The inside of a closed surface in the body; it is above layers.
    Enclosed(Enclosed),
}

/// The inside of a closed surface.
#[derive(Debug, Clone)]
pub struct Enclosed {
    surface: Arc<Surface>,
    tree: Arc<AabbTree>,
    /// A third of the cube root of its volume [m].
    size: f64,
}

impl From<Surface> for Enclosed {
    fn from(surface: Surface) -> Self {
        Self {
            tree: Arc::new(AabbTree::new(surface.mesh())),
            size: surface.mesh().volume().abs().cbrt() / 3.0,
            surface: Arc::new(surface),
        }
    }
}

/// Errors in the regions of a body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// A shape reaches out of the body.
    #[error("region {} reaches {outside} m out of the body; make it smaller or move it in", region + 1)]
    Outside {
        /// Its number among the regions, from 0.
        region: usize,
        /// How far [m].
        outside: f64,
    },
    /// Two shapes share a place.
    #[error("regions {} and {} overlap; move them apart", regions[0] + 1, regions[1] + 1)]
    Overlap {
        /// Their numbers among the regions, from 0.
        regions: [usize; 2],
    },
    /// A region has no part of the body.
    #[error("region {} is nowhere in the body; make a layer thinner, or a shape larger", region + 1)]
    Nowhere {
        /// Its number among the regions, from 0.
        region: usize,
    },
    /// The boundary of the body has no inside.
    #[error("layers and shapes need a body whose boundary is a surface: {0}")]
    NoSurface(MeshError),
    /// The layers together are as thick as the body, or thicker.
    #[error("the layers are {} mm thick together, and no place of the body is deeper; make them thinner", 1e3 * thickness)]
    NothingBelowLayers {
        /// Of all layers [m].
        thickness: f64,
    },
}

/// By how much less deep a body may be than its layers are thick, whose surface is of triangles [-].
const MARGIN: f64 = 0.02;

/// The region of each point of a body. Region 0 is the part in no other; the others are numbered from 1, in
/// the order in which they were given.
#[derive(Debug, Clone, Default)]
pub struct RegionMap {
    regions: Vec<Mapped>,
    /// Clearance of each from the surface and from other shapes [m]; infinite for a layer.
    clearances: Vec<f64>,
    /// Triangles from which depths are measured, where there are layers.
    outer: Option<(TriangleMesh, AabbTree)>,
}

#[derive(Debug, Clone)]
enum Mapped {
    /// Depths of the upper and the lower face of a layer [m].
    Layer {
        top: f64,
        bottom: f64,
    },
    Shape(InclusionShape),
    Enclosed(Enclosed),
}

impl RegionMap {
    /// The `places` in the body inside of `surface`, whose tree is `tree`.
    ///
    /// # Errors
    /// When a shape does not lie inside of the body and clear of the others, or there are layers and they are thicker than the body,
    /// or no triangle of the surface looks outwards.
    pub fn new(
        surface: &Surface,
        tree: &AabbTree,
        places: impl IntoIterator<Item = RegionPlace>,
    ) -> Result<Self, RegionError> {
        let mut bottom = 0.0;
        let mut has_layers = false;
        let regions = places.into_iter().map(|place| match place {
            RegionPlace::Layer(thickness) => {
                has_layers = true;
                let top = bottom;
                bottom += thickness;
                Mapped::Layer { top, bottom }
            }
            RegionPlace::Shape(shape) => Mapped::Shape(shape),
            RegionPlace::Enclosed(surface) => Mapped::Enclosed(surface),
        });
        let regions = regions.collect();
        let outer = match has_layers {
            true => Some(outer(surface.mesh(), tree).map_err(RegionError::NoSurface)?),
            false => None,
        };
        let mut map = Self {
            regions,
            clearances: Vec::new(),
            outer,
        };
        map.clearances = map.check(surface, tree)?;
        Ok(map)
    }

    /// The closed surfaces among the regions.
    pub fn enclosed(&self) -> impl Iterator<Item = &Surface> {
        self.regions.iter().filter_map(|region| match region {
            Mapped::Enclosed(enclosed) => Some(enclosed.surface.as_ref()),
            Mapped::Layer { .. } | Mapped::Shape(_) => None,
        })
    }

    /// The geometry of its regions as bytes: the same for equal regions alone.
    pub fn bytes(&self, write: &mut dyn FnMut(&[u8])) {
        for region in &self.regions {
            match region {
                Mapped::Layer { top, bottom } => {
                    write(b"layer");
                    write(&top.to_le_bytes());
                    write(&bottom.to_le_bytes());
                }
                // Numbers are printed so that they are read as the same ones.
                Mapped::Shape(shape) => write(format!("{shape:?}").as_bytes()),
                Mapped::Enclosed(Enclosed { surface, .. }) => {
                    write(b"enclosed");
                    let mesh = surface.mesh();
                    write(&(mesh.vertices().len() as u64).to_le_bytes());
                    for coordinate in mesh.vertices().iter().flatten() {
                        write(&coordinate.to_le_bytes());
                    }
                    for node in mesh.triangles().iter().flatten() {
                        write(&node.0.to_le_bytes());
                    }
                }
            }
        }
    }

    /// Whether the regions are in the body and apart; how far [m].
    fn check(&self, surface: &Surface, tree: &AabbTree) -> Result<Vec<f64>, RegionError> {
        let mut clearances = vec![f64::INFINITY; self.regions.len()];
        let mut borders: Vec<(usize, Vec<Vec3>)> = Vec::new();
        for (region, number) in self.regions.iter().zip(1..) {
            let points = match region {
                Mapped::Layer { .. } => continue,
                Mapped::Shape(shape) => border(shape),
                Mapped::Enclosed(enclosed) => enclosed.surface.mesh().vertices().to_vec(),
            };
            let outside = points.iter();
            let outside = outside.map(|point| surface.signed_distance(tree, point).1);
            let outside = outside.fold(f64::NEG_INFINITY, f64::max);
            let region = number - 1;
            if outside > 0.0 {
                return Err(RegionError::Outside { region, outside });
            }
            clearances[region] = -outside;
            let least = |over: usize, points: &[Vec3]| {
                let heights = points.iter().map(|point| self.height(over, point));
                heights.fold(f64::INFINITY, f64::min)
            };
            for (other, of_other) in &borders {
                let apart = least(number, of_other).min(least(*other, &points));
                let other = other - 1;
                if apart < 0.0 {
                    return Err(RegionError::Overlap {
                        regions: [other, region],
                    });
                }
                for each in [other, region] {
                    clearances[each] = clearances[each].min(apart);
                }
            }
            borders.push((number, points));
        }
        self.check_layers(surface, tree)?;
        Ok(clearances)
    }

    /// Whether the body is as deep as its layers are.
    fn check_layers(&self, surface: &Surface, tree: &AabbTree) -> Result<(), RegionError> {
        let Some((outer, _)) = &self.outer else {
            return Ok(());
        };
        // What lies that deep has its nearest place of the surface straight above it.
        let has_place = |deep: f64| {
            let deep = (1.0 - MARGIN) * deep;
            outer.triangle_ids().any(|triangle| {
                let centroid = outer.positions(triangle).iter().sum::<Vec3>() / 3.0;
                let below = centroid - outer.area_vector(triangle).normalize() * deep;
                self.depth(&below) >= (1.0 - MARGIN) * deep
                    && surface.signed_distance(tree, &below).1 <= 0.0
            })
        };
        for (region, own) in self.regions.iter().enumerate() {
            if matches!(own, Mapped::Layer { top, .. } if *top > 0.0 && !has_place(*top)) {
                return Err(RegionError::Nowhere { region });
            }
        }
        let thickness = self.thickness_of_layers();
        match has_place(thickness) {
            true => Ok(()),
            false => Err(RegionError::NothingBelowLayers { thickness }),
        }
    }

    /// Of all layers together [m].
    pub fn thickness_of_layers(&self) -> f64 {
        let layers = self.regions.iter().filter_map(|region| match region {
            Mapped::Layer { bottom, .. } => Some(*bottom),
            Mapped::Shape(_) | Mapped::Enclosed(_) => None,
        });
        layers.fold(0.0, f64::max)
    }

    /// Numbers of the regions whose borders are levels of [`height`](Self::height): shapes, then layers from outside.
    pub fn bounded(&self) -> impl Iterator<Item = usize> + '_ {
        let of_kind = move |layers: bool| {
            let numbers = 1..=self.regions.len();
            numbers.filter(move |number| self.is_layer(*number) == layers)
        };
        of_kind(false).chain(of_kind(true))
    }

    /// Whether a region is a layer.
    pub fn is_layer(&self, number: usize) -> bool {
        matches!(self.region(number), Some(Mapped::Layer { .. }))
    }

    /// The region of a number; none of region 0, which has no border of its own.
    fn region(&self, number: usize) -> Option<&Mapped> {
        self.regions.get(number.checked_sub(1)?)
    }

    /// How far a point [m] lies outside of a shape, or below the lower face of a layer [m]; negative on the other side, and
    /// infinite for region 0.
    pub fn height(&self, number: usize, place: &Vec3) -> f64 {
        match self.region(number) {
            None => f64::INFINITY,
            Some(Mapped::Layer { bottom, .. }) => self.depth(place) - bottom,
            Some(Mapped::Shape(shape)) => shape.off((*place).into()),
            Some(Mapped::Enclosed(Enclosed { surface, tree, .. })) => {
                surface.signed_distance(tree, place).1
            }
        }
    }

    /// Volume [m³] and area [m²] of a shape or of what a surface encloses; none of what has no border of its own.
    pub fn volume_and_area(&self, number: usize) -> Option<[f64; 2]> {
        match self.region(number)? {
            Mapped::Layer { .. } => None,
            Mapped::Shape(shape) => Some(shape.volume_and_area()),
            Mapped::Enclosed(Enclosed { surface, .. }) => {
                let mesh = surface.mesh();
                Some([mesh.volume().abs(), mesh.area()])
            }
        }
    }

    /// About so many places [m] spread evenly over a shape or what a surface encloses, and the volume of each [m³]; none of what has
    /// no border of its own.
    pub fn places_in(&self, number: usize, about: f64) -> Option<(Vec<Vec3>, f64)> {
        match self.region(number)? {
            Mapped::Layer { .. } => None,
            Mapped::Shape(shape) => places_in_shape(shape, about),
            Mapped::Enclosed(Enclosed { surface, .. }) => {
                let mesh = surface.mesh();
                let is_inside = |place: &Vec3| self.height(number, place) <= 0.0;
                spread(mesh.volume().abs(), about, mesh.vertices(), is_inside)
            }
        }
    }

    /// Distance to the outer surface [m]; infinite without layers.
    fn depth(&self, place: &Vec3) -> f64 {
        let outer = self.outer.as_ref();
        outer.map_or(f64::INFINITY, |(mesh, tree)| {
            tree.nearest(mesh, place).distance
        })
    }

    /// The region of a point that lies below the borders for which `is_below` holds.
    pub fn region_below(&self, is_below: impl FnMut(&usize) -> bool) -> usize {
        self.bounded().find(is_below).unwrap_or(0)
    }

    /// The region of a point [m].
    pub fn at(&self, place: &Vec3) -> usize {
        self.region_below(|number| self.height(*number, place) <= 0.0)
    }

    /// The longest edge at `place` [m], if edges in a shape are to have `of_radius` of its smallest radius [-], and to grow
    /// by `growth` [-] away from it.
    pub fn longest_edge_at_shapes(&self, place: &Vec3, of_radius: f64, growth: f64) -> f64 {
        let edges = self.regions.iter().zip(1..).filter_map(|(region, number)| {
            let size = match region {
                Mapped::Layer { .. } => return None,
                Mapped::Shape(shape) => shape.smallest_radius(),
                Mapped::Enclosed(enclosed) => enclosed.size,
            };
            let off = self.height(number, place).max(0.0);
            Some(of_radius * size + growth * off)
        });
        edges.fold(f64::INFINITY, f64::min)
    }

    /// Thickness of the layer in which a point [m] lies [m]; infinite below them.
    pub fn thickness_at(&self, place: &Vec3) -> f64 {
        if self.outer.is_none() {
            return f64::INFINITY;
        }
        let depth = self.depth(place);
        let found = self.regions.iter().find_map(|region| match region {
            Mapped::Layer { top, bottom } if depth < *bottom => Some(bottom - top),
            _ => None,
        });
        found.unwrap_or(f64::INFINITY)
    }
}

/// Points of the border of a shape [m], spread evenly, and some within a capsule.
fn border(shape: &InclusionShape) -> Vec<Vec3> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let parts = match shape {
        InclusionShape::Capsule { .. } => ALONG,
        _ => 1,
    };
    let mut points = Vec::with_capacity(parts * AROUND);
    for k in 0..parts {
        let part = k as f64 / (ALONG - 1) as f64;
        for i in 0..AROUND {
            let height = 1.0 - (2 * i + 1) as f64 / AROUND as f64;
            let (sine, cosine) = (golden * i as f64).sin_cos();
            let around = (1.0 - height * height).sqrt();
            let unit = [around * cosine, around * sine, height];
            points.push(shape.point(unit, part).into());
        }
    }
    points
}

/// As [`RegionMap::places_in`], of a shape.
pub(crate) fn places_in_shape(shape: &InclusionShape, about: f64) -> Option<(Vec<Vec3>, f64)> {
    let [volume, _] = shape.volume_and_area();
    let is_inside = |place: &Vec3| shape.contains([place.x, place.y, place.z]);
    spread(volume, about, &border(shape), is_inside)
}

/// About so many places [m] of a body of a `volume` [m³] between points of its `border`, and the volume of each [m³].
fn spread(
    volume: f64,
    about: f64,
    border: &[Vec3],
    is_inside: impl Fn(&Vec3) -> bool,
) -> Option<(Vec<Vec3>, f64)> {
    let first = border.first().copied().unwrap_or_default();
    let low = border.iter().fold(first, |low, place| low.inf(place));
    let high = border.iter().fold(first, |high, place| high.sup(place));
    let spacing = (volume / about).cbrt();
    let counts = [0, 1, 2].map(|axis| ((high - low)[axis] / spacing).ceil() as usize);
    let along =
        |axis: usize| (0..counts[axis]).map(move |n| low[axis] + (n as f64 + 0.5) * spacing);
    let mut places = Vec::new();
    for (x, y) in along(0).flat_map(|x| along(1).map(move |y| (x, y))) {
        let column = along(2).map(|z| Vec3::new(x, y, z));
        places.extend(column.filter(&is_inside));
    }
    let each = volume / places.len() as f64;
    (!places.is_empty()).then_some((places, each))
}

/// The triangles of the outer surface.
fn outer(mesh: &TriangleMesh, tree: &AabbTree) -> Result<(TriangleMesh, AabbTree), MeshError> {
    let (low, high) = mesh.bounds();
    let reach = (high - low).norm();
    let looks_out = |triangle| {
        let [a, b, c] = mesh.positions(triangle);
        let area = mesh.area_vector(triangle);
        let normal = area.normalize();
        let along = (b - a).normalize();
        let across = normal.cross(&along);
        let start = (a + b + c) / 3.0 + normal * (1e-3 * (2.0 * area.norm()).sqrt());
        let mut directions = (0..DIRECTIONS).map(|k| {
            let (sine, cosine) = (2.0 * PI * k as f64 / DIRECTIONS as f64).sin_cos();
            (normal + OFF_NORMAL * (cosine * along + sine * across)).normalize()
        });
        let is_free = |direction: &Vec3| tree.cast(mesh, &start, direction, reach).is_none();
        is_free(&normal) || directions.any(|direction| is_free(&direction))
    };
    let triangles: Vec<_> = mesh
        .triangle_ids()
        .filter(|triangle| looks_out(*triangle))
        .map(|triangle| mesh.corners(triangle))
        .collect();
    let triangles = TriangleMesh::new(mesh.vertices().to_vec(), triangles)?;
    let tree = AabbTree::new(&triangles);
    Ok((triangles, tree))
}
