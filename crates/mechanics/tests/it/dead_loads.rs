//! Solids under their weight and under forces that keep their direction.

use std::sync::Arc;

use palpate_files::scene::{Region, RegionPlane};
use palpate_geometry::TetrahedronMesh;
use palpate_mechanics::finite_elements::solid::{
    Body, LoadPlace, Loads, SolidAnswer, SolidError, SolidProblem, SurfaceLoad, Weight, solve,
    solve_at,
};
use palpate_mechanics::{Error, Law, LinearElastic, NeoHookean, Vec3};

/// A beam along x from 0, where it is held, with its middle line at y = z = 0 [m].
pub(crate) const LENGTH: f64 = 0.1;
pub(crate) const HEIGHT: f64 = 0.01;
const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;

pub(crate) fn beam(cells: [usize; 3], law: Arc<dyn Law>) -> SolidProblem {
    let half = 0.5 * HEIGHT;
    let (low, high) = (Vec3::new(0.0, -half, -half), Vec3::new(LENGTH, half, half));
    SolidProblem {
        points: vec![LENGTH * Vec3::x()],
        ..SolidProblem::new(
            Body::Volume(TetrahedronMesh::block(low, high, cells).unwrap()),
            plane(1e-6, Vec3::x()),
            law,
        )
    }
}

/// The half-space below `at` [m] along the axis of `normal`.
pub(crate) fn plane(at: f64, normal: Vec3) -> Region {
    Region {
        planes: vec![RegionPlane {
            point_m: (at * normal.abs()).into(),
            normal: normal.into(),
        }],
        ..Region::default()
    }
}

fn weight(gravity: Vec3) -> Option<Weight> {
    Some(Weight {
        gravity,
        density: DENSITY,
    })
}

pub(crate) fn at(problem: &SolidProblem, halvings: i32) -> SolidAnswer {
    solve_at(problem, halvings, &mut |_| ()).unwrap()
}

/// The force on the end face.
fn end(force: Vec3) -> SurfaceLoad {
    SurfaceLoad::Force {
        place: LoadPlace::Faces(plane(LENGTH - 1e-6, -Vec3::x())),
        force,
    }
}

/// Judge: Timoshenko's beam, q L⁴/(8 E I) + q L²/(2 k G A) with k = 5/6, at a deflection of a thousandth of the length.
/// At ν = 0 the cross-section stays as it is, at the clamp as elsewhere. Left are the mesh and the k of a beam of this height.
#[test]
fn a_beam_under_its_weight_is_timoshenkos() {
    let (modulus, ratio) = (1e7, 0.0);
    let law = Arc::new(LinearElastic::new(modulus, ratio).unwrap());
    let mut problem = beam([20, 2, 2], law);
    problem.loads.weight = weight(-GRAVITY * Vec3::z());
    let load = DENSITY * GRAVITY * HEIGHT * HEIGHT;
    let bending = load * LENGTH.powi(4) / (8.0 * modulus * HEIGHT.powi(4) / 12.0);
    let shear = modulus / (2.0 * (1.0 + ratio));
    let sheared = load * LENGTH.powi(2) / (2.0 * 5.0 / 6.0 * shear * HEIGHT * HEIGHT);
    let answer = at(&problem, 0);
    let expected = -(bending + sheared);
    println!("{} of {expected}", answer.points[0].z);
    assert!((answer.points[0].z / expected - 1.0).abs() < 0.005);
    // Equilibrium, to the solver's tolerance.
    let whole = load * LENGTH;
    assert!((answer.reaction - whole * Vec3::z()).norm() < 1e-6 * whole);
    assert_eq!(answer.force, Vec3::zeros());
}

