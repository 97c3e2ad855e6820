use std::sync::Arc;

use palpate_files::Domain;
use palpate_mechanics::finite_elements::indentation::{
    Block, ElasticBase, IndentationRun, IndentationSettings, Indenter, IndenterShape,
};
use palpate_mechanics::finite_elements::tube::{Ends, Tube, TubeProblem, TubePunch, indent};
use palpate_mechanics::{IndentationCurve, Law, PronySeries};

use super::body::{BaseModulus, Body};
use super::family::Family;
use super::law::{CandidateLaw, ShapeRange};
use super::mesh_error::MeshError;
use super::organ::FarField;
use super::tables;
use crate::Error;

/// Elastic force per unit of the modulus [m²] over the depth [m], of a law with given shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitCurve {
    /// The shapes of the law [-].
    pub shape: Vec<f64>,
    /// The force.
    pub force: IndentationCurve,
    /// Its change with each shape.
    pub by_shape: Vec<IndentationCurve>,
    /// Relative error of the force by the elements [-].
    pub discretisation: f64,
    /// How it changes with the base of a layer, where it is on one.
    pub base: Option<BaseSensitivity>,
}

/// How the force on a layer changes with its base.
#[derive(Debug, Clone, PartialEq)]
pub struct BaseSensitivity {
    /// Change with the logarithm of the base's stiffness over the layer's [m²].
    pub by_stiffness: IndentationCurve,
    /// Whether the stiffness of the base is known by itself, so that the ratio falls where the layer's modulus rises.
    pub is_absolute: bool,
    /// Standard error of the stiffness, over it [-].
    pub error: f64,
}

impl UnitCurve {
    /// The change of the force with the modulus at `depth` [m] [m²].
    pub(super) fn by_modulus(&self, depth: f64) -> f64 {
        let force = self.force.force(depth);
        match &self.base {
            Some(base) if base.is_absolute => force - base.by_stiffness.force(depth),
            _ => force,
        }
    }
}

/// Problem of a run of finite elements.
#[derive(Debug, Clone, Copy)]
struct PressedPiece {
    /// The tissue.
    block: Block,
    /// The indenter.
    indenter: Indenter,
    /// Its elastic base, if any.
    base: Option<ElasticBase>,
}

/// Source of unit curves: solved curves are cached, tabulated ones are not solved.
#[derive(Debug, Clone)]
pub struct Curves {
    body: Body,
    law: CandidateLaw,
    /// Deepest depth of the curves [m].
    deepest: f64,
    /// How much too stiff the coarsest mesh is, once it was found, for the logarithm of a base's stiffness.
    mesh_error: Option<(f64, MeshError)>,
    /// Solved curves, for each modulus that matters [Pa].
    solved: Vec<(f64, Family)>,
    solves: usize,
    /// What counts of the bounds on the product of an elastic force and G(t) [-].
    product_share: f64,
    /// Compliance of the organ in series with the body; none for a specimen that is the body.
    far: Option<FarField>,
}

/// What is left of these bounds when full runs have taken the product's error away [-]: how far its size differs between
/// meshes, 4.27 and 3.95 % of the force at six radii.
const LEFT_BY_LOOP: f64 = 0.1;

/// Depths of a curve, in radii of the indenter [-], until they grow by the last step.
const DEPTHS: [f64; 5] = [0.1, 0.25, 0.5, 0.75, 1.0];
const STEP: f64 = 0.5;
/// Depths of a curve under a sphere or a cone.
const ROUND_DEPTHS: usize = 16;
/// The range of the logarithm of a base's stiffness, by which distances between curves are measured.
const STIFFNESS: ShapeRange = ShapeRange {
    lower: -1.0,
    start: 0.0,
    upper: 1.0,
};
/// A change of that logarithm by which elements are about as wrong.
const ALIKE_BASES: f64 = 0.2;
/// Depths of a curve of a tube.
const TUBE_DEPTHS: usize = 6;
/// Relative accuracy of a tube's force [-]: that of meshes that take seconds.
const TUBE_ACCURACY: f64 = 0.1;

impl Curves {
    /// Of `law` in `body` down to `deepest` [m].
    pub fn new(body: Body, law: CandidateLaw, deepest: f64) -> Self {
        Self {
            body,
            law,
            deepest,
            mesh_error: None,
            solved: Vec::new(),
            solves: 0,
            product_share: 1.0,
            far: None,
        }
    }

