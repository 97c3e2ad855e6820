//! What must hold on every mesh, whatever its shape.

use nalgebra::Matrix3;
use palpate_geometry::{
    AabbTree, ContactPoint, Organ, PatchField, SimplifySettings, Surface, TriangleId, Vec3, follow,
    project_contact_point, simplify,
};

use crate::agreement::real_surfaces;
use crate::shapes::{Random, organ, size, tries};

/// After some triangles have moved, a refitted tree answers as one built afresh.
#[test]
fn refit_is_rebuild() {
    for each in [Organ::Liver, Organ::Esophagus, Organ::Cube] {
        let (surface, mut tree) = organ(each, 3_000);
        let extent = size(surface.mesh());
        let mut mesh = surface.mesh().clone();
        let mut random = Random(1);
        for _ in 0..3 {
            let center = mesh.vertices()[random.below(mesh.vertices().len())];
            let push = random.direction() * (0.1 * extent);
            let moved: Vec<TriangleId> = mesh
                .triangle_ids()
                .filter(|&t| {
                    mesh.positions(t)
                        .iter()
                        .any(|p| (p - center).norm() < 0.2 * extent)
                })
                .collect();
            assert!(!moved.is_empty() && moved.len() < mesh.triangles().len());
            mesh = mesh
                .map_vertices(|v| {
                    let near = (1.0 - (v - center).norm() / (0.2 * extent)).max(0.0);
                    v + near * push
                })
                .unwrap();
            tree.refit(&mesh, &moved);
            let fresh = AabbTree::new(&mesh);
            for _ in 0..tries(2_000) {
                let (point, end) = (random.around(&mesh), random.around(&mesh));
                assert_eq!(tree.nearest(&mesh, &point), fresh.nearest(&mesh, &point));
                let reach = 0.5 * tree.nearest(&mesh, &point).distance;
                let [ours, theirs] =
                    [&tree, &fresh].map(|t| t.is_near_segment(&mesh, [&point, &end], reach));
                assert_eq!(ours, theirs);
                let direction = (end - point).normalize();
                let [ours, theirs] =
                    [&tree, &fresh].map(|t| t.cast(&mesh, &point, &direction, extent));
                assert_eq!(ours, theirs);
                let boxed = |tree: &AabbTree| {
                    let mut found = Vec::new();
                    tree.visit_box(&point.inf(&end), &point.sup(&end), |t| found.push(t));
                    found.sort_unstable();
                    found
                };
                assert_eq!(boxed(&tree), boxed(&fresh));
            }
        }
    }
}

/// A turned organ has turned normals and curvatures.
#[test]
fn patch_field_turns_along() {
    let mut random = Random(2);
    for each in Organ::ALL {
        let (surface, _) = organ(each, 1_000);
        let radius = 0.08 * size(surface.mesh());
        let field = PatchField::new(&surface, radius);
        for _ in 0..tries(30) {
            let turn = random.rotation();
            let turned = Surface::new(surface.mesh().map_vertices(|v| turn * v).unwrap()).unwrap();
            let turned_field = PatchField::new(&turned, radius);
            for t in surface.mesh().triangle_ids() {
                let weights = [0.2, 0.3, 0.5];
                let still = field.at(&surface, t, &weights);
                let moved = turned_field.at(&turned, t, &weights);
                let curvature = turn * still.curvature * turn.transpose();
                // Rounding, amplified by the condition of the fits; curvatures in units of the patch.
                assert!(
                    (moved.normal - turn * still.normal).norm() < 1e-10,
                    "{each}"
                );
                let off = (moved.curvature - curvature).norm() * radius;
                assert!(off < 1e-10, "{each}, triangle {t:?}: {off}");
                // The normal is in the null space and the tensor is symmetric.
                assert!((still.curvature * still.normal).norm() * radius < 1e-12);
                assert!((still.curvature - still.curvature.transpose()).norm() * radius < 1e-12);
            }
        }
    }
}

