//! The finer triangles around a contact: without cracks, and on the organ rather than on its triangles.

use palpate_files::scene::{Enhancement, EnhancementArea, Smoothing};
use palpate_geometry::{NodeId, Organ, Surface, TriangleId, TriangleMesh, inspect, read_mesh};
use palpate_mechanics::Vec3;
use palpate_mechanics::enhance::{
    EmbeddedDisplayPoints, EnhancedPatch, EnhancementModel, Interpolation, SurfaceField,
    SurfacePoint,
};

use crate::contacts::organ;

/// An octahedron whose triangles are cut into four `levels` times, blown up to a ball of radius 1 m.
pub(crate) fn ball(levels: usize) -> Surface {
    let mut vertices: Vec<Vec3> = (0..6)
        .map(|k| Vec3::ith(k / 2, [1.0, -1.0][k % 2]))
        .collect();
    let mut triangles = Vec::new();
    for octant in 0..8 {
        let [a, b, c] = [0, 1, 2].map(|axis| (2 * axis + (octant >> axis & 1)) as u32);
        let outward = (octant as u32).count_ones().is_multiple_of(2);
        triangles.push(if outward { [a, b, c] } else { [a, c, b] });
    }
    for _ in 0..levels {
        let mut middles = std::collections::BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to): (u32, u32)| {
                *middles
                    .entry((from.min(to), from.max(to)))
                    .or_insert_with(|| {
                        let sum = vertices[from as usize] + vertices[to as usize];
                        vertices.push(sum.normalize());
                        vertices.len() as u32 - 1
                    })
            });
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    let triangles = triangles.iter().map(|t| t.map(NodeId)).collect();
    Surface::new(TriangleMesh::new(vertices, triangles).unwrap()).unwrap()
}

pub(crate) fn real_kidney() -> Option<Surface> {
    let path = crate::data::folder()?.join("meshes/vhm_kidney_left_688.ply");
    let mesh = read_mesh(&path, None).unwrap().mesh;
    Some(Surface::new(mesh).unwrap())
}

pub(crate) fn model(surface: Surface, area: EnhancementArea, levels: usize) -> EnhancementModel {
    let settings = Enhancement {
        area,
        levels,
        smoothing: Smoothing::MovingLeastSquares,
    };
    EnhancementModel::new(surface, settings).unwrap()
}

/// Displacements of all centroids.
pub(crate) fn sampled(interpolation: &Interpolation, field: impl Fn(&Vec3) -> Vec3) -> Vec<Vec3> {
    let ids = interpolation.surface().mesh().triangle_ids();
    ids.map(|id| field(&interpolation.place(&SurfacePoint::centroid(id))))
        .collect()
}

/// Every `stride`-th triangle touched, with both areas.
fn watertight(surface: &Surface, levels: &[usize], stride: usize) {
    let crossing = inspect(surface.mesh()).self_intersections;
    let mut patch = EnhancedPatch::default();
    for area in [EnhancementArea::Edge, EnhancementArea::Vertex] {
        for &levels in levels {
            let model = model(surface.clone(), area, levels);
            let interpolation = model.interpolation();
            let twist = |x: &Vec3| Vec3::new(x.y * x.z, x.x.sin(), x.x * x.y);
            let mut field = SurfaceField::default();
            field.update(interpolation, &sampled(interpolation, twist), &[]);
            let mut coarse = vec![Vec3::zeros(); surface.mesh().vertices().len()];
            EmbeddedDisplayPoints::of_vertices(interpolation).interpolate(&field, &mut coarse);
            for touched in surface.mesh().triangle_ids().step_by(stride) {
                patch.build(&model, &[touched]);
                let whole = sound(surface, &patch);
                if touched.index() % (20 * stride) == 0 {
                    assert_eq!(inspect(whole.mesh()).self_intersections, crossing);
                }
                let mut displaced = vec![Vec3::zeros(); patch.places().len()];
                patch.displace(&field, &mut displaced);
                for (node, displacement) in patch.corners().iter().zip(&displaced) {
                    assert_eq!(*displacement, coarse[node.index()], "{touched:?} {node:?}");
                }
            }
        }
    }
}

/// The surface with the patch in it, if it is one.
fn sound(surface: &Surface, patch: &EnhancedPatch) -> Surface {
    let whole = patch.in_mesh(surface.mesh(), patch.places());
    let grown = whole.volume() / surface.mesh().volume() - 1.0;
    assert!(grown.abs() < 0.1, "{grown}");
    Surface::new(whole).unwrap()
}

