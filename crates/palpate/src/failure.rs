//! Why a command ends early, and with which exit status.

use std::fmt;
use std::io;

use palpate_jobs::Error;

/// Why a command ends early. The message is one sentence: the cause, then how to fix it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Failure of a job, or of the command's own work on documents, meshes and devices.
    #[error(transparent)]
    Job(#[from] Error),
    /// Failure of a table or figure that is recomputed.
    #[error(transparent)]
    Reproduce(#[from] palpate_reproduce::Error),
    /// Failure of the training record.
    #[error(transparent)]
    Record(#[from] palpate_record::Error),
    /// Failure of a window or picture.
    #[error(transparent)]
    Viewer(#[from] palpate_viewer::Error),
    /// The command line names no command; the help shows them.
    #[error("{message}")]
    CommandLine {
        /// The message.
        message: &'static str,
        /// Several lines.
        help: String,
    },
    /// The reader of standard output has closed it (`palpate … | head`); no error message.
    #[error("the output was closed")]
    ClosedPipe,
}

impl Failure {
    pub(crate) fn input(message: impl fmt::Display) -> Self {
        Error::input(message).into()
    }

    pub(crate) fn failed(message: impl fmt::Display) -> Self {
        Error::failed(message).into()
    }

    /// A command line with an error; the parser's paragraphs become one sentence.
    pub(crate) fn of_command_line(mistake: &clap::Error) -> Self {
        use clap::error::ErrorKind;
        let text = mistake.to_string();
        if mistake.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
            return Self::CommandLine {
                message: "choose a subcommand",
                help: text,
            };
        }
        let lines = text.lines().take_while(|line| !line.starts_with("Usage:"));
        let parts: Vec<&str> = lines.map(str::trim).filter(|l| !l.is_empty()).collect();
        let sentence = parts.join(", ").replace(":, ", ": ").replace(", tip:", ";");
        let sentence = sentence.trim_start_matches("error: ");
        match sentence.contains("--help") {
            true => Self::input(sentence),
            false => Self::input(format!("{sentence}; `--help` shows what can be given")),
        }
    }

    pub(crate) fn exit_status(&self) -> u8 {
        let is_input = match self {
            Self::Job(error) => return error.exit_status(),
            Self::Reproduce(error) => error.is_input(),
            Self::Record(error) => error.is_input(),
            Self::Viewer(error) => error.is_input(),
            Self::CommandLine { .. } => true,
            Self::ClosedPipe => false,
        };
        palpate_jobs::exit_status(is_input)
    }
}

palpate_jobs::from_carried_errors!(Failure);

/// Failure of writing to standard output.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ClosedPipe,
            _ => Self::failed(format!(
                "standard output cannot be written ({error}); check where it goes"
            )),
        }
    }
}
