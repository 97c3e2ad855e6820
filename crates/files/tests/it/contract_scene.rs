//! Scenes in the words that others rely on.

use std::path::PathBuf;

use palpate_files::scene::*;
use palpate_files::{Error, Scene, Tissue};

const ORGAN: &str = "builtin = \"hemisphere\"\nbuiltin_tissue = \"pig-liver\"\n";
const NONLINEAR: &str = "[model]\nkind = \"nonlinear\"\nnodes = 800\n";

fn read(text: &str) -> Result<Scene, Error> {
    Scene::parse(&format!("format = 1\n{text}"), "scenes/scene.toml")
}

fn parse(text: &str) -> Scene {
    read(text).unwrap()
}

fn refused(text: &str, words: &[&str]) {
    let error = read(text).expect_err("this must be refused");
    let message = error.to_string();
    assert!(error.is_input() && !message.contains('\n'), "{message}");
    for words in [&["scenes/scene.toml"], words].concat() {
        assert!(message.contains(words), "{message} lacks {words}");
    }
}

/// `contact = "slip" | "stick" | { coulomb = 0.3 }`.
#[test]
fn a_tip_slips_sticks_or_has_friction() {
    let tip = |keys: &str| {
        let tool = format!("[[tool]]\ntip = {{ shape = \"flat\", radius_m = 0.001{keys} }}\n");
        format!("[organ]\n{ORGAN}{tool}")
    };
    let of = |keys: &str| {
        let tip = parse(&tip(keys)).tools[0].tip;
        (tip.contact, tip.friction)
    };
    assert_eq!(of(""), (TipContact::Stick, None));
    assert_eq!(of(", contact = \"stick\""), (TipContact::Stick, None));
    assert_eq!(of(", contact = \"slip\""), (TipContact::Slip, None));
    let coulomb = (TipContact::Stick, Some(0.3));
    assert_eq!(of(", contact = { coulomb = 0.3 }"), coulomb);
    assert_eq!(of(", contact = \"stick\", friction = 0.3"), coulomb);
    refused(
        &tip(", contact = { coulomb = 0.3 }, friction = 0.3"),
        &["line 6", "`tool[0].tip.friction`", "contact = { coulomb }"],
    );
    refused(
        &tip(", contact = { coulomb = -1.0 }"),
        &[
            "line 6",
            "`tool[0].tip.contact.coulomb` is -1.0",
            "friction",
        ],
    );
    refused(
        &tip(", contact = { columb = 0.3 }"),
        &["`tool[0].tip.contact.columb`", "nearest known key is"],
    );
    refused(
        &tip(", contact = 0.3"),
        &[
            "`tool[0].tip.contact` is 0.3",
            "\"stick\" or \"slip\", or a table { coulomb }",
        ],
    );
}

/// `[[organ.region]]` is read into the same lists as layers and inclusions.
#[test]
fn regions_of_an_organ_are_layers_and_inclusions() {
    let scene = parse(&format!(
        "[organ]\n{ORGAN}\
         [[organ.layer]]\nthickness_m = 0.001\nbuiltin_tissue = \"pig-spleen\"\nperforation_force_n = 0.5\n\
         [[organ.region]]\nname = \"fat\"\nlayer = {{ thickness_mm = 2 }}\nbuiltin_tissue = \"pig-liver\"\n\
         [[organ.region]]\nname = \"lump\"\nball = {{ center_m = [0, 0, 0.03], radius_m = 0.005 }}\ntissue = \"lump.toml\"\n\
         [[organ.region]]\nsurface = \"vessel.stl\"\nmesh_unit = \"mm\"\nbuiltin_tissue = \"pig-kidney\"\n\
         [[organ.region]]\nlayer = {{ thickness_m = 0.003 }}\nbuiltin_tissue = \"pig-liver\"\n{NONLINEAR}"
    ));
    let layers = &scene.organ.layers;
    let thicknesses: Vec<f64> = layers.iter().map(|layer| layer.thickness_m).collect();
    assert_eq!(thicknesses, [0.001, 0.002, 0.003]);
    assert_eq!(
        (layers[1].name.as_str(), layers[2].name.as_str()),
        ("fat", "region 4")
    );
    assert_eq!(layers[0].perforation_force_n, Some(0.5));
    let [lump, vessel] = &scene.organ.inclusions[..] else {
        panic!("{:?}", scene.organ.inclusions)
    };
    let ball = InclusionShape::Ball {
        center_m: [0.0, 0.0, 0.03],
        radius_m: 0.005,
    };
    assert_eq!(lump.place, InclusionPlace::Shape(ball));
    assert_eq!(
        lump.tissue(),
        Some(&TissueChoice::File(PathBuf::from("scenes/lump.toml")))
    );
    let mesh = InclusionPlace::Mesh {
        path: PathBuf::from("scenes/vessel.stl"),
        unit: Some(LengthUnit::Millimetre),
    };
    assert_eq!(vessel.place, mesh);
    assert_eq!(vessel.name, "region 3");
    // A session keeps a scene that means the same in its own folder.
    let kept = scene.written.as_deref().unwrap();
    let again = Scene::parse(kept, "elsewhere/scene.toml").unwrap();
    let InclusionPlace::Mesh { path, .. } = &again.organ.inclusions[1].place else {
        panic!("{kept}")
    };
    assert!(
        path.is_absolute() && path.ends_with("scenes/vessel.stl"),
        "{kept}"
    );
}

