use palpate_geometry::{AabbTree, Organ, Surface, Vec3};
use palpate_viewer::{Camera, Orbit, pick};

fn camera() -> Camera {
    Camera {
        eye: Vec3::new(0.1, -0.4, 0.2),
        target: Vec3::new(0.01, 0.02, -0.03),
        up: Vec3::z(),
        field_of_view: 0.8,
        lamp: None,
    }
}

/// The ray of a place of the picture passes through every point that is seen there: by construction of a
/// point on it. Rounding of numbers of size one.
#[test]
fn a_pixel_and_its_ray_agree() {
    let camera = camera();
    let axes = camera.axes();
    for (k, a) in axes.iter().enumerate() {
        for (l, b) in axes.iter().enumerate() {
            let expected = f64::from(u8::from(k == l));
            assert!((a.dot(b) - expected).abs() < 1e-12);
        }
    }
    for place in [(0.5, 0.5), (0.0, 0.0), (0.9, 0.2), (0.3, 1.0)] {
        for aspect in [0.5, 1.6] {
            let ray = camera.ray(place, aspect);
            let (seen, ahead) = camera.project(&(camera.eye + 0.7 * ray), aspect).unwrap();
            assert!((seen.0 - place.0).abs() < 1e-12 && (seen.1 - place.1).abs() < 1e-12);
            assert!(ahead > 0.0 && ahead <= 0.7);
            assert!(camera.project(&(camera.eye - ray), aspect).is_none());
        }
    }
    let (middle, ahead) = camera.project(&camera.target, 1.6).unwrap();
    assert!((middle.0 - 0.5).abs() < 1e-12 && (middle.1 - 0.5).abs() < 1e-12);
    assert!((ahead - camera.distance()).abs() < 1e-12);
}

/// Looking straight along the up direction still has a right and an up.
#[test]
fn a_look_straight_down_has_axes() {
    let down = Camera {
        eye: Vec3::new(0.0, 0.0, 1.0),
        target: Vec3::zeros(),
        ..camera()
    };
    assert!(down.axes().iter().all(|a| (a.norm() - 1.0).abs() < 1e-12));
}

/// Every vertex is inside of the picture, and one is near its edge: the margin is 14 %.
#[test]
fn the_whole_organ_is_framed() {
    for organ in Organ::ALL {
        let mesh = organ.surface_mesh(organ.default_triangles()).unwrap();
        for aspect in [0.6, 1.0, 1.6] {
            let camera = Orbit::framing(&mesh, 0.8, aspect).camera();
            let mut farthest = 0.0_f64;
            for vertex in mesh.vertices() {
                let ((x, y), _) = camera.project(vertex, aspect).unwrap();
                farthest = farthest
                    .max((2.0 * x - 1.0).abs())
                    .max((2.0 * y - 1.0).abs());
            }
            assert!(
                (0.85..0.87).contains(&farthest),
                "{organ} {aspect}: {farthest}"
            );
        }
    }
}

/// On a sphere of known radius the pick is where the line meets it, within the sagitta of its triangles.
#[test]
fn a_pick_on_a_hemisphere_is_on_the_line_and_the_ball() {
    let surface = Surface::new(Organ::Hemisphere.surface_mesh(12_000).unwrap()).unwrap();
    let tree = AabbTree::new(surface.mesh());
    let camera = Orbit::framing(surface.mesh(), 0.8, 1.6).camera();
    let picked = pick(&surface, &tree, &camera, (0.5, 0.4), 1.6).unwrap();
    let ray = camera.ray((0.5, 0.4), 1.6);
    assert!((picked.point - camera.eye).cross(&ray).norm() < 1e-9);
    // How far the middle of a triangle lies below its ball: its circle's radius is at most the longest edge
    // over √3 where triangles are nearly equilateral, and is taken as the edge itself.
    let mesh = surface.mesh();
    let edges = mesh.triangle_ids().map(|id| {
        let [a, b, c] = mesh.positions(id);
        (a - b).norm().max((b - c).norm()).max((c - a).norm())
    });
    let longest = edges.fold(0.0, f64::max);
    let sagitta = longest * longest / (2.0 * 0.05);
    assert!((picked.point.norm() - 0.05).abs() < sagitta, "{picked:?}");
    // Normals of corners are off by the angle of an edge, squared.
    let angle = longest / 0.05;
    assert!((picked.normal - picked.point.normalize()).norm() < angle * angle);
    assert!(pick(&surface, &tree, &camera, (0.01, 0.01), 1.6).is_none());
}

/// An endoscope looks along the same line, from outside of the organ and nearer, with its own lamp set for
/// the distance there; the judge is a cast of the line.
#[test]
fn an_endoscope_stands_before_the_organ() {
    for organ in Organ::ALL {
        let mesh = organ.surface_mesh(organ.default_triangles()).unwrap();
        let tree = AabbTree::new(&mesh);
        let orbit = Orbit::framing(&mesh, 0.8, 1.6);
        let (far, near) = (orbit.camera(), orbit.endoscope(orbit.before(&mesh, &tree)));
        let sight = near.ray((0.5, 0.5), 1.6);
        assert!((sight - far.ray((0.5, 0.5), 1.6)).norm() < 1e-12);
        assert!(near.distance() < far.distance());
        let lamp = near.lamp.unwrap().distance;
        let hit = tree.cast(&mesh, &near.eye, &sight, 10.0);
        // Some organs are bent around their middle: there the line meets nothing, or their far side.
        let hit = hit.map(|hit| hit.distance);
        let expected = hit.unwrap_or(near.distance()).min(near.distance());
        assert!((lamp - expected).abs() < 1e-9, "{organ}: {lamp} {expected}");
    }
}
