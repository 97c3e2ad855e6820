use palpate_files::Recording;
use palpate_files::recording::{
    self, IndenterFriction, RecordingHeader, Samples, StimulusKind, Support,
};
use palpate_mechanics::contact::{
    Friction, FrictionLaw, RoundedProfile, half_space_stiffness, hertz_force, rounded_force,
    sneddon_force,
};
use palpate_mechanics::finite_elements::indentation::{
    Base, History, IndentationPoint, IndentationProblem, Indenter, IndenterShape, Side, solve,
    solve_history,
};

use super::super::problem::{Indentation, Loading, Problem, Ramp};
use super::super::table::Table;
use super::{
    Figures, FrictionFigures, RequestedOutputs, Solution, field, millimetres, millinewtons, plots,
    warnings,
};
use crate::Error;
use crate::VERSION;
use crate::plot::Plot;
use crate::solve::solver_progress::ProgressReporter;

/// Force at each depth, or at each time of a ramp.
pub(crate) fn solution(
    problem: &Problem,
    case: &Indentation,
    wanted: RequestedOutputs,
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let solution = match &case.loading {
        Loading::Depths(depths) => at_depths(problem, case, depths, reporter),
        Loading::Ramp(ramp) => in_time(problem, case, ramp, reporter),
    }?;
    let vtu = wanted.vtu.then(|| field::of_indentation(problem, case));
    Ok(Solution {
        vtu: vtu.transpose()?,
        ..solution
    })
}

fn at_depths(
    problem: &Problem,
    case: &Indentation,
    depths: &[f64],
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let found = solve(
        &mechanical(problem, case),
        depths,
        problem.accuracy,
        &mut |progress| reporter.at(progress),
    )
    .map_err(|error| problem.refused(error))?;
    let forces: Vec<f64> = found.answer.points.iter().map(|p| p.force).collect();
    let mut warnings = found.warnings;
    warnings.extend(warnings::of_depths(
        problem,
        contact_radius(case, depths),
        depths,
    ));
    let closed = |depth: f64| half_space_force(problem, case, depth);
    let table = Table::default()
        .with("depth [mm]", millimetres(depths))
        .with("force [mN]", millinewtons(&forces))
        .with(
            &format!("{} [mN]", half_space(case)),
            depths.iter().map(|&d| 1e3 * closed(d)),
        );
    let friction = friction(&found.answer.points);
    let table = with_friction(table, friction.as_ref());
    Ok(Solution {
        heading: heading(case),
        tables: vec![table],
        plot: over_depth(case, depths, &forces, &closed),
        figures: Figures::Indentation {
            depth_m: depths.to_vec(),
            force_n: forces,
            time_s: None,
            friction,
        },
        unknowns: found.answer.unknowns,
        estimated_error: found.error,
        observed_order: found.observed_order,
        warnings,
        vtu: None,
        recording: None,
    })
}

fn in_time(
    problem: &Problem,
    case: &Indentation,
    ramp: &Ramp,
    reporter: &ProgressReporter<'_>,
) -> Result<Solution, Error> {
    let (history, wanted) = ramp.history();
    let found = solve_history(
        &mechanical(problem, case),
        &problem.material.prony,
        ramp.method,
        &history,
        problem.accuracy,
        &mut |progress| reporter.at(progress),
    )
    .map_err(|error| problem.refused(error))?;
    let pick = |values: &[f64]| wanted.iter().map(|&k| values[k]).collect::<Vec<_>>();
    let forces: Vec<f64> = found.answer.points.iter().map(|p| p.force).collect();
    // With the end of the ramp, where the force has its peak.
    let drawn = history.times.iter().copied().zip(millinewtons(&forces));
    let drawn = plots::line("", drawn);
    let (times, depths, forces) = (pick(&history.times), pick(&history.depths), pick(&forces));
    let table = Table::default()
        .with("time [s]", times.iter().copied())
        .with("depth [mm]", millimetres(&depths))
        .with("force [mN]", millinewtons(&forces));
    let sampled: Vec<_> = wanted
        .iter()
        .map(|&k| found.answer.points[k].clone())
        .collect();
    let friction = friction(&sampled);
    let table = with_friction(table, friction.as_ref()).with_peak_shown(&forces);
    let mut warnings = found.warnings;
    warnings.extend(warnings::of_depths(
        problem,
        contact_radius(case, &depths),
        &depths,
    ));
    warnings.extend(warnings::of_ramp(problem, ramp.ramp));
    Ok(Solution {
        heading: heading(case),
        tables: vec![table],
        plot: Plot {
            title: format!(
                "{}, pressed {} mm and held",
                title(case),
                plots::short(1e3 * ramp.depth)
            ),
            x_label: "Time [s]".to_owned(),
            y_label: "Force on the tissue [mN]".to_owned(),
            series: vec![drawn],
            ..Plot::default()
        },
        recording: Some(recording(case, ramp, &times, &depths, &forces)?),
        figures: Figures::Indentation {
            depth_m: depths,
            force_n: forces,
            time_s: Some(times),
            friction,
        },
        unknowns: found.answer.unknowns,
        estimated_error: found.error,
        observed_order: found.observed_order,
        warnings,
        vtu: None,
    })
}

