//! Virtual tissue.
//!
//! A half-space of a law, or a measured static response, exerts a force on the indenter's tip,
//! which then relaxes by a Prony series. The surface is a plane or a ball ([`Shape`]), which moves with a heart that beats
//! and a breath that is drawn or held. Tangential forces and the torque on a tilted tip: `touch`.
//!
//! *How we know*: `specimen::…`, and the chain: `characterize` finds the given tissue in its recordings.
//!
//! *Limits*: a tip that is dragged along the surface never slips.

mod touch;

use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use palpate_files::Tissue;
use palpate_files::recording::{IndenterShape, RecordingHeader};
use palpate_files::tissue::LawName;
use palpate_mechanics::contact::{Friction, FrictionLaw, Tip};
use palpate_mechanics::finite_elements::indentation::{
    self, Base, Block, IndentationProblem, Indenter, Side,
};
use palpate_mechanics::{
    ForceHistory, IndentationCurve, Material, PronySeries, TipLaw, Vec3, contact,
};

pub use touch::Shape;

use crate::Error;
use crate::noise::Noise;

/// A periodic motion of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodicMotion {
    /// Frequency [Hz].
    pub frequency: f64,
    /// From rest to its end [m].
    pub amplitude: f64,
}

/// Instantaneous response of tissue.
#[derive(Debug, Clone)]
enum Elastic {
    /// A law under the tip.
    Law { law: Box<TipLaw>, stiffness: f64 },
    /// A static response.
    Response(IndentationCurve),
}

/// A specimen under the indenter.
#[derive(Debug, Clone)]
pub struct VirtualSpecimen {
    /// Header of its recordings on specimen and indenter.
    pub header: RecordingHeader,
    /// How much stiffer than its tissue this one is [-].
    pub factor: f64,
    /// A heart that moves its surface.
    pub heart: Option<PeriodicMotion>,
    /// A breath that does.
    pub breath: Option<PeriodicMotion>,
    /// Height of its surface at rest [m].
    pub surface: f64,
    /// The shape of its surface.
    pub shape: Shape,
    /// The direction from the tip to the device, of length one [-].
    pub(crate) indenter_axis: Vec3,
    /// Radius of the punch [m].
    radius: f64,
    /// Tangential over normal stiffness of the bonded punch [-].
    tangential: f64,
    /// Where the tip met the surface, from the surface's point under the rig's zero [m].
    first_contact: Option<Vec3>,
    elastic: Elastic,
    series: PronySeries,
    history: ForceHistory,
    breath_held: Arc<AtomicBool>,
    breath_level: f64,
    phases: [f64; 2],
}

/// How far up a breath moves tissue that is alive [m].
pub const BREATH_MOTION: f64 = 8e-3;
/// Tangential over normal stiffness of a bonded punch on incompressible tissue [-]: 16/3 over 8.
const INCOMPRESSIBLE: f64 = 2.0 / 3.0;
/// Time in which a breath comes to rest [s].
const BREATH_RESTS: f64 = 0.3;

impl VirtualSpecimen {
    /// A wide and deep piece of `tissue` under a flat punch of `radius` [m] that it sticks to, on its face and on
    /// its side, down to `deepest` [m]. A nonlinear law is solved by finite elements, which takes seconds;
    /// `at_step` receives the part that is done [-].
    ///
    /// # Errors
    /// When the tissue makes no material, or no equilibrium is found down to there.
    pub fn of_tissue(
        tissue: &Tissue,
        radius: f64,
        deepest: f64,
        at_step: &mut dyn FnMut(f64),
    ) -> Result<Self, Error> {
        let material = Material::isotropic(tissue, "a virtual specimen")?;
        if tissue.elasticity.law() != LawName::Linear {
            let curve = solved(&material, radius, deepest, at_step)?;
            return Self::of_solved(tissue, radius, curve);
        }
        let (tip, bond) = (Tip::Flat { radius }, Friction::Bonded);
        let elastic = Elastic::Law {
            law: Box::new(TipLaw::linear(tip, bond, material.at_rest)),
            stiffness: contact::half_space_stiffness(&material.at_rest, radius, bond),
        };
        Ok(Self::named(tissue, elastic, &material, radius))
    }

    /// The same of a tissue whose `curve` under this punch was [solved](Self::solved) before.
    ///
    /// # Errors
    /// When the tissue makes no material.
    pub fn of_solved(tissue: &Tissue, radius: f64, curve: IndentationCurve) -> Result<Self, Error> {
        let material = Material::from_tissue(tissue)?;
        let elastic = Elastic::Response(curve);
        Ok(Self::named(tissue, elastic, &material, radius))
    }

    /// Its force over depth at once, where that had to be solved.
    pub fn solved(&self) -> Option<&IndentationCurve> {
        match &self.elastic {
            Elastic::Law { .. } => None,
            Elastic::Response(curve) => Some(curve),
        }
    }

