use super::words;
use crate::report::{Markup, Table, count, quantity, symbol};
use palpate_jobs::characterize::{Named, Specimen};

/// Models without geometry.
pub(super) fn tables(own: &Specimen) -> Markup {
    let found = [
        ("linear_elastic", &own.lumped.linear_elastic),
        ("adhesion", &own.lumped.adhesion),
        ("kelvin", &own.lumped.kelvin),
        ("column", &own.lumped.column),
        ("nonlinear_springs", &own.lumped.nonlinear_springs),
    ];
    let mut table = Table::new(["law", "parameters"]).of_class("text");
    if let Some(modulus) = &own.lumped.mean_elastic_modulus {
        let depth = quantity("_m", modulus.depth_m, None);
        let value = quantity("_pa", modulus.value, modulus.standard_deviation);
        let holds = count(modulus.holds, "hold");
        let spread = match modulus.standard_deviation {
            Some(_) => ", ± their standard deviation",
            None => "",
        };
        let value = format!(
            "{value}: relaxed, a secant of the half-space at {depth}, from {holds}{spread}"
        );
        table.row(vec![
            words::quantity("mean_elastic_modulus").into(),
            value.into(),
        ]);
    }
    for (key, named) in found {
        if let Some(named) = named {
            table.row(vec![words::quantity(key).into(), parameters(named)]);
        }
    }
    if table.is_empty() {
        return Markup::default();
    }
    let note = "These belong to this indenter on this specimen. The springs are in newtons, millimetres and seconds.";
    let note = Markup::of_class("p", "muted", note);
    Markup::plain("h3", "Without geometry").and(table).and(note)
}

fn parameters(named: &Named) -> Markup {
    let each = named.iter().enumerate().map(|(place, (key, known))| {
        let space = if place == 0 { "" } else { ", " };
        let value = quantity(key, known.value, known.standard_error);
        Markup::from(space)
            .and(symbol(key))
            .and(format!(" = {value}"))
    });
    each.collect()
}
