use super::{recorded, words};
use crate::plot::{Band, Plot, Series, Style};
use crate::report::{Markup, Scale, figure, unit};
use palpate_characterize::lumped::PieceTest;
use palpate_jobs::characterize::Specimen;
use palpate_jobs::characterize::{DrawnCurve, DrawnFit, FitPlots};

/// Recordings that are drawn in one plot, at most.
const RECORDINGS: usize = 6;

/// Recordings, models over time and depth, and residuals of the models.
pub(super) fn figures(own: &Specimen, portrait: &FitPlots) -> Markup {
    let recordings = portrait.recordings.iter();
    let recorded: Markup = recordings
        .clone()
        .take(RECORDINGS)
        .map(recorded::figure_of)
        .collect();
    let fitted: Vec<&DrawnFit> = recordings.filter_map(|own| own.fitted.as_ref()).collect();
    let preferred = own.preferred.as_deref().unwrap_or_default();
    let shown = Shown::new(&fitted, preferred);
    let models = match fitted.iter().any(|fit| !fit.laws.is_empty()) {
        true => shown.figures(),
        false => Markup::default(),
    };
    recorded.and(models)
}

/// The curves of laws, compared with the measured ones.
struct Shown<'a> {
    fitted: &'a [&'a DrawnFit],
    preferred: &'a str,
    is_piece: bool,
    /// Of force or stress.
    scale: Scale,
    quantity: &'static str,
}

