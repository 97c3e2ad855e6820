use std::path::{Path, PathBuf};

use super::goal::{CUT, FIND, TOUCH, TRACTION};
use super::self_contained::plain;
use super::{Goal, Neighbour, Tool};
use crate::{Domain, Error, Key, Keys};

/// The task, and the criteria for a performance.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Task {
    /// Its title.
    pub title: Option<String>,
    /// The instructions for the trainee.
    pub instructions: Option<String>,
    /// The time limit [s].
    pub time_limit_s: Option<f64>,
    /// The force above which tissue would be harmed [N].
    pub force_limit_n: Option<f64>,
    /// The folder of an expert's session, or of several.
    pub expert: Option<PathBuf>,
    /// A picture for a list of tasks.
    pub picture: Option<PathBuf>,
    /// The goal.
    pub goal: Goal,
}

/// Properties of a scene on which its task depends.
pub(super) struct TaskScene<'a> {
    /// How many layers the organ has.
    pub(super) layers: usize,
    pub(super) tools: &'a [Tool],
    pub(super) neighbours: &'a [Neighbour],
}

/// The folder of the expert's session. The scene's own folder may only hold the judged session.
fn expert(keys: &Keys<'_>, folder: &Path) -> Result<Option<PathBuf>, Error> {
    match keys.text("expert")? {
        Some(path) if plain(Path::new(&path)).as_os_str().is_empty() => Err(keys.invalid(
            "expert",
            "the folder of an expert's session; with its own scene a session would be judged against itself",
        )),
        path => Ok(path.map(|path| folder.join(path))),
    }
}

impl Task {
    pub(super) const KEYS: &'static [Key] = &[
        Key::text("title", "What it is called.").optional("\"Find the stiff spot\"", "it has no title"),
        Key::text("instructions", "What the trainee reads.").optional(
            "\"One place under the surface is stiffer. Press on it and say: here.\"",
            "nothing",
        ),
        Key::number("time_limit_s", Domain::DURATION, "How long it may take.")
            .optional("60.0", "as long as it takes"),
        Key::number(
            "force_limit_n",
            Domain::FORCE,
            "The force above which tissue would be harmed; forces above it count against the trainee.",
        )
        .optional("2.0", "no force counts"),
        Key::path(
            "expert",
            "An expert's session to compare with: its folder, or a folder of several.",
        )
        .optional("\"expert-session\"", "none"),
        Key::path("picture", "A picture of it for the start screen: a PNG file.")
            .optional("\"picture.png\"", "none"),
        Key::table(
            "find",
            FIND,
            "Done when a place is marked. At most one of `find`, `traction`, `cut` and `touch`.",
        )
        .optional("", "everybody does what they like"),
        Key::table("traction", TRACTION, "Done when a force was held for long enough.")
            .optional("", "another goal"),
        Key::table("cut", CUT, "Done when a line is cut.")
            .optional("", "another goal"),
        Key::table(
            "touch",
            TOUCH,
            "Done when a place of a neighbour was touched for long enough, with the organ out of the way.",
        )
        .optional("", "another goal"),
    ];

    pub(super) fn from_keys(
        keys: Option<&Keys<'_>>,
        folder: &Path,
        around: &TaskScene<'_>,
    ) -> Result<Self, Error> {
        let Some(keys) = keys else {
            return Ok(Self::default());
        };
        Ok(Self {
            title: keys.text("title")?,
            instructions: keys.text("instructions")?,
            time_limit_s: keys.number("time_limit_s")?,
            force_limit_n: keys.number("force_limit_n")?,
            expert: expert(keys, folder)?,
            picture: keys.text("picture")?.map(|path| folder.join(path)),
            goal: Goal::from_keys(keys, around)?,
        })
    }
}