/// Contact of the indenter at each point, where it has Coulomb friction at all of them.
fn friction(points: &[IndentationPoint]) -> Option<FrictionFigures> {
    let contacts: Option<Vec<_>> = points.iter().map(|point| point.friction).collect();
    let contacts = contacts.filter(|contacts| !contacts.is_empty())?;
    Some(FrictionFigures {
        contact_radius_m: contacts.iter().map(|c| c.contact_radius).collect(),
        stick_radius_m: contacts.iter().map(|c| c.stick_radius).collect(),
        tangential_force_n: contacts.iter().map(|c| c.tangential_force).collect(),
    })
}

fn with_friction(table: Table, friction: Option<&FrictionFigures>) -> Table {
    match friction {
        None => table,
        Some(friction) => table
            .with(
                "contact radius [mm]",
                millimetres(&friction.contact_radius_m),
            )
            .with("stick radius [mm]", millimetres(&friction.stick_radius_m))
            .with(
                "tangential [mN]",
                millinewtons(&friction.tangential_force_n),
            ),
    }
}

impl Ramp {
    /// The depth over time, with the end of the ramp among its times, and which of the times are requested.
    fn history(&self) -> (History, Vec<usize>) {
        let last = self.ramp + self.hold;
        let parts = (self.samples - 1) as f64;
        let samples = (0..self.samples).map(|k| last * k as f64 / parts);
        let mut times: Vec<(f64, bool)> = samples.map(|time| (time, true)).collect();
        let end = times.partition_point(|(time, _)| *time < self.ramp);
        if times.get(end).is_none_or(|(time, _)| *time > self.ramp) {
            times.insert(end, (self.ramp, false));
        }
        let depth = |time: f64| self.depth * (time / self.ramp).min(1.0);
        let history = History {
            depths: times.iter().map(|(time, _)| depth(*time)).collect(),
            times: times.iter().map(|(time, _)| *time).collect(),
        };
        let wanted = (0..times.len()).filter(|&k| times[k].1).collect();
        (history, wanted)
    }
}

/// The simulated recording of the indenter.
fn recording(
    case: &Indentation,
    ramp: &Ramp,
    times: &[f64],
    depths: &[f64],
    forces: &[f64],
) -> Result<Recording, Error> {
    let shape = match case.indenter.shape {
        IndenterShape::Flat { .. } | IndenterShape::RoundedPunch { .. } => {
            recording::IndenterShape::Flat
        }
        IndenterShape::Sphere => recording::IndenterShape::Sphere,
        IndenterShape::Cone { .. } => recording::IndenterShape::Cone,
    };
    let half_angle = match case.indenter.shape {
        IndenterShape::Cone { half_angle, .. } => Some(half_angle.to_degrees()),
        _ => None,
    };
    let support = match case.block.base {
        Base::Bonded => Support::Bonded,
        Base::Lubricated => Support::Lubricated,
    };
    // No header has a key for a rounded edge or a coefficient; the source states them.
    let rounded = match edge_radius(&case.indenter) {
        Some(radius) => format!(", edge rounded to {} mm", plots::short(1e3 * radius)),
        None => String::new(),
    };
    let (friction, source) = match case.indenter.face {
        FrictionLaw::Bonded => (Some(IndenterFriction::Bonded), String::new()),
        FrictionLaw::Frictionless => (Some(IndenterFriction::Frictionless), String::new()),
        FrictionLaw::Coulomb(coefficient) => {
            (None, format!(", coefficient of friction {coefficient}"))
        }
    };
    let header = RecordingHeader {
        stimulus: Some(StimulusKind::RampAndHold),
        ramp_s: Some(ramp.ramp),
        amplitude_m: Some(ramp.depth),
        sample_rate_hz: Some((ramp.samples - 1) as f64 / (ramp.ramp + ramp.hold)),
        indenter_shape: Some(shape),
        indenter_radius_m: Some(case.indenter.radius),
        indenter_half_angle_deg: half_angle,
        indenter_friction: friction,
        thickness_m: Some(case.block.height),
        specimen_radius_m: Some(case.block.radius),
        support: Some(support),
        source: Some(format!(
            "palpate solve {VERSION}, finite elements{rounded}{source}"
        )),
        ..RecordingHeader::default()
    };
    let samples = Samples {
        time_s: times.to_vec(),
        depth_m: depths.to_vec(),
        force_n: forces.to_vec(),
    };
    Ok(Recording::new(header, samples)?)
}

