//! The tasks: those that come with the program, and those of the user's folder.

use std::path::Path;

use palpate_files::{Scene, write_whole};
use palpate_simulate::SessionFolder;

use crate::failure::Failure;
use crate::output;

/// A task that comes with the program.
struct BuiltIn {
    name: &'static str,
    scene: &'static str,
    /// A session that shows it, by a script: no surgeon's.
    demonstration: Option<&'static str>,
}

const BUILT_IN: [BuiltIn; 3] = [
    BuiltIn {
        name: "palpation",
        scene: include_str!("../../../../assets/tasks/palpation.toml"),
        demonstration: None,
    },
    BuiltIn {
        name: "traction",
        scene: include_str!("../../../../assets/tasks/traction.toml"),
        demonstration: Some(include_str!(
            "../../../../assets/tasks/traction-demonstration.csv"
        )),
    },
    BuiltIn {
        name: "myotomy",
        scene: include_str!("../../../../assets/tasks/myotomy.toml"),
        demonstration: Some(include_str!(
            "../../../../assets/tasks/myotomy-demonstration.csv"
        )),
    },
];

/// The lower esophagus where it lies, to be touched without a task.
const FREE: &str = include_str!("../../../../assets/esophagus/trainer.toml");

/// All tasks, the program's first. A file of the user's that is no task is told and left out.
pub(super) fn tasks(folder: &Path) -> Result<Vec<Scene>, Failure> {
    let built_in = BUILT_IN.iter().map(|task| task.scene(folder));
    let mut tasks: Vec<Scene> = built_in.collect::<Result<_, _>>()?;
    let own = std::fs::read_dir(folder.join("tasks"));
    let mut paths: Vec<_> = own
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    paths.sort_unstable();
    for path in paths {
        match Scene::read(&path) {
            Ok(scene) => tasks.push(scene),
            Err(error) => output::warnings(&[format!("a task is left out: {error}")]),
        }
    }
    Ok(tasks)
}

impl BuiltIn {
    /// Its scene, with its demonstration as the expert unless the user has sessions of a better one in
    /// `experts/NAME` of the `folder`.
    fn scene(&self, folder: &Path) -> Result<Scene, Failure> {
        let mut scene = Scene::parse(self.scene, format!("built-in task {}.toml", self.name))?;
        let expert = folder.join("experts").join(self.name);
        if expert.is_dir() {
            scene.task.expert = Some(expert);
        } else if let Some(session) = self.demonstration {
            let shown = folder.join("demonstrations").join(self.name);
            let file = SessionFolder::session_file(&shown);
            // Without it the task goes on without a ghost.
            let written = std::fs::create_dir_all(&shown).is_ok()
                && write_whole(&file, session.as_bytes()).is_ok();
            scene.task.expert = written.then_some(shown);
        }
        Ok(scene)
    }
}

/// What is touched without a task.
pub(crate) fn free() -> Result<Scene, Failure> {
    Ok(Scene::parse(FREE, "built-in scene")?)
}

#[cfg(test)]
mod tests {
    use palpate_files::Session;
    use palpate_files::scene::ModelKind;
    use palpate_simulate::{Simulation, performance};

    use super::*;

    /// Every task that comes with the program can be played, and its demonstration passes it.
    #[test]
    fn tasks_are_whole() {
        for task in &BUILT_IN {
            let mut scene = Scene::parse(task.scene, task.name).unwrap();
            assert!(scene.task.title.is_some() && scene.task.instructions.is_some());
            assert!(scene.written.is_some());
            if let Some(session) = task.demonstration {
                let session = Session::parse(session, task.name).unwrap();
                let score = performance::score(&scene.task, &session.tools, &session.rows);
                assert_eq!(score.outcome.passed(), Some(true), "{}", task.name);
                assert_eq!(score.errors.force_limit, 0, "{}", task.name);
            }
            scene.model.kind = ModelKind::Local;
            Simulation::new(&scene).unwrap();
        }
        assert!(free().unwrap().task.title.is_none());
    }
}
