use super::super::estimate::{Estimated, Progress};
use super::super::mesh::ElementMesh;
use super::super::model::{FiniteElementModel, FiniteElementWorkspace, Formulation};
use super::answer::SolidAnswer;
use super::frame::Frame;
use super::grading::Ground;
use super::problem::{Body, SolidProblem};
use super::solve::equilibrium;
use super::supports::Held;
use crate::{Error, Vec3};

/// More unknowns than these are refused: their factors would have about ten gigabytes.
const MOST_UNKNOWNS: usize = 600_000;

/// A third mesh is solved when the second had at most so many unknowns, since it has about two and a
/// half times as many.
const MOST_BEFORE_THE_THIRD: usize = 150_000;

/// Power of the size of the elements with which the force errs [-]. Stress at the edge of the patch is
/// infinite, which leaves 1; the circle, which is cut into ever more chords, takes some of it away.
const ORDER: f64 = 0.8;

/// The force of a patch, to the relative `accuracy` [-] if the second mesh, or the third, gives it; on a
/// body too large for a third the error that is left is told all the same.
///
/// # Errors
/// When the problem is none (no anchor, no patch, no displacement), too large for the memory, or
/// cannot be followed to its end.
pub fn solve(
    problem: &SolidProblem,
    accuracy: f64,
    progress: &mut dyn FnMut(Progress),
) -> Result<Estimated<SolidAnswer>, Error> {
    problem.check()?;
    let ground = Ground::new(problem)?;
    let mut coarse = problem.solve_on(&ground, 0, progress)?.force_along;
    let mut halvings = 1;
    loop {
        let answer = problem.solve_on(&ground, halvings, progress)?;
        let error = change(coarse, answer.force_along) / (2.0_f64.powf(ORDER) - 1.0);
        let last = halvings >= 2 || answer.unknowns > MOST_BEFORE_THE_THIRD;
        if error <= accuracy || last {
            return Ok(Estimated { answer, error });
        }
        coarse = answer.force_along;
        halvings += 1;
    }
}

/// The same on one mesh, whose elements at the edge of the patch were halved `halvings` times.
///
/// # Errors
/// See [`solve`].
pub fn solve_at(
    problem: &SolidProblem,
    halvings: u32,
    progress: &mut dyn FnMut(Progress),
) -> Result<SolidAnswer, Error> {
    problem.check()?;
    let ground = Ground::new(problem)?;
    problem.solve_on(&ground, halvings, progress)
}

impl SolidProblem {
    fn solve_on(
        &self,
        ground: &Ground<'_>,
        halvings: u32,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<SolidAnswer, Error> {
        progress(Progress {
            part: 0.0,
            halvings,
        });
        let (tetrahedra, crossing) = ground.mesh(halvings)?;
        let corners = tetrahedra.vertices().len();
        let unknowns = 4 * corners + 3 * tetrahedra.edges().len();
        if unknowns > MOST_UNKNOWNS {
            return Err(Error::TooManyUnknowns {
                unknowns,
                most: MOST_UNKNOWNS,
            });
        }
        let held = Held::new(self, &tetrahedra, &ground.center)?;
        let frame = Frame::new(&self.patch);
        let mesh = frame.put(ElementMesh::from_tetrahedra(&tetrahedra));
        let model = FiniteElementModel::new(mesh, self.law.clone(), Formulation::Mixed)?;
        let mut workspace = FiniteElementWorkspace::new(&model)?;
        let state = equilibrium(&model, (&frame, &held), &mut workspace, &mut |part| {
            progress(Progress { part, halvings });
        })?;
        let supports = (&frame, &held, &self.patch.displacement);
        let mut answer = SolidAnswer::new(&model, &state, &workspace, supports);
        answer.doubts.clone_from(&ground.doubts);
        if crossing > 0 {
            answer.doubts.push(format!(
                "{crossing} edges of the mesh cross the edge of the patch, whose area is {:.3e} m²",
                answer.patch_area
            ));
        }
        Ok(answer)
    }

    fn check(&self) -> Result<(), Error> {
        let patch = &self.patch;
        let length = |name: &'static str, found: f64| {
            if found > 0.0 && found.is_finite() {
                Ok(())
            } else {
                Err(Error::NotALength { name, found })
            }
        };
        let displacement = patch.displacement.norm();
        length("the radius of the patch", patch.radius)?;
        length("the displacement of the patch", displacement)?;
        let (low, high) = self.body.bounds();
        let extent = (high - low).max();
        if displacement > extent {
            return Err(Error::DisplacementBeyondBody {
                displacement,
                extent,
            });
        }
        if self.anchor.is_empty() {
            return Err(Error::NothingHeld);
        }
        Ok(())
    }
}

/// Relative change of a force [-].
fn change(coarse: f64, fine: f64) -> f64 {
    if coarse == fine {
        0.0
    } else {
        ((fine - coarse) / fine).abs()
    }
}

impl Body {
    /// Lowest and highest coordinates [m].
    pub fn bounds(&self) -> (Vec3, Vec3) {
        match self {
            Self::Surface(surface) => surface.mesh().bounds(),
            Self::Volume(mesh) => {
                let none = Vec3::repeat(f64::INFINITY);
                let vertices = mesh.vertices().iter();
                vertices.fold((none, -none), |(low, high), v| (low.inf(v), high.sup(v)))
            }
        }
    }
}
