//! Rigid bodies that a nonlinear body stays out of.

use std::sync::Arc;

use palpate_geometry::TetrahedronMesh;
use palpate_mechanics::contact::FrictionLaw;
use palpate_mechanics::finite_elements::indentation::{
    Base, Block, IndentationRun, IndentationSettings, Indenter, IndenterShape,
};
use palpate_mechanics::nonlinear::{
    Against, BoundaryPoint, Conditions, Moduli, NonlinearModel, NonlinearState, StepSettings,
    TOOL_POINTS, UnilateralContact, Workspace, advance,
};
use palpate_mechanics::{NeoHookean, PronySeries, Vec3};

/// c₁₀ [Pa].
const C10: f64 = 2000.0;

/// Edge and height of a block that is fixed below [m], and the radius of a sphere that presses it.
const EDGE: f64 = 0.2;
const HEIGHT: f64 = 0.1;
const RADIUS: f64 = 0.1;

/// A rigid body by the signed distance of a place [m], and its normal there.
type Body<'a> = &'a dyn Fn(&Vec3) -> (f64, Vec3);

/// Vertices crowd around the middle of the upper face.
fn graded(place: &Vec3) -> Vec3 {
    let about = |x: f64| {
        let off = 2.0 * x / EDGE - 1.0;
        0.5 * EDGE * (1.0 + off.signum() * off.abs().powf(1.7))
    };
    let below = 1.0 - place.z / HEIGHT;
    Vec3::new(
        about(place.x),
        about(place.y),
        HEIGHT * (1.0 - below.powf(1.7)),
    )
}

struct Pressed {
    against: Against,
    model: NonlinearModel,
    state: NonlinearState,
    workspace: Workspace,
}

impl Pressed {
    fn new(cells: [usize; 3], ratio: f64, against: Against) -> Self {
        let high = Vec3::new(EDGE, EDGE, HEIGHT);
        let even = TetrahedronMesh::block(Vec3::zeros(), high, cells).unwrap();
        let mesh = TetrahedronMesh::new(
            even.vertices().iter().map(graded).collect(),
            even.tetrahedra().to_vec(),
        )
        .unwrap();
        let moduli = Moduli::mooney_rivlin(C10, 0.0, ratio).unwrap();
        let moduli = vec![moduli; mesh.tetrahedra().len()];
        let model = NonlinearModel::new(
            &mesh,
            &moduli,
            |_, place| place.z < 1e-9,
            |_, place| place.z > HEIGHT - 1e-9,
        )
        .unwrap();
        Self {
            against,
            state: NonlinearState::at_rest(&model, 1),
            workspace: model.workspace(1),
            model,
        }
    }

    /// The contacts with `body` of the points that are nearer than a margin.
    fn contacts(&self, body: Body<'_>) -> Vec<UnilateralContact> {
        let points = self.points();
        points
            .filter_map(|(number, point)| {
                let moved = point.displacement(&self.state.displacements);
                let (distance, normal) = body(&(point.place + moved));
                let contact = UnilateralContact {
                    point: number as u32,
                    normal,
                    offset: distance - normal.dot(&moved),
                    friction: 0.0,
                    against: self.against,
                };
                let near = distance < 1e-3 || self.state.force_of(&self.model, &contact) > 0.0;
                (near && point.place.z > HEIGHT - 1e-6).then_some(contact)
            })
            .collect()
    }

    /// The points that may bear on what is pressed.
    fn points(&self) -> impl Iterator<Item = (usize, &BoundaryPoint)> {
        let [few, more] = TOOL_POINTS;
        let (points, of_face) = match self.against {
            Against::Tool { .. } => (self.model.tool_points(), few + more),
            Against::Fixed | Against::Boundary(_) => (self.model.boundary_points(), few),
        };
        let points = points.iter().enumerate();
        points.filter(move |(number, _)| number % of_face < few)
    }

    fn step(&mut self, body: Body<'_>, iterations: usize) {
        let contacts = self.contacts(body);
        let pace = StepSettings {
            iterations,
            elapsed: 0.0,
        };
        let conditions = Conditions {
            couplings: &[None],
            contacts: &contacts,
        };
        let ended = advance(
            &self.model,
            conditions,
            pace,
            &mut self.state,
            &mut self.workspace,
        );
        assert!(!ended.was_reset);
    }

