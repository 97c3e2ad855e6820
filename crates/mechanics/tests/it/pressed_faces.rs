//! Pressures on the boundary of a solid.

use std::sync::Arc;

use palpate_files::scene::{CavityContent, Region, RegionSphere};
use palpate_mechanics::finite_elements::solid::{
    LoadPlace, RegionContent, SolidPlace, SolidRegion, SurfaceLoad,
};
use palpate_mechanics::regions::RegionPlace;
use palpate_mechanics::{LinearElastic, NeoHookean, Vec3};

use crate::dead_loads::{HEIGHT, LENGTH, at, beam, plane};
use crate::solid_regions::{ball, pulled};

fn pressure(region: Option<Region>, pressure: f64) -> SurfaceLoad {
    SurfaceLoad::Pressure { region, pressure }
}

/// The end of a shearless elastica of stiffness `stiffness` [N m²] under a pressure on its upper side that gives `load`
/// [N/m] in its middle line: how far it goes down and along [m]. From the free end inwards, with the tangent towards the
/// clamp and the normal along the pressure: N' = κ Q, Q' = q (1 + κ h/2) − κ N, M' = Q, κ = M/(E I). The upper side is the
/// longer one of the bent beam, by 1 + κ h/2.
fn elastica(load: f64, stiffness: f64) -> [f64; 2] {
    const STEPS: usize = 20_000;
    let step = LENGTH / STEPS as f64;
    let slope = |[n, q, m]: [f64; 3]| {
        let curvature = m / stiffness;
        let load = load * (1.0 + 0.5 * HEIGHT * curvature);
        [curvature * q, load - curvature * n, q]
    };
    let mut state = [0.0; 3];
    let mut curvatures = Vec::new();
    for _ in 0..STEPS {
        // Midpoint rule.
        let first = slope(state);
        let middle = [0, 1, 2].map(|k| state[k] + 0.5 * step * first[k]);
        let by = slope(middle);
        state = [0, 1, 2].map(|k| state[k] + step * by[k]);
        curvatures.push(middle[2] / stiffness);
    }
    let (mut angle, mut down, mut along) = (0.0_f64, 0.0, 0.0);
    for curvature in curvatures.iter().rev() {
        let middle = angle + 0.5 * step * curvature;
        down += step * middle.sin();
        along += step * middle.cos();
        angle += step * curvature;
    }
    [down, along]
}

/// Judge: the elastica under a load that stays normal to it, bent by more than a right angle. Tolerance 2 % of the length:
/// shear adds about E h²/(4 k G L²), 1 %, and the clamp of whole faces stiffens the first height by 0.3 %. A dead load of
/// the same size bends it by a tenth of the length less, and draws it elsewhere.
#[test]
#[ignore = "long"]
fn a_beam_under_a_pressure_is_the_elastica_under_a_following_load() {
    let modulus = 3e6;
    let law = NeoHookean::compressible(modulus / 4.0, modulus / 3.0).unwrap();
    let mut problem = beam([20, 1, 2], Arc::new(law));
    let stiffness = modulus * HEIGHT.powi(4) / 12.0;
    for angle in [0.3, 1.2] {
        // Of a beam that bends little, q L³/(6 E I).
        let load = 6.0 * stiffness * angle / LENGTH.powi(3);
        let top = plane(0.5 * HEIGHT - 1e-6, -Vec3::z());
        problem.loads.on_surface = vec![pressure(Some(top), load / HEIGHT)];
        let found = at(&problem, 0).points[0];
        let [down, along] = elastica(load, stiffness);
        let found = [-found.z, LENGTH + found.x];
        println!("{found:?} of {:?}", [down, along]);
        assert!((found[0] - down).abs() < 0.02 * LENGTH);
        assert!((found[1] - along).abs() < 0.02 * LENGTH);
    }
}

/// Judge: superposition. A pressure on all sides and the same one in a cavity leave incompressible tissue as it is, whatever
/// its shape; one of them alone moves it.
#[test]
#[ignore = "long"]
fn equal_pressures_inside_and_outside_move_nothing() {
    let place = RegionPlace::Shape(ball(Vec3::zeros(), 0.08));
    let law = Arc::new(NeoHookean::incompressible(0.5).unwrap());
    let with = |inside: f64, outside: f64| {
        let mut problem = pulled(law.clone(), place.clone());
        problem.law = law.clone();
        problem.points.clear();
        problem.loads.on_surface = vec![pressure(None, outside)];
        problem.regions = vec![SolidRegion {
            name: "part".to_owned(),
            place: SolidPlace::Bounded(place.clone()),
            content: RegionContent::Cavity(CavityContent::Pressure(inside)),
        }];
        let moved = at(&problem, -1).fields.displacements;
        moved.iter().map(Vec3::norm).fold(0.0, f64::max)
    };
    let (both, alone) = (with(0.1, 0.1), with(0.0, 0.1));
    println!("{both:e} and {alone:e}");
    assert!(alone > 1e-3);
    // The tolerance of the solution.
    assert!(both < 1e-6 * alone);
}

/// Judge: a dead force of the same size on the same part of a flat side, which ends within triangles. At small strain both
/// are one load, to rounding.
#[test]
fn a_pressure_on_a_flat_part_is_its_force_at_small_strain() {
    let region = Region {
        spheres: vec![RegionSphere {
            center_m: [0.06, 0.001, 0.5 * HEIGHT],
            radius_m: 0.003,
        }],
        ..Region::default()
    };
    let law = Arc::new(LinearElastic::new(1e6, 0.3).unwrap());
    let mut problem = beam([10, 2, 2], law);
    problem.loads.on_surface = vec![pressure(Some(region.clone()), 500.0)];
    let pressed = at(&problem, 0);
    problem.loads.on_surface = vec![SurfaceLoad::Force {
        place: LoadPlace::Faces(region),
        force: -pressed.reaction,
    }];
    let forced = at(&problem, 0);
    let area = pressed.reaction.z / 500.0;
    assert!((area / (std::f64::consts::PI * 9e-6) - 1.0).abs() < 0.02);
    let apart = (pressed.points[0] - forced.points[0]).norm() / forced.points[0].norm();
    println!("{area:e} m2, apart {apart:e}");
    assert!(apart < 1e-9);
}