/// Judge: the checks of a surface: closed, manifold, oriented, in one piece, no triangle without area; and
/// those of `inspect`: no triangle passes through another. Vertices that the patch shares with the coarse
/// mesh move with it to the last bit, so that there is no crack after displacement either. The volume tells
/// that a patch is where it should be; a tenth of it is more than the patch of any of these bodies adds.
#[test]
fn every_patch_is_watertight() {
    watertight(&ball(2), &[1, 2], 5);
    watertight(&organ(Organ::Hemisphere, 192), &[0, 1, 2], 3);
    watertight(&organ(Organ::Cube, 48), &[1, 2, 3], 1);
    watertight(&organ(Organ::Esophagus, 400), &[1], 13);
}

/// As `every_patch_is_watertight`, on the kidney of an atlas.
#[test]
fn real_kidney_patches_are_watertight() {
    let Some(kidney) = real_kidney() else { return };
    watertight(&kidney, &[1, 2], 11);
}

/// As `every_patch_is_watertight`, at every triangle.
#[test]
#[ignore = "slow: a minute, every triangle of every body"]
fn every_patch_everywhere_is_watertight() {
    watertight(&ball(3), &[1, 2], 1);
    watertight(&organ(Organ::Hemisphere, 768), &[1, 2], 1);
    watertight(&organ(Organ::Cube, 192), &[1, 2], 1);
    watertight(&organ(Organ::Esophagus, 1000), &[1, 2], 1);
}

/// As `every_patch_is_watertight`, at every triangle of the kidney of an atlas.
#[test]
#[ignore = "slow: half a minute, every triangle"]
fn real_kidney_patches_are_watertight_everywhere() {
    let Some(kidney) = real_kidney() else { return };
    watertight(&kidney, &[1, 2], 1);
}

/// Judge: two contacts whose areas overlap are one patch.
#[test]
fn patches_of_two_contacts_join() {
    let surface = ball(2);
    let model = model(surface.clone(), EnhancementArea::Vertex, 2);
    let mut patch = EnhancedPatch::default();
    for other in surface.mesh().triangle_ids() {
        patch.build(&model, &[TriangleId(17), other]);
        sound(&surface, &patch);
    }
    patch.build(&model, &[]);
    assert_eq!(
        patch.in_mesh(surface.mesh(), patch.places()),
        *surface.mesh()
    );
}

/// Slope of log error over log size between neighbouring rows.
pub(crate) fn orders(table: &[(f64, f64)]) -> Vec<f64> {
    let pairs = table.windows(2);
    pairs
        .map(|pair| (pair[0].1 / pair[1].1).ln() / (pair[0].0 / pair[1].0).ln())
        .collect()
}

/// Judge: the ball that the coarse vertices lie on. Flat triangles meet it with order two. The patch has
/// its tangents at the corners, so that its edges do with order four; the middle with order three at least.
#[test]
fn patches_converge_to_the_sphere() {
    let mut table = Vec::new();
    let mut flat = Vec::new();
    for levels in 1..5 {
        let surface = ball(levels);
        let size = 0.5_f64.powi(levels as i32);
        let model = model(surface.clone(), EnhancementArea::Edge, 3);
        let mut patch = EnhancedPatch::default();
        let mut farthest: f64 = 0.0;
        let mut chord: f64 = 0.0;
        for touched in surface.mesh().triangle_ids().step_by(3) {
            patch.build(&model, &[touched]);
            let off = |x: &Vec3| (x.norm() - 1.0).abs();
            farthest = patch.places().iter().map(off).fold(farthest, f64::max);
            let middle = model
                .interpolation()
                .place(&SurfacePoint::centroid(touched));
            chord = chord.max(off(&middle));
        }
        table.push((size, farthest));
        flat.push((size, chord));
    }
    println!("patch {table:?}, triangle {flat:?}");
    println!("orders {:?} and {:?}", orders(&table), orders(&flat));
    assert!(orders(&table).iter().all(|&order| order > 2.9), "{table:?}");
}

/// Judge: a cube's faces and edges, on which every new point stays; rounding of coordinates of 0.05 m.
#[test]
fn a_cube_keeps_its_faces_and_edges() {
    let surface = organ(Organ::Cube, 192);
    let model = model(surface.clone(), EnhancementArea::Vertex, 2);
    let mut patch = EnhancedPatch::default();
    for touched in surface.mesh().triangle_ids() {
        patch.build(&model, &[touched]);
        for place in patch.places() {
            assert!((place.amax() - 0.05).abs() < 1e-16, "{place}");
        }
        let whole = patch.in_mesh(surface.mesh(), patch.places());
        assert!((whole.volume() - 1e-3).abs() < 1e-15);
    }
}
