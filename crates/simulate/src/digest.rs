//! A digest that identifies a simulation by surface, tissue, model and tools. Folders, file names, devices and
//! display-only settings do not count.
//!
//! The digest of version 2 is `2-` and the first 16 hexadecimal digits of the SHA-256 of the canonical form: the
//! coordinates and nodes of the surface as bytes, then a line `key = values` for each number and word, under keys that
//! are defined only here. Numbers are the bits of their IEEE 754 form, so that their printed form does not matter, and
//! words are those of the documents. A field that is renamed in the program keeps its key here; a new field is written
//! only if its value differs from that of all earlier scenes.
//!
//! The digest of version 1 was 16 digits, from the names of the fields in the program. It is still computed, so that
//! sessions of that version are recognized.
//!
//! *How we know*: `digest::…`.

use std::fmt::{Debug, Write};

use palpate_files::scene::{
    Calibration, CavityContent, Cutting, DeviceKind, Enhancement, EstimatedInclusion, Inclusion,
    InclusionPlace, InclusionShape, IntegrationPoints, Jaws, Layer, LocalSettings, Model, Region,
    RegionBox, RegionPlane, RegionSphere, Tip, Tool,
};
use palpate_files::{Scene, Tissue};
use palpate_geometry::Surface;
use sha2::{Digest, Sha256};

use crate::neighbour::Neighbour;

/// Stiffness of every neighbour before scenes could state it [N/m].
const EARLIER_STIFFNESS: f64 = 1000.0;

/// Prefix of a digest of the canonical form.
const VERSION: &str = "2-";

/// The digests of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SceneDigest {
    /// Of the canonical form.
    pub(crate) canonical: String,
    /// Of version 1, before the canonical form.
    former: String,
}

impl SceneDigest {
    /// `effective` are the tissues of layers and inclusions that affect the forces, `enclosed` the surfaces of inclusions,
    /// and `neighbours` those of other bodies, each with the neighbour at which tools stop if it is rigid.
    pub(crate) fn of<'a>(
        scene: &Scene,
        surface: &Surface,
        tissue: &Tissue,
        effective: &[Tissue],
        enclosed: &[Surface],
        neighbours: impl Iterator<Item = (&'a Surface, Option<&'a Neighbour>)>,
    ) -> Self {
        let mut form = canonical(scene, tissue);
        effective.iter().for_each(|tissue| form.tissue(tissue));
        if scene.model.gravity_m_per_s2.is_some() {
            for tissue in std::iter::once(tissue).chain(effective) {
                form.numbers("density_kg_m3", &[tissue.density_kg_m3.value]);
            }
        }
        for body in enclosed {
            form.word("enclosed", &digits(of_surface(body)));
        }
        for (surface, rigid) in neighbours {
            form.word("neighbour", &digits(of_surface(surface)));
            let Some(rigid) = rigid else { continue };
            if rigid.stiffness != EARLIER_STIFFNESS {
                form.numbers("neighbour_stiffness_n_per_m", &[rigid.stiffness]);
            }
            if rigid.friction != 0.0 {
                form.numbers("neighbour_friction", &[rigid.friction]);
            }
        }
        let of_surface = of_surface(surface);
        let with = |text: &str| digits(of_surface.clone().chain_update(text));
        Self {
            canonical: format!("{VERSION}{}", with(&form.0)),
            former: with(&former(scene, tissue)),
        }
    }

    /// Whether the digest in a session is one of this scene.
    pub(crate) fn matches(&self, digest: &str) -> bool {
        digest == self.canonical || digest == self.former
    }
}

/// Whether two digests are of different scenes; none if their versions differ, since these cannot be compared.
pub(crate) fn differ(one: &str, other: &str) -> Option<bool> {
    let is_canonical = |digest: &str| digest.starts_with(VERSION);
    (is_canonical(one) == is_canonical(other)).then(|| one != other)
}

fn of_surface(surface: &Surface) -> Sha256 {
    let mut hash = Sha256::new();
    for vertex in surface.mesh().vertices() {
        for coordinate in vertex.iter() {
            hash.update(coordinate.to_le_bytes());
        }
    }
    for node in surface.mesh().triangles().iter().flatten() {
        hash.update(node.0.to_le_bytes());
    }
    hash
}

