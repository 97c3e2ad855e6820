//! Figures and tables of the source that this command does not compute, each with its reason: drawings, photographs,
//! pictures of other programs, and data of others without numbers.

use super::{Item, Rows};

macro_rules! not_computed {
    ($($constant:ident $name:literal $title:literal $reason:literal)*) => {$(
        pub(super) const $constant: Item = Item {
            name: $name,
            title: $title,
            seconds: 0.0,
            run: |rows: &mut Rows<'_>| {
                rows.not_computed($reason);
                Ok(())
            },
        };
    )*};
}

not_computed! {
    FIGURE_2_1 "figure-2-1" "learning curve of surgeons"
        "a curve of clinical data that the source cites, without a table of numbers"
    FIGURE_2_2 "figure-2-2" "images of the Visible Human"
        "pictures of a data set of others"
    TABLE_2_1 "table-2-1" "facts about the Visible Human data sets"
        "years, resolutions and sizes of images of others: nothing follows from a computation"
    FIGURE_2_3 "figure-2-3" "organs segmented from the Visible Human"
        "a picture of meshes of others, rendered by 3D Studio Max"
    FIGURE_2_4 "figure-2-4" "the PHANTOM"
        "a photograph"
    FIGURE_2_5 "figure-2-5" "the Laparoscopic Impulse Engine"
        "a photograph"
    FIGURE_2_6 "figure-2-6" "components of a simulator"
        "a drawing"
    FIGURE_3_1 "figure-3-1" "an organ that is meshed as a whole"
        "a drawing"
    FIGURE_3_2 "figure-3-2" "particles and their spheres of influence"
        "a drawing; figure-3-3 and figure-3-4 compute with such particles, and figure-4-5 draws interpolation functions of the same \
         kind"
    FIGURE_3_5 "figure-3-5" "software architecture: model thread, haptic buffer, haptic thread"
        "a drawing; section-3-4 computes what the hand-over between the threads costs, and `palpate quality` measures our threads"
    FIGURE_3_6 "figure-3-6" "placement of the particles on a triangle"
        "a drawing without numbers; a scene with `placement = \"source\"` places its particles by this rule"
    FIGURE_4_1 "figure-4-1" "concept of the hybrid model"
        "a drawing"
    FIGURE_4_3 "figure-4-3" "steps of the local enhancement"
        "six pictures of one procedure, without numbers; figure-4-4 has its neighbourhoods, and figure-4-6 the deformation \
         without and with it"
    FIGURE_5_2 "figure-5-2" "Dundee single point compliance probe"
        "a photograph"
    FIGURE_5_3 "figure-5-3" "TeMPeST 1-D"
        "photographs"
    FIGURE_5_4 "figure-5-4" "force feedback endoscopic grasper"
        "a photograph"
    FIGURE_5_5 "figure-5-5" "the indenter and its force sensor"
        "a photograph"
    FIGURE_5_7 "figure-5-7" "window of the experimental control"
        "a screenshot of another program; `palpate measure` opens ours, and docs/pictures/rig.png shows it"
    FIGURE_5_9 "figure-5-9" "experimental setup"
        "a drawing and a photograph"
    FIGURE_5_10 "figure-5-10" "abdominal organs of a pig"
        "an anatomical drawing"
    FIGURE_5_11 "figure-5-11" "a spleen under the indenter"
        "a photograph"
    FIGURE_6_1 "figure-6-1" "inverse finite elements"
        "a drawing"
    FIGURE_6_2 "figure-6-2" "an organ as a half-space"
        "a drawing; table-6-1 uses it"
    FIGURE_6_6 "figure-6-6" "the algorithm of inverse finite elements"
        "a flow chart; table-6-4 and table-6-5 run the algorithm"
    FIGURE_6_13 "figure-6-13" "the esophagus and where it lies"
        "an anatomical drawing"
    FIGURE_6_14 "figure-6-14" "finite element mesh of the esophagus"
        "a picture of a mesh of which the source prints only the length; section-6-4-5 and figure-6-15 solve the tube"
    FIGURE_7_1 "figure-7-1" "the esophagus and its neighbours"
        "an anatomical drawing"
    FIGURE_7_2 "figure-7-2" "the simulator"
        "a photograph"
    FIGURE_7_3 "figure-7-3" "a PHANTOM at the end of an instrument"
        "a photograph"
    FIGURE_7_4 "figure-7-4" "virtual forces and those of the abdominal wall"
        "a drawing of another work, without numbers; no abdominal wall is modelled here: a trocar only holds the instrument"
    FIGURE_7_5 "figure-7-5" "a haptic device as a two-port"
        "a drawing; equation-7-6 computes both ports"
    FIGURE_7_6 "figure-7-6" "lumped model of the device"
        "a drawing; equation-7-6 has its numbers"
    FIGURE_7_9 "figure-7-9" "the esophagus of the Visible Human"
        "pictures of a mesh of others, which is not distributed with this program"
    FIGURE_7_11 "figure-7-11" "texture mapping"
        "a drawing"
    TABLE_7_2 "table-7-2" "steps of environment mapping"
        "a list of OpenGL calls without numbers; figure-7-12 draws by such a map, and table-7-1 times it"
    FIGURE_7_13 "figure-7-13" "collision detection and response"
        "a drawing"
    FIGURE_7_14 "figure-7-14" "the algorithm of progressive cutting"
        "a flow chart; figure-7-15 and figure-7-16 run the algorithm"
    APPENDIX_A "appendix-a" "labels and weights of the pigs"
        "facts about the animals; the rows of chapter 5 count and weigh their virtual animals by them"
}
