//! Why a command ends early, and with which exit status.

use std::fmt;
use std::io;

use palpate_geometry::{MeshError, OrganError, ReadError, UnknownUnit};

/// Exit status when the input has to be mended.
const BAD_INPUT: u8 = 2;

/// Exit status when the input is not at fault.
const FAILED: u8 = 1;

/// Why a command ends early. The message is one sentence: cause, then mend.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What was given has to be mended.
    Input(String),
    /// The command line names no command; the help shows them.
    CommandLine {
        /// The message.
        message: &'static str,
        /// Several lines.
        help: String,
    },
    /// Something else went wrong.
    Failed(String),
    /// Whoever read standard output has gone (`palpate … | head`); nothing to complain about.
    NobodyReads,
}

impl Failure {
    pub(crate) fn input(message: impl fmt::Display) -> Self {
        Self::Input(message.to_string())
    }

    pub(crate) fn failed(message: impl fmt::Display) -> Self {
        Self::Failed(message.to_string())
    }

    /// A command line that is not understood; the parser's paragraphs become one sentence.
    pub(crate) fn of_command_line(mistake: &clap::Error) -> Self {
        use clap::error::ErrorKind;
        let said = mistake.to_string();
        if mistake.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
            return Self::CommandLine {
                message: "choose a subcommand",
                help: said,
            };
        }
        let lines = said.lines().take_while(|line| !line.starts_with("Usage:"));
        let parts: Vec<&str> = lines.map(str::trim).filter(|l| !l.is_empty()).collect();
        let sentence = parts.join(", ").replace(":, ", ": ").replace(", tip:", ";");
        let sentence = sentence.trim_start_matches("error: ");
        match sentence.contains("--help") {
            true => Self::input(sentence),
            false => Self::input(format!("{sentence}; `--help` shows what can be given")),
        }
    }

    pub(crate) fn exit_status(&self) -> u8 {
        match self {
            Self::Input(_) | Self::CommandLine { .. } => BAD_INPUT,
            Self::Failed(_) | Self::NobodyReads => FAILED,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(message) | Self::Failed(message) => f.write_str(message),
            Self::CommandLine { message, .. } => f.write_str(message),
            Self::NobodyReads => f.write_str("nobody reads the output"),
        }
    }
}

impl From<palpate_files::Error> for Failure {
    fn from(error: palpate_files::Error) -> Self {
        match error.is_input() {
            true => Self::input(error),
            false => Self::failed(error),
        }
    }
}

impl From<palpate_jobs::Error> for Failure {
    fn from(error: palpate_jobs::Error) -> Self {
        match error {
            palpate_jobs::Error::Input(message) => Self::Input(message),
            palpate_jobs::Error::Failed(message) => Self::Failed(message),
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::input(error)
    }
}

impl From<MeshError> for Failure {
    fn from(error: MeshError) -> Self {
        Self::input(error)
    }
}

impl From<OrganError> for Failure {
    fn from(error: OrganError) -> Self {
        Self::input(error)
    }
}

impl From<UnknownUnit> for Failure {
    fn from(error: UnknownUnit) -> Self {
        Self::input(error)
    }
}

impl From<palpate_mechanics::Error> for Failure {
    fn from(error: palpate_mechanics::Error) -> Self {
        Self::input(error)
    }
}

impl From<palpate_characterize::Error> for Failure {
    fn from(error: palpate_characterize::Error) -> Self {
        Self::input(error)
    }
}

impl From<palpate_record::Error> for Failure {
    fn from(error: palpate_record::Error) -> Self {
        match error.is_input() {
            true => Self::input(error),
            false => Self::failed(error),
        }
    }
}

impl From<palpate_reproduce::Error> for Failure {
    fn from(error: palpate_reproduce::Error) -> Self {
        match error.is_input() {
            true => Self::input(error),
            false => Self::failed(error),
        }
    }
}

impl From<palpate_simulate::Error> for Failure {
    fn from(error: palpate_simulate::Error) -> Self {
        match error.is_input() {
            true => Self::input(error),
            false => Self::failed(error),
        }
    }
}

impl From<palpate_viewer::Error> for Failure {
    fn from(error: palpate_viewer::Error) -> Self {
        match error.is_input() {
            true => Self::input(error),
            false => Self::failed(error),
        }
    }
}

/// Of writing to standard output.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::NobodyReads,
            _ => Self::failed(format!(
                "standard output cannot be written ({error}); check where it goes"
            )),
        }
    }
}