fn digits(hash: Sha256) -> String {
    let bytes = hash.finalize();
    bytes[..8]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// The text of version 1.
fn former(scene: &Scene, tissue: &Tissue) -> String {
    // The device of a tool does not affect the simulation.
    let mut tools = scene.tools.clone();
    tools
        .iter_mut()
        .for_each(|tool| tool.device = DeviceKind::None);
    let parts: [&dyn Debug; 8] = [
        &tissue.elasticity,
        &tissue.prony,
        &scene.organ.anchor,
        &scene.model,
        &tools,
        &scene.cutting,
        &scene.organ.layers,
        &scene.organ.estimated_inclusions,
    ];
    let text = parts.map(|part| format!("{part:?}")).concat();
    // In version 1 layers had no toughness of their own, and the local model no calibration.
    text.replace(", toughness_j_per_m2: None", "")
        .replace(", calibration: Fitted", "")
        .replace(", reason: None", "")
        .replace(", nodes: None", "")
        .replace(", gravity_m_per_s2: None", "")
        .replace(", friction: None", "")
}

/// The canonical text.
fn canonical(scene: &Scene, tissue: &Tissue) -> Form {
    let mut form = Form::default();
    form.tissue(tissue);
    form.region("anchor", scene.organ.anchor.as_ref());
    form.model(&scene.model);
    scene.tools.iter().for_each(|tool| form.tool(tool));
    form.cutting(&scene.cutting);
    scene
        .organ
        .layers
        .iter()
        .for_each(|layer| form.layer(layer));
    scene
        .organ
        .estimated_inclusions
        .iter()
        .for_each(|inclusion| form.estimated_inclusion(inclusion));
    scene
        .organ
        .inclusions
        .iter()
        .for_each(|inclusion| form.inclusion(inclusion));
    if scene.organ.self_contact {
        form.numbers("self_friction", &[scene.organ.self_friction]);
    }
    for (soft, neighbour) in scene
        .neighbours
        .iter()
        .filter_map(|own| Some((own.soft.as_ref()?, own)))
    {
        form.region("soft_anchor", soft.anchor.as_ref());
        form.numbers("soft", &[soft.nodes as f64, neighbour.friction]);
        soft.layers.iter().for_each(|layer| form.layer(layer));
        let inclusions = soft.inclusions.iter();
        inclusions.for_each(|inclusion| form.inclusion(inclusion));
    }
    form
}

/// Lines `key = values`. Structs are destructured completely, so that the compiler demands a line for a new field.
#[derive(Default)]
struct Form(String);

impl Form {
    fn word(&mut self, key: &str, word: &str) {
        writeln!(self.0, "{key} = {word}").expect("a string takes every text");
    }

    fn numbers(&mut self, key: &str, numbers: &[f64]) {
        // 0 and -0 are the same number.
        let bits = numbers.iter().map(|number| (number + 0.0).to_bits());
        let bits: Vec<String> = bits.map(|bits| format!("{bits:016x}")).collect();
        self.word(key, &bits.join(" "));
    }

    fn optional(&mut self, key: &str, number: Option<f64>) {
        match number {
            Some(number) => self.numbers(key, &[number]),
            None => self.word(key, "none"),
        }
    }

    fn tissue(&mut self, tissue: &Tissue) {
        // The uncertainty and the name of a number change no force.
        self.word("law", tissue.elasticity.law().word());
        for (key, parameter) in tissue.elasticity.parameters() {
            self.numbers(key, &[parameter.value]);
        }
        for term in &tissue.prony {
            self.numbers("prony", &[term.g.value, term.tau_s.value]);
        }
    }

    fn region(&mut self, name: &str, region: Option<&Region>) {
        let Some(Region {
            planes,
            boxes,
            spheres,
        }) = region
        else {
            return self.word(name, "none");
        };
        self.word(name, "region");
        for RegionPlane { point_m, normal } in planes {
            self.numbers("plane", &[*point_m, *normal].concat());
        }
        for RegionBox { min_m, max_m } in boxes {
            self.numbers("box", &[*min_m, *max_m].concat());
        }
        for RegionSphere { center_m, radius_m } in spheres {
            self.numbers("sphere", &[&center_m[..], &[*radius_m]].concat());
        }
    }

    fn model(&mut self, model: &Model) {
        let Model {
            kind,
            // The reason is no part of the simulation.
            reason: _,
            step_s,
            local,
            enhancement,
            mechanical_triangles,
            nodes,
            gravity_m_per_s2,
            response,
            hand_over,
            force_scale,
        } = model;
        self.word("model", kind.word());
        self.numbers("step_s", &[*step_s]);
        let LocalSettings {
            particles,
            form,
            placement,
            solver,
            assembly,
            integration_points,
            calibration,
        } = local;
        self.word("particles", &particles.to_string());
        self.word("form", form.word());
        self.word("placement", placement.word());
        self.word("solver", solver.word());
        self.word("assembly", assembly.word());
        let points = match integration_points {
            IntegrationPoints::Few => "few",
            IntegrationPoints::Standard => "standard",
            IntegrationPoints::Many => "many",
        };
        self.word("integration_points", points);
        // Sessions from before this choice keep their digest.
        if *calibration != Calibration::Fitted {
            self.word("calibration", calibration.word());
        }
        let Enhancement {
            area,
            levels,
            smoothing,
        } = enhancement;
        self.word("area", area.word());
        self.word("levels", &levels.to_string());
        self.word("smoothing", smoothing.word());
        let triangles = mechanical_triangles.map(|count| count.to_string());
        self.word(
            "mechanical_triangles",
            triangles.as_deref().unwrap_or("none"),
        );
        if let Some(nodes) = nodes {
            self.word("nodes", &nodes.to_string());
        }
        if let Some(gravity) = gravity_m_per_s2 {
            self.numbers("gravity_m_per_s2", gravity);
        }
        self.word("response", response.word());
        self.word("hand_over", hand_over.word());
        self.numbers("force_scale", &[*force_scale]);
    }

    fn tool(&mut self, tool: &Tool) {
        let Tool {
            name,
            kind,
            tip:
                Tip {
                    shape,
                    radius_m,
                    contact,
                    friction,
                },
            trocar_m,
            trocar_friction_n,
            trocar_stiffness_n_per_m,
            jaws,
            // Display only.
            mesh: _,
            // The device of a tool does not affect the simulation.
            device: _,
        } = tool;
        self.word("tool", name);
        self.word("kind", kind.word());
        self.word("shape", shape.word());
        self.numbers("radius_m", &[*radius_m]);
        self.word("contact", contact.word());
        // Written if a scene states one: earlier scenes had none.
        if let Some(friction) = friction {
            self.numbers("tip_friction", &[*friction]);
        }
        match trocar_m {
            Some(place) => self.numbers("trocar_m", place),
            None => self.word("trocar_m", "none"),
        }
        self.numbers("trocar_friction_n", &[*trocar_friction_n]);
        self.numbers("trocar_stiffness_n_per_m", &[*trocar_stiffness_n_per_m]);
        match jaws {
            Some(Jaws {
                length_m,
                width_m,
                opening_m,
                force_n,
                friction,
            }) => self.numbers(
                "jaws",
                &[*length_m, *width_m, *opening_m, *force_n, *friction],
            ),
            None => self.word("jaws", "none"),
        }
    }

    fn cutting(&mut self, cutting: &Cutting) {
        let Cutting {
            mode,
            depth_m,
            width_m,
            toughness_j_per_m2,
            force_limit_n,
        } = cutting;
        self.word("cutting", mode.word());
        self.optional("depth_m", *depth_m);
        self.numbers("width_m", &[*width_m]);
        self.numbers("toughness_j_per_m2", &[*toughness_j_per_m2]);
        self.optional("force_limit_n", *force_limit_n);
    }

    /// A layer's own tissue is listed with those that affect the forces, if it does.
    fn layer(&mut self, layer: &Layer) {
        let Layer {
            name: _,
            thickness_m,
            tissue: _,
            perforation_force_n,
            toughness_j_per_m2,
        } = layer;
        self.numbers("layer", &[*thickness_m]);
        self.optional("perforation_force_n", *perforation_force_n);
        // Scenes of before layers had it keep their digest.
        if let Some(toughness) = toughness_j_per_m2 {
            self.numbers("layer_toughness_j_per_m2", &[*toughness]);
        }
    }

    /// A surface is identified by its vertices; its tissue is listed with those that affect the forces.
    fn inclusion(&mut self, inclusion: &Inclusion) {
        match inclusion.cavity() {
            Some(CavityContent::Pressure(pressure)) => self.numbers("cavity", &[pressure]),
            Some(CavityContent::Fluid(pressure)) => self.numbers("fluid", &[pressure]),
            None => {}
        }
        if let InclusionPlace::Shape(shape) = &inclusion.place {
            self.shape(shape);
        }
    }

    fn shape(&mut self, shape: &InclusionShape) {
        match shape {
            InclusionShape::Ball { center_m, radius_m } => {
                self.numbers("ball", &[&center_m[..], &[*radius_m]].concat());
            }
            InclusionShape::Ellipsoid {
                center_m,
                radii_m,
                turn_rad,
            } => self.numbers("ellipsoid", &[*center_m, *radii_m, *turn_rad].concat()),
            InclusionShape::Capsule {
                from_m,
                to_m,
                radius_m,
            } => self.numbers("capsule", &[&from_m[..], to_m, &[*radius_m]].concat()),
        }
    }

    fn estimated_inclusion(&mut self, inclusion: &EstimatedInclusion) {
        let EstimatedInclusion {
            name: _,
            shape,
            stiffness_ratio,
        } = inclusion;
        self.numbers("estimated_inclusion", &[*stiffness_ratio]);
        self.shape(shape);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Simulation;

    const ESOPHAGUS: &str = include_str!("../../../assets/esophagus/scene.toml");

    const SCENE: &str = "format = 1\n[organ]\nbuiltin = \"hemisphere\"\ntriangles = 800\n[organ.tissue]\n\
        law = \"linear\"\nyoungs_modulus_pa = 10000.0\npoissons_ratio = 0.45\n\
        prony = [{ g = 0.3, tau_s = 0.5 }]\n[[organ.layer]]\nname = \"outer\"\nthickness_m = 0.001\n\
        builtin_tissue = \"pig-liver\"\n[[organ.inclusion]]\nball = { center_m = [0.0, 0.0, 0.03], radius_m = 0.005 }\n\
        stiffness_ratio = 6.0\n[model]\nkind = \"local\"\n[[tool]]\nname = \"right\"\ndevice = \"mouse\"\n\
        tip = { shape = \"flat\", radius_m = 0.002, contact = \"slip\" }\n[[neighbour]]\nbuiltin = \"cube\"\n\
        at_m = [0.3, 0.0, 0.0]\ncollides = true\nfriction = 0.2\n";

    fn digest(text: &str) -> SceneDigest {
        let scene = Scene::parse(text, "scene.toml").unwrap();
        Simulation::new(&scene).unwrap().scene_digest
    }

    /// The digest of this scene in a session of version 0.1.0. The current one is in `tests/it/digest.rs`.
    #[test]
    fn digests_of_recorded_sessions_are_known() {
        let esophagus = digest(ESOPHAGUS);
        assert!(esophagus.matches("03af0b310a409016"));
        assert!(esophagus.canonical.starts_with(VERSION));
        assert!(esophagus.matches(&esophagus.canonical));
        assert!(!esophagus.matches("2-03af0b310a409016"));
    }

    /// Every change of a force changes the digest; names, devices and number formats do not.
    #[test]
    fn whatever_changes_a_force_changes_the_digest() {
        let own = digest(SCENE);
        for (from, to) in [
            ("10000.0", "10000.000001"),
            ("linear", "neo_hookean"),
            ("g = 0.3", "g = 0.31"),
            ("tau_s = 0.5", "tau_s = 0.6"),
            ("thickness_m = 0.001", "thickness_m = 0.002"),
            ("0.03]", "0.031]"),
            ("stiffness_ratio = 6.0", "stiffness_ratio = 7.0"),
            ("kind = \"local\"", "kind = \"local\"\nparticles = 50"),
            ("kind = \"local\"", "kind = \"local\"\nstep_s = 0.004"),
            ("slip", "stick"),
            ("0.002, c", "0.0021, c"),
            ("triangles = 800", "triangles = 900"),
            ("\"flat\"", "\"sphere\""),
            ("friction = 0.2", "friction = 0.25"),
        ] {
            let mut changed = SCENE.replace(from, to);
            if to == "neo_hookean" {
                changed = changed.replace(
                    "youngs_modulus_pa = 10000.0\npoissons_ratio = 0.45",
                    "c10_pa = 1000.0",
                );
            }
            assert_ne!(changed, SCENE, "{from}");
            assert_ne!(digest(&changed).canonical, own.canonical, "{from}: {to}");
        }
        for (from, to) in [("outer", "muscle"), ("mouse", "none"), ("10000.0", "1e4")] {
            let changed = SCENE.replace(from, to);
            assert_eq!(digest(&changed).canonical, own.canonical, "{from}: {to}");
        }
    }

    #[test]
    fn digests_of_two_versions_are_not_compared() {
        assert_eq!(differ("2-01", "2-02"), Some(true));
        assert_eq!(differ("01", "01"), Some(false));
        assert_eq!(differ("2-01", "01"), None);
    }
}
