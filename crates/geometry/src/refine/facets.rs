//! The parts of a surface between its sharp edges.

use std::collections::{BTreeMap, BTreeSet};

use crate::{AabbTree, SHARP_EDGE, Surface, TriangleId, Vec3, closest_on_triangle};

/// A smaller part of the surface is roughness and belongs to the facet with which it has the longest border [-].
const SMALLEST: f64 = 1e-3;

/// A point this near to a facet lies on it, in extents of the surface [-].
const ON: f64 = 1e-9;

/// A surface with sharp edges: facets, the edges in which two of them meet, and the corners in which more do.
pub(super) struct Facets<'a> {
    surface: &'a Surface,
    /// The facet of each triangle.
    facets: Vec<u32>,
    /// The sharp edges between two facets [m], the lower number first.
    edges: BTreeMap<[u32; 2], Vec<[Vec3; 2]>>,
    /// [m]
    pub(super) corners: Vec<Vec3>,
    tolerance: f64,
}

/// The facets that a point lies on, in ascending order.
pub(super) type On = Vec<u32>;

impl<'a> Facets<'a> {
    /// None where no sharp edge goes around a part of the surface.
    pub(super) fn new(surface: &'a Surface) -> Option<Self> {
        let facets = facets(surface);
        if facets.iter().all(|facet| *facet == facets[0]) {
            return None;
        }
        let mesh = surface.mesh();
        let mut edges: BTreeMap<[u32; 2], Vec<[Vec3; 2]>> = BTreeMap::new();
        for [triangle, other] in borders(surface, |triangle| facets[triangle.index()]) {
            let pair = [triangle, other].map(|t| facets[t.index()]);
            let ends = common_edge(surface, triangle, other);
            edges.entry(sorted(pair)).or_default().push(ends);
        }
        let corners = (0..mesh.vertices().len() as u32).map(crate::NodeId);
        let corners = corners.filter(|node| {
            let around = surface.adjacency().around(*node).iter();
            let met: BTreeSet<u32> = around.map(|t| facets[t.index()]).collect();
            met.len() > 2
        });
        let (low, high) = mesh.bounds();
        Some(Self {
            surface,
            corners: corners.map(|node| mesh.vertices()[node.index()]).collect(),
            facets,
            edges,
            tolerance: ON * (high - low).max(),
        })
    }

