//! Scenes and motions in few words.

use palpate_files::{Motion, Pose, Scene, SessionRow};
use palpate_geometry::{AabbTree, TriangleId, Vec3};
use palpate_simulate::{
    Error, Flow, Simulation, SimulationState, SimulationWorkspace, Summary, play, step,
};

pub(crate) const YOUNGS_MODULUS: f64 = 1e4;

/// A scene with one tool, `right`.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    /// Lines of `[organ]`.
    pub(crate) organ: &'a str,
    /// Which model.
    pub(crate) kind: &'a str,
    /// Lines of `[model]`.
    pub(crate) model: &'a str,
    pub(crate) poissons_ratio: f64,
    pub(crate) shape: &'a str,
    pub(crate) radius: f64,
    pub(crate) contact: &'a str,
    /// The `prony` of the tissue.
    pub(crate) prony: &'a str,
}

impl Default for Setting<'_> {
    fn default() -> Self {
        Self {
            organ: "builtin = \"hemisphere\"",
            kind: "local",
            model: "",
            poissons_ratio: 0.45,
            shape: "flat",
            radius: 1e-3,
            contact: "slip",
            prony: "[]",
        }
    }
}

impl Setting<'_> {
    pub(crate) fn scene(&self) -> Scene {
        let text = format!(
            "format = 1\n[organ]\n{}\n[organ.tissue]\nlaw = \"linear\"\n\
             youngs_modulus_pa = {YOUNGS_MODULUS:?}\npoissons_ratio = {:?}\nprony = {}\n\
             [model]\nkind = \"{}\"\n{}\n[[tool]]\nname = \"right\"\n\
             tip = {{ shape = \"{}\", radius_m = {:?}, contact = \"{}\" }}\n",
            self.organ,
            self.poissons_ratio,
            self.prony,
            self.kind,
            self.model,
            self.shape,
            self.radius,
            self.contact
        );
        Scene::parse(&text, "scene.toml").unwrap()
    }

    pub(crate) fn simulation(&self) -> Simulation {
        Simulation::new(&self.scene()).unwrap()
    }
}

/// A run that is stepped by hand.
pub(crate) struct Hand<'a> {
    simulation: &'a Simulation,
    pub(crate) state: SimulationState,
    pub(crate) workspace: SimulationWorkspace,
    time: f64,
}

impl<'a> Hand<'a> {
    pub(crate) fn new(simulation: &'a Simulation) -> Self {
        Self {
            simulation,
            state: SimulationState::new(simulation),
            workspace: SimulationWorkspace::new(simulation),
            time: 0.0,
        }
    }

    /// The first tool one step later at `tip` [m]; the force on it [N].
    pub(crate) fn at(&mut self, tip: &Vec3) -> Vec3 {
        let pose = Pose {
            position_m: (*tip).into(),
            orientation: None,
            grip: 0.0,
            cut: false,
        };
        let elapsed = self.simulation.step();
        step(
            self.simulation,
            self.time,
            elapsed,
            &[Some(pose)],
            &mut self.state,
            &mut self.workspace,
        );
        self.time += elapsed;
        self.state.tools[0].force
    }

    pub(crate) fn row(&self) -> &SessionRow {
        &self.state.tools[0].row
    }
}

/// A motion of the tool `right` through `rows` of time [s] and place [m].
pub(crate) fn motion(rows: &[(f64, [f64; 3])]) -> Motion {
    let mut text = "# format = 1\ntime_s,tool,x_m,y_m,z_m\n".to_owned();
    for (time, [x, y, z]) in rows {
        text += &format!("{time:?},right,{x:?},{y:?},{z:?}\n");
    }
    Motion::parse(&text, "motion.csv").unwrap()
}

pub(crate) fn played(simulation: &Simulation, motion: &Motion) -> (Vec<SessionRow>, Summary) {
    let mut rows = Vec::new();
    let summary = play(simulation, motion, |frame| -> Result<Flow, Error> {
        rows.extend(frame.rows().copied());
        Ok(Flow::Continue)
    });
    (rows, summary.unwrap())
}

/// A plain linear congruential generator: the same places on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Evenly in 0..1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::from_fn(|_, _| self.unit() - 0.5)
    }

    /// A point of the surface, the outward normal of its triangle, and a direction along it.
    pub(crate) fn place(&mut self, simulation: &Simulation) -> (Vec3, Vec3, Vec3) {
        let mesh = simulation.surface().mesh();
        let number = self.unit() * mesh.triangles().len() as f64;
        let triangle = TriangleId(number as u32);
        let [a, b, c] = mesh.positions(triangle);
        let (mut u, mut v) = (self.unit(), self.unit());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let normal = mesh.area_vector(triangle).normalize();
        let direction = self.vector();
        let along = direction - normal * direction.dot(&normal);
        (a + (b - a) * u + (c - a) * v, normal, along.normalize())
    }
}

/// The nearest point of the rest surface [m] and the normal that changes smoothly over it.
pub(crate) fn nearest(simulation: &Simulation, tree: &AabbTree, point: &Vec3) -> (Vec3, Vec3) {
    let mesh = simulation.surface().mesh();
    let near = tree.nearest(mesh, point);
    let normals = simulation.surface().vertex_normals();
    let corners = mesh.corners(near.triangle);
    let normal: Vec3 = (0..3)
        .map(|k| normals[corners[k].index()] * near.on.barycentric[k])
        .sum();
    (near.on.position, normal.normalize())
}
