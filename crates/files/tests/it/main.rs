//! Tests of the documents as their users meet them.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "clippy.toml allows both in tests, but does not see helpers as tests"
)]

mod builtin;
mod card;
mod contract_scene;
mod draw;
mod errors;
mod fibre_directions;
mod foreign;
mod fuzz;
mod instruments;
mod jpk_files;
mod microscopes;
mod motion;
mod old_waves;
mod plausible;
mod readers;
mod response;
mod rig_protocol;
mod round_trip;
mod scene;
mod session;
mod units;
mod writer;

use proptest::test_runner::Config;

/// How often a random test tries: `full` times when `PALPATE_FULL=1`, else a tenth of it.
fn tries(full: u32) -> Config {
    let wants_full = std::env::var("PALPATE_FULL").is_ok_and(|value| value == "1");
    let tries = if wants_full { full } else { full.div_ceil(10) };
    Config {
        // A failure is printed with its input, which then becomes a test of its own.
        failure_persistence: None,
        ..Config::with_cases(tries)
    }
}

/// A scene with every table and every key.
const SCENE: &str = r#"
format = 1
[organ]
mesh = "kidney.stl"
mesh_unit = "mm"
tissue = "tissue.toml"
[organ.anchor]
planes = [{ point_m = [0.0, 0.0, 0.001], normal = [0.0, 0.0, 1.0] }]
boxes = [{ min_m = [-1, -1, -1], max_mm = [-10, 1000, 1000] }]
spheres = [{ center_m = [0.1, 0.0, 0.0], radius_mm = 5 }]
[[organ.layer]]
name = "outer muscle"
thickness_mm = 1.5
perforation_force_n = 0.5
[organ.layer.tissue]
law = "neo_hookean"
c10_kpa = 1.0
prony = [{ g = 0.2866, tau_s = 1.537 }, { g = 0.2022, tau_ms = 6090 }]
[[organ.layer]]
thickness_m = 0.002
builtin_tissue = "pig-liver"
[[neighbour]]
mesh = "stomach.stl"
[[neighbour]]
builtin = "liver"
triangles = 2000
at_mm = [10, -20, 30]
turn_deg = [0, 0, 90]
scale = 1.5
collides = true
[model]
kind = "hybrid"
step_ms = 4
particles = 40
form = "strong"
placement = "source"
solver = "gmres"
assembly = "every_step"
integration_points = 957
calibration = "none"
enhancement = { area = "vertex", levels = 2, smoothing = "shepard" }
hand_over = "hold"
force_scale = 2.0
[[tool]]
name = "right"
kind = "grasper"
tip = { shape = "sphere", radius_mm = 2, contact = "slip" }
trocar_m = [0.0, -0.1, 0.2]
trocar_friction_mn = 300
trocar_stiffness_n_per_m = 20.0
jaws = { length_mm = 20, width_mm = 5, opening_mm = 12, force_n = 3.0, friction = 0.3 }
device = "force_dimension"
[[tool]]
name = "left"
tip = { shape = "flat", radius_m = 0.001 }
[view]
eye_m = [0.0, -0.3, 0.2]
up = [0, 0, 1]
field_of_view_deg = 60
shading = "plain"
[task]
instructions = "Find the stiff spot."
time_limit_s = 60
force_limit_mn = 2000
expert = "expert"
title = "palpation"
[task.find]
target_mm = [1, 2, 3]
tolerance_m = 0.004
[[organ.nodule]]
center_m = [0, 0, 0.02]
radius_mm = 5
stiffness_ratio = 6
"#;

/// A tissue with every table and every key.
const TISSUE: &str = r#"
format = 1
[tissue]
name = "pig liver"
density_kg_m3 = 1060.0
law = "mooney_rivlin"
c10_pa = { value = 322.96, standard_error = 12.0 }
c01_kpa = { value = 0.5, standard_error = 0.0625 }
prony = [{ g = 0.2866, g_standard_error = 0.01, tau_s = 1.537, tau_standard_error_s = 0.1 }]
[tissue.lumped.kelvin]
k1_n_per_mm = 0.008
k2_n_per_m = 7.0
b_n_s_per_m = { value = 130.0, standard_error = 1.0 }
tau_s = 16.25
[tissue.lumped.column]
gamma_pa = 1000.0
alpha = 2.0
effective_area_mm2 = 3.0
effective_length_m = 0.01
[tissue.lumped.nonlinear_springs]
k01 = 0.002
k02 = 1.680
k11 = 0.025
k12 = 2.236
k13 = 0.007
k21 = 0.080
k22 = 2.184
k23 = 0.0005
[tissue.source]
recordings = ["a.csv", "b.csv"]
method = "inverse finite elements"
version = "0.1.0"
warnings = ["depth beyond 10 mm"]
"#;

