//! The tasks: those that come with the program, and those of the user's folder.

use std::path::Path;

use palpate_files::Scene;
use palpate_viewer::training::{OfferedTask, TaskPicture};

use crate::failure::Failure;
use crate::output;

/// A task that comes with the program.
struct BuiltIn {
    name: &'static str,
    scene: &'static str,
    picture: &'static [u8],
}

macro_rules! built_in {
    ($name:literal) => {
        BuiltIn {
            name: $name,
            scene: include_str!(concat!("../../../../assets/tasks/", $name, ".toml")),
            picture: include_bytes!(concat!("../../../../assets/tasks/", $name, ".png")),
        }
    };
}

/// The tasks that come with the program.
const BUILT_IN: [BuiltIn; 5] = [
    built_in!("palpation"),
    built_in!("traction"),
    built_in!("retraction"),
    built_in!("cutting"),
    built_in!("myotomy"),
];

/// The lower esophagus in place, to be touched without a task.
const FREE: &str = include_str!("../../../../assets/esophagus/trainer.toml");

/// All tasks, the program's first. An invalid file of the user gives a warning and is left out.
pub(super) fn tasks(folder: &Path) -> Result<Vec<OfferedTask>, Failure> {
    let all = BUILT_IN.iter().map(|task| {
        Ok(OfferedTask {
            scene: task.scene(folder)?,
            picture: TaskPicture::decode(task.picture).ok(),
        })
    });
    let mut tasks: Vec<OfferedTask> = all.collect::<Result<_, Failure>>()?;
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
            Ok(scene) => tasks.push(OfferedTask {
                picture: picture(&scene),
                scene,
            }),
            Err(error) => output::warnings(&[format!("a task is left out: {error}")]),
        }
    }
    Ok(tasks)
}

impl BuiltIn {
    /// Its scene, with the experts' sessions that the user has in `experts/NAME` of the `folder`.
    fn scene(&self, folder: &Path) -> Result<Scene, Failure> {
        let Self { name, scene, .. } = self;
        let mut scene = Scene::parse(scene, format!("built-in task {name}.toml"))?;
        let experts = folder.join("experts").join(name);
        scene.task.expert = experts.is_dir().then_some(experts);
        Ok(scene)
    }
}

/// The picture of a user's task. One that cannot be shown gives a warning and is left out.
fn picture(scene: &Scene) -> Option<TaskPicture> {
    let path = scene.task.picture.as_ref()?;
    let bytes = std::fs::read(path).map_err(|cause| cause.to_string());
    match bytes.and_then(|bytes| TaskPicture::decode(&bytes)) {
        Ok(picture) => Some(picture),
        Err(cause) => {
            let warning = format!(
                "{}: the picture of a task is left out: {cause}",
                path.display()
            );
            output::warnings(&[warning]);
            None
        }
    }
}

/// The scene without a task.
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
    #[ignore = "long"]
    fn tasks_are_whole() {
        for BuiltIn {
            name,
            scene,
            picture,
        } in &BUILT_IN
        {
            assert!(TaskPicture::decode(picture).is_ok(), "{name}");
            let drawn = Scene::parse(scene, name).unwrap();
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
