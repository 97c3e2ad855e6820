//! Training: the tasks that come with the program, and the storage of sessions and results.

mod record;
mod tasks;
mod window_record;

use std::path::PathBuf;
use std::time::{SystemTime, UNIX_EPOCH};

use palpate_viewer::training::{Training, TrainingRecord};

pub(crate) use record::record_file;
pub(crate) use tasks::free;
pub(crate) use window_record::{Author, VARIANT, save_score};

use crate::failure::Failure;
use window_record::WindowRecord;

/// The variable that names the folder of sessions and results.
const FOLDER_VARIABLE: &str = "PALPATE_TRAINING";

/// The folder of sessions and results.
pub(crate) fn folder() -> Result<PathBuf, Failure> {
    let named = std::env::var_os(FOLDER_VARIABLE).filter(|name| !name.is_empty());
    let set = || crate::settings::read_or_warn().training_folder;
    let own = || Some(dirs::data_dir()?.join("palpate"));
    named
        .map(PathBuf::from)
        .or_else(set)
        .or_else(own)
        .ok_or_else(|| {
            Failure::failed(format!(
                "this system names no folder for sessions and results; name one with the variable \
             {FOLDER_VARIABLE}"
            ))
        })
}

/// Seconds since the beginning of 1970.
pub(crate) fn now() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| since.as_secs() as i64)
}

/// All data that a window needs for training.
pub(crate) fn training() -> Result<Training, Failure> {
    let folder = folder()?;
    let record = WindowRecord::new(&folder)?;
    let user = std::env::var("USER").unwrap_or_else(|_| "trainee".to_owned());
    Ok(Training {
        tasks: tasks::tasks(&folder)?,
        free: tasks::free()?,
        sessions: folder.join("sessions"),
        trainee: record.last_trainee().unwrap_or(user),
        record: Box::new(record),
    })
}
