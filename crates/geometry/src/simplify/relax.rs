use std::ops::ControlFlow;

use super::guard::{Demands, Guard, NewTriangle, double_area, shape};
use super::net::Net;
use super::reference::Reference;
use crate::{SHARP_EDGE, Vec3};

/// Rounds of flipping, sliding and fitting.
const ROUNDS: usize = 3;

/// Part of the way to the middle of its surroundings that a vertex slides in a round [-].
const SLIDE: f64 = 0.7;

/// Triangles may turn this far when they slide, and this far when an edge is flipped [-]: cosines.
const TURN_OF_SLIDE: f64 = 0.8;
const TURN_OF_FLIP: f64 = 0.85;

/// Evens the triangles out while they keep to the original: edges are flipped where that makes the
/// worse of two triangles better, vertices slide along the surface to the middle of their
/// surroundings and then stand so that the surface is on the mean neither outside of the original
/// nor inside. Vertices on borders and sharp edges stay.
pub(super) fn relax(
    net: &mut Net,
    reference: &Reference<'_>,
    on_crease: &[bool],
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let free: Vec<u32> = (0..net.positions.len() as u32)
        .filter(|&v| !on_crease[v as usize] && !net.is_pinned(v) && !net.around(v).is_empty())
        .collect();
    let mut guard = Guard::new(net);
    for round in 0..ROUNDS {
        progress(round as f64 / (ROUNDS + 1) as f64)?;
        flip_all(net, &mut guard);
        slide_all(net, &mut guard, &free);
        fit_all(net, &mut guard, reference, &free);
    }
    progress(ROUNDS as f64 / (ROUNDS + 1) as f64)?;
    fit_all(net, &mut guard, reference, &free);
    ControlFlow::Continue(())
}

fn flip_all(net: &mut Net, guard: &mut Guard) {
    for edge in net.edges() {
        let [a, b] = edge;
        let Some(diamond) = net.diamond(a, b) else {
            continue;
        };
        let [(left, apex), (right, opposite)] = diamond;
        let areas = [left, right].map(|t| double_area(&net.placed(t)));
        let is_sharp = areas[0].dot(&areas[1]) <= SHARP_EDGE * areas[0].norm() * areas[1].norm();
        let few = [a, b].iter().any(|&v| net.around(v).len() < 4);
        if is_sharp || few {
            continue;
        }
        let fresh = |nodes: [u32; 3]| NewTriangle {
            nodes,
            corners: nodes.map(|v| net.positions[v as usize]),
            before: areas[0] + areas[1],
        };
        let new = [fresh([a, opposite, apex]), fresh([opposite, b, apex])];
        let least = |shapes: [f64; 2]| shapes[0].min(shapes[1]);
        let before = least([left, right].map(|t| shape(&net.placed(t))));
        let after = least([0, 1].map(|k| shape(&new[k].corners)));
        let demands = Demands {
            shape: before,
            turn: TURN_OF_FLIP,
            apart: true,
        };
        if after > before + 1e-9 && guard.admits(net, &[left, right], &new, demands) {
            net.flip(edge, diamond);
            guard.note(left, &new[0].corners);
            guard.note(right, &new[1].corners);
        }
    }
}

fn slide_all(net: &mut Net, guard: &mut Guard, free: &[u32]) {
    for &vertex in free {
        let (mut weights, mut middle, mut upright) = (0.0, Vec3::zeros(), Vec3::zeros());
        for &triangle in net.around(vertex) {
            let corners = net.placed(triangle);
            let double = double_area(&corners);
            weights += double.norm();
            middle += double.norm() * (corners[0] + corners[1] + corners[2]) / 3.0;
            upright += double;
        }
        let Some(normal) = upright.try_normalize(0.0) else {
            continue;
        };
        let here = net.positions[vertex as usize];
        let way = SLIDE * (middle / weights - here);
        // The volume depends on the position of one vertex along this normal alone.
        let along = way - normal * way.dot(&normal);
        for part in [1.0, 0.5, 0.25] {
            if try_to_move(net, guard, vertex, here + part * along) {
                break;
            }
        }
    }
}

fn fit_all(net: &mut Net, guard: &mut Guard, reference: &Reference<'_>, free: &[u32]) {
    let gaps = reference.mean_gaps(net);
    for &vertex in free {
        let normals = net.around(vertex).iter();
        let upright: Vec3 = normals.map(|&t| double_area(&net.placed(t))).sum();
        if let (Some(normal), Some(gap)) = (upright.try_normalize(0.0), gaps[vertex as usize]) {
            let target = net.positions[vertex as usize] - gap * normal;
            try_to_move(net, guard, vertex, target);
        }
    }
}

fn try_to_move(net: &mut Net, guard: &mut Guard, vertex: u32, target: Vec3) -> bool {
    let star = net.around(vertex).to_vec();
    let fresh = |&triangle: &u32| {
        let nodes = net.corners(triangle);
        let before = net.placed(triangle);
        NewTriangle {
            nodes,
            corners: [0, 1, 2].map(|k| {
                if nodes[k] == vertex {
                    target
                } else {
                    before[k]
                }
            }),
            before: double_area(&before),
        }
    };
    let new: Vec<NewTriangle> = star.iter().map(fresh).collect();
    let demands = Demands {
        shape: 0.6,
        turn: TURN_OF_SLIDE,
        apart: true,
    };
    let admitted = guard.admits(net, &star, &new, demands);
    if admitted {
        net.positions[vertex as usize] = target;
        for (&triangle, fresh) in star.iter().zip(&new) {
            guard.note(triangle, &fresh.corners);
        }
    }
    admitted
}