#[test]
fn regions_that_are_none_are_refused() {
    let region = |keys: &str| {
        format!(
            "[organ]\n{ORGAN}[[organ.region]]\nbuiltin_tissue = \"pig-liver\"\n{keys}\n{NONLINEAR}"
        )
    };
    refused(
        &region(""),
        &["line 6", "`organ.region[0].layer` is missing", "ball = {"],
    );
    refused(
        &region("label = 2"),
        &[
            "line 7",
            "`organ.region[0].label` is 2",
            "`surface = \"file.stl\"`",
            "is a surface",
        ],
    );
    refused(
        &region("layer = { thickness_m = 0.001 }\nsurface = \"a.stl\""),
        &["`organ.region[0].surface` is given although `organ.region[0].layer`"],
    );
    refused(
        &region("mesh_unit = \"mm\"\nlayer = { thickness_m = 0.001 }"),
        &["line 7", "mesh_unit"],
    );
    let layer =
        "[[organ.region]]\nlayer = { thickness_m = 0.001 }\nbuiltin_tissue = \"pig-liver\"\n";
    refused(
        &format!("[organ]\n{ORGAN}{}", layer.repeat(7)),
        &["`organ.region`", "at most 6 layers"],
    );
}

/// A cavity stands in place of a tissue, in a table of either kind, and `auto` takes the only model that has it.
#[test]
fn an_organ_has_cavities() {
    let ball = "ball = { center_m = [0, 0, 0.03], radius_m = 0.005 }";
    let hollow = |part: &str, cavity: &str, model: &str| {
        format!("[organ]\n{ORGAN}[[organ.{part}]]\n{ball}\ncavity = {cavity}\n{model}")
    };
    let auto = "[model]\nkind = \"auto\"\n";
    for (cavity, content) in [
        ("{}", CavityContent::Pressure(0.0)),
        ("{ pressure_pa = -50.0 }", CavityContent::Pressure(-50.0)),
        (
            "{ constant_volume = true, pressure_pa = 900.0 }",
            CavityContent::Fluid(900.0),
        ),
    ] {
        for part in ["region", "inclusion"] {
            let scene = parse(&hollow(part, cavity, auto));
            assert_eq!(scene.model.kind, ModelKind::Nonlinear);
            assert_eq!(scene.organ.inclusions[0].cavity(), Some(content));
        }
    }
    for kind in ["", "[model]\nkind = \"hybrid\"\n"] {
        refused(
            &hollow("region", "{}", kind),
            &[
                "line 7",
                "`organ.region[0].cavity`",
                "`model.kind = \"nonlinear\"`",
            ],
        );
    }
    refused(
        &hollow("inclusion", "{ volume_m3 = 1e-6 }", auto),
        &["line 7", "volume_m3"],
    );
    refused(
        &hollow("inclusion", "{}\nbuiltin_tissue = \"pig-liver\"", auto),
        &["`organ.inclusion[0].builtin_tissue` is given although `organ.inclusion[0].cavity`"],
    );
    refused(
        &format!(
            "[organ]\n{ORGAN}[[organ.region]]\nlayer = {{ thickness_m = 0.001 }}\ncavity = {{}}\n{auto}"
        ),
        &["`organ.region[0].layer`", "a shape that tissue encloses"],
    );
}