/// The field is a value at every vertex of every organ, and of every lent mesh.
#[test]
fn patch_field_is_finite_everywhere() {
    for each in Organ::ALL {
        let (surface, _) = organ(each, 2_000);
        for radius in [1e-4, 3e-3, 2e-2] {
            is_finite(each.name(), &surface, radius);
        }
    }
}

#[test]
fn real_organs_have_finite_patch_fields() {
    for (name, surface) in real_surfaces() {
        is_finite(&name, &surface, 5e-3);
    }
}

fn is_finite(name: &str, surface: &Surface, radius: f64) {
    let field = PatchField::new(surface, radius);
    let mut sharpest: f64 = 0.0;
    for t in surface.mesh().triangle_ids() {
        let patch = field.at(surface, t, &[1.0 / 3.0; 3]);
        let finite = patch.curvature.iter().all(|c| c.is_finite());
        assert!(
            finite && (patch.normal.norm() - 1.0).abs() < 1e-12,
            "{name}, {t:?}: {patch:?}"
        );
        sharpest = sharpest.max(patch.curvature.norm());
    }
    println!("{name}: sharpest curvature {sharpest:.0} 1/m over patches of {radius} m");
}

struct Slide {
    /// Largest way of the contact point over that of the tip.
    ratio: f64,
    /// The same, times 1 − d κ.
    after_shrinking: f64,
    steps: usize,
}

/// Slides a tip at `depth` [m] from a random place in a random direction by steps of 0.1 mm, as long as
/// the depth stays below `deepest` radii of curvature.
fn slide(
    surface: &Surface,
    field: &PatchField,
    random: &mut Random,
    depth: f64,
    deepest: f64,
) -> Slide {
    let triangle = TriangleId(random.below(surface.mesh().triangles().len()) as u32);
    let corners = surface.mesh().positions(triangle);
    let mut contact_point = ContactPoint {
        triangle,
        barycentric: [1.0 / 3.0; 3],
        point: corners.iter().sum::<Vec3>() / 3.0,
        normal: field.at(surface, triangle, &[1.0 / 3.0; 3]).normal,
        depth,
    };
    let patch = |f: &ContactPoint| field.at(surface, f.triangle, &f.barycentric);
    let mut direction = random.direction();
    let mut tip = contact_point.point - depth * patch(&contact_point).normal;
    let mut slide = Slide {
        ratio: 0.0,
        after_shrinking: 0.0,
        steps: 0,
    };
    for _ in 0..300 {
        let here = patch(&contact_point);
        let sharpest = here.curvature.symmetric_eigenvalues().max();
        if depth * sharpest > deepest {
            break;
        }
        direction = (direction - here.normal * here.normal.dot(&direction)).normalize();
        let next = tip + 1e-4 * direction;
        let Some(found) = follow(surface, field, &contact_point, &tip, &next) else {
            panic!("lost the contact at {tip}");
        };
        let ratio = (found.point - contact_point.point).norm() / (next - tip).norm();
        slide.ratio = slide.ratio.max(ratio);
        slide.after_shrinking = slide
            .after_shrinking
            .max(ratio * (1.0 - depth * sharpest.max(0.0)));
        slide.steps += 1;
        contact_point = found;
        // Back to the same depth.
        tip = next + patch(&contact_point).normal * (contact_point.depth - depth);
        contact_point.depth = depth;
    }
    slide
}

