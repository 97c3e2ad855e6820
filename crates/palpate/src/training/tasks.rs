//! The tasks: those that come with the program, and those of the user's folder.

use std::path::Path;

use palpate_files::Scene;

use crate::failure::Failure;
use crate::output;

/// The tasks that come with the program: their names and scenes.
const BUILT_IN: [(&str, &str); 3] = [
    (
        "palpation",
        include_str!("../../../../assets/tasks/palpation.toml"),
    ),
    (
        "traction",
        include_str!("../../../../assets/tasks/traction.toml"),
    ),
    (
        "myotomy",
        include_str!("../../../../assets/tasks/myotomy.toml"),
    ),
];

/// The lower esophagus where it lies, to be touched without a task.
const FREE: &str = include_str!("../../../../assets/esophagus/trainer.toml");

/// All tasks, the program's first. A file of the user's that is no task is told and left out.
pub(super) fn tasks(folder: &Path) -> Result<Vec<Scene>, Failure> {
    let all = BUILT_IN
        .iter()
        .map(|(name, text)| built_in(name, text, folder));
    let mut tasks: Vec<Scene> = all.collect::<Result<_, _>>()?;
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

/// A task that comes with the program, beside the experts' sessions that the user has in `experts/NAME` of the
/// `folder`.
fn built_in(name: &str, text: &str, folder: &Path) -> Result<Scene, Failure> {
    let mut scene = Scene::parse(text, format!("built-in task {name}.toml"))?;
    let experts = folder.join("experts").join(name);
    scene.task.expert = experts.is_dir().then_some(experts);
    Ok(scene)
}

/// What is touched without a task.
pub(crate) fn free() -> Result<Scene, Failure> {
    Ok(Scene::parse(FREE, "built-in scene")?)
}

#[cfg(test)]
mod tests {
    use palpate_files::scene::ModelKind;
    use palpate_simulate::{Simulation, draw_variant};

    use super::*;

    /// Every task that comes with the program draws its variants, and can be played.
    #[test]
    fn tasks_are_whole() {
        for (name, text) in &BUILT_IN {
            let drawn = Scene::parse(text, name).unwrap();
            assert!(drawn.draws.is_some(), "{name}");
            let mut scene = draw_variant(&drawn, 0).unwrap();
            assert!(scene.task.title.is_some() && scene.task.instructions.is_some());
            assert!(scene.written.is_some());
            scene.model.kind = ModelKind::Local;
            Simulation::new(&scene).unwrap();
        }
        assert!(free().unwrap().task.title.is_none());
    }
}
