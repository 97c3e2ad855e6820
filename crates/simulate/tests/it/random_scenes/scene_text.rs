//! A random scene, as its document.

use std::fmt::Write as _;

use crate::scenes::Random;

impl Random {
    /// One of some things.
    pub(super) fn of<'a, T: ?Sized>(&mut self, all: &[&'a T]) -> &'a T {
        all[self.below(all.len())]
    }

    /// A whole number below another.
    pub(super) fn below(&mut self, end: usize) -> usize {
        ((self.unit() * end as f64) as usize).min(end - 1)
    }

    /// Whether something of this probability happens.
    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// As many small numbers as large ones, of both above zero.
    pub(super) fn spread(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }
}

/// Few organs and ratios, so that a whole organ's response is solved once and read after that.
const ORGANS: [&str; 8] = [
    "esophagus",
    "liver",
    "kidney",
    "stomach",
    "spleen",
    "diaphragm",
    "hemisphere",
    "cube",
];

pub(super) fn scene_text(random: &mut Random) -> String {
    let mut text = "format = 1\n".to_owned();
    let is_hybrid = random.chance(0.5);
    let organ = random.of(&ORGANS);
    writeln!(text, "[organ]\nbuiltin = \"{organ}\"\ntriangles = 400").unwrap();
    text += &tissue(random);
    if random.chance(0.3) {
        text += &layers(random);
    }
    if random.chance(0.15) {
        text += &inclusion(random, organ);
    }
    text += &model(random, is_hybrid);
    if random.chance(0.5) {
        text += &cutting(random);
    }
    let tools = 1 + random.below(2);
    for name in ["right", "left"].into_iter().take(tools) {
        text += &tool(random, name, organ);
    }
    text
}

fn tissue(random: &mut Random) -> String {
    let law = match random.below(1000) {
        0..600 => {
            let modulus = random.spread(300.0, 1e6);
            let ratio = random.of(&["0.3", "0.45", "0.49"]);
            format!("law = \"linear\"\nyoungs_modulus_pa = {modulus:?}\npoissons_ratio = {ratio}\n")
        }
        600..998 => format!(
            "law = \"neo_hookean\"\nc10_pa = {:?}\n",
            random.spread(100.0, 1e5)
        ),
        // Their force over depth is computed for each scene, in minutes.
        998 => "law = \"mooney_rivlin\"\nc10_pa = 500.0\nc01_pa = 300.0\n".to_owned(),
        _ => "law = \"exponential\"\ngamma_pa = 900.0\nalpha = 1.5\n".to_owned(),
    };
    let mut left = 0.95;
    let terms: Vec<_> = (0..random.below(4))
        .map(|_| {
            let g = left * random.between(0.05, 0.8);
            left -= g;
            format!("{{ g = {g:?}, tau_s = {:?} }}", random.spread(1e-3, 20.0))
        })
        .collect();
    format!("[organ.tissue]\n{law}prony = [{}]\n", terms.join(", "))
}

fn layers(random: &mut Random) -> String {
    (0..1 + random.below(3))
        .map(|_| {
            format!(
                "[[organ.layer]]\nthickness_m = {:?}\nbuiltin_tissue = \"pig-esophagus\"\n\
                 perforation_force_n = {:?}\n",
                random.spread(2e-4, 2e-3),
                random.spread(0.02, 5.0)
            )
        })
        .collect()
}

/// In the middle of a body that has tissue there.
fn inclusion(random: &mut Random, organ: &str) -> String {
    let middle = match organ {
        "hemisphere" => random.between(0.005, 0.045),
        "cube" => random.between(-0.045, 0.045),
        _ => return String::new(),
    };
    format!(
        "[[organ.inclusion]]\nball = {{ center_m = [0.0, 0.0, {middle:?}], radius_m = {:?} }}\nstiffness_ratio = {:?}\n",
        random.spread(1e-3, 1e-2),
        random.between(1.5, 30.0)
    )
}

fn model(random: &mut Random, is_hybrid: bool) -> String {
    let step = random.of(&["0.001", "0.005", "0.005", "0.02"]);
    let hand_over = random.of(&["local_model", "linear", "hold"]);
    let common = format!("step_s = {step}\nhand_over = \"{hand_over}\"\n");
    if !is_hybrid {
        let placement = random.of(&["template", "template", "source"]);
        let assembly = match placement {
            "template" => random.of(&["every_step", "reused"]),
            _ => "every_step",
        };
        return format!(
            "[model]\nkind = \"local\"\n{common}particles = {}\nform = \"{}\"\nplacement = \"{placement}\"\n\
             solver = \"{}\"\nassembly = \"{assembly}\"\n",
            random.of(&["12", "20", "34"]),
            random.of(&["weak", "weak", "strong"]),
            match random.chance(0.1) {
                true => "gmres",
                false => "direct",
            },
        );
    }
    format!(
        "[model]\nkind = \"hybrid\"\n{common}response = \"boundary_elements\"\nmechanical_triangles = {}\n\
         enhancement = {{ area = \"{}\", levels = {}, smoothing = \"{}\" }}\n",
        random.of(&["120", "240"]),
        random.of(&["none", "edge", "vertex"]),
        random.below(3),
        random.of(&["none", "shepard", "moving_least_squares"]),
    )
}

fn cutting(random: &mut Random) -> String {
    let mut text = format!(
        "[cutting]\nmode = \"{}\"\nwidth_m = {:?}\ntoughness_j_per_m2 = {:?}\n",
        random.of(&["split", "split", "snap"]),
        random.spread(3e-4, 3e-3),
        random.spread(1.0, 400.0)
    );
    if random.chance(0.7) {
        writeln!(text, "depth_m = {:?}", random.spread(3e-4, 5e-3)).unwrap();
    }
    if random.chance(0.3) {
        writeln!(text, "force_limit_n = {:?}", random.spread(0.01, 3.0)).unwrap();
    }
    text
}

fn tool(random: &mut Random, name: &str, organ: &str) -> String {
    let kind = random.of(&["probe", "grasper", "grasper", "scissors", "hook"]);
    let mut text = format!(
        "[[tool]]\nname = \"{name}\"\nkind = \"{kind}\"\n\
         tip = {{ shape = \"{}\", radius_m = {:?}, contact = \"{}\" }}\n",
        random.of(&["flat", "sphere"]),
        random.spread(5e-4, 8e-3),
        random.of(&["stick", "slip"])
    );
    if random.chance(0.25) {
        let away = match organ {
            "hemisphere" | "cube" => 0.15,
            _ => 0.4,
        };
        let [x, y] = [(); 2].map(|()| random.between(-0.1, 0.1));
        writeln!(text, "trocar_m = [{x:?}, {y:?}, {away:?}]").unwrap();
    }
    if kind == "grasper" && random.chance(0.7) {
        writeln!(
            text,
            "jaws = {{ length_m = {:?}, width_m = {:?}, opening_m = {:?}, force_n = {:?}, friction = {:?} }}",
            random.spread(4e-3, 3e-2),
            random.spread(1e-3, 1e-2),
            random.spread(3e-3, 2e-2),
            random.spread(0.05, 20.0),
            random.of(&[&0.0, &0.1, &0.4, &1.0, &100.0])
        )
        .unwrap();
    }
    text
}