/// Judge: the same beam as tetrahedra. As a surface, turned so that no lattice fits it, it bends as far, within what
/// the test above leaves to the mesh.
#[test]
fn a_beam_as_a_surface_bends_as_its_tetrahedra() {
    let law = Arc::new(LinearElastic::new(1e7, 0.3).unwrap());
    let mut straight = beam([20, 2, 2], law.clone());
    straight.loads.weight = weight(GRAVITY * -Vec3::z());
    let turn = nalgebra::Rotation3::new(Vec3::new(0.3, 0.7, 0.2));
    let half = 0.5 * HEIGHT * Vec3::new(0.0, 1.0, 1.0);
    let block = TetrahedronMesh::block(-half, half + LENGTH * Vec3::x(), [1, 1, 1]).unwrap();
    let surface = block.boundary_surface().unwrap();
    let surface = surface.mesh().map_vertices(|v| turn * v).unwrap();
    let held = Region {
        planes: vec![RegionPlane {
            point_m: (turn * (1e-6 * Vec3::x())).into(),
            normal: (turn * Vec3::x()).into(),
        }],
        ..Region::default()
    };
    let turned = SolidProblem {
        points: vec![turn * (LENGTH * Vec3::x())],
        loads: Loads {
            weight: weight(turn * (GRAVITY * -Vec3::z())),
            ..Loads::default()
        },
        ..SolidProblem::new(
            Body::Surface(palpate_geometry::Surface::new(surface).unwrap()),
            held,
            law,
        )
    };
    let tip = |problem: &SolidProblem| at(problem, 0).points[0].norm();
    let [expected, found] = [&straight, &turned].map(tip);
    println!("{found} of {expected}");
    assert!((found / expected - 1.0).abs() < 0.005);
}

/// Deflection and shortening of the end of an inextensible elastica under a dead force at its end [m], by shooting: with
/// the angle θ from its axis, E I θ'' = −F cos θ, θ(0) = 0, θ'(L) = 0.
fn elastica(force_over_stiffness: f64) -> [f64; 2] {
    const STEPS: usize = 20_000;
    let step = LENGTH / STEPS as f64;
    let shoot = |first: f64| {
        let (mut angle, mut curvature, mut down, mut along) = (0.0_f64, first, 0.0, 0.0);
        for _ in 0..STEPS {
            // Midpoint rule.
            let middle = angle + 0.5 * step * curvature;
            let bend = curvature - 0.5 * step * force_over_stiffness * angle.cos();
            curvature -= step * force_over_stiffness * middle.cos();
            angle += step * bend;
            down += step * middle.sin();
            along += step * middle.cos();
        }
        (curvature, [down, LENGTH - along])
    };
    let (mut low, mut high) = (0.0, 2.0 * force_over_stiffness * LENGTH);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if shoot(middle).0 < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    shoot(0.5 * (low + high)).1
}

/// Judge: the elastica, by shooting, at a deflection of about half the length. It neither shears nor stretches: shear adds
/// about E h²/(4 k G L²), 1 %; and the clamp stiffens the first height by a tenth, 0.3 % each.
#[test]
#[ignore = "long"]
fn a_slender_beam_is_the_elastica() {
    let modulus = 3e6;
    let law = Arc::new(NeoHookean::incompressible(modulus / 6.0).unwrap());
    let mut problem = beam([20, 2, 2], law);
    let stiffness = modulus * HEIGHT.powi(4) / 12.0;
    let force = 2.0 * stiffness / LENGTH.powi(2);
    let [down, back] = elastica(force / stiffness);
    let region = end(-force * Vec3::z());
    problem.loads.on_surface = vec![region];
    let answer = at(&problem, 0);
    let found = answer.points[0];
    println!("{found:?}: {down} {back}");
    assert!((0.4..0.6).contains(&(down / LENGTH)));
    assert!((-found.z / down - 1.0).abs() < 0.02);
    assert!((-found.x / back - 1.0).abs() < 0.03);
    assert!((answer.reaction - force * Vec3::z()).norm() < 1e-5 * force);
}