    /// The same in an organ, which gives way by so much more than the body.
    pub fn in_organ(self, far: FarField) -> Self {
        // Of the depth the body has what the rest leaves; a force that grows less than linearly leaves a tenth more.
        let part = 1.1 * (1.0 - far.share);
        let part = if far.compliance > 0.0 {
            part.min(1.0)
        } else {
            part
        };
        let own = part * self.deepest;
        Self {
            deepest: far
                .contact
                .map_or(own, |contact| contact.depth_on_plane(own)),
            far: Some(far),
            ..self
        }
    }

    /// The same for forces from which full runs have taken the error of the product.
    pub(crate) fn in_loop(self) -> Self {
        Self {
            product_share: LEFT_BY_LOOP,
            ..self
        }
    }

    /// What counts of the bounds on the product of an elastic force and G(t) [-].
    pub(super) fn product_share(&self) -> f64 {
        self.product_share
    }

    /// The indented body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The same body with another law.
    pub fn of_law(&self, law: CandidateLaw) -> Self {
        if law == self.law {
            return self.clone();
        }
        Self {
            law,
            solved: Vec::new(),
            solves: 0,
            ..self.clone()
        }
    }

    /// The law.
    pub fn law(&self) -> CandidateLaw {
        self.law
    }

    /// How many runs of finite elements it took so far.
    pub fn solve_count(&self) -> usize {
        self.solves
    }

    /// The curve of these shapes [-] at a `modulus` [Pa]. The modulus matters under pressure, of which an infinite one feels
    /// none, and on a base whose own modulus is known: under an infinite one that is as stiff as the layer.
    ///
    /// # Errors
    /// When no equilibrium is found down to the deepest depth.
    pub fn of(&mut self, modulus: f64, shape: &[f64]) -> Result<UnitCurve, Error> {
        if self.is_known(modulus, shape)
            && let Some(known) = self.predicted(modulus, shape)
        {
            return Ok(known);
        }
        let curve = match self.body {
            Body::Block { block, indenter }
            | Body::Layer {
                block, indenter, ..
            } => {
                let piece = PressedPiece {
                    block,
                    indenter,
                    base: self.base(modulus),
                };
                self.solve_block(piece, shape)?
            }
            Body::Tube {
                tube,
                radius,
                face,
                pressure,
            } => {
                let punch = TubePunch {
                    radius,
                    face,
                    pressure: pressure / modulus,
                    depths: tube_depths(self.deepest),
                };
                self.solve_tube(tube, &punch, shape)?
            }
        };
        match self.family(modulus) {
            Some(place) => self.solved[place].1.add(curve.clone()),
            None => {
                let mut ranges = self.law.shapes();
                if curve.shape.len() > ranges.len() {
                    ranges.push(STIFFNESS);
                }
                let family = Family::of(&ranges, curve.clone());
                self.solved.push((modulus, family));
            }
        }
        Ok(self.placed(curve))
    }

    /// The curve of these shapes [-] at a `modulus` [Pa], as far as it follows from what was tabulated or solved; none
    /// where nothing was.
    pub(super) fn predicted(&self, modulus: f64, shape: &[f64]) -> Option<UnitCurve> {
        let tabulated = tables::curve(&self.body, self.law, shape, self.deepest);
        let known = tabulated.or_else(|| {
            let place = self.family(modulus)?;
            Some(self.solved[place].1.at(&self.place(modulus, shape)))
        });
        known.map(|curve| self.placed(curve))
    }

    /// The shapes [-], and after them the logarithm of a base's stiffness: where a curve is in its family.
    fn place(&self, modulus: f64, shape: &[f64]) -> Vec<f64> {
        let base = self.stiffness(modulus).map(f64::ln);
        shape.iter().copied().chain(base).collect()
    }

    /// How much stiffer than the layer its base is at a `modulus` [Pa]; none without a base.
    fn stiffness(&self, modulus: f64) -> Option<f64> {
        match self.body {
            Body::Layer { base, .. } => Some(base.stiffness(self.law, modulus)),
            Body::Block { .. } | Body::Tube { .. } => None,
        }
    }

    /// The base that is solved: a fit may go beyond what it may end at.
    fn base(&self, modulus: f64) -> Option<ElasticBase> {
        let Body::Layer { base, .. } = self.body else {
            return None;
        };
        let [least, most] = Domain::BASE_RATIOS;
        let stiffness = base.stiffness(self.law, modulus);
        Some(ElasticBase {
            thickness: base.thickness,
            stiffness: stiffness.clamp(least, most),
        })
    }