    /// The facets that a point [m] lies on.
    pub(super) fn at(&self, tree: &AabbTree, point: &Vec3) -> On {
        let reach = Vec3::repeat(self.tolerance);
        let mut found = On::new();
        tree.visit_box(&(point - reach), &(point + reach), |triangle| {
            let corners = self.surface.mesh().positions(triangle);
            let nearest = closest_on_triangle(&corners, point).position;
            if (nearest - point).norm() <= self.tolerance {
                found.push(self.facets[triangle.index()]);
            }
        });
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Where the chord from `from`, on some facets, to `to`, on others, could cross a sharp edge between them [m]; first where the
    /// ways along both facets are shortest. None where no two of them meet.
    pub(super) fn crossings(&self, from: (&Vec3, &On), to: (&Vec3, &On)) -> Vec<Vec3> {
        let pairs = from
            .1
            .iter()
            .flat_map(|a| to.1.iter().map(move |b| [*a, *b]));
        let edges = pairs.filter_map(|pair| self.edges.get(&sorted(pair)));
        let nearest = edges.map(|edges| {
            let ways = [from.0, to.0].map(|end| (nearest_on(edges, end) - end).norm());
            (ways, edges)
        });
        let nearest = nearest
            .min_by(|(one, _), (other, _)| (one[0] + one[1]).total_cmp(&(other[0] + other[1])));
        let Some(([before, after], edges)) = nearest else {
            return Vec::new();
        };
        let parts = [before / (before + after), 0.5, 0.25, 0.75];
        let places = parts.map(|part| nearest_on(edges, &(from.0 + part * (to.0 - from.0))));
        let finite = |place: &Vec3| place.iter().all(|c| c.is_finite());
        places.into_iter().filter(finite).collect()
    }

    /// The point nearest to `point` [m] on a sharp edge that both of two points lie on; none where they have none in common.
    pub(super) fn nearest_on_edge(&self, point: &Vec3, ends: [&On; 2]) -> Option<Vec3> {
        let common = common(ends[0], ends[1]);
        let pairs = common.iter().flat_map(|a| common.iter().map(|b| [*a, *b]));
        let edges = pairs.filter_map(|pair| self.edges.get(&pair));
        edges
            .map(|edges| nearest_on(edges, point))
            .min_by(|one, other| (one - point).norm().total_cmp(&(other - point).norm()))
    }
}

/// The facets that two points have in common.
pub(super) fn common(one: &On, other: &On) -> On {
    one.iter()
        .copied()
        .filter(|facet| other.contains(facet))
        .collect()
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The point of some segments [m] nearest to another.
fn nearest_on(segments: &[[Vec3; 2]], point: &Vec3) -> Vec3 {
    let places = segments.iter().map(|[a, b]| {
        let along = b - a;
        let part = (point - a).dot(&along) / along.norm_squared();
        a + part.clamp(0.0, 1.0) * along
    });
    let nearest = places.min_by(|one, other| {
        (one - point)
            .norm_squared()
            .total_cmp(&(other - point).norm_squared())
    });
    nearest.unwrap_or(*point)
}

/// Neighbours of different facets, each pair once.
fn borders(
    surface: &Surface,
    facet: impl Fn(TriangleId) -> u32,
) -> impl Iterator<Item = [TriangleId; 2]> {
    surface.mesh().triangle_ids().flat_map(move |triangle| {
        let across = surface.adjacency().across(triangle).into_iter().flatten();
        let others: Vec<_> = across
            .filter(|other| *other > triangle && facet(*other) != facet(triangle))
            .collect();
        others.into_iter().map(move |other| [triangle, other])
    })
}

/// The edge that two neighbours have in common [m].
fn common_edge(surface: &Surface, triangle: TriangleId, other: TriangleId) -> [Vec3; 2] {
    let mesh = surface.mesh();
    let others = mesh.corners(other);
    let mut ends = mesh
        .corners(triangle)
        .into_iter()
        .filter(|node| others.contains(node));
    [(); 2].map(|()| {
        ends.next()
            .map_or(Vec3::zeros(), |node| mesh.vertices()[node.index()])
    })
}

/// The facet of each triangle: what hangs together without a sharp edge, small parts with the neighbour of the longest border.
fn facets(surface: &Surface) -> Vec<u32> {
    let mesh = surface.mesh();
    let adjacency = surface.adjacency();
    let normals: Vec<Vec3> = mesh
        .triangle_ids()
        .map(|t| mesh.area_vector(t).normalize())
        .collect();
    const NONE: u32 = u32::MAX;
    let mut facets = vec![NONE; normals.len()];
    let mut areas: Vec<f64> = Vec::new();
    for start in mesh.triangle_ids() {
        if facets[start.index()] != NONE {
            continue;
        }
        let number = areas.len() as u32;
        let mut area = 0.0;
        let mut open = vec![start];
        facets[start.index()] = number;
        while let Some(triangle) = open.pop() {
            area += mesh.area_vector(triangle).norm();
            for other in adjacency.across(triangle).into_iter().flatten() {
                let cosine = normals[triangle.index()].dot(&normals[other.index()]);
                if facets[other.index()] == NONE && cosine >= SHARP_EDGE {
                    facets[other.index()] = number;
                    open.push(other);
                }
            }
        }
        areas.push(area);
    }
    let into = merged(surface, &facets, &mut areas);
    facets.iter().map(|facet| into[*facet as usize]).collect()
}

/// The facet that each one belongs to in the end; the smallest are asked first.
fn merged(surface: &Surface, facets: &[u32], areas: &mut [f64]) -> Vec<u32> {
    let all: f64 = areas.iter().sum();
    let mut into: Vec<u32> = (0..areas.len() as u32).collect();
    let mut borders_of: Vec<Vec<(u32, f64)>> = vec![Vec::new(); areas.len()];
    for [triangle, other] in borders(surface, |triangle| facets[triangle.index()]) {
        let [from, to] = common_edge(surface, triangle, other);
        let length = (to - from).norm();
        let [one, other] = [triangle, other].map(|t| facets[t.index()]);
        borders_of[one as usize].push((other, length));
        borders_of[other as usize].push((one, length));
    }
    let mut order: Vec<u32> = (0..areas.len() as u32).collect();
    order.sort_by(|a, b| areas[*a as usize].total_cmp(&areas[*b as usize]));
    for small in order {
        let small = last(&into, small);
        if areas[small as usize] >= SMALLEST * all {
            continue;
        }
        let mut lengths: BTreeMap<u32, f64> = BTreeMap::new();
        for (other, length) in std::mem::take(&mut borders_of[small as usize]) {
            let other = last(&into, other);
            if other != small {
                *lengths.entry(other).or_default() += length;
            }
        }
        let longest = lengths.iter().max_by(|one, other| one.1.total_cmp(other.1));
        let Some((&neighbour, _)) = longest else {
            continue;
        };
        into[small as usize] = neighbour;
        areas[neighbour as usize] += areas[small as usize];
        borders_of[neighbour as usize].extend(lengths);
    }
    (0..into.len() as u32)
        .map(|facet| last(&into, facet))
        .collect()
}

fn last(into: &[u32], mut facet: u32) -> u32 {
    while into[facet as usize] != facet {
        facet = into[facet as usize];
    }
    facet
}
