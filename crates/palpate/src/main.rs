//! The command `palpate`: soft-tissue touch, from the first indentation to the trained hand.
//!
//! This crate joins the others: it reads the command line, calls the crate that does the work, prints its result and
//! decides the exit status. Nothing else in the project prints or exits.

mod command;
mod date;
mod failure;
mod interrupt;
mod output;
mod plot;
mod preparation;
mod progress;
mod recorded;
mod report;
mod settings;
mod training;

use std::process::ExitCode;

use clap::Parser;

use command::CommandLine;
use failure::Failure;

fn main() -> ExitCode {
    quieten_driver();
    let outcome = match CommandLine::try_parse() {
        Ok(line) => line.run(),
        Err(answer) if !answer.use_stderr() => output::text(answer.render()),
        Err(mistake) => Err(Failure::of_command_line(&mistake)),
    };
    if palpate_geometry::threads_were_refused() {
        output::warnings(&[
            "the system gave fewer threads than there are cores; the results are the same, and took longer"
                .to_owned(),
        ]);
    }
    match outcome {
        Ok(()) | Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            output::error(&failure);
            ExitCode::from(failure.exit_status())
        }
    }
}

/// Without a desktop session, Mesa's layer that selects a device calls Wayland without success, and prints an error
/// that does not concern this program.
#[allow(unsafe_code, reason = "drivers read the environment alone")]
fn quieten_driver() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: no other thread runs yet.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
