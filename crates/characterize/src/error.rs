use palpate_files::Domain;
use palpate_files::tissue::LawName;

use crate::fit::Parameter;

/// Why something cannot be found from a recording.
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// The samples are too few.
    #[error(
        "the recording has {samples} samples, and {task} takes at least {least}; record for longer or faster"
    )]
    TooShort {
        /// How many there are.
        samples: usize,
        /// How many are needed.
        least: usize,
        /// What for.
        task: &'static str,
    },
    /// The force never changes.
    #[error("the force is {force} N in every sample; check that the sensor was connected")]
    ConstantForce {
        /// The force [N].
        force: f64,
    },
    /// The indenter never touches.
    #[error(
        "no contact is found, because {cause}; check the signs and units, or record until the tissue is pressed"
    )]
    NoContact {
        /// Why.
        cause: &'static str,
    },
    /// A contact is stated at a time that was not recorded.
    #[error("the contact is stated at {time} s; give a time from {first} to {last} s")]
    ContactOutside {
        /// The time stated [s].
        time: f64,
        /// The first time recorded [s].
        first: f64,
        /// The last time recorded [s].
        last: f64,
    },
    /// A parameter is wanted that no guess has.
    #[error("there is no parameter `{name}` in the guess; it has {}", known.join(", "))]
    NotInGuess {
        /// The name.
        name: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// Only closed forms were sought.
    #[error(
        "only closed forms were asked for; leave out --closed-forms to fit laws and relaxation"
    )]
    NotFitted,
    /// The force never pulls as the indenter goes back.
    #[error(
        "the force does not fall below zero by more than its noise as the indenter goes back: no adhesion shows"
    )]
    NoPullOff,
    /// A force pulls an indenter that is no sphere.
    #[error(
        "the force pulls as the indenter goes back; a work of adhesion is found for a sphere alone (indenter_shape = \"sphere\")"
    )]
    AdhesionOfSphere,
    /// Every protocol goes beyond a limit.
    #[error(
        "no protocol keeps within the limits of force, depth, speed and time; allow more of one of them, or name other radii"
    )]
    NoDesign,
    /// A recording is of an organ whose mesh is not there.
    #[error(
        "the recording is of an organ with a `mesh`, which was not read; characterize it by the command, which reads it"
    )]
    NoMesh,
    /// An organ with a mesh that is a layer or a tube as well.
    #[error(
        "an organ's `mesh` is fitted as one solid; leave `mesh` out, or `specimen`, which says that it is a layer or a tube"
    )]
    OrganBody,
    /// An organ that bends inwards more than a round indenter does outwards.
    #[error(
        "where the indenter touches it, the organ is hollow with a radius of {:.3} mm, and this indenter is fitted in \
         hollows of {:.3} mm and more; press where the organ is flat or bulges, or use a smaller indenter",
        1e3 * radius, 1e3 * least
    )]
    OrganTooHollow {
        /// The smaller radius of curvature there [m].
        radius: f64,
        /// The least that is fitted [m].
        least: f64,
    },
    /// The mesh of an organ is none.
    #[error("{why}")]
    UnreadMesh {
        /// Why.
        why: String,
    },
    /// The place of the indenter is not on the organ.
    #[error(
        "`location_m` is {:.2} mm off the surface of the mesh, more than the radius of the indenter; the nearest point of the \
         surface is {nearest:?}, in metres: check the unit of the mesh, or give that",
        1e3 * distance
    )]
    OffMesh {
        /// From the surface [m].
        distance: f64,
        /// The nearest point of it [m].
        nearest: [f64; 3],
    },
    /// The organ is pressed where it is fixed.
    #[error("`location_m` lies where the organ is `fixed`; fix another part of it")]
    PressedWhereFixed,
    /// A filter that the samples cannot carry.
    #[error(
        "the cut-off is {cutoff} Hz with {rate} samples a second; give one above 0 and below half of that"
    )]
    BadCutoff {
        /// The cut-off [Hz].
        cutoff: f64,
        /// The rate [Hz].
        rate: f64,
    },
    /// A parameter of a fit makes no sense.
    #[error(
        "{} starts at {:e} with the scale {:e}, which does not lie between its bounds {:e} and {:e} or is no number; start inside, with a scale above 0",
        .parameter.name, .parameter.value, .parameter.scale, .parameter.lower, .parameter.upper
    )]
    BadParameter {
        /// The parameter.
        parameter: Box<Parameter>,
    },
    /// A formula of the half-space was asked about a tube.
    #[error(
        "the organ is hollow, and a mean modulus is that of a half-space; fit a tube to it instead"
    )]
    HollowOrgan,
    /// A steady force was asked for where the indenter never stays.
    #[error(
        "no recording stays at a depth, and a mean modulus is that of a steady force; record a ramp and a hold"
    )]
    NoHold,
    /// A fit has nowhere to start.
    #[error("the model has no answer where its fit starts, at {}; start elsewhere", listed(.parameters))]
    NoStart {
        /// The parameters there.
        parameters: Vec<Parameter>,
    },
    /// A law that is solved by finite elements does not settle.
    #[error(
        "the shape of the law did not settle in {tried} runs of finite elements; seek a simpler law, or press deeper"
    )]
    NoShape {
        /// How many.
        tried: usize,
    },
    /// There is no force, or no depth, that a law could be found from.
    #[error(
        "no force that grows with depth is found in the recording; check the signs and the units of depth and force"
    )]
    NoContactForce,
    /// The recordings do not say something.
    #[error(
        "the recording does not say `{key}`; add the line `# {key} = ...` at its top, or state it with --set"
    )]
    Unknown {
        /// The key.
        key: &'static str,
    },
    /// Too little is seen of the elastic force for the exponential law on a column.
    #[error(
        "the recordings tell too little of how force grows with depth for the exponential law on a column; hold at three depths or more, or record the ramp faster"
    )]
    ColumnUnknown,
    /// A law that is not sought in tubes.
    #[error("`{}` is not sought in a hollow organ, whose force takes minutes to solve for each shape of a law; use neo_hookean", .law.word())]
    TubeLaw {
        /// The law.
        law: LawName,
    },
    /// A law with fibres under an indenter.
    #[error(
        "`{}` is fitted to pieces that are pulled, pressed or sheared and not to indentations, as a tissue with fibres is not \
         symmetric about an indenter; cut strips in two directions to the fibres (`stimulus = \"uniaxial_tension\"`), or use an \
         isotropic law such as neo_hookean", .law.word()
    )]
    FibresUnderIndenter {
        /// The law.
        law: LawName,
    },
    /// Finite elements in the loop of a hollow organ.
    #[error(
        "finite elements in the loop need a solid specimen under an indenter; leave them out for a tube, a layer on a base, an organ's mesh or a piece along one axis"
    )]
    NoLoop,
    /// A run in the loop would take too many steps.
    #[error(
        "a run of finite elements through this recording takes {samples} steps, and {most} are the most; use finite elements in the loop on a ramp and a hold"
    )]
    LoopMovesTooLong {
        /// How many.
        samples: usize,
        /// The most.
        most: usize,
    },
    /// The loop goes on changing the tissue.
    #[error(
        "the parameters still change after {rounds} rounds of finite elements, so the recording does not tell them apart; use another law or press deeper"
    )]
    LoopDoesNotSettle {
        /// How many.
        rounds: usize,
    },
    /// Fits that would take runs of finite elements each.
    #[error("fits of `{}` are not repeated under pressure, because each takes runs of finite elements; its standard errors hold for small changes", .law.word())]
    CostlyToRepeat {
        /// The law.
        law: LawName,
    },
    /// An indenter that is not solved on a tube.
    #[error("only a flat indenter is solved on a hollow organ; use a flat one")]
    TubeIndenter,
    /// A layer whose base is too different from it.
    #[error(
        "the base would be {stiffness:.2e} times as stiff as the layer, and both are told apart from {} to {} times: check \
         `base_modulus_pa` and `thickness_m`, or leave `specimen = \"layer\"` out where the base is as good as rigid",
        Domain::BASE_RATIOS[0], Domain::BASE_RATIOS[1]
    )]
    BaseTooDifferent {
        /// The shear modulus of the base over that of the layer [-].
        stiffness: f64,
    },
    /// A specimen that is thinner than it was pressed.
    #[error(
        "the specimen is pressed by {depth} m and is {thickness} m thick; check the units, or correct `thickness_m`"
    )]
    DeeperThanThick {
        /// How far it was pressed [m].
        depth: f64,
        /// Its thickness [m].
        thickness: f64,
    },
    /// A specimen that is narrower than what touches it.
    #[error(
        "the specimen has a radius of {radius} m (a square one as much cross-section), and the indenter touches {least} m; correct `specimen_radius_m` or `specimen_width_m`"
    )]
    Narrow {
        /// Radius of the specimen [m].
        radius: f64,
        /// Radius of the contact [m].
        least: f64,
    },
    /// Finite elements find no equilibrium as deep as the recordings go.
    #[error(
        "the force of the `{}` law could not be solved down to {:.3} mm, the deepest that was recorded, but {} ({failure}); \
         leave out what was recorded deeper, or choose another law with --law", .law.word(), 1e3 * .asked, reach(*.reached)
    )]
    NotSolved {
        /// The law.
        law: LawName,
        /// The deepest depth recorded [m].
        asked: f64,
        /// The depth that was reached [m].
        reached: f64,
        /// Why it went no further.
        failure: palpate_mechanics::finite_elements::Failure,
    },
    /// Finite elements find no equilibrium of a tube under its pressure.
    #[error(
        "the tube of the `{}` law could not be inflated beyond {:.0} % of its pressure ({failure}); check `pressure_pa` \
         and the radii of the tube, or choose another law with --law", .law.word(), 100.0 * .part
    )]
    NotInflated {
        /// The law.
        law: LawName,
        /// The part of the pressure that was reached [-].
        part: f64,
        /// Why it went no further.
        failure: palpate_mechanics::finite_elements::Failure,
    },
    /// The mechanics have no answer.
    #[error(transparent)]
    Mechanics(#[from] palpate_mechanics::Error),
}

