use std::collections::{BTreeMap, BTreeSet};

use palpate_files::scene::{Enhancement, EnhancementArea, Smoothing};
use palpate_geometry::{NodeId, TriangleId, TriangleMesh, Vec3};
use palpate_mechanics::enhance::{EnhancedPatch, EnhancementModel, Neighborhood};

use crate::Error;
use crate::m03::{Body, MODELS};
use crate::row::Rows;
use palpate_jobs::plot::{Series, Style};

/// The source's parts of the figure.
const AREAS: [(&str, EnhancementArea); 3] = [
    ("touched", EnhancementArea::None),
    ("edge", EnhancementArea::Edge),
    ("vertex", EnhancementArea::Vertex),
];

/// Each triangle becomes 16.
const LEVELS: usize = 2;

pub(crate) fn run(rows: &mut Rows<'_>) -> Result<(), Error> {
    let cube = Body::new(MODELS[0])?;
    let touched = cube.opposite()[0];
    for (name, area) in AREAS {
        rows.figure(name).draw(drawn(&cube, touched, area)?)?;
    }
    Ok(())
}

fn drawn(cube: &Body, touched: TriangleId, area: EnhancementArea) -> Result<Vec<Series>, Error> {
    let coarse = cube.surface.mesh();
    let settings = Enhancement {
        area,
        levels: LEVELS,
        smoothing: Smoothing::None,
    };
    let model = EnhancementModel::new(cube.surface.clone(), settings)?;
    let mut patch = EnhancedPatch::default();
    patch.build(&model, &[touched]);
    let around = Neighborhood::of(&cube.surface, &[touched], area);
    let middle = |&id: &TriangleId| {
        let sum: Vec3 = coarse.positions(id).iter().sum();
        (1e3 * sum.x / 3.0, 1e3 * sum.y / 3.0)
    };
    // What is drawn later covers what was drawn before.
    let dots = [
        ("cut at the border", around.border()),
        ("made finer", around.refined()),
        ("touched", &[touched]),
    ];
    let edges = edges_of_top(&patch.in_mesh(coarse, patch.places()));
    let edges = Series::new("edges", edges, Style::Line, 0);
    let dots = (1..).zip(dots).map(|(color, (name, ids))| {
        let points = ids.iter().map(middle).collect();
        Series::new(name, points, Style::Dots, color)
    });
    let dots = dots.filter(|dots| !dots.points.is_empty());
    Ok(std::iter::once(edges).chain(dots).collect())
}

/// A walk along all edges that lie on the top [mm], which goes back where it cannot go on.
fn edges_of_top(mesh: &TriangleMesh) -> Vec<(f64, f64)> {
    let (_, high) = mesh.bounds();
    let place = |node: NodeId| mesh.vertices()[node.index()];
    let mut ways: BTreeMap<NodeId, BTreeSet<NodeId>> = BTreeMap::new();
    for corners in mesh.triangles() {
        // Rounding.
        if corners.iter().any(|&node| high.z - place(node).z > 1e-9) {
            continue;
        }
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            ways.entry(from).or_default().insert(to);
            ways.entry(to).or_default().insert(from);
        }
    }
    let mut points = Vec::new();
    let mut walk: Vec<NodeId> = ways.keys().next().copied().into_iter().collect();
    while let Some(&node) = walk.last() {
        points.push((1e3 * place(node).x, 1e3 * place(node).y));
        match ways.get_mut(&node).and_then(BTreeSet::pop_first) {
            Some(next) => {
                if let Some(back) = ways.get_mut(&next) {
                    back.remove(&node);
                }
                walk.push(next);
            }
            None => {
                walk.pop();
            }
        }
    }
    points
}
