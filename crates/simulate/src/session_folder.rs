//! The folder of a session: what happened, and the scene that it happened in, so that it can be looked at again.

use std::path::{Path, PathBuf};

use palpate_files::scene::Task;
use palpate_files::{Scene, Session, SessionWriter, write_whole};

use crate::performance::{self, Score};
use crate::{Error, Simulation};

/// The files in the folder.
const SESSION: &str = "session.csv";
const SCENE: &str = "scene.toml";

/// A session that was read from its folder.
#[derive(Debug, Clone)]
pub struct SessionFolder {
    /// The folder.
    pub path: PathBuf,
    /// What happened.
    pub session: Session,
    /// The scene; none for a session that was recorded without it.
    pub scene: Option<Scene>,
}

impl SessionFolder {
    /// Begins a session of `simulation`, which was made of `scene`, in the folder `path`; the folder is made.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn create(
        path: &Path,
        (scene, simulation): (&Scene, &Simulation),
    ) -> Result<SessionWriter, Error> {
        std::fs::create_dir_all(path).map_err(|cause| palpate_files::Error::Write {
            path: path.to_owned(),
            source: cause,
        })?;
        if let Some(text) = &scene.written {
            write_whole(path.join(SCENE), text.as_bytes())?;
        }
        let names: Vec<_> = simulation.tools().iter().map(|t| t.name.clone()).collect();
        let header = simulation.session_header();
        Ok(SessionWriter::create(path.join(SESSION), &header, &names)?)
    }

    /// The session file of the folder `path`.
    pub fn session_file(path: &Path) -> PathBuf {
        path.join(SESSION)
    }

    /// Reads a folder, or the session of a file alone.
    ///
    /// # Errors
    /// When the session cannot be read, or a scene is there that cannot be.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let (folder, file) = match path.is_dir() {
            true => (path, path.join(SESSION)),
            false => (path.parent().unwrap_or(Path::new("")), path.to_owned()),
        };
        let session = Session::read(&file)?;
        let scene = folder.join(SCENE);
        Ok(Self {
            path: path.to_owned(),
            session,
            scene: match scene.exists() {
                true => Some(Scene::read(scene)?),
                false => None,
            },
        })
    }

    /// What was to be done; nothing in particular without a scene.
    pub fn task(&self) -> Task {
        self.scene
            .as_ref()
            .map_or_else(Task::default, |scene| scene.task.clone())
    }

    /// Its score by `task`.
    pub fn score(&self, task: &Task) -> Score {
        performance::score(task, &self.session.tools, &self.session.rows)
    }
}

/// The sessions of experts in `path`: that of the folder itself, or those of the folders in it, in the order of
/// their names.
///
/// # Errors
/// When there is none, or one cannot be read.
pub fn read_experts(path: &Path) -> Result<Vec<SessionFolder>, Error> {
    if path.is_file() || path.join(SESSION).exists() {
        return Ok(vec![SessionFolder::read(path)?]);
    }
    let entries = std::fs::read_dir(path).map_err(|source| palpate_files::Error::Read {
        path: path.to_owned(),
        source,
    })?;
    let mut folders: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|folder| folder.join(SESSION).exists())
        .collect();
    folders.sort_unstable();
    if folders.is_empty() {
        return Err(Error::NoExpert {
            path: path.to_owned(),
        });
    }
    folders
        .iter()
        .map(|folder| SessionFolder::read(folder))
        .collect()
}
