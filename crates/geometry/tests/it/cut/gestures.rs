//! Random gestures of a blade, with seeds.

use palpate_geometry::{CutMethod, CutSurface, Organ, Surface, TriangleId, Vec3};

use super::BOTH;
use super::sound::{border_loops, euler, pieces, sound};
use crate::agreement::real_surfaces;
use crate::shapes::{Random, organ};

/// Begins somewhere and goes on in a wavering direction, by steps from none to several triangles; now
/// and then far away or nowhere.
fn gesture(cut: &mut CutSurface, surface: &Surface, random: &mut Random, edge: f64) {
    let near = TriangleId(random.below(cut.mesh().triangles().len()) as u32);
    let [a, b, c] = cut.mesh().positions(near);
    let (u, v) = (random.unit(), random.unit());
    let mut at = a + 0.9 * u * (b - a) + 0.9 * (1.0 - u) * v * (c - a);
    cut.begin(surface, near, &at).unwrap();
    let mut heading = random.direction();
    let stride = edge * 10.0_f64.powf(1.5 * random.unit() - 1.0);
    for _ in 0..random.below(40) {
        heading = (heading + 0.4 * random.direction()).normalize();
        at += stride * random.unit() * heading;
        match random.below(60) {
            0 => drop(cut.advance(surface, &Vec3::repeat(f64::NAN)).unwrap_err()),
            1 => drop(cut.advance(surface, &(1e9 * heading)).unwrap()),
            _ => {
                let progress = cut.advance(surface, &at).unwrap();
                assert!(progress.away.is_finite());
                // As a hand would: back to the surface, where the blade has stayed.
                if progress.away > 3.0 * edge {
                    at += 0.9 * progress.away * (a - at).normalize();
                }
            }
        }
    }
    cut.end(surface).unwrap();
}

/// After each hundred gestures the mesh is sound, has at most 8 times its triangles, and Euler's
/// characteristic is that of its borders: 2 − 2 genus − loops, summed over pieces, when every piece
/// but the first is a disk or more holes. Undone one by one, all is as before; repeated, all is equal.
///
/// Splitting keeps the area to rounding. Moving a vertex keeps that of its triangles within 1 %; what
/// comes of it on the whole is less, whatever the number of cuts.
fn gestures(each: &str, surface: &Surface, method: CutMethod, count: usize) {
    let mesh = surface.mesh();
    let edge = (4.0 * mesh.area() / mesh.triangles().len() as f64 / 3f64.sqrt()).sqrt();
    let run = || {
        let mut cut = CutSurface::new(surface, method);
        let mut random = Random(7);
        for number in 0..count {
            // A fresh organ now and then: one that is all cut has nothing left to try.
            if number % 50 == 49 {
                sound(surface, &cut);
                while number % 100 == 99 && cut.undo().unwrap() {}
            }
            gesture(&mut cut, surface, &mut random, edge);
            assert!(cut.mesh().triangles().len() <= 8 * mesh.triangles().len());
            if method == CutMethod::SnapVertices {
                assert_eq!(cut.mesh().triangles().len(), mesh.triangles().len());
            }
        }
        cut
    };
    let mut cut = run();
    sound(surface, &cut);
    let (loops, parts) = (border_loops(&cut), pieces(&cut));
    let change = cut.mesh().area() / mesh.area() - 1.0;
    println!(
        "{each} {method:?}: {} triangles, {loops} borders, {parts} pieces, area {change:.1e}",
        cut.mesh().triangles().len()
    );
    let allowed = match method {
        CutMethod::SnapVertices => 1e-2,
        CutMethod::SplitTriangles => 1e-10,
    };
    assert!(change.abs() < allowed, "{change}");
    // Cutting joins and parts handles, so the genus is not known; its sum is not negative.
    let twice = 2 * parts as i64 - loops as i64 - euler(&cut);
    assert!(twice >= 0 && twice % 2 == 0, "{twice}");
    assert_eq!(cut.mesh(), run().mesh());
    while cut.undo().unwrap() {}
    assert_eq!(cut.mesh(), mesh);
    let fresh = CutSurface::new(surface, method);
    for triangle in mesh.triangle_ids() {
        assert_eq!(cut.across(triangle), fresh.across(triangle));
        assert_eq!(cut.parent(triangle), triangle);
    }
}

const ORGANS: [Organ; 4] = [Organ::Esophagus, Organ::Stomach, Organ::Liver, Organ::Cube];

/// A hundred gestures per organ and method: nothing panics, nothing breaks. Judge: the mesh's own
/// numbers.
#[test]
fn random_gestures_leave_sound_meshes() {
    for each in ORGANS {
        for method in BOTH {
            gestures(each.name(), &organ(each, 1_500).0, method, 120);
        }
    }
}

/// The same with ten thousand in all. Judge: the mesh's own numbers. Quick form:
/// `random_gestures_leave_sound_meshes`.
#[test]
#[ignore = "slow: 10,000 gestures, twice"]
fn ten_thousand_random_gestures() {
    for each in ORGANS {
        for method in BOTH {
            gestures(each.name(), &organ(each, 1_500).0, method, 1_250);
        }
    }
}

/// The same on the real organs that are at hand. Judge: the mesh's own numbers. Quick form:
/// `random_gestures_leave_sound_meshes`.
#[test]
#[ignore = "slow: reads all real organs"]
fn real_random_gestures() {
    for (name, surface) in real_surfaces() {
        for method in BOTH {
            gestures(&name, &surface, method, 120);
        }
    }
}
