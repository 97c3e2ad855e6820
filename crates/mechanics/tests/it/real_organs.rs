//! Real organs under a tip, beside quadratic tetrahedra at many places.

use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

use palpate_files::scene::Smoothing;
use palpate_geometry::{AabbTree, Surface, TriangleId, closest_on_triangle, read_mesh};
use palpate_mechanics::Vec3;
use palpate_mechanics::contact::{Friction, Tip, half_space_stiffness};
use palpate_mechanics::enhance::{Interpolation, Press, SurfaceField, SurfacePoint, profile};
use palpate_mechanics::finite_elements::solid::{
    Body, MovedPatch, SolidAnswer, SolidProblem, solve,
};
use palpate_mechanics::surface_response::{PressedTip, SurfaceResponse, TipField, TipLoad};

use crate::boundary_response::Held;
use crate::solid::plane;
use crate::tip_field::{FlatTip, compliance, law};

const NU: f64 = 0.45;
const RADIUS: f64 = 3e-3;
const DEPTH: f64 = 1e-4;

fn real(name: &str) -> Option<Surface> {
    let path = crate::data::folder()?.join(format!("meshes/{name}.ply"));
    let mesh = read_mesh(&path, None).unwrap().mesh;
    Some(Surface::new(mesh).unwrap())
}

/// Triangles as far from one another and from what is held as can be.
fn spread(solid: &Held, count: usize) -> Vec<TriangleId> {
    let held = solid.held.iter().map(|&id| solid.centroid(id));
    let mut taken: Vec<Vec3> = held.collect();
    let mut places = Vec::new();
    let mut nearest: Vec<f64> = solid
        .free
        .iter()
        .map(|&id| {
            let away = taken.iter().map(|x| (x - solid.centroid(id)).norm());
            away.fold(f64::INFINITY, f64::min)
        })
        .collect();
    while places.len() < count {
        let (at, _) = nearest
            .iter()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(b.1))
            .unwrap();
        let id = solid.free[at];
        places.push(id);
        taken.push(solid.centroid(id));
        for (distance, &other) in nearest.iter_mut().zip(&solid.free) {
            *distance = distance.min((solid.centroid(other) - solid.centroid(id)).norm());
        }
    }
    places
}

/// A kidney that is held on its lower quarter, with what ten places on it need to be touched.
struct Kidney {
    solid: Held,
    floor: Vec3,
    places: Vec<TriangleId>,
    response: SurfaceResponse,
}

impl Kidney {
    fn new(surface: Surface) -> Self {
        let (low, high) = surface.mesh().bounds();
        let floor = low + 0.25 * (high - low);
        let solid = Held::new(surface, NU, |centroid| centroid.y < floor.y);
        let places = spread(&solid, 10);
        let mut touchable: Vec<_> = places.iter().flat_map(|&id| solid.near(id, 100)).collect();
        touchable.sort();
        touchable.dedup();
        Self {
            response: solid.response(&touchable),
            solid,
            floor,
            places,
        }
    }

    fn problem(&self, place: TriangleId, friction: Friction) -> SolidProblem {
        let normal = self.solid.surface.mesh().area_vector(place).normalize();
        SolidProblem {
            patch: Some(MovedPatch {
                center: self.solid.centroid(place),
                radius: RADIUS,
                displacement: -DEPTH * normal,
                friction,
            }),
            ..SolidProblem::new(
                Body::Surface(self.solid.surface.clone()),
                plane(self.floor, Vec3::y()),
                Arc::new(law(NU)),
            )
        }
    }

    /// The whole surface under a tip, with its dimple.
    fn pressed(&self, load: &TipLoad<'_>, tip: &PressedTip, at: SurfacePoint) -> Shown {
        let surface = &self.solid.surface;
        let mut sums = vec![0.0_f32; 3 * self.response.parts().triangles];
        self.response.add_field_of_tip(load, &tip.force, &mut sums);
        self.response.sharpen(surface, load, tip, &mut sums);
        let moved = sums.as_chunks::<3>().0.iter();
        let moved: Vec<_> = moved.map(|u| Vec3::from(u.map(f64::from))).collect();
        let interpolation = Interpolation::new(surface.clone(), Smoothing::MovingLeastSquares);
        let mut field = SurfaceField::default();
        let press = Press {
            at,
            tip: tip.tip,
            displacement: tip.own + load.structural_compliance() * tip.force,
            own: tip.own,
        };
        field.update(&interpolation, &moved, &[press]);
        Shown {
            interpolation,
            field,
        }
    }

    /// How far the dimple and its spread load are from each other where the patch ends, in parts of the
    /// depth [-].
    fn jump(&self, load: &TipLoad<'_>, tip: &PressedTip) -> f64 {
        let bearing: Vec<_> = load
            .shares()
            .map(|share| {
                let centroid = self.response.touchable()[share.triangle.index()].centroid;
                (share.weight, centroid)
            })
            .collect();
        let away = bearing.iter().map(|(_, x)| (x - tip.place).norm());
        let reach = away.fold(0.0, f64::max);
        let along = tip.normal * tip.normal.dot(&tip.force);
        let yields = along * (1.0 - NU) + (tip.force - along) * (1.0 - 0.5 * NU);
        let jump = |place: Vec3| {
            let terms = bearing.iter();
            let inverse: f64 = terms.map(|(weight, x)| weight / (x - place).norm()).sum();
            let spread = yields * (inverse * (1.0 + NU) / PI);
            let own = tip.own * profile(&tip.tip, RADIUS, (place - tip.place).norm());
            (own - spread).norm() / DEPTH
        };
        let free = self.solid.free.iter().map(|&id| self.solid.centroid(id));
        let border = free.filter(|x| ((x - tip.place).norm() / reach - 2.0).abs() < 0.1);
        border.map(jump).fold(0.0, f64::max)
    }