impl Error {
    /// Whether the input is invalid (exit status 2), rather than something else at fault (1).
    pub fn is_input(&self) -> bool {
        match self {
            Self::Mechanics(error) => error.is_input(),
            Self::NoShape { .. }
            | Self::LoopDoesNotSettle { .. }
            | Self::NotSolved { .. }
            | Self::NotInflated { .. } => false,
            Self::TooShort { .. }
            | Self::ConstantForce { .. }
            | Self::NoContact { .. }
            | Self::ContactOutside { .. }
            | Self::NotInGuess { .. }
            | Self::NotFitted
            | Self::NoPullOff
            | Self::AdhesionOfSphere
            | Self::NoDesign
            | Self::BadCutoff { .. }
            | Self::BadParameter { .. }
            | Self::HollowOrgan
            | Self::NoMesh
            | Self::OrganBody
            | Self::OrganTooHollow { .. }
            | Self::UnreadMesh { .. }
            | Self::OffMesh { .. }
            | Self::PressedWhereFixed
            | Self::NoHold
            | Self::NoStart { .. }
            | Self::NoContactForce
            | Self::Unknown { .. }
            | Self::ColumnUnknown
            | Self::TubeLaw { .. }
            | Self::FibresUnderIndenter { .. }
            | Self::NoLoop
            | Self::LoopMovesTooLong { .. }
            | Self::CostlyToRepeat { .. }
            | Self::TubeIndenter
            | Self::BaseTooDifferent { .. }
            | Self::DeeperThanThick { .. }
            | Self::Narrow { .. } => true,
        }
    }

