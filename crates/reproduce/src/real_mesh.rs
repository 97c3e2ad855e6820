use std::path::PathBuf;

use palpate_geometry::{TriangleMesh, read_mesh};

use crate::Error;

/// The variable that names the folder of real meshes, and where they are without it.
const FOLDER_VARIABLE: &str = "PALPATE_DATA";
const USUAL_FOLDER: &str = "../shared/data";

/// The real mesh `name`, when it is at hand.
pub(super) fn real_mesh(name: &str) -> Result<Option<TriangleMesh>, Error> {
    let folder = std::env::var_os(FOLDER_VARIABLE).unwrap_or_else(|| USUAL_FOLDER.into());
    let path = PathBuf::from(folder).join(format!("meshes/{name}.ply"));
    if !path.is_file() {
        return Ok(None);
    }
    Ok(Some(read_mesh(&path, None)?.mesh))
}
