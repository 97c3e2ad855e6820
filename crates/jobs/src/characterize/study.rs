use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use palpate_characterize::inverse::Organ;
use palpate_characterize::lumped::fit_approach;
use palpate_characterize::{CharacterizeSettings, characterize_organ, specimens};
use palpate_files::scene::Shape;
use palpate_geometry::collect_on_all_cores;
use palpate_simulate::read_organ;

use super::answer::Specimen;
use super::finished::{Finished, Studied};
use super::folder::StudyFolder;
use crate::{Error, ProgressCallback, ReadRecording};

/// Characterizes every specimen of `recordings`, on all cores, and returns them in their order. Reads stored results
/// from `folder` and writes each new result there at once.
pub(crate) fn of(
    recordings: Vec<ReadRecording>,
    settings: &CharacterizeSettings,
    folder: Option<&StudyFolder>,
    watch: &dyn ProgressCallback,
) -> Result<Vec<Finished>, Error> {
    let groups = grouped(recordings);
    let files = |folder: &StudyFolder| -> Vec<_> {
        let places = 0..groups.len();
        places
            .map(|place| folder.specimen_file(&groups, place, settings))
            .collect()
    };
    let files = folder.map(files).unwrap_or_default();
    let finished = folder.map_or(Ok(Vec::new()), |folder| folder.begin(&files))?;
    let finished: Vec<_> = finished.into_iter().map(Mutex::new).collect();
    watch.report_fraction(0.0);
    let done = AtomicUsize::new(0);
    let work = |place: usize, group: &Vec<ReadRecording>| {
        let name = Specimen::title(&group[0].clean.header, &group[0].path);
        let say = |doing: &str| watch.report_step(&format!("{name}: {doing}"));
        let before = finished.get(place).and_then(|own| own.lock().ok()?.take());
        let finished = match before {
            Some(finished) => Ok(finished),
            None => {
                if groups.len() == 1 && !settings.closed_forms {
                    warnings_before(group).for_each(|warning| watch.warn(&warning));
                }
                let finished = finish(group, settings, &say);
                let written = files
                    .get(place)
                    .map_or(Ok(()), |file| file.write(&finished, watch));
                written.map(|()| finished)
            }
        };
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        watch.report_fraction(done as f64 / groups.len() as f64);
        finished
    };
    collect_on_all_cores(&groups, work).into_iter().collect()
}

/// Warnings that are known before laws are fitted.
fn warnings_before(group: &[ReadRecording]) -> impl Iterator<Item = String> {
    let cleaned = group.iter().flat_map(|own| {
        let named = |warning| format!("{}: {warning}", own.path.display());
        own.clean.warnings.iter().map(named)
    });
    let recordings: Vec<_> = group.iter().map(|own| own.clean.clone()).collect();
    let contact = fit_approach(&recordings).ok();
    cleaned.chain(contact.and_then(|contact| contact.warning()))
}

/// The recordings of each specimen.
fn grouped(recordings: Vec<ReadRecording>) -> Vec<Vec<ReadRecording>> {
    let headers: Vec<_> = recordings.iter().map(|read| &read.clean.header).collect();
    let groups = specimens(&headers);
    let mut recordings: Vec<Option<ReadRecording>> = recordings.into_iter().map(Some).collect();
    let mut take = |group: Vec<usize>| {
        let each = group
            .into_iter()
            .filter_map(|place| recordings[place].take());
        each.collect()
    };
    groups.into_iter().map(&mut take).collect()
}

/// Characterizes one specimen; `say` receives the current step.
fn finish(
    group: &[ReadRecording],
    settings: &CharacterizeSettings,
    say: &dyn Fn(&str),
) -> Finished {
    let recordings: Vec<_> = group.iter().map(|read| read.clean.clone()).collect();
    let organ = organ(&group[0]);
    let found = characterize_organ(&recordings, organ, settings, &mut |doing| say(doing));
    Finished::of(&Studied {
        files: group.iter().map(|read| read.path.clone()).collect(),
        digests: group.iter().map(|read| read.digest.clone()).collect(),
        recordings,
        found,
    })
}

/// The organ that a recording names a mesh of; none where it names none.
fn organ(recording: &ReadRecording) -> Option<Result<Organ, palpate_characterize::Error>> {
    let header = &recording.clean.header;
    let path = recording.mesh()?;
    let unit = header.mesh_unit;
    let read = read_organ(&Shape::Mesh { path, unit });
    let unread = |why: palpate_simulate::Error| palpate_characterize::Error::UnreadMesh {
        why: why.to_string(),
    };
    Some(read.map_err(unread).map(|(surface, _)| Organ {
        surface,
        fixed: header.fixed.clone().unwrap_or_default(),
        location: header.location_m.unwrap_or_default().into(),
    }))
}
