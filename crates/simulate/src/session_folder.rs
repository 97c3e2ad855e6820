//! The folder of a session: its rows and its scene, for replay.

use std::path::{Path, PathBuf};

use palpate_files::scene::Task;
use palpate_files::{
    Claim, Scene, Session, SessionHeader, SessionRow, SessionWriter, unfinished, write_atomically,
};

use crate::digest::differ;
use crate::performance::{self, Score};
use crate::{Error, Simulation};

/// The files in the folder.
const SESSION: &str = "session.csv";
const SCENE: &str = "scene.toml";

/// Files derived from a session. They are removed together with it: a summary never appears with another session's
/// rows, and a session that stays keeps its own.
const MADE_OF_SESSION: [&str; 4] = ["summary.json", "force.png", "force-depth.png", "beside.png"];

/// A session that was read from its folder.
#[derive(Debug, Clone)]
pub struct SessionFolder {
    /// The folder.
    pub path: PathBuf,
    /// The rows.
    pub session: Session,
    /// The scene; none for a session that was recorded without it.
    pub scene: Option<Scene>,
    /// The file of the session.
    file: PathBuf,
    /// Whether there is also a later, unfinished session.
    has_unfinished: bool,
}

/// Writes the folder of a session while it runs. Until it is finished, an older session in the folder stays unchanged,
/// and the new one is in files with the ending `.part`.
#[derive(Debug)]
pub struct SessionFolderWriter {
    session: SessionWriter,
    folder: Claim,
    /// Whether the scene was written.
    has_scene: bool,
}

impl SessionFolderWriter {
    /// Begins a session of `tools` with `header` in the claimed `folder`; `scene` is the text of its scene, if known.
    ///
    /// # Errors
    /// When there is a session in the folder that may not be replaced, or a file cannot be written.
    pub fn begin(
        folder: Claim,
        scene: Option<&str>,
        header: &SessionHeader,
        tools: &[String],
    ) -> Result<Self, Error> {
        folder.check([SESSION, SCENE])?;
        if let Some(text) = scene {
            write_atomically(unfinished(folder.path().join(SCENE)), text.as_bytes())?;
        }
        Ok(Self {
            session: SessionWriter::create(folder.path().join(SESSION), header, tools)?,
            folder,
            has_scene: scene.is_some(),
        })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// As of [`SessionWriter::write`].
    pub fn write(&mut self, row: &SessionRow) -> Result<(), palpate_files::Error> {
        self.session.write(row)
    }

    /// Flushes all rows to the file.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn flush(&mut self) -> Result<(), palpate_files::Error> {
        self.session.flush()
    }

    /// Ends the session: it replaces an older one, with its scene. The folder stays claimed until the return value is
    /// dropped.
    ///
    /// # Errors
    /// When the operating system refuses.
    pub fn finish(self) -> Result<Claim, palpate_files::Error> {
        let at = |name: &str| self.folder.path().join(name);
        let (session, scene) = (at(SESSION), at(SCENE));
        // In this order a reader never gets one session's rows with another's scene: without a `session.csv` it reads
        // the `.part` files.
        self.session.finish_after(|| {
            remove(&session)?;
            for name in MADE_OF_SESSION {
                remove(&at(name))?;
            }
            match self.has_scene {
                true => std::fs::rename(unfinished(&scene), &scene).map_err(|source| {
                    palpate_files::Error::Write {
                        path: scene.clone(),
                        source,
                    }
                }),
                false => remove(&scene),
            }
        })?;
        Ok(self.folder)
    }
}

/// Removes a file if it exists.
fn remove(path: &Path) -> Result<(), palpate_files::Error> {
    match std::fs::remove_file(path) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
            Err(palpate_files::Error::Write {
                path: path.to_owned(),
                source,
            })
        }
        _ => Ok(()),
    }
}

impl SessionFolder {
    /// Begins a session of `simulation`, which was made of `scene`, in the claimed `folder`.
    ///
    /// # Errors
    /// When there is a session in the folder that may not be replaced, or a file cannot be written.
    pub fn create(
        folder: Claim,
        scene: &Scene,
        simulation: &Simulation,
    ) -> Result<SessionFolderWriter, Error> {
        let names: Vec<_> = simulation.tools().iter().map(|t| t.name.clone()).collect();
        let header = simulation.session_header();
        SessionFolderWriter::begin(folder, scene.written.as_deref(), &header, &names)
    }

    /// The session file of the folder `path`.
    pub fn session_file(path: &Path) -> PathBuf {
        path.join(SESSION)
    }

    /// Whether there is a session in the folder `path`, finished or not.
    fn is_in(path: &Path) -> bool {
        let file = Self::session_file(path);
        file.exists() || unfinished(file).exists()
    }

    /// Reads a folder, or the session of a single file. If the folder has only an unfinished session, it reads that.
    ///
    /// # Errors
    /// When the session, or an existing scene, cannot be read.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let (folder, file) = match path.is_dir() {
            true => (path, path.join(SESSION)),
            false => (path.parent().unwrap_or(Path::new("")), path.to_owned()),
        };
        let part = unfinished(&file);
        let has_part = path.is_dir() && part.exists();
        let is_part = has_part && !file.exists();
        let scene = folder.join(SCENE);
        let scene_part = unfinished(&scene);
        let scene = match is_part && scene_part.exists() {
            true => scene_part,
            false => scene,
        };
        let file = if is_part { part } else { file };
        Ok(Self {
            path: path.to_owned(),
            session: Session::read(&file)?,
            file,
            scene: match scene.exists() {
                true => Some(Scene::read(scene)?),
                false => None,
            },
            has_unfinished: has_part && !is_part,
        })
    }

    /// Whether both are of the same file.
    pub fn is_same(&self, other: &Self) -> bool {
        let whole = |path: &Path| std::fs::canonicalize(path).ok();
        whole(&self.file).is_some_and(|own| whole(&other.file) == Some(own))
    }

    /// Whether both are of different scenes; none if they were written by versions whose digests cannot be compared.
    pub fn is_of_other_scene(&self, other: &Self) -> Option<bool> {
        let digest = |folder: &Self| folder.session.header.scene_digest.clone();
        differ(&digest(self), &digest(other))
    }

    /// Time of its last row, since the beginning of 1970 [s]; none if the system does not say.
    pub fn when(&self) -> Option<i64> {
        let written = std::fs::metadata(&self.file).ok()?.modified().ok()?;
        let since = written.duration_since(std::time::UNIX_EPOCH).ok()?;
        Some(since.as_secs() as i64)
    }

    /// Problems of the session as recorded, in sentences.
    pub fn warnings(&self) -> Vec<String> {
        let path = self.path.display();
        let incomplete = self.session.incomplete.iter();
        let mut warnings: Vec<String> = incomplete.map(|why| format!("{path}: {why}")).collect();
        if self.has_unfinished {
            warnings.push(format!(
                "{path}: a later session was begun here and not finished ({SESSION}.part); this is the one before"
            ));
        }
        warnings
    }

    /// The goal of its task; none without a scene.
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
    if path.is_file() || SessionFolder::is_in(path) {
        return Ok(vec![SessionFolder::read(path)?]);
    }
    let entries = std::fs::read_dir(path).map_err(|source| palpate_files::Error::Read {
        path: path.to_owned(),
        source,
    })?;
    let mut folders: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|folder| SessionFolder::is_in(folder))
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
