//! A map of moduli: one square for each indented location on a surface.

use palpate_files::quantity::rounded;
use palpate_jobs::characterize::Specimen;

use crate::report::{Markup, Scale, unit};

/// Fewest places of a map.
const FEWEST: usize = 3;
/// Sides of the picture and of its margins, in its own units.
const WIDTH: f64 = 560.0;
const SIDE: f64 = 360.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 16.0;
const BAR: f64 = 18.0;
/// Steps of the color bar.
const STEPS: usize = 64;
/// From small to large: the map viridis of Smith and van der Walt, at even steps.
const COLORS: [[f64; 3]; 6] = [
    [68.0, 1.0, 84.0],
    [65.0, 68.0, 135.0],
    [42.0, 120.0, 142.0],
    [34.0, 168.0, 132.0],
    [122.0, 209.0, 81.0],
    [253.0, 231.0, 37.0],
];

/// A location, and Young's modulus [Pa] there where it was found.
struct Place {
    x: f64,
    y: f64,
    modulus: Option<f64>,
    title: String,
}

/// The map of specimens whose positions are stated; nothing for fewer than three locations or for a single one.
pub(super) fn figure(specimens: &[Specimen]) -> Markup {
    let places = specimens.iter().filter_map(|own| {
        let [x, y, _] = own.position_m?;
        let modulus = own.lumped.linear_elastic.as_ref();
        Some(Place {
            x,
            y,
            modulus: modulus.and_then(|found| Some(found.get("youngs_modulus_pa")?.value)),
            title: own.title.clone(),
        })
    });
    let places: Vec<Place> = places.collect();
    match Map::of(&places) {
        Some(map) => map.figure(&places),
        None => Markup::default(),
    }
}

/// How places and moduli become lengths and colors of the picture.
struct Map {
    /// Where the picture begins [m].
    corner: [f64; 2],
    /// Lengths of the picture for a metre.
    scale: f64,
    /// The side of a square [m].
    side: f64,
    /// The least and the largest modulus [Pa].
    moduli: [f64; 2],
}

impl Map {
    fn of(places: &[Place]) -> Option<Self> {
        let moduli = extent(places.iter().filter_map(|own| own.modulus))?;
        let [xs, ys] = [
            extent(places.iter().map(|own| own.x))?,
            extent(places.iter().map(|own| own.y))?,
        ];
        let wide = (xs[1] - xs[0]).max(ys[1] - ys[0]);
        if places.len() < FEWEST || wide <= 0.0 {
            return None;
        }
        // The nearest neighbors along an axis; places of a grid differ a little from row to row.
        let mut steps: Vec<f64> = Vec::new();
        for axis in [|own: &Place| own.x, |own: &Place| own.y] {
            let mut along: Vec<f64> = places.iter().map(axis).collect();
            along.sort_by(f64::total_cmp);
            let ways = along.windows(2).map(|pair| pair[1] - pair[0]);
            steps.extend(ways.filter(|way| *way > SAME * wide));
        }
        let side = steps.into_iter().fold(wide, f64::min);
        Some(Self {
            corner: [xs[0] - 0.5 * side, ys[1] + 0.5 * side],
            scale: SIDE / (wide + side),
            side,
            moduli,
        })
    }

    fn figure(&self, places: &[Place]) -> Markup {
        let squares: Markup = places.iter().map(|own| self.square(own)).collect();
        let bottom = TOP + SIDE;
        let inside = squares.and(self.axes(places, bottom)).and(self.bar());
        let view = format!("0 0 {WIDTH} {}", bottom + 46.0);
        let attributes = [
            ("xmlns", "http://www.w3.org/2000/svg"),
            ("viewBox", view.as_str()),
            ("role", "img"),
            ("font-size", "12"),
        ];
        let drawn = Markup::element("svg", &attributes, inside);
        let missing = places.iter().filter(|own| own.modulus.is_none()).count();
        let missing = match missing {
            0 => String::new(),
            count => format!("; {count} without a modulus are crossed out"),
        };
        let caption = format!(
            "Young's modulus by linear elastic contact (ν = ½) of the approach, at {} places{missing}.",
            places.len()
        );
        let title = Markup::plain("h4", "Map of Young's modulus");
        let caption = Markup::plain("figcaption", caption);
        Markup::plain("figure", title.and(drawn).and(caption))
    }

    /// A square, with a tooltip.
    fn square(&self, place: &Place) -> Markup {
        let side = self.scale * self.side;
        let [x, y] = [
            LEFT + self.scale * (place.x - self.corner[0]) - 0.5 * side,
            TOP + self.scale * (self.corner[1] - place.y) - 0.5 * side,
        ];
        let value = match place.modulus {
            Some(modulus) => palpate_files::quantity::plain_quantity("_pa", modulus, None),
            None => "no modulus".to_owned(),
        };
        let title = Markup::plain("title", format!("{}: {value}", place.title));
        let [x, y, side] = [x, y, side].map(length);
        let fill = match place.modulus {
            Some(modulus) => color(self.share(modulus)),
            None => "none".to_owned(),
        };
        let square = rectangle([&x, &y, &side, &side], &fill, title);
        if place.modulus.is_some() {
            return square;
        }
        let path = format!("M{x} {y}l{side} {side}m-{side} 0l{side} -{side}");
        let cross = [
            ("d", path.as_str()),
            ("stroke", "var(--muted)"),
            ("fill", "none"),
        ];
        square.and(Markup::element("path", &cross, Markup::default()))
    }

    /// Where a modulus is between the least and the largest [-].
    fn share(&self, modulus: f64) -> f64 {
        let [least, most] = self.moduli;
        match most > least {
            true => (modulus - least) / (most - least),
            false => 0.5,
        }
    }