    /// Refuses a layer whose base is much softer or stiffer at a `modulus` [Pa].
    pub(super) fn check_base(&self, modulus: f64) -> Result<(), Error> {
        let [least, most] = Domain::BASE_RATIOS;
        match self.stiffness(modulus) {
            Some(stiffness) if !(least..=most).contains(&stiffness) => {
                Err(Error::BaseTooDifferent { stiffness })
            }
            _ => Ok(()),
        }
    }

    fn is_known(&self, modulus: f64, shape: &[f64]) -> bool {
        let is_tabulated = || tables::curve(&self.body, self.law, shape, self.deepest).is_some();
        let place = self.place(modulus, shape);
        let is_solved = |family: usize| self.solved[family].1.nearest(&place) == place;
        self.family(modulus).is_some_and(is_solved) || is_tabulated()
    }

    /// A curve of the body in its organ: at each force the depth is larger by what the organ gives way.
    fn placed(&self, mut curve: UnitCurve) -> UnitCurve {
        if let Body::Layer { base, .. } = self.body {
            // The last shape is the base's.
            curve.shape.truncate(self.law.count() - 1);
            let by_stiffness = curve.by_shape.pop();
            curve.base = by_stiffness.map(|by_stiffness| BaseSensitivity {
                by_stiffness,
                is_absolute: matches!(base.modulus, BaseModulus::Young(_)),
                error: base.error,
            });
            return curve;
        }
        let Some(far) = self.far else {
            return curve;
        };
        let further = far.compliance / self.law.shear();
        let known: Vec<(f64, f64)> = curve.force.points().skip(1).collect();
        let curved = |depth: f64| far.contact.map_or(depth, |contact| contact.depth(depth));
        let slope = |depth: f64| {
            far.contact
                .map_or(1.0, |contact| contact.depth_slope(depth))
        };
        let each = known.iter();
        let depths: Vec<f64> = each
            .map(|(d, force)| curved(*d) + further * force)
            .collect();
        let through = |of: &dyn Fn(&(f64, f64)) -> f64| {
            IndentationCurve::through(&depths, &known.iter().map(of).collect::<Vec<_>>())
        };
        let by_shape = curve.by_shape.iter().map(|by| {
            // At one depth of the organ, that of the body falls where the force rises.
            through(&|(d, _)| {
                by.force(*d) / (1.0 + further * curve.force.stiffness(*d) / slope(*d))
            })
        });
        UnitCurve {
            force: through(&|(_, force)| *force),
            by_shape: by_shape.collect(),
            discretisation: curve.discretisation + far.error,
            shape: curve.shape,
            base: None,
        }
    }

    /// The shapes next to `shape` [-] that were tabulated or solved at a `modulus` [Pa].
    pub(super) fn nearest(&self, modulus: f64, shape: &[f64]) -> Option<Vec<f64>> {
        match tables::curve(&self.body, self.law, shape, self.deepest) {
            Some(_) => Some(shape.to_vec()),
            None => self.family(modulus).map(|family| {
                let place = self.place(modulus, shape);
                self.solved[family].1.nearest(&place)[..shape.len()].to_vec()
            }),
        }
    }

    fn family(&self, modulus: f64) -> Option<usize> {
        let matters = self.depend_on_modulus();
        let is_its = |(of, _): &(f64, Family)| *of == modulus || !matters;
        self.solved.iter().position(is_its)
    }

    /// Whether a curve is that of one modulus alone: under pressure.
    pub(super) fn depend_on_modulus(&self) -> bool {
        matches!(self.body, Body::Tube { pressure, .. } if pressure > 0.0)
    }

    fn depths(&self) -> Vec<f64> {
        if let Body::Block { indenter, .. } | Body::Layer { indenter, .. } = self.body
            && !matches!(indenter.shape, IndenterShape::Flat { .. })
        {
            // Even steps of what a sphere touches.
            let part = |i: usize| (i as f64 / ROUND_DEPTHS as f64).powi(2);
            return (1..=ROUND_DEPTHS).map(|i| self.deepest * part(i)).collect();
        }
        let last = self.deepest / self.body.radius();
        let further = (3..).map(|i| STEP * f64::from(i)).take_while(|x| *x < last);
        let inner = DEPTHS.into_iter().take_while(|x| *x < last);
        let all = inner.chain(further).chain([last]);
        all.map(|x| x * self.body.radius()).collect()
    }

