//! `palpate devices`: the connected haptic devices, and their self-test.

mod answer;

use clap::{Args, ValueEnum};
use palpate_devices::{Found, Kind, Places, SelfTest, self_test};
use palpate_servo::Clock;
use palpate_viewer::hands::gamepads::gamepads;

use answer::{Answer, Device};

use crate::failure::Failure;
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate devices
      lists all kinds of devices with their limits
  palpate devices haply --self-test
      tests each Haply device, which pushes with 0.2 N to the right, up and towards you: hold
      the handle

Environment variables: PALPATE_HAPLY is the address of the Haply Inverse Service (HOST:PORT, or HOST:PORT,PORT with \
its event port); PALPATE_OPENHAPTICS and PALPATE_FORCE_DIMENSION are the paths of libHD and libdhd, if they are not \
in the system's search path. No driver has been tested on hardware yet: docs/devices.md.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Only this kind; an error if it is not connected.
    #[arg(value_enum, value_name = "KIND")]
    kind: Option<Word>,
    /// Push with 0.2 N on every device found, for three seconds each.
    #[arg(long)]
    self_test: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// A kind, as a scene calls it.
#[derive(Debug, Clone, Copy, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Word {
    /// Haply, through the Haply Inverse Service
    Haply,
    /// Touch and PHANTOM, through libHD
    #[value(name = "openhaptics")]
    OpenHaptics,
    /// Force Dimension, through libdhd
    ForceDimension,
}

impl Word {
    fn kind(self) -> Kind {
        match self {
            Self::Haply => Kind::Haply,
            Self::OpenHaptics => Kind::OpenHaptics,
            Self::ForceDimension => Kind::ForceDimension,
        }
    }
}

/// Lists, tests and prints.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let places = Places::from_environment()?;
    let mut answer = Answer::default();
    if arguments.kind.is_none() {
        answer.gamepads = gamepads();
    }
    let kinds = match arguments.kind {
        Some(word) => vec![word.kind()],
        None => Kind::ALL.to_vec(),
    };
    for kind in kinds {
        match kind.list(&places) {
            Ok(found) if found.is_empty() => answer.absent(kind, "none is plugged in".to_owned()),
            Ok(found) => {
                for device in found {
                    answer
                        .devices
                        .push(examined(arguments, kind, device, &places)?);
                }
            }
            Err(why) => answer.absent(kind, why.to_string()),
        }
    }
    // A missing device that was requested by name is one sentence, and so is an empty list.
    if let (Some(_), [absent]) = (arguments.kind, answer.absent.as_slice()) {
        return Err(Failure::failed(&absent.why));
    }
    match arguments.json {
        true => output::json(&answer)?,
        false => output::text(answer.text())?,
    }
    answer.outcome()
}

/// A device with the result of its self-test, if requested.
fn examined(
    arguments: &Arguments,
    kind: Kind,
    found: Found,
    places: &Places,
) -> Result<Device, Failure> {
    let test = match arguments.self_test {
        true => Some(tested(arguments, kind, &found, places)?),
        false => None,
    };
    Ok(Device::new(kind, &found, test.as_ref()))
}

fn tested(
    arguments: &Arguments,
    kind: Kind,
    found: &Found,
    places: &Places,
) -> Result<SelfTest, Failure> {
    let progress = Progress::new(Reader::of_json(arguments.json), None);
    progress.show_step(format!(
        "{}: hold the handle for three seconds",
        found.capabilities.name
    ));
    let device = kind.open(found.number, places)?;
    Ok(self_test(device, Clock::real())?)
}