    /// What the mechanics say of a `law` that is pressed as deep as `asked` [m], for who asked for the law and not
    /// for a mesh.
    pub(crate) fn of_law(law: LawName, asked: f64, error: palpate_mechanics::Error) -> Self {
        match error {
            palpate_mechanics::Error::NoEquilibrium { depth, failure } => Self::NotSolved {
                law,
                asked,
                reached: depth,
                failure,
            },
            palpate_mechanics::Error::NoPath { factor, failure } => Self::NotInflated {
                law,
                part: factor,
                failure,
            },
            other => Self::Mechanics(other),
        }
    }
}

/// Down to where something could be solved.
fn reach(depth: f64) -> String {
    match depth > 0.0 {
        true => format!("down to {:.3} mm only", 1e3 * depth),
        false => "at no depth at all".to_owned(),
    }
}

fn listed(parameters: &[Parameter]) -> String {
    let each = parameters
        .iter()
        .map(|p| format!("{} = {}", p.name, p.value));
    each.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use palpate_mechanics::finite_elements::Failure;

    /// Who seeks a law has no mesh to refine.
    #[test]
    fn failures_of_finite_elements_say_what_to_do_with_recordings() {
        let law = LawName::Exponential;
        let failure = Failure::Inverted;
        let pressed = palpate_mechanics::Error::NoEquilibrium {
            depth: 0.0,
            failure,
        };
        let inflated = palpate_mechanics::Error::NoPath {
            factor: 0.4,
            failure,
        };
        for (error, words) in [(pressed, "at no depth at all"), (inflated, "beyond 40 %")] {
            let said = Error::of_law(law, 6e-3, error).to_string();
            assert!(
                said.contains(words) && said.contains("`exponential`"),
                "{said}"
            );
            assert!(said.contains("--law") && !said.contains("mesh"), "{said}");
        }
    }
}