    fn solve_block(&mut self, piece: PressedPiece, shape: &[f64]) -> Result<UnitCurve, Error> {
        let base = piece.base;
        let mesh_error = self.mesh_error(piece)?;
        let depths = self.depths();
        let points = self.run(piece, self.law.unit(shape)?, 0)?;
        let right = |place: usize| mesh_error.correction[place];
        let forces: Vec<f64> = points
            .iter()
            .enumerate()
            .map(|(i, point)| right(i) * point.0)
            .collect();
        let each = points.iter();
        let slopes: Vec<_> = each
            .map(|point| {
                let of_law = self.law.by_shape(shape, &point.1);
                // The last change is that with the base.
                let of_base = base.and(point.1.last().copied());
                of_law.into_iter().chain(of_base).collect::<Vec<_>>()
            })
            .collect();
        let place: Vec<f64> = shape
            .iter()
            .copied()
            .chain(base.map(|base| base.stiffness.ln()))
            .collect();
        let by_shape = (0..place.len()).map(|place| {
            let slopes = slopes.iter().enumerate();
            let slopes: Vec<f64> = slopes.map(|(i, by)| right(i) * by[place]).collect();
            IndentationCurve::through(&depths, &slopes)
        });
        Ok(UnitCurve {
            shape: place,
            force: IndentationCurve::through(&depths, &forces),
            by_shape: by_shape.collect(),
            discretisation: mesh_error.left,
            base: None,
        })
    }

    /// Forces at all depths on one mesh, each with its changes with the parameters of the law.
    fn run(
        &mut self,
        piece: PressedPiece,
        law: Arc<dyn Law>,
        halvings: i32,
    ) -> Result<Vec<(f64, Vec<f64>)>, Error> {
        self.solves += 1;
        let settings = IndentationSettings {
            block: piece.block,
            indenter: piece.indenter,
            law,
            prony: PronySeries::default(),
            deepest: self.deepest,
            halvings,
        };
        let run = match piece.base {
            Some(base) => IndentationRun::on_base(&settings, base),
            None => IndentationRun::new(&settings),
        };
        let mut run = run?.with_sensitivities();
        let (name, deepest) = (self.law.name(), self.deepest);
        let press = |depth: f64| {
            let point = run.press(depth, depth, |_| ());
            let point = point.map_err(|why| Error::of_law(name, deepest, why))?;
            Ok((point.force, point.sensitivities))
        };
        self.depths().into_iter().map(press).collect()
    }

    /// How much too stiff the coarsest mesh is: tabulated, or from neo-Hookean tissue on a mesh with every element
    /// halved, for it is about alike for every law.
    fn mesh_error(&mut self, piece: PressedPiece) -> Result<MeshError, Error> {
        let stiffness = piece.base.map_or(0.0, |base| base.stiffness.ln());
        let known = self.mesh_error.as_ref();
        if known.is_none_or(|(of, _)| (of - stiffness).abs() > ALIKE_BASES) {
            let depths = self.depths();
            let found = if self.body.is_tabulated() {
                MeshError {
                    correction: depths
                        .iter()
                        .map(|d| tables::correction(&self.body, *d))
                        .collect(),
                    left: tables::discretisation(),
                }
            } else {
                let law = CandidateLaw::NeoHookean.unit(&[])?;
                let coarse = self.run(piece, law.clone(), 0)?;
                MeshError::of_two(&coarse, &self.run(piece, law, 1)?)
            };
            self.mesh_error = Some((stiffness, found));
        }
        let known = self.mesh_error.clone().ok_or(Error::NoContactForce)?;
        Ok(known.1)
    }

    fn solve_tube(
        &mut self,
        tube: Tube,
        punch: &TubePunch,
        shape: &[f64],
    ) -> Result<UnitCurve, Error> {
        self.solves += 1;
        let problem = TubeProblem {
            tube,
            law: self.law.unit(shape)?,
            ends: Ends::Fixed,
        };
        let found = indent(&problem, punch, TUBE_ACCURACY, &mut |_| ());
        let found = found.map_err(|why| Error::of_law(self.law.name(), self.deepest, why))?;
        Ok(UnitCurve {
            shape: shape.to_vec(),
            force: IndentationCurve::through(&punch.depths, &found.answer.forces),
            by_shape: Vec::new(),
            discretisation: found.error,
            base: None,
        })
    }
}

fn tube_depths(deepest: f64) -> Vec<f64> {
    (1..=TUBE_DEPTHS)
        .map(|i| deepest * i as f64 / TUBE_DEPTHS as f64)
        .collect()
}
