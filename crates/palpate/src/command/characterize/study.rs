use palpate_characterize::{CharacterizeSettings, characterize, specimens};

use super::answer::Specimen;
use super::finished::{Finished, Studied};
use super::folder::{Kept, StudyFolder};
use crate::command::recordings::ReadRecording;
use crate::cores::on_all_cores;
use crate::failure::Failure;
use crate::progress::{Progress, Reader};

/// Every specimen of `recordings`, as many at once as there are cores, in their order. What `folder` keeps
/// already is taken from there, and what is finished goes there at once.
pub(super) fn of(
    recordings: Vec<ReadRecording>,
    settings: &CharacterizeSettings,
    folder: Option<&StudyFolder>,
    reader: Reader,
) -> Result<Vec<Finished>, Failure> {
    let groups = grouped(recordings);
    if let Some(folder) = folder {
        folder.say_when_stopped(groups.len());
    }
    let progress = Progress::new(reader, Some(groups.len() as u64));
    let work = |place: usize, group: &Vec<ReadRecording>| {
        let name = Specimen::title(&group[0].clean.header, &group[0].path);
        let kept = folder.map(|folder| folder.kept(&groups, place, settings));
        let finished = finish(group, settings, kept.as_ref(), |doing| {
            progress.say(format!("{name}: {doing}"));
        });
        progress.step();
        finished
    };
    on_all_cores(&groups, work).into_iter().collect()
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

fn finish(
    group: &[ReadRecording],
    settings: &CharacterizeSettings,
    kept: Option<&Kept>,
    mut say: impl FnMut(&str),
) -> Result<Finished, Failure> {
    if let Some(finished) = kept.and_then(Kept::read) {
        return Ok(finished);
    }
    let recordings: Vec<_> = group.iter().map(|read| read.clean.clone()).collect();
    let found = characterize(&recordings, settings, &mut |doing| say(doing));
    let finished = Finished::of(&Studied {
        files: group.iter().map(|read| read.path.clone()).collect(),
        digests: group.iter().map(|read| read.digest.clone()).collect(),
        recordings,
        found,
    });
    if let Some(kept) = kept {
        kept.write(&finished)?;
    }
    Ok(finished)
}