impl<'a> Shown<'a> {
    fn new(fitted: &'a [&'a DrawnFit], preferred: &'a str) -> Self {
        let is_piece = fitted.iter().any(|fit| fit.is_piece);
        let all = fitted.iter().flat_map(|fit| &fit.measured);
        let most = all.fold(0.0_f64, |most, value| most.max(value.abs()));
        Self {
            fitted,
            preferred,
            is_piece,
            scale: unit(if is_piece { "_pa" } else { "_n" }, most),
            quantity: if is_piece { "nominal stress" } else { "force" },
        }
    }

    fn figures(&self) -> Markup {
        let law = words::law(self.preferred);
        let drawn = match self.fitted.len() {
            count if count > RECORDINGS => {
                format!(" Of {count} recordings the first {RECORDINGS} are drawn.")
            }
            _ => String::new(),
        };
        let band = format!(
            "The band holds the true curve of the {law} law with a probability of 95 %: what noise leaves open of its parameters, and what the \
             model may be off. It is cut where it leaves the others far behind.{drawn}"
        );
        let [along, over_time] = match self.is_piece {
            true => ["Stress over stretch", "Stress over time"],
            false => ["Force over depth", "Force over time"],
        };
        let (factor, label) = self.course();
        let course = |fit: &DrawnFit| fit.course.iter().map(|value| factor * value).collect();
        let course = self.plot(along, label, course);
        let time = self.plot(over_time, TIME.to_owned(), |fit| fit.time.clone());
        let both = match self.is_piece {
            true => figure(&course, &*band).and(figure(&time, "The same over time.")),
            false => figure(&time, &*band).and(figure(&course, "The same over depth.")),
        };
        both.and(self.residuals())
    }

    /// Factor on depths or stretches to draw them, and the name of their axis.
    fn course(&self) -> (f64, String) {
        if self.is_piece {
            let is_shear = |fit: &&&DrawnFit| fit.test == Some(PieceTest::SimpleShear);
            let name = match self.fitted.iter().filter(is_shear).count() {
                0 => "stretch [-]",
                all if all == self.fitted.len() => "amount of shear [-]",
                _ => "stretch or amount of shear [-]",
            };
            return (1.0, name.to_owned());
        }
        let depths = self.fitted.iter().flat_map(|fit| &fit.course);
        let Scale { factor, unit } = unit("_m", depths.fold(0.0, |most: f64, d| most.max(*d)));
        (factor, format!("depth [{unit}]"))
    }

    fn plot(&self, title: &str, x_label: String, along: impl Fn(&DrawnFit) -> Vec<f64>) -> Plot {
        let laws = self.laws();
        let (mut series, mut bands) = (Vec::new(), Vec::new());
        for (place, fit) in self.fitted.iter().take(RECORDINGS).enumerate() {
            let x = along(fit);
            let name = match fit.fibre_axis_angle_deg {
                Some(angle) => of_piece(fit.test, angle),
                None => Self::named("measured", place),
            };
            let points = scaled(&x, &fit.measured, self.scale.factor);
            // Colors distinguish the angles of several pieces.
            series.push(match fit.fibre_axis_angle_deg {
                Some(_) => Series {
                    color: place,
                    ..measured(name, points)
                },
                None => measured(name, points),
            });
            for (color, law) in laws.iter().enumerate() {
                let Some(curve) = fit.laws.iter().find(|curve| curve.law == **law) else {
                    continue;
                };
                let name = Self::named(words::law(law), place);
                let points = scaled(&x, &curve.values, self.scale.factor);
                if curve.law == self.preferred {
                    bands.push(Band {
                        points: x.iter().copied().zip(self.edges(curve)).collect(),
                        color,
                    });
                    series.push(line(name, points, Style::Line, color));
                } else {
                    series.push(line(name, points, Style::DashedLine, color));
                }
            }
        }
        Plot {
            title: title.to_owned(),
            x_label,
            y_label: format!("{} [{}]", self.quantity, self.scale.unit),
            series,
            bands,
            ..Plot::default()
        }
    }

    /// The band of a curve, clipped where it far exceeds the other curves.
    fn edges(&self, curve: &DrawnCurve) -> impl Iterator<Item = [f64; 2]> {
        let measured = self.fitted.iter().flat_map(|fit| &fit.measured);
        let ends = measured.fold([0.0_f64; 2], |[low, high], value| {
            [low.min(*value), high.max(*value)]
        });
        let (most, factor) = (ends[1] - ends[0], self.scale.factor);
        let [low, high] = [ends[0] - 0.5 * most, ends[1] + 0.5 * most];
        let each = curve.values.iter().zip(&curve.reach);
        each.map(move |(value, reach)| {
            [value - reach, value + reach].map(|edge| factor * edge.clamp(low, high))
        })
    }

    /// The drawn laws, the preferred one first.
    fn laws(&self) -> Vec<&String> {
        let mut laws: Vec<&String> = Vec::new();
        for curve in self.fitted.iter().flat_map(|fit| &fit.laws) {
            if !laws.contains(&&curve.law) {
                laws.push(&curve.law);
            }
        }
        laws.sort_by_key(|law| **law != self.preferred);
        laws
    }

    /// A name for the first recording alone: one entry of a legend stands for all.
    fn named(name: &str, place: usize) -> String {
        match place {
            0 => name.to_owned(),
            _ => String::new(),
        }
    }

    /// Residuals of the preferred law.
    fn residuals(&self) -> Markup {
        let several = self.fitted.len() > 1;
        let left = self
            .fitted
            .iter()
            .take(RECORDINGS)
            .enumerate()
            .filter_map(|(place, fit)| {
                let curve = fit.laws.iter().find(|curve| curve.law == self.preferred)?;
                let left = fit.measured.iter().zip(&curve.values);
                let left: Vec<f64> = left.map(|(measured, model)| measured - model).collect();
                let name = match several {
                    true => format!("recording {}", place + 1),
                    false => "measured less model".to_owned(),
                };
                Some((name, place, &fit.time, left))
            });
        let left: Vec<_> = left.collect();
        let all = left.iter().flat_map(|(_, _, _, left)| left);
        let most = all.fold(0.0_f64, |most, value| most.max(value.abs()));
        let scale = unit(if self.is_piece { "_pa" } else { "_n" }, most);
        let series = left.into_iter().map(|(name, color, time, left)| {
            line(
                name,
                scaled(time, &left, scale.factor),
                Style::FineLine,
                color,
            )
        });
        let plot = Plot {
            title: format!("What the {} law leaves", words::law(self.preferred)),
            x_label: TIME.to_owned(),
            y_label: format!("measured less model [{}]", scale.unit),
            series: series.collect(),
            ..Plot::default()
        };
        figure(
            &plot,
            "What neighbouring samples share counts: noise is taken as an autoregressive process over the means of blocks of samples, found from \
             these residuals, and as independent between recordings.",
        )
    }
}

/// Measured curves of a piece, by the deformation at an angle [degrees] to its fibres.
fn of_piece(test: Option<PieceTest>, angle: f64) -> String {
    let test = match test.unwrap_or_default() {
        PieceTest::Uniaxial => "measured",
        PieceTest::PlanarTension => "planar tension",
        PieceTest::SimpleShear => "simple shear",
    };
    format!("{test}, fibres at {angle}°")
}

/// The name of the axis of time.
pub(super) const TIME: &str = "time from first contact [s]";

pub(super) fn line(name: String, points: Vec<(f64, f64)>, style: Style, color: usize) -> Series {
    Series {
        name,
        points,
        style,
        color,
    }
}

/// Few samples are dots; many a broad line, under the models.
pub(super) fn measured(name: String, points: Vec<(f64, f64)>) -> Series {
    const FEW: usize = 80;
    let style = if points.len() <= FEW {
        Style::Dots
    } else {
        Style::BroadLine
    };
    line(name, points, style, MEASURED)
}

/// The color of measured data.
pub(super) const MEASURED: usize = 5;

/// Points of two columns, the second times `factor`.
pub(super) fn scaled(x: &[f64], y: &[f64], factor: f64) -> Vec<(f64, f64)> {
    x.iter().zip(y).map(|(x, y)| (*x, factor * y)).collect()
}