/// A layer at depth d below a surface of curvature κ is shorter by 1 − d κ, so the contact point runs
/// ahead of the tip by the inverse. On a smooth surface that is all; a mesh adds the change of the
/// averaged normals from triangle to triangle, which may be as large again.
#[test]
fn slide_has_no_leaps() {
    // The hemisphere's rim is a sharp edge, over which normals turn within a triangle: not near it.
    for (each, triangles, radius, deepest) in [
        (Organ::Hemisphere, 3_072, 5e-3, 0.2),
        (Organ::Liver, 6_000, 8e-3, 0.5),
        (Organ::Liver, 20_000, 5e-3, 0.5),
    ] {
        let (surface, _) = organ(each, triangles);
        let field = PatchField::new(&surface, radius);
        let mut random = Random(4);
        for depth in [1e-3, 2e-3, 3e-3] {
            let (mut ratio, mut after, mut steps) = (0.0f64, 0.0f64, 0);
            for _ in 0..tries(300) {
                let slide = slide(&surface, &field, &mut random, depth, deepest);
                ratio = ratio.max(slide.ratio);
                after = after.max(slide.after_shrinking);
                steps += slide.steps;
            }
            println!(
                "{each}, {triangles}, {depth} m: the contact moves {ratio:.3} times the tip, {after:.3} after shrinking, {steps} steps"
            );
            assert!(steps > 1_000, "{steps}");
            // Twice the inverse, and the slides stop where d κ is ½ at the latest.
            assert!(
                after < 2.0 && ratio < 4.0,
                "{each}, {depth} m: {ratio} {after}"
            );
        }
    }
}

/// A coarser mesh under a fine one: where a point of the fine one lies on it goes on without leaps, as far as a
/// normal passes through it. Judge: the nearest point, which leaps. Tolerance: a facet is a few times as long
/// as what is above it, where the mesh is bent most.
#[test]
fn a_place_on_a_coarser_mesh_does_not_leap() {
    let (fine, tree) = organ(Organ::Esophagus, 1_200);
    let coarse = simplify(fine.mesh(), &SimplifySettings::to(600)).unwrap();
    let coarse = Surface::new(coarse.mesh).unwrap();
    let below = AabbTree::new(coarse.mesh());
    let place = |point: &Vec3| {
        let near = below.nearest(coarse.mesh(), point);
        let from = ContactPoint {
            triangle: near.triangle,
            barycentric: near.on.barycentric,
            point: near.on.position,
            normal: coarse.mesh().area_vector(near.triangle).normalize(),
            depth: 0.0,
        };
        let under = project_contact_point(&coarse, coarse.vertex_normals(), &from, point);
        (near.on.position, under.map(|under| under.point))
    };
    let step = 2e-5;
    let mut random = Random(9);
    let (mut nearest, mut settled, mut lost, mut steps) = (0.0_f64, 0.0_f64, 0, 0);
    for _ in 0..tries(1_000) {
        let mut point = random.around(fine.mesh());
        let mut along = random.direction();
        let mut before: Option<(Vec3, Option<Vec3>)> = None;
        for _ in 0..200 {
            let on = tree.nearest(fine.mesh(), &point);
            let normal = fine.mesh().area_vector(on.triangle).normalize();
            along = (along - normal * normal.dot(&along)).normalize();
            let now = place(&on.on.position);
            if let Some(before) = before {
                nearest = nearest.max((now.0 - before.0).norm() / step);
                match (before.1, now.1) {
                    (Some(before), Some(now)) => {
                        settled = settled.max((now - before).norm() / step)
                    }
                    _ => lost += 1,
                }
                steps += 1;
            }
            before = Some(now);
            point = on.on.position + along * step;
        }
    }
    println!(
        "{steps} steps: the nearest point runs {nearest:.1} times as fast, the settled one {settled:.1}, {lost} lost"
    );
    assert!(
        settled < 4.0 && nearest > 2.0 * settled,
        "{nearest} {settled}"
    );
    assert!(lost < steps / 100, "{lost} of {steps}");
}

/// Neighbourhoods are mutual, and a closed mesh has a triangle across every edge which runs along it the other way.
#[test]
fn neighborhoods_are_mutual() {
    for each in Organ::ALL {
        let (surface, _) = organ(each, 1_000);
        let (mesh, adjacency) = (surface.mesh(), surface.adjacency());
        for t in mesh.triangle_ids() {
            let mut across = 0;
            for (edge, other) in adjacency.across(t).into_iter().enumerate() {
                let other = other.unwrap();
                let corners = mesh.corners(t);
                let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
                let theirs = mesh.corners(other);
                let back = (0..3).find(|&k| theirs[k] == to && theirs[(k + 1) % 3] == from);
                assert_eq!(adjacency.across(other)[back.unwrap()], Some(t), "{each}");
                across += 1;
            }
            assert_eq!(adjacency.edge_neighborhood(t).count(), across);
            for node in mesh.corners(t) {
                assert!(adjacency.around(node).contains(&t));
            }
        }
    }
}

