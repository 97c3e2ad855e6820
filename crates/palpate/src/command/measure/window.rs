//! The rig's window, as the command opens it.

use std::path::Path;
use std::sync::Arc;

use palpate_files::Overwrite;
use palpate_files::protocol::MeasuredTissue;
use palpate_jobs::measure::{Plan, folder as claimed};
use palpate_servo::{Clock, Vec3};
use palpate_viewer::rig::{Begin, Bench, Place, PreparedRig, open_rig_window};
use palpate_viewer::{Error, check_display};

use crate::command::window::is_absent;
use crate::failure::Failure;
use crate::interrupt;

/// Opens a window with the rigs of `plan`, whose recordings go into `folder`, and returns when it is closed.
pub(super) fn open(plan: Plan, folder: &Path) -> Result<(), Failure> {
    if folder.extension().is_some_and(|ending| ending == "csv") {
        return Err(Failure::input(format!(
            "a window makes as many recordings as one likes, and --out {} is one file; name a folder",
            folder.display()
        )));
    }
    check_display().or_else(no_window)?;
    // Before a window; each rig opens it anew.
    plan.open_device()?;
    // Before any measurement that could not be saved.
    let _claim = claimed(folder, Overwrite::Refused)?;
    let bench = Bench {
        settings: plan.settings,
        stimuli: plan.stimuli.clone(),
        places: (0..plan.specimens.len())
            .map(|place| self::place(&plan, place))
            .collect(),
        stops_at: plan.target,
        folder: folder.to_owned(),
        warnings: plan.warnings,
        // Ctrl-C withdraws the indenter, as closing the window does.
        is_ended: interrupt::is_requested,
    };
    // The first call starts listening for Ctrl-C.
    let _ = interrupt::is_requested();
    open_rig_window(bench).or_else(no_window)
}

fn no_window(why: Error) -> Result<(), Failure> {
    match is_absent(&why) {
        true => Err(Failure::failed(format!(
            "{why}; --headless measures without a window"
        ))),
        false => Err(why.into()),
    }
}

/// A specimen of the protocol, with how a rig over it is made.
fn place(plan: &Plan, place: usize) -> Place {
    let measured = &plan.specimens[place];
    let published = match &measured.tissue {
        MeasuredTissue::Published(organ) => Some(organ.to_string()),
        MeasuredTissue::Tissue(_) | MeasuredTissue::Real => None,
    };
    let organ = measured.organ.clone().or(published);
    let known = [organ, measured.subject.clone(), measured.site.clone()];
    let known: Vec<String> = known.into_iter().flatten().collect();
    let plan = plan.clone();
    let make = move |at_step: &mut dyn FnMut(f64)| -> Result<PreparedRig, String> {
        let (specimen, warnings) = plan.specimen(place, at_step).map_err(|e| e.to_string())?;
        let rig = plan.rig(specimen, place, Clock::real());
        Ok(PreparedRig {
            rig: rig.map_err(|error| error.to_string())?,
            warnings,
        })
    };
    Place {
        begin: Begin {
            place: Vec3::from(measured.place.place_m),
            measures_normal: measured.place.measure_normal,
        },
        name: match known.as_slice() {
            [] => format!("specimen {}", place + 1),
            known => known.join(", "),
        },
        make: Arc::new(make),
    }
}