    /// Distance of the point of the boundary that is nearest to `body` [m].
    fn nearest(&self, body: Body<'_>) -> f64 {
        let distances = self.points().map(|(_, point)| {
            let moved = point.displacement(&self.state.displacements);
            body(&(point.place + moved)).0
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    /// The force on the body [N] by all contacts, upwards negative.
    fn force(&self, body: Body<'_>) -> f64 {
        let contacts = self.contacts(body);
        let forces = contacts
            .iter()
            .map(|contact| self.state.force_of(&self.model, contact) * contact.normal.z);
        -forces.sum::<f64>()
    }
}

/// A sphere that is so deep in the block [m].
fn sphere(depth: f64) -> impl Fn(&Vec3) -> (f64, Vec3) {
    let centre = Vec3::new(0.5 * EDGE, 0.5 * EDGE, HEIGHT + RADIUS - depth);
    move |place| {
        let apart = place - centre;
        (apart.norm() - RADIUS, apart.normalize())
    }
}

/// Axisymmetric finite elements of a frictionless sphere on a cylinder of the block's height and area [N].
fn judged(depth: f64, ratio: f64) -> f64 {
    let bulk = 4.0 * C10 * (1.0 + ratio) / (3.0 * (1.0 - 2.0 * ratio));
    let law = NeoHookean::compressible(C10, bulk).unwrap();
    let settings = IndentationSettings {
        block: Block {
            radius: EDGE / std::f64::consts::PI.sqrt(),
            height: HEIGHT,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: IndenterShape::Sphere,
            radius: RADIUS,
            face: FrictionLaw::Frictionless,
        },
        law: Arc::new(law),
        prony: PronySeries::default(),
        deepest: depth,
        halvings: 0,
    };
    let mut run = IndentationRun::new(&settings).unwrap();
    run.press(depth, depth, |_| {}).unwrap().force
}

/// Judge of the force: axisymmetric finite elements with a sphere of their own, of a law that is the same at small strains:
/// 5 % for two laws, a square beside a disc (1 % between discs within and around it) and contact at points, of which finer
/// meshes (12 cells, and depths of 1.5 and 6 mm) kept 2.5 to 4.6 %, always too soft. Judge of a motion: the same, held and
/// iterated until nothing changes.
#[test]
#[ignore = "long"]
fn a_sphere_presses_as_on_finite_elements_and_leaves_the_body_at_rest() {
    let (depth, steps) = (6e-3, 6);
    for (ratio, against) in [
        (0.3, Against::Fixed),
        (0.45, Against::Fixed),
        (
            0.45,
            Against::Tool {
                number: 0,
                motion: Vec3::zeros(),
            },
        ),
    ] {
        let exact = judged(depth, ratio);
        let mut pressed = Pressed::new([8, 8, 4], ratio, against);
        for step in 1..=steps {
            pressed.step(&sphere(depth * f64::from(step) / f64::from(steps)), 4);
        }
        let moving = pressed.force(&sphere(depth));
        for _ in 0..6 {
            pressed.step(&sphere(depth), 15);
        }
        let force = pressed.force(&sphere(depth));
        println!("nu {ratio}: {exact:.3} N, converged {force:.3}, in motion {moving:.3}");
        assert!((moving / force - 1.0).abs() < 0.01, "{moving} {force}");
        assert!((force / exact - 1.0).abs() < 0.05, "{force} {exact}");
        let deepest = pressed.nearest(&sphere(depth));
        assert!(deepest > -0.01 * depth, "{deepest}");
        for step in (0..steps).rev() {
            let part = f64::from(step) / f64::from(steps);
            pressed.step(&sphere(depth * part - 1e-3), 4);
            assert!(pressed.force(&sphere(depth * part - 1e-3)) >= 0.0);
        }
        for _ in 0..3 {
            pressed.step(&sphere(-2e-3), 4);
        }
        let left = pressed.state.largest(&pressed.model);
        assert!(left < 1e-3 * depth, "{left}");
    }
}