/// Further organs are bodies that bend.
#[test]
fn organs_are_a_list() {
    let one = parse(&format!("[[organ]]\n{ORGAN}"));
    let table = parse(&format!("[organ]\n{ORGAN}"));
    assert_eq!(
        (&one.organ, &one.neighbours),
        (&table.organ, &table.neighbours)
    );
    let second = "[[organ]]\nbuiltin = \"kidney\"\nbuiltin_tissue = \"pig-kidney\"\nat_mm = [100, 0, 0]\n\
                  turn_deg = [0, 0, 90]\nscale = 0.5\nnodes = 400\nfriction = 0.2\n";
    let rigid = "[[neighbour]]\nbuiltin = \"stomach\"\n";
    let scene = parse(&format!("[[organ]]\n{ORGAN}{second}{rigid}{NONLINEAR}"));
    let same = parse(&format!(
        "[organ]\n{ORGAN}{rigid}{}{NONLINEAR}",
        second.replace("[[organ]]", "[[neighbour]]")
    ));
    assert_eq!(scene.organ, same.organ);
    assert_eq!(scene.neighbours, same.neighbours);
    assert!(scene.neighbours[0].soft.is_none() && scene.neighbours[1].soft.is_some());
    // The least model that has bodies that bend.
    let auto = parse(&format!(
        "[[organ]]\n{ORGAN}{second}[model]\nkind = \"auto\"\n"
    ));
    assert_eq!(auto.model.kind, ModelKind::Nonlinear);
}

#[test]
fn organs_that_cannot_be_are_refused() {
    let second = "[[organ]]\nbuiltin = \"kidney\"\nbuiltin_tissue = \"pig-kidney\"\n";
    let with = |keys: &str| format!("[[organ]]\n{ORGAN}{second}{keys}{NONLINEAR}");
    refused(
        &format!("[[organ]]\n{ORGAN}{second}"),
        &[
            "line 6",
            "`organ[1].builtin` is \"kidney\"",
            "one organ",
            "\"nonlinear\"",
        ],
    );
    refused(
        &format!("[[organ]]\nscale = 2.0\n{ORGAN}"),
        &["line 3", "`organ[0].scale` is 2.0", "further organs"],
    );
    for keys in [
        "nodule = [{ center_m = [0, 0, 0], radius_m = 0.001, stiffness_ratio = 2 }]\n",
        "touchable = { spheres = [{ center_m = [0, 0, 0], radius_m = 1 }] }\n",
        "self_contact = true\n",
    ] {
        let key = keys.split(' ').next().unwrap();
        let key = format!("`organ[1].{key}`");
        refused(&with(keys), &["line 8", &key, "only the first `[[organ]]`"]);
    }
    refused("organ = []\n", &["`organ` is missing"]);
    refused(
        "[[organ]]\nbuiltin = \"kidney\"\nbuiltin_tisue = \"pig-kidney\"\n",
        &[
            "line 4",
            "`organ[0].builtin_tisue`",
            "`organ[0].builtin_tissue`",
        ],
    );
}

/// Densities of both batches are one quantity.
#[test]
fn a_tissue_has_one_density() {
    let tissue = |lines: &str| {
        let text = format!("format = 1\n[tissue]\nlaw = \"neo_hookean\"\nc10_pa = 1000.0\n{lines}");
        Tissue::parse(&text, "tissue.toml")
    };
    for key in ["density_kg_m3", "density_kg_per_m3"] {
        let read = tissue(&format!("{key} = 1030.0\n")).unwrap();
        assert_eq!(read.density_kg_m3.value, 1030.0);
    }
    let both = tissue("density_kg_per_m3 = 1030.0\ndensity_kg_m3 = 1030.0\n");
    let message = both.expect_err("this must be refused").to_string();
    for words in [
        "tissue.toml",
        "line 6",
        "tissue.density_kg_m3",
        "tissue.density_kg_per_m3",
    ] {
        assert!(message.contains(words), "{message} lacks {words}");
    }
}
