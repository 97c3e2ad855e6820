use std::path::{Path, PathBuf};

use toml::{Table, Value};

use crate::Error;
use crate::error::Place;

/// The keys whose texts are paths, wherever they stand in a scene.
const PATHS: [&str; 5] = ["mesh", "surface", "tissue", "expert", "picture"];

/// The text of a scene that means the same in any folder: the paths in it, which are relative to `path`, become
/// absolute. It is stored with a session, so that the session can be played again.
///
/// # Errors
/// When the text is no TOML.
pub fn self_contained(text: &str, path: impl AsRef<Path>) -> Result<String, Error> {
    let path = path.as_ref();
    // The name of a file alone has an empty folder, which has no absolute path.
    let folder = path.parent().unwrap_or(Path::new("")).join(".");
    let folder = std::path::absolute(&folder).unwrap_or(folder);
    let bad = |message: &str| Error::Syntax {
        place: Place::file(path),
        message: message.replace('\n', " "),
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut scene: Table = toml::from_str(text).map_err(|cause| bad(cause.message()))?;
    complete(&mut scene, &folder);
    toml::to_string(&scene).map_err(|cause| bad(&cause.to_string()))
}

fn complete(table: &mut Table, folder: &Path) {
    for (key, value) in table.iter_mut() {
        match value {
            Value::String(path) if PATHS.contains(&key.as_str()) => {
                *path = plain(&folder.join(&*path)).display().to_string();
            }
            Value::Table(inner) => complete(inner, folder),
            Value::Array(each) => {
                let tables = each.iter_mut().filter_map(Value::as_table_mut);
                tables.for_each(|inner| complete(inner, folder));
            }
            _ => {}
        }
    }
}

/// Without `.` and without the `a/..` in it.
pub(super) fn plain(path: &Path) -> PathBuf {
    use std::path::Component::{CurDir, Normal, ParentDir};
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            CurDir => {}
            ParentDir if matches!(plain.components().next_back(), Some(Normal(_))) => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}