    fn named(tissue: &Tissue, elastic: Elastic, material: &Material, radius: f64) -> Self {
        let mut specimen = Self::new(elastic, material.prony.clone(), radius);
        let law = &material.at_rest;
        specimen.tangential = contact::half_space_tangential_stiffness(law, radius)
            / contact::half_space_stiffness(law, radius, Friction::Bonded);
        specimen.header.organ.clone_from(&tissue.name);
        specimen
    }

    /// One whose force [N] over depth [m] is `response` when it has been held for `after` [s], under a flat
    /// punch of `radius` [m].
    pub fn of_response(
        response: &IndentationCurve,
        series: PronySeries,
        after: f64,
        radius: f64,
    ) -> Self {
        let at_once = response.scaled(1.0, 1.0 / series.relaxation(after));
        Self::new(Elastic::Response(at_once), series, radius)
    }

    fn new(elastic: Elastic, series: PronySeries, radius: f64) -> Self {
        Self {
            header: RecordingHeader {
                indenter_shape: Some(IndenterShape::Flat),
                indenter_radius_m: Some(radius),
                ..RecordingHeader::default()
            },
            factor: 1.0,
            heart: None,
            breath: None,
            surface: -0.005,
            shape: Shape::level(),
            indenter_axis: Vec3::z(),
            radius,
            tangential: INCOMPRESSIBLE,
            first_contact: None,
            elastic,
            series,
            history: ForceHistory::default(),
            breath_held: Arc::default(),
            breath_level: 0.0,
            phases: [0.0; 2],
        }
    }

    /// The same with a surface of another shape.
    #[must_use]
    pub fn with_shape(self, shape: Shape) -> Self {
        Self { shape, ..self }
    }

    /// The same with a heart of 1.5 Hz that moves it by 0.4 mm and a breath of 0.25 Hz by 8 mm, each beginning
    /// somewhere.
    pub fn alive(mut self, seed: u64) -> Self {
        let mut random = Noise::new(seed);
        self.phases = [random.uniform(), random.uniform()];
        self.heart = Some(PeriodicMotion {
            frequency: 1.5,
            amplitude: 0.4e-3,
        });
        self.breath = Some(PeriodicMotion {
            frequency: 0.25,
            amplitude: BREATH_MOTION,
        });
        self
    }

    /// Holds its breath while it is true.
    pub fn breath_held(&self) -> Arc<AtomicBool> {
        self.breath_held.clone()
    }

    /// Height of the surface under the rig's zero [m].
    fn height(&mut self, time: f64, step: f64) -> f64 {
        let turns = |rhythm: PeriodicMotion, phase: f64| rhythm.frequency * time + phase;
        let heart = self.heart.map_or(0.0, |heart| {
            heart.amplitude * (TAU * turns(heart, self.phases[0])).sin()
        });
        let drawn = self.breath.map_or(0.0, |breath| {
            0.5 * breath.amplitude * (1.0 - (TAU * turns(breath, self.phases[1])).cos())
        });
        let held = self.breath_held.load(Ordering::Relaxed);
        let aim = if held { 0.0 } else { drawn };
        let follow = 1.0 - (-step / BREATH_RESTS).exp();
        self.breath_level += (aim - self.breath_level) * follow;
        self.surface + heart + self.breath_level
    }
}

/// Depths of a solved response, in parts of the deepest [-].
const DEPTHS: [f64; 10] = [0.02, 0.06, 0.12, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1.0];
/// Relative accuracy of its forces [-].
const ACCURACY: f64 = 0.02;
/// Radius and height of the piece, in radii of the punch [-]: the source's cube of 100 mm under 1 mm.
const PIECE: [f64; 2] = [56.42, 100.0];

/// Force over depth by finite elements, on meshes that are refined until they are accurate.
fn solved(
    material: &Material,
    radius: f64,
    deepest: f64,
    at_step: &mut dyn FnMut(f64),
) -> Result<IndentationCurve, Error> {
    let problem = IndentationProblem {
        block: Block {
            radius: PIECE[0] * radius,
            height: PIECE[1] * radius,
            base: Base::Bonded,
        },
        indenter: Indenter {
            shape: indentation::IndenterShape::Flat {
                side: Side::Touches(FrictionLaw::Bonded),
            },
            radius,
            face: FrictionLaw::Bonded,
        },
        law: material.law.clone(),
    };
    let depths = DEPTHS.map(|part| part * deepest);
    let found = indentation::solve(&problem, &depths, ACCURACY, &mut |progress| {
        at_step(progress.part);
    })?;
    let forces: Vec<f64> = found
        .answer
        .points
        .iter()
        .map(|point| point.force)
        .collect();
    Ok(IndentationCurve::through(&depths, &forces))
}
