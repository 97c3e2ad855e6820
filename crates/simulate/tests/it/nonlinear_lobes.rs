//! Lobes that a tip bends, as thick as one or two elements, by every model.

use std::f64::consts::PI;
use std::fs;
use std::sync::Arc;

use palpate_files::scene::{Region, RegionSphere};
use palpate_geometry::{LengthUnit, TetrahedronMesh, Vec3, WriteFormat};
use palpate_mechanics::LinearElastic;
use palpate_mechanics::finite_elements::solid::{
    Body, LoadPlace, Loads, SolidProblem, SurfaceLoad, solve_at,
};
use palpate_simulate::fixed_region;

use crate::scenes::{Hand, Setting, YOUNGS_MODULUS};

const SIZES: [f64; 2] = [0.04, 0.03];
/// Distances of the tip from the end [m].
const FROM_END: f64 = 0.015;
const AT_END: f64 = 0.004;
const RADIUS: f64 = 3e-3;
const DEPTH: f64 = 1e-4;
const NU: f64 = 0.45;

/// A lobe of so much tissue [m] that is fixed at its root, x = 0, under a flat tip of a radius [m] so far from its end [m].
#[derive(Debug, Clone, Copy)]
struct Lobe {
    thickness: f64,
    from_end: f64,
    radius: f64,
}

const NONLINEAR: &str = "nonlinear";

impl Lobe {
    fn mesh(&self, cells: [usize; 3]) -> TetrahedronMesh {
        let sizes = Vec3::new(SIZES[0], SIZES[1], self.thickness);
        TetrahedronMesh::block(Vec3::zeros(), sizes, cells).unwrap()
    }

    fn tip(&self) -> Vec3 {
        Vec3::new(SIZES[0] - self.from_end, 0.5 * SIZES[1], self.thickness)
    }

    fn scene(&self, path: &str, kind: &str, model: &str) -> palpate_files::Scene {
        Setting {
            organ: &format!(
                "mesh = {path:?}\nmesh_unit = \"m\"\nanchor = {{ planes = [{{ point_m = [1e-4, 0.0, 0.0], \
                 normal = [1.0, 0.0, 0.0] }}] }}"
            ),
            kind,
            model,
            radius: self.radius,
            poissons_ratio: NU,
            ..Setting::default()
        }
        .scene()
    }

    /// Stiffness under the tip [N/m] by quadratic elements, under an even traction, whose compliance differs from that of a tip by
    /// what a half-space knows: 16/(3 π²) (1 − ν²)/a and (1 − ν²)/2 a over E [Johnson 1985].
    fn expected(&self) -> f64 {
        // A tip's face is of some triangles.
        let mesh = self.mesh(match self.radius < RADIUS {
            true => [60, 45, 5],
            false => [24, 18, 4],
        });
        let above = 4.0 * self.radius;
        let ball = RegionSphere {
            center_m: (self.tip() + above * Vec3::z()).into(),
            radius_m: above.hypot(self.radius),
        };
        let surface = mesh.boundary_surface().unwrap();
        let areas = surface.mesh().triangle_ids().map(|id| {
            let centroid = surface.mesh().positions(id).iter().sum::<Vec3>() / 3.0;
            let area = surface.mesh().area_vector(id).norm();
            if ball.contains(centroid.into()) {
                area
            } else {
                0.0
            }
        });
        let even = 16.0 / (3.0 * PI.powi(2) * (areas.sum::<f64>() / PI).sqrt());
        let place = LoadPlace::Faces(Region {
            spheres: vec![ball],
            ..Region::default()
        });
        let organ = self.scene("lobe.ply", NONLINEAR, "").organ;
        let pressed = SolidProblem {
            loads: Loads {
                weight: None,
                on_surface: vec![SurfaceLoad::Force {
                    place,
                    force: -Vec3::z(),
                }],
            },
            ..SolidProblem::new(
                Body::Volume(mesh),
                fixed_region(&organ.shape, organ.anchor.as_ref()),
                Arc::new(LinearElastic::new(YOUNGS_MODULUS, NU).unwrap()),
            )
        };
        let energy = solve_at(&pressed, 0, &mut |_| ()).unwrap().energy;
        let own = (1.0 - NU * NU) / YOUNGS_MODULUS;
        1.0 / (2.0 * energy + own * (0.5 / self.radius - even))
    }