pub(super) fn mechanical(problem: &Problem, case: &Indentation) -> IndentationProblem {
    IndentationProblem {
        block: case.block,
        indenter: case.indenter,
        law: problem.material.law.clone(),
    }
}

/// Force on the same indenter on a half-space at small strain [N]; with Coulomb friction, or where it is rounded and
/// sticks, for which there is no closed form, the force without friction.
fn half_space_force(problem: &Problem, case: &Indentation, depth: f64) -> f64 {
    let (law, radius) = (&problem.material.at_rest, case.indenter.radius);
    let friction = match case.indenter.face {
        FrictionLaw::Bonded => Friction::Bonded,
        FrictionLaw::Frictionless | FrictionLaw::Coulomb(_) => Friction::Frictionless,
    };
    if let Some(profile) = case.indenter.rounded_profile() {
        return rounded_force(law, &profile, depth);
    }
    match case.indenter.shape {
        IndenterShape::Sphere => hertz_force(law, radius, depth),
        IndenterShape::Flat { .. } | IndenterShape::RoundedPunch { .. } => {
            depth * half_space_stiffness(law, radius, friction)
        }
        IndenterShape::Cone { half_angle, .. } => sneddon_force(law, half_angle, depth),
    }
}

/// The name of that force.
fn half_space(case: &Indentation) -> &'static str {
    match case.indenter.face {
        FrictionLaw::Coulomb(_) => "half-space without friction",
        FrictionLaw::Bonded if case.indenter.rounded_profile().is_some() => {
            "half-space without friction"
        }
        FrictionLaw::Bonded | FrictionLaw::Frictionless => "half-space",
    }
}

/// Radius of the contact area at the largest depth [m].
fn contact_radius(case: &Indentation, depths: &[f64]) -> f64 {
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    case.indenter.contact_radius(deepest)
}

/// The radius of an edge or an apex that is rounded [m].
fn edge_radius(indenter: &Indenter) -> Option<f64> {
    match indenter.rounded_profile()? {
        RoundedProfile::Punch { edge_radius, .. } => Some(edge_radius),
        RoundedProfile::Cone { apex_radius, .. } => Some(apex_radius),
    }
}

fn title(case: &Indentation) -> String {
    let shape = match case.indenter.shape {
        IndenterShape::Sphere => "Sphere",
        IndenterShape::Cone { .. } => "Cone",
        IndenterShape::Flat { .. } | IndenterShape::RoundedPunch { .. } => "Flat punch",
    };
    format!(
        "{shape} of radius {} mm",
        plots::short(1e3 * case.indenter.radius)
    )
}

fn heading(case: &Indentation) -> String {
    let surface = |friction, slides: &str| match friction {
        FrictionLaw::Bonded => "sticks".to_owned(),
        FrictionLaw::Frictionless => slides.to_owned(),
        FrictionLaw::Coulomb(coefficient) => format!("has friction {coefficient}"),
    };
    let face = surface(case.indenter.face, "slips");
    let rounded = match edge_radius(&case.indenter) {
        Some(radius) => format!("rounded to {} mm ", plots::short(1e3 * radius)),
        None => String::new(),
    };
    let how = match case.indenter.shape {
        IndenterShape::Sphere => format!("that {face}"),
        IndenterShape::RoundedPunch { .. } => format!("with its edge {rounded}that {face}"),
        IndenterShape::Cone { half_angle, .. } => {
            format!("of {:.1}° {rounded}that {face}", half_angle.to_degrees())
        }
        IndenterShape::Flat { side } => {
            let side = match side {
                Side::Touches(friction) => surface(friction, "slides"),
                Side::Absent => "is not there".to_owned(),
            };
            format!("(its face {face}, its side {side})")
        }
    };
    let base = match case.block.base {
        Base::Bonded => "",
        Base::Lubricated => ", lubricated below",
    };
    format!(
        "{} {how} on a block of radius {} mm and height {} mm{base}",
        title(case),
        plots::short(1e3 * case.block.radius),
        plots::short(1e3 * case.block.height)
    )
}

fn over_depth(
    case: &Indentation,
    depths: &[f64],
    forces: &[f64],
    closed: &dyn Fn(f64) -> f64,
) -> Plot {
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    let along = (0..=60).map(|k| deepest * f64::from(k) / 60.0);
    // The force is zero at depth zero, so the curve begins there.
    let points = millimetres(depths).zip(millinewtons(forces));
    Plot {
        title: format!("{}: force against depth", title(case)),
        x_label: "Depth [mm]".to_owned(),
        y_label: "Force on the tissue [mN]".to_owned(),
        series: vec![
            plots::dotted_line("finite elements", points),
            plots::closed_form(
                &format!("{} at small strain, closed form", half_space(case)),
                along.map(|depth| (1e3 * depth, 1e3 * closed(depth))),
            ),
        ],
        ..Plot::default()
    }
}