    /// Positions of the outermost places, and the names of the axes.
    fn axes(&self, places: &[Place], bottom: f64) -> Markup {
        let size = places
            .iter()
            .fold(0.0_f64, |most, own| most.max(own.x.abs()).max(own.y.abs()));
        let Scale { factor, unit } = unit("_m", size);
        let shown = |value: f64| rounded(factor * value, 4);
        let ends = |values: Option<[f64; 2]>| values.unwrap_or_default();
        let [left, right] = ends(extent(places.iter().map(|own| own.x)));
        let [low, high] = ends(extent(places.iter().map(|own| own.y)));
        let across = |x: f64| LEFT + self.scale * (x - self.corner[0]);
        let down = |y: f64| TOP + self.scale * (self.corner[1] - y) + 4.0;
        let mut all = text([across(left), bottom + 16.0], "middle", &shown(left));
        if right > left {
            all = all.and(text(
                [across(right), bottom + 16.0],
                "middle",
                &shown(right),
            ));
        }
        all = all.and(text([LEFT - 6.0, down(low)], "end", &shown(low)));
        if high > low {
            all = all.and(text([LEFT - 6.0, down(high)], "end", &shown(high)));
        }
        let middle = LEFT + 0.5 * SIDE;
        all.and(text(
            [middle, bottom + 36.0],
            "middle",
            &format!("x [{unit}]"),
        ))
        .and(text(
            [LEFT - 6.0, TOP + 0.5 * SIDE],
            "end",
            &format!("y [{unit}]"),
        ))
    }

    fn bar(&self) -> Markup {
        let left = LEFT + SIDE + 24.0;
        let step = SIDE / STEPS as f64;
        let steps = (0..STEPS).map(|place| {
            let share = (place as f64 + 0.5) / STEPS as f64;
            let y = TOP + SIDE - step * (place + 1) as f64;
            let [x, y, width, height] = [left, y, BAR, step + 0.5].map(length);
            rectangle([&x, &y, &width, &height], &color(share), Markup::default())
        });
        let [least, most] = self.moduli;
        let Scale { factor, unit } = unit("_pa", most);
        let label = |share: f64| {
            let value = rounded(factor * (least + share * (most - least)), 3);
            let y = TOP + SIDE * (1.0 - share) + 4.0;
            text([left + BAR + 6.0, y], "start", &value)
        };
        let labels: Markup = match most > least {
            true => [0.0, 0.5, 1.0].map(label).into_iter().collect(),
            false => label(0.5),
        };
        let name = text([left, TOP + SIDE + 20.0], "start", &format!("E [{unit}]"));
        steps.collect::<Markup>().and(labels).and(name)
    }
}

/// Distances between locations that count as zero, over the width of the map [-].
const SAME: f64 = 1e-3;

fn extent(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |own, value| {
        let [low, high] = own.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

fn length(value: f64) -> String {
    format!("{value:.2}")
}

fn rectangle([x, y, width, height]: [&str; 4], fill: &str, inside: Markup) -> Markup {
    let attributes = [
        ("x", x),
        ("y", y),
        ("width", width),
        ("height", height),
        ("fill", fill),
        (
            "stroke",
            if fill == "none" {
                "var(--muted)"
            } else {
                "none"
            },
        ),
    ];
    Markup::element("rect", &attributes, inside)
}

fn text([x, y]: [f64; 2], anchor: &str, words: &str) -> Markup {
    let [x, y] = [x, y].map(length);
    let attributes = [
        ("x", x.as_str()),
        ("y", y.as_str()),
        ("text-anchor", anchor),
        ("fill", "var(--ink)"),
    ];
    Markup::element("text", &attributes, words)
}

/// The color of a share from 0 to 1.
fn color(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (COLORS.len() - 1) as f64;
    let below = (at as usize).min(COLORS.len() - 2);
    let part = at - below as f64;
    let mixed =
        |band: usize| COLORS[below][band] + part * (COLORS[below + 1][band] - COLORS[below][band]);
    format!(
        "#{:02x}{:02x}{:02x}",
        mixed(0) as u8,
        mixed(1) as u8,
        mixed(2) as u8
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(x: f64, y: f64, modulus: Option<f64>) -> Place {
        let title = "a < b".to_owned();
        Place {
            x,
            y,
            modulus,
            title,
        }
    }

    /// Judge: a grid of 10 µm whose squares are counted and colored by hand.
    #[test]
    fn a_map_shows_each_place_and_those_without_a_modulus() {
        let places = [
            place(0.0, 0.0, Some(100.0)),
            place(1e-5, 0.0, Some(3000.0)),
            place(0.0, 1e-5, None),
        ];
        let map = Map::of(&places).unwrap();
        assert!((map.side - 1e-5).abs() < 1e-12, "{}", map.side);
        let drawn = map.figure(&places).to_string();
        assert!(
            drawn.contains("fill=\"#440154\"") && drawn.contains("fill=\"#fde725\""),
            "{drawn}"
        );
        assert!(
            drawn.contains("x [µm]") && drawn.contains("E [kPa]"),
            "{drawn}"
        );
        assert!(
            drawn.contains("1 without a modulus are crossed out") && drawn.contains("a &lt; b")
        );
        // Upwards in the picture is a larger y.
        assert!(drawn.contains("M70.00 16.00"), "{drawn}");
        assert!(Map::of(&places[..2]).is_none());
        let one = [1.0; 4].map(|modulus| place(1.0, 1.0, Some(modulus)));
        assert!(Map::of(&one).is_none());
    }
}