/// A point over a vertex is as near to all of its triangles; the lowest number wins, turned or not.
#[test]
fn ties_at_a_vertex_go_to_the_lowest_triangle() {
    let mut random = Random(5);
    for each in [
        Organ::Hemisphere,
        Organ::Cube,
        Organ::Esophagus,
        Organ::Liver,
    ] {
        let (surface, tree) = organ(each, 1_000);
        let turn = random.rotation();
        let turned = surface.mesh().map_vertices(|v| turn * v).unwrap();
        let turned_tree = AabbTree::new(&turned);
        let mut ties = 0;
        for t in surface.mesh().triangle_ids() {
            for node in surface.mesh().corners(t) {
                let vertex = surface.mesh().vertices()[node.index()];
                let above = vertex + 2e-3 * surface.vertex_normals()[node.index()];
                let nearest = tree.nearest(surface.mesh(), &above);
                // In a hollow the nearest point is another.
                if (nearest.on.position - vertex).norm() > 1e-12 {
                    continue;
                }
                ties += 1;
                let lowest = surface.adjacency().around(node)[0];
                assert_eq!(nearest.triangle, lowest, "{each} {node:?}");
                let again = turned_tree.nearest(&turned, &(turn * above));
                assert_eq!(again.triangle, lowest, "{each} {node:?}, turned");
            }
        }
        assert!(ties > 500, "{each}: {ties}");
    }
}

/// The curvature between vertices is that at the vertices, and goes over an edge without a leap.
#[test]
fn patch_field_is_continuous_over_edges() {
    let (surface, _) = organ(Organ::Liver, 2_000);
    let field = PatchField::new(&surface, 8e-3);
    let mesh = surface.mesh();
    for t in mesh.triangle_ids() {
        for (edge, other) in surface.adjacency().across(t).into_iter().enumerate() {
            let other = other.unwrap();
            let ends = [mesh.corners(t)[edge], mesh.corners(t)[(edge + 1) % 3]];
            let at = |triangle: TriangleId| {
                let corners = mesh.corners(triangle);
                let weights = corners.map(|c| match ends.iter().position(|&e| e == c) {
                    Some(0) => 0.3,
                    Some(_) => 0.7,
                    None => 0.0,
                });
                field.at(&surface, triangle, &weights)
            };
            let (here, there) = (at(t), at(other));
            // Rounding.
            assert!((here.normal - there.normal).norm() < 1e-14);
            let off: Matrix3<f64> = here.curvature - there.curvature;
            assert!(off.norm() * field.radius() < 1e-12);
        }
    }
}

/// Squares of what lies far out are no numbers any more. Judge: the same direction from a thousand kilometres.
#[test]
fn what_is_beyond_all_bounds_is_outside() {
    let (surface, tree) = organ(Organ::Hemisphere, 2000);
    for direction in [Vec3::x(), -Vec3::z(), Vec3::new(1.0, -1.0, 1.0)] {
        let near = surface.signed_distance(&tree, &(direction * 1e6));
        assert!(near.1 > 0.9e6, "{near:?}");
        for far in [1e9, 1e20, 1e100, 1e155, 1e300, f64::MAX] {
            let (start, end) = (direction * far, direction * (0.5 * far));
            assert_eq!(surface.signed_distance(&tree, &start), near);
            assert!(!tree.is_near_segment(surface.mesh(), [&start, &end], 0.9e6));
            assert!(tree.is_near_segment(surface.mesh(), [&start, &end], 2e6));
        }
    }
}