    /// The same as a hand feels it in a scene of a kind of model, whose surface is of so many cells.
    fn felt(&self, cells: [usize; 3], kind: &str, model: &str) -> f64 {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lobe.ply");
        let surface = self.mesh(cells).boundary_surface().unwrap();
        let bytes = WriteFormat::Ply.bytes(surface.mesh(), LengthUnit::Metre);
        fs::write(&path, bytes).unwrap();
        let scene = self.scene(path.to_str().unwrap(), kind, model);
        let simulation = palpate_simulate::Simulation::new(&scene).unwrap();
        let mut hand = Hand::new(&simulation);
        let mut force = 0.0;
        for step in 1..=20 {
            let depth = DEPTH * f64::from(step.min(10)) / 10.0;
            force = hand.at(&(self.tip() - depth * Vec3::z())).z;
        }
        force / DEPTH
    }
}

/// Judge: quadratic elements, 4 through the thickness. Tolerance: 5 %, as asked of the nonlinear model.
fn lobes_bend_as_finite_elements_do(thicknesses: &[f64], from_end: f64, nodes: &[usize]) {
    for &thickness in thicknesses {
        let lobe = Lobe {
            thickness,
            from_end,
            radius: RADIUS,
        };
        let expected = lobe.expected();
        for &nodes in nodes {
            let error =
                lobe.felt([16, 12, 3], NONLINEAR, &format!("nodes = {nodes}")) / expected - 1.0;
            let [millimetres, percent] = [1e3 * thickness, 100.0 * error];
            println!("{millimetres:.0} mm, {nodes} nodes: {percent:+.1} %");
            assert!(error.abs() < 0.05, "{thickness} {nodes}: {error}");
        }
    }
}

#[test]
#[ignore = "long"]
fn a_lobe_of_one_element_bends_as_finite_elements_do() {
    lobes_bend_as_finite_elements_do(&[5e-3], FROM_END, &[700, 1500]);
}

#[test]
#[ignore = "slow: a minute"]
fn lobes_of_3_to_12_mm_bend_as_finite_elements_do() {
    let thicknesses = [3e-3, 4e-3, 5e-3, 7e-3, 12e-3];
    lobes_bend_as_finite_elements_do(&thicknesses, FROM_END, &[700, 1500, 4000]);
    lobes_bend_as_finite_elements_do(&[3e-3, 5e-3, 12e-3], AT_END, &[1500]);
}

/// As [`lobes_bend_as_finite_elements_do`], of the local and the hybrid model on surfaces whose triangles are these parts of the
/// thickness.
fn lobes_bend_by_a_response(thicknesses: &[f64], radii: &[f64], parts: &[f64]) {
    for (&thickness, &radius) in thicknesses
        .iter()
        .flat_map(|of| radii.iter().map(move |r| (of, r)))
    {
        let lobe = Lobe {
            thickness,
            from_end: AT_END,
            radius,
        };
        let expected = lobe.expected();
        for (part, kind) in parts
            .iter()
            .flat_map(|part| [(part, "local"), (part, "hybrid")])
        {
            let cells = [SIZES[0], SIZES[1], thickness].map(|size| size / (part * thickness));
            let cells = cells.map(|cells| cells.round() as usize);
            let error = lobe.felt(cells, kind, "") / expected - 1.0;
            let [millimetres, tip, percent] = [1e3 * thickness, 2e3 * radius, 100.0 * error];
            println!(
                "{millimetres:.0} mm, tip of {tip:.0} mm, {kind}, triangles {part}: {percent:+.1} %"
            );
            assert!(error.abs() < 0.05, "{kind}: {error}");
        }
    }
}

#[test]
#[ignore = "long"]
fn a_lobe_is_felt_to_bend_by_every_model() {
    lobes_bend_by_a_response(&[5e-3], &[RADIUS], &[0.35, 0.5]);
}

/// Not with triangles of 0.8 of 7 mm, which spread the tip's force beyond the end of the lobe: 16 % too stiff.
#[test]
#[ignore = "slow: some minutes"]
fn lobes_of_3_to_7_mm_are_felt_to_bend_by_every_model() {
    lobes_bend_by_a_response(&[3e-3, 5e-3, 7e-3], &[1e-3, RADIUS], &[0.2, 0.35, 0.5]);
    lobes_bend_by_a_response(&[3e-3, 5e-3], &[RADIUS], &[0.8]);
}