/// A motion with every column.
const PROTOCOL: &str = r#"
format = 1
[rig]
force_limit_n = 2.0
depth_limit_m = 0.012
speed_limit_m_per_s = 0.06
recovery_s = 30.0
breath_s = 25.0
approach_speed_m_per_s = 0.002
gains = "gentle"
device = "haply"
[[specimen]]
builtin_tissue = "pig-liver"
organ = "liver"
subject = "pig 1"
condition = "in_vivo"
indenter_radius_m = 0.001
alive = true
factor = 1.2
weight_kg = 34.0
site = "left lobe"
[[specimen]]
published = "kidney"
[[stimulus]]
kind = "ramp_and_hold"
depths_m = [0.002, 0.004]
ramp_s = 0.5
hold_s = 20.0
repeats = 2
[[stimulus]]
kind = "sine"
amplitude_m = 0.001
pre_indentation_m = 0.002
frequencies_hz = [0.5, 1.0]
cycles = 10
[[stimulus]]
kind = "chirp_exponential"
amplitude_m = 0.001
pre_indentation_m = 0.002
frequency_hz = 0.5
end_frequency_hz = 5.0
duration_s = 15.0
"#;

const MOTION: &str = "# format = 1
time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut
0.0,right,0,0,0.01,0,0,0,1,0,0
0.5,left,1,2,3,0,0,1,1,0.5,1
1.0,right,0,0,0.005,0,1,0,0,1,1
";

/// A session with two tools and several events.
const SESSION: &str = "# format = 1
# version = \"0.1.0\"
# scene_digest = \"89ab\"
# model = \"local\"
# step_s = 0.005
# seed = 7
# force_scale = 1.0
time_s,tool,x_m,y_m,z_m,qx,qy,qz,qw,grip,cut,fx_n,fy_n,fz_n,contact,depth_m,event,grip_force_n
0.0,right,0.0,0.0,0.01,0.0,0.0,0.0,1.0,0.0,0,0.0,0.0,0.0,0,0.0,,0.0
0.0,left,1.0,0.0,0.01,0.0,0.0,0.0,1.0,0.0,0,0.0,0.0,0.0,0,0.0,,0.0
0.005,right,0.0,0.0,-0.001,0.0,0.0,0.0,1.0,0.5,1,0.0,1e-7,0.023,1,0.001,contact;cut,0.25
0.005,left,1.0,0.0,0.01,0.0,0.0,0.0,1.0,0.0,0,0.0,0.0,0.0,0,0.0,,0.0
";

/// A recording with every key and extra columns.
const RECORDING: &str = "# format = 1
# organ = \"liver\"
# subject = 3
# weight_kg = 30.0
# site = \"left lobe\"
# repeat = 2
# condition = \"in_vivo\"
# post_mortem_h = 0.5
# breath_held = true
# stimulus = \"ramp_and_hold\"
# ramp_ms = 500
# amplitude_mm = 6
# pre_indentation_m = 0.001
# frequency_hz = 1
# end_frequency_hz = 8
# sample_rate_hz = 1000
# indenter_shape = \"flat\"
# indenter_radius_mm = 1
# indenter_half_angle_deg = 30
# area_mm2 = 20
# height_m = 0.03
# specimen = \"tube\"
# inner_radius_m = 0.005
# outer_radius_m = 0.0075
# length_mm = 60
# pressure_mmhg = 30
# source = \"rig 1\"
# operator = J. Doe
# a sentence about the day
time_ms,depth_mm,force_mn,temperature_c,note
0,0,0,37.5,start
1,0.5,4.8,37.4,
2,1,7.9,37.4,\"a, b\"
";
