//! `palpate devices`: which haptic devices are there, and whether they do what they should.

mod answer;

use clap::{Args, ValueEnum};
use palpate_devices::{Found, Kind, Places, SelfTest, self_test};
use palpate_servo::Clock;

use answer::{Answer, Device};

use crate::failure::Failure;
use crate::output;
use crate::progress::{Progress, Reader};

/// Examples at the end of the help.
const EXAMPLES: &str = "\
Examples:
  palpate devices
      what is found of every kind, with its limits
  palpate devices haply --self-test
      every Haply device answers, and pushes a hand with 0.2 N right, up and toward it: hold the handle

The variable PALPATE_HAPLY says where the Haply Inverse Service is (HOST:PORT, or HOST:PORT,PORT with \
that of its events), PALPATE_OPENHAPTICS and PALPATE_FORCE_DIMENSION where libHD and libdhd are, if not \
where the system looks for them. None of the drivers was tried on hardware yet: docs/devices.md.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Only this kind, which then has to be there.
    #[arg(value_enum, value_name = "KIND")]
    kind: Option<Word>,
    /// Push a hand with 0.2 N on every device that is found, for three seconds each.
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
    /// By the Haply Inverse Service
    Haply,
    /// Touch and PHANTOM, by libHD
    #[value(name = "openhaptics")]
    OpenHaptics,
    /// By libdhd
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
    // One that was asked for by name is one sentence, and so is nothing at all.
    if let (Some(_), [absent]) = (arguments.kind, answer.absent.as_slice()) {
        return Err(Failure::failed(&absent.why));
    }
    match arguments.json {
        true => output::json(&answer)?,
        false => output::text(answer.text())?,
    }
    answer.outcome()
}

/// A device with how it did in its self-test, if that is wanted.
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
    progress.say(format!(
        "{}: hold the handle for three seconds",
        found.capabilities.name
    ));
    let device = kind.open(found.number, places)?;
    Ok(self_test(device, Clock::real())?)
}
