//! Repeats a recorded indentation on the organ of a scene.

use std::path::{Path, PathBuf};

use palpate_characterize::CleanRecording;
use palpate_files::recording::{IndenterShape, StimulusKind};
use palpate_files::scene::{Tip, TipShape};
use palpate_files::{Motion, Scene};
use palpate_geometry::Vec3;
use palpate_jobs::Recordings;
use palpate_simulate::Simulation;

use crate::failure::Failure;
use crate::recorded::Comparison;

/// A point, from its three coordinates with commas between them [m].
pub(super) fn point(text: &str) -> Result<[f64; 3], String> {
    let numbers = text.split(',').map(|number| number.trim().parse::<f64>());
    let numbers: Result<Vec<f64>, _> = numbers.collect();
    numbers
        .ok()
        .filter(|numbers| numbers.iter().all(|number| number.is_finite()))
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| "write three numbers, in metres: 0.01,0,-0.02".to_owned())
}

/// A recording, read as `characterize` reads it: the depth from the same first contact, the force less the same
/// zero.
pub(super) struct Repeated {
    file: PathBuf,
    recording: CleanRecording,
}

impl Repeated {
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        let (mut read, _) = Recordings::of(path).read(|_| ())?;
        if read.len() != 1 {
            let path = path.display();
            return Err(Failure::input(format!(
                "{path} holds {} recordings, and an indentation is of one; name a file",
                read.len()
            )));
        }
        let read = read.remove(0);
        let stimulus = read.clean.header.stimulus;
        if stimulus.is_some_and(StimulusKind::is_of_piece) {
            return Err(Failure::input(format!(
                "{}: a whole piece was pressed or pulled, not indented; name the recording of an indenter",
                read.path.display()
            )));
        }
        Ok(Self {
            file: read.path,
            recording: read.clean,
        })
    }

    /// The motion of the scene's first tool that repeats it near `at` [m], and the comparison of forces.
    pub(super) fn on(
        self,
        scene: &Scene,
        simulation: &Simulation,
        at: Option<[f64; 3]>,
    ) -> Result<(Motion, Comparison), Failure> {
        let tool = &simulation.tools()[0];
        let site = simulation.site(tool, at.map(Vec3::from));
        let file = self.file.display().to_string();
        let warnings = self.recording.warnings.iter();
        let mut warnings: Vec<String> = warnings
            .map(|warning| format!("{file}: {warning}"))
            .collect();
        warnings.extend(self.other_tip(&scene.tools[0].tip));
        let CleanRecording {
            time,
            depth,
            filtered_force,
            handling,
            ..
        } = self.recording;
        // In the recording's own time.
        let time: Vec<f64> = time.iter().map(|t| t + handling.contact.time_s).collect();
        let motion = site.indented(tool, &time, &depth)?;
        let recorded = [time, depth, filtered_force];
        Ok((motion, Comparison::new(self.file, recorded, site, warnings)))
    }

    /// A warning when the tip differs from the indenter.
    fn other_tip(&self, tip: &Tip) -> Option<String> {
        let header = &self.recording.header;
        let is_shape = match header.indenter_shape {
            None => true,
            Some(IndenterShape::Flat) => tip.shape == TipShape::Flat,
            Some(IndenterShape::Sphere) => tip.shape == TipShape::Sphere,
            Some(IndenterShape::Cone) => false,
        };
        let radius = header.indenter_radius_m;
        // As written, to a thousandth.
        let is_size = radius.is_none_or(|own| (own / tip.radius_m - 1.0).abs() < 1e-3);
        let known = |shape: Option<IndenterShape>| {
            shape.map_or("of unknown shape".to_owned(), |shape| shape.to_string())
        };
        (!is_shape || !is_size).then(|| {
            format!(
                "the tip is {}, radius {} mm, and the indenter was {}, radius {} mm: their forces are not to be \
                 compared",
                tip.shape,
                1e3 * tip.radius_m,
                known(header.indenter_shape),
                radius.map_or("unknown".to_owned(), |radius| (1e3 * radius).to_string()),
            )
        })
    }
}
