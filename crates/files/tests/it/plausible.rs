//! Numbers that no tissue and no tool has are refused, unusual ones are told, with the unit that was meant.

use palpate_files::{BuiltinTissue, Error, Motion, Protocol, Recording, Scene, Tissue};

fn scene(modulus: &str, tip: &str) -> Result<Scene, Error> {
    Scene::parse(
        &format!(
            "format = 1\n[organ]\nbuiltin = \"hemisphere\"\n\
             tissue = {{ law = \"linear\", youngs_modulus_pa = {modulus}, poissons_ratio = 0.45 }}\n\
             [[tool]]\ntip = {{ shape = \"flat\", {tip} }}\n"
        ),
        "s.toml",
    )
}

fn refused(modulus: &str, tip: &str) -> String {
    scene(modulus, tip).unwrap_err().to_string()
}

#[test]
fn impossible_numbers_are_refused_with_the_unit_that_was_meant() {
    assert_eq!(
        refused("1e4", "radius_m = 1"),
        "s.toml line 6: `tool[0].tip.radius_m` is 1; give the radius of a tip from 1 nm to 100 mm; did you mean \
         1 mm (`radius_mm`)?"
    );
    assert!(refused("1e4", "radius_m = 1000").contains("from 1 nm to 100 mm"));
    for modulus in ["1e12", "1e300", "inf", "nan", "-1e4", "0"] {
        let said = refused(modulus, "radius_mm = 1");
        assert!(said.contains("from 0.001 Pa to 100 GPa"), "{said}");
    }
    let motion = |z: &str| format!("# format = 1\ntime_s,tool,x_m,y_m,z_m\n0,right,0,0,{z}\n");
    assert!(Motion::parse(&motion("1e300"), "m.csv").is_err());
    let header = "# format = 1\n# indenter_radius_mm = 1e5\ntime_s,depth_m,force_n\n0,0,0\n";
    assert!(Recording::parse(header, "r.csv").is_err());
}

#[test]
fn unusual_numbers_are_told() {
    assert_eq!(scene("1e4", "radius_mm = 1").unwrap().warnings, [""; 0]);
    let told = scene("10", "radius_m = 0.05").unwrap().warnings;
    assert_eq!(
        told,
        [
            "s.toml line 4: `organ.tissue.youngs_modulus_pa` is 10; a modulus of tissue is usually from 20 Pa to \
             20 MPa; did you mean 10 kPa (`youngs_modulus_kpa`)?",
            "s.toml line 6: `tool[0].tip.radius_m` is 0.05; the radius of a tip is usually from 1 um to 20 mm; did \
             you mean 0.05 mm (`radius_mm`)?"
        ]
    );
    let own = Tissue::parse(
        "format = 1\n[tissue]\nlaw = \"neo_hookean\"\nc10_pa = 2\ndensity_kg_m3 = 1.06\n",
        "t.toml",
    );
    let told = own.unwrap().warnings;
    assert!(told[0].contains("did you mean 1.06 g/cm^3"), "{told:?}");
    assert!(
        told[1].contains("did you mean 2 kPa (`c10_kpa`)?"),
        "{told:?}"
    );
    let motion = "# format = 1\ntime_s,tool,x_m,y_m,z_m\n0,right,0,0,-120\n";
    let motion = Motion::parse(motion, "m.csv").unwrap();
    assert_eq!(
        motion.warnings(),
        [
            "m.csv: the column `z_m` goes to -120; a coordinate is usually at most 5 m in size; did you mean -120 mm \
          (`z_mm`)?"
        ]
    );
}

#[test]
fn shipped_documents_are_usual() {
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets");
    for name in [
        "esophagus/scene",
        "esophagus/trainer",
        "tasks/cutting",
        "tasks/myotomy",
        "tasks/palpation",
        "tasks/retraction",
        "tasks/traction",
    ] {
        let scene = Scene::read(format!("{assets}/{name}.toml")).unwrap();
        assert_eq!(scene.warnings, [""; 0], "{name}");
    }
    for name in ["esophagus/motion", "esophagus/pull"] {
        let motion = Motion::read(format!("{assets}/{name}.csv")).unwrap();
        assert_eq!(motion.warnings(), [""; 0], "{name}");
    }
    for (_, tissue) in BuiltinTissue::WORDS {
        let text = Tissue::builtin(*tissue).to_toml();
        assert_eq!(
            Tissue::parse(&text, "t.toml").unwrap().warnings,
            [""; 0],
            "{tissue}"
        );
    }
}

/// A speed and a toughness in another unit; each was once read by the unit of its last letters.
#[test]
fn units_of_a_speed_and_of_a_toughness_are_whole() {
    let rig = |line: &str| {
        Protocol::parse(
            &format!(
                "format = 1\n[rig]\n{line}\n[[specimen]]\nbuiltin_tissue = \"pig-liver\"\n\
                 [[stimulus]]\nkind = \"ramp_and_hold\"\ndepth_mm = 2\n"
            ),
            "p.toml",
        )
    };
    let speed = rig("approach_speed_mm_per_s = 2")
        .unwrap()
        .rig
        .approach_speed_m_per_s;
    assert_eq!(speed, Some(0.002));
    assert!(rig("approach_speed_m_per_ms = 2").is_err());
    let scene = |line: &str| {
        Scene::parse(
            &format!(
                "format = 1\n[organ]\nbuiltin = \"cube\"\nbuiltin_tissue = \"pig-liver\"\n[cutting]\n{line}\n"
            ),
            "s.toml",
        )
    };
    let tough = scene("toughness_kj_per_m2 = 0.2")
        .unwrap()
        .cutting
        .toughness_j_per_m2;
    assert_eq!(tough, 200.0);
    assert!(scene("toughness_j_per_mm2 = 0.2").is_err());
}
