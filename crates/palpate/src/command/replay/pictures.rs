//! Pictures of a session that is played again: in files of their own, or in one animation.

use std::path::{Path, PathBuf};

use palpate_files::{Claim, Overwrite, Scene};
use palpate_simulate::{Replay, Simulation};
use palpate_viewer::{Animation, FRAME_SIZE, Studio, png};

use crate::failure::Failure;

/// Width and height of an animation [pixels]: a quarter of a picture's, because each of its pictures is stored whole.
const ANIMATION_SIZE: (u32, u32) = (FRAME_SIZE.0 / 2, FRAME_SIZE.1 / 2);

/// The pictures to take, and when.
pub(super) struct Pictures {
    /// The steps after which a picture is taken, the next one last.
    due: Vec<usize>,
    studio: Studio,
    destination: Destination,
    files: Vec<PathBuf>,
    /// Until it is dropped nobody else writes there.
    _claims: Vec<Claim>,
}

/// Destination of the pictures.
enum Destination {
    InFolder(PathBuf),
    InAnimation(PathBuf, Box<Animation>),
}

impl Pictures {
    /// This many files in `folder`, evenly over so many steps.
    pub(super) fn files(
        folder: &Path,
        count: u64,
        overwrite: Overwrite,
        scene: &Scene,
        simulation: &Simulation,
        steps: usize,
    ) -> Result<Self, Failure> {
        let claim = Claim::of_folder(folder, overwrite)?;
        claim.check((0..count).map(name))?;
        let last = steps as u64 - 1;
        let due = (0..count).map(|number| match count {
            1 => last,
            _ => number * last / (count - 1),
        });
        Ok(Self {
            due: due.rev().map(|step| step as usize).collect(),
            studio: Studio::new(scene, simulation, FRAME_SIZE)?,
            destination: Destination::InFolder(folder.to_owned()),
            files: Vec::new(),
            _claims: vec![claim],
        })
    }

    /// An animation in `file` at a speed [-].
    pub(super) fn animation(
        file: &Path,
        speed: f64,
        overwrite: Overwrite,
        scene: &Scene,
        simulation: &Simulation,
        replay: &Replay,
    ) -> Result<Self, Failure> {
        let claims = Claim::of_files([file], overwrite)?;
        let mut due = Vec::new();
        for step in 0..replay.steps() {
            let since = replay.time(step) - replay.time(0);
            // Half a step early is nearer than half a step late.
            if since + 0.5 * simulation.step() >= due.len() as f64 * speed * Animation::DELAY {
                due.push(step);
            }
        }
        due.reverse();
        let animation = Box::new(Animation::new(ANIMATION_SIZE)?);
        Ok(Self {
            due,
            studio: Studio::new(scene, simulation, ANIMATION_SIZE)?,
            destination: Destination::InAnimation(file.to_owned(), animation),
            files: Vec::new(),
            _claims: claims,
        })
    }

    /// Takes the pictures that are due after the last step.
    pub(super) fn see(&mut self, replay: &Replay) -> Result<(), Failure> {
        while self.due.pop_if(|step| *step < replay.played()).is_some() {
            let picture = self.studio.picture(replay.state())?;
            match &mut self.destination {
                Destination::InFolder(folder) => {
                    let path = folder.join(name(self.files.len() as u64));
                    palpate_files::write_atomically(&path, &png(&picture)?)?;
                    self.files.push(path);
                }
                Destination::InAnimation(_, animation) => animation.add(&picture)?,
            }
        }
        Ok(())
    }

    /// Writes what is not yet written; all files.
    pub(super) fn finish(mut self) -> Result<Vec<PathBuf>, Failure> {
        if let Destination::InAnimation(path, animation) = self.destination {
            palpate_files::write_atomically(&path, &animation.finish()?)?;
            self.files.push(path);
        }
        Ok(self.files)
    }
}

/// The file of a picture, counted from zero.
fn name(number: u64) -> String {
    format!("frame-{:04}.png", number + 1)
}