    /// How far the triangles that a tip reaches turn away under it [degrees].
    fn turn(&self, tip: &PressedTip) -> f64 {
        let mesh = self.solid.surface.mesh();
        let reached = |&&id: &&TriangleId| {
            let nearest = closest_on_triangle(&mesh.positions(id), &tip.place);
            (nearest.position - tip.place).norm() < RADIUS
        };
        let under = self.solid.free.iter().filter(reached);
        let turns = under.map(|&id| mesh.area_vector(id).angle(&tip.normal).to_degrees());
        turns.fold(0.0, f64::max)
    }
}

/// A surface that a tip has moved.
struct Shown {
    interpolation: Interpolation,
    field: SurfaceField,
}

impl Shown {
    /// Root of the mean square of the difference of displacements, and the largest, in parts of the depth [-],
    /// over the nodes of the tetrahedra on the surface whose distance from the tip [m] is in `range`.
    fn error(&self, judge: &SolidAnswer, tip: &Vec3, range: Range<f64>) -> [f64; 2] {
        let mesh = self.interpolation.surface().mesh();
        let tree = AabbTree::new(mesh);
        let (mut squares, mut count, mut largest) = (0.0, 0.0, 0.0_f64);
        let fields = &judge.fields;
        for (x, u) in fields.positions.iter().zip(&fields.displacements) {
            let on = tree.nearest(mesh, x);
            // Half a depth: nodes on the surface, and between two of them on a chord.
            if on.distance > 0.5 * DEPTH || !range.contains(&(x - tip).norm()) {
                continue;
            }
            let at = SurfacePoint {
                triangle: on.triangle,
                barycentric: on.on.barycentric,
            };
            let off = (self.field.displacement(&self.interpolation, &at) - u).norm() / DEPTH;
            squares += off * off;
            count += 1.0;
            largest = largest.max(off);
        }
        [(squares / count).sqrt(), largest]
    }
}

/// A tip at `place` that has been moved inward.
fn pressed_tip(load: &TipLoad<'_>, place: Vec3, normal: Vec3, bond: Friction) -> PressedTip {
    let tip = FlatTip {
        a: RADIUS,
        nu: NU,
        bond,
    };
    let compliance = compliance(load, &normal, tip);
    let moved = -DEPTH * normal;
    let force = match bond {
        Friction::Frictionless => moved / normal.dot(&(compliance * normal)),
        Friction::Bonded => compliance.try_inverse().unwrap() * moved,
    };
    PressedTip {
        tip: Tip::Flat { radius: RADIUS },
        radius: RADIUS,
        place,
        normal,
        own: (compliance - load.structural_compliance()) * force,
        force,
    }
}

/// Judge: quadratic tetrahedra at ten places as far from one another as can be, to 3 %. Tolerances: what is
/// asked for: 8 % of the force, 3 % at five of them; a hundredth of the depth where the refined patch ends; a
/// tenth in the field, in the mean under the tip and at each point beyond it (`docs/theory/boundary_elements.md` has
/// what it is at the tip's rim, where it slides on a fold).
#[test]
#[ignore = "slow: half an hour"]
fn real_kidney_at_ten_places() {
    let Some(surface) = real("vhm_kidney_left_5146") else {
        return;
    };
    let kidney = Kidney::new(surface);
    let surface = &kidney.solid.surface;
    let field = TipField::new(&kidney.response, surface, RADIUS).unwrap();
    let (mut worst, mut close) = ([0.0_f64; 3], 0);
    for (number, &place) in kidney.places.iter().enumerate() {
        let bonds = [
            (Friction::Frictionless, Friction::Frictionless),
            (Friction::Bonded, Friction::Bonded),
        ];
        let (grip, bond) = bonds[number % 2];
        let problem = kidney.problem(place, grip);
        let normal = -problem.patch.unwrap().displacement.normalize();
        let at = SurfacePoint::centroid(place);
        let load = field.at(surface, place, &at.barycentric);
        let tip = pressed_tip(&load, problem.patch.unwrap().center, normal, bond);
        let judge = solve(&problem, 0.03, &mut |_| ()).unwrap();
        let half_space = DEPTH * half_space_stiffness(&law(NU), RADIUS, bond);
        let force = tip.force.dot(&-normal) / judge.answer.force_along - 1.0;
        let shown = kidney.pressed(&load, &tip, at);
        let [near, rim] = shown.error(&judge.answer, &tip.place, 0.0..2.0 * RADIUS);
        let [mean, largest] = shown.error(&judge.answer, &tip.place, 2.0 * RADIUS..f64::MAX);
        let jump = kidney.jump(&load, &tip);
        let turn = kidney.turn(&tip);
        println!(
            "{number} {bond:?}: {:.4} of the half-space, {:+.1} % (judge: {:.1} %), field off by {mean:.3} of the \
             depth, {largest:.3} at most, {near:.3} at the tip, {rim:.3} at most, jump {jump:.4}, turns by {turn:.0} degrees",
            judge.answer.force_along / half_space,
            100.0 * force,
            100.0 * judge.error,
        );
        close += usize::from(force.abs() < 0.03);
        worst = [
            worst[0].max(force.abs()),
            worst[1].max(jump),
            worst[2].max(near).max(largest),
        ];
    }
    assert!(
        worst[0] < 0.08 && worst[1] < 0.01 && worst[2] < 0.1,
        "{worst:?}"
    );
    assert!(close >= 5, "{close}");
}