/// Judge: Saint-Venant. Spread over the end face or over a line across its top, the same force bends the beam alike; the
/// line's turning moment about the axis is none.
#[test]
fn a_force_on_an_edge_bends_as_one_on_the_face() {
    let law = Arc::new(LinearElastic::new(1e7, 0.3).unwrap());
    let mut problem = beam([10, 2, 2], law);
    let middle = 0.5 * LENGTH * Vec3::x();
    problem.points = vec![middle];
    problem.loads.on_surface = vec![end(-0.01 * Vec3::z())];
    let face = at(&problem, 0);
    let half = 0.5 * HEIGHT;
    let top = |side: f64| Vec3::new(LENGTH, side * half, half);
    problem.loads.on_surface = vec![SurfaceLoad::Force {
        place: LoadPlace::Line([top(-1.0), top(1.0)]),
        force: -0.01 * Vec3::z(),
    }];
    let edge = at(&problem, 0);
    let apart = (face.points[0] - edge.points[0]).norm() / face.points[0].norm();
    println!("{apart:e}");
    // e^(−L/2h) and less at five heights from the end; the solver's tolerance above it.
    assert!(apart < 1e-3, "{apart}");
    assert!((face.reaction - edge.reaction).norm() < 1e-6 * 0.01);
}

/// Judge: the finest mesh, and what the estimate says of the others.
#[test]
#[ignore = "long"]
fn the_displacement_of_a_beam_converges() {
    let law = Arc::new(NeoHookean::incompressible(4e4).unwrap());
    let mut problem = beam([6, 1, 1], law);
    problem.loads.weight = weight(-GRAVITY * Vec3::z());
    let found = solve(&problem, 0.02, &mut |_| ()).unwrap();
    let finest = at(&problem, 2);
    let error = (found.answer.points[0] - finest.points[0]).norm() / finest.points[0].norm();
    println!("estimated {:.4}, is {error:.4}", found.error);
    assert!(error <= found.error && found.error < 0.05);
}

#[test]
fn what_cannot_be_loaded_is_refused() {
    let law: Arc<dyn Law> = Arc::new(LinearElastic::new(1e7, 0.3).unwrap());
    let refused = |change: &dyn Fn(&mut SolidProblem)| {
        let mut problem = beam([4, 1, 1], law.clone());
        problem.loads.weight = weight(-GRAVITY * Vec3::z());
        change(&mut problem);
        match solve_at(&problem, 0, &mut |_| ()) {
            Err(Error::Solid(error)) => error,
            other => panic!("{other:?}"),
        }
    };
    let load = |place: LoadPlace, force: Vec3| SurfaceLoad::Force { place, force };
    let nowhere = || LoadPlace::Faces(Region::default());
    assert_eq!(
        refused(&|p| p.loads = Loads::default()),
        SolidError::NothingLoads
    );
    for density in [0.0, -1.0, f64::NAN] {
        assert!(matches!(
            refused(&|p| p.loads.weight.as_mut().unwrap().density = density),
            SolidError::DensityOutOfRange { .. }
        ));
    }
    for gravity in [0.0, f64::INFINITY] {
        let gravity = Vec3::repeat(gravity);
        assert!(matches!(
            refused(&|p| p.loads.weight = weight(gravity)),
            SolidError::NoDirection { .. }
        ));
    }
    assert!(matches!(
        refused(&|p| p.loads.on_surface = vec![load(nowhere(), Vec3::zeros())]),
        SolidError::NoDirection { .. }
    ));
    assert_eq!(
        refused(&|p| p.loads.on_surface = vec![load(nowhere(), Vec3::x())]),
        SolidError::EmptyLoad { load: 0 }
    );
    let line = |ends| load(LoadPlace::Line(ends), Vec3::x());
    assert_eq!(
        refused(&|p| p.loads.on_surface = vec![line([Vec3::zeros(); 2])]),
        SolidError::NoLine { load: 0 }
    );
    assert!(matches!(
        refused(&|p| p.loads.on_surface = vec![line([Vec3::z(), 2.0 * Vec3::z()])]),
        SolidError::LineOffSurface { load: 0, .. }
    ));
    let pressed = |region, pressure| SurfaceLoad::Pressure { region, pressure };
    assert_eq!(
        refused(&|p| p.loads.on_surface = vec![pressed(None, 0.0)]),
        SolidError::NoPressure {
            load: 0,
            found: 0.0
        }
    );
    assert_eq!(
        refused(&|p| p.loads.on_surface = vec![pressed(Some(Region::default()), 1.0)]),
        SolidError::EmptyLoad { load: 0 }
    );
    assert!(matches!(
        refused(&|p| p.points.push(Vec3::z())),
        SolidError::PointOutside { point: 1, .. }
    ));
}
