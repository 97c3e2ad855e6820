use crate::fit::Parameter;

/// Why something cannot be found from a recording.
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
    /// A parameter of a fit makes no sense.
    #[error(
        "{} starts at {:e} with the scale {:e}, which does not lie between its bounds {:e} and {:e} or is no number; start inside, with a scale above 0",
        .parameter.name, .parameter.value, .parameter.scale, .parameter.lower, .parameter.upper
    )]
    BadParameter {
        /// The parameter.
        parameter: Box<Parameter>,
    },
    /// A fit has nowhere to start.
    #[error("the model has no answer where its fit starts, at {}; start elsewhere", listed(.parameters))]
    NoStart {
        /// The parameters there.
        parameters: Vec<Parameter>,
    },
}

fn listed(parameters: &[Parameter]) -> String {
    let each = parameters
        .iter()
        .map(|p| format!("{} = {}", p.name, p.value));
    each.collect::<Vec<_>>().join(", ")
}
