//! The plots of figure 3-4.

use palpate_mechanics::finite_spheres::Form;

use palpate_jobs::plot::{Axis, Plot, Series, Style};

/// How the curves of a form are drawn.
pub(super) fn style(form: Form) -> Style {
    match form {
        Form::Weak => Style::LineWithDots,
        Form::Strong => Style::DashedLineWithSquares,
    }
}

/// Size of the force error.
pub(super) fn of_errors(series: Vec<Series>) -> Plot {
    Plot {
        title: "Force at the pole of a hemisphere: error of the local model".to_owned(),
        x_label: "number of particles [-]".to_owned(),
        y_label: "size of the force error [%]".to_owned(),
        x_axis: Axis::Logarithmic,
        y_axis: Axis::Logarithmic,
        series,
        ..Plot::default()
    }
}

/// Time of a step.
pub(super) fn of_times(series: Vec<Series>) -> Plot {
    Plot {
        title: "Time of one step of the local model".to_owned(),
        x_label: "number of particles [-]".to_owned(),
        y_label: "time of a step [ms]".to_owned(),
        x_axis: Axis::Logarithmic,
        y_axis: Axis::Logarithmic,
        series,
        ..Plot::default()
    }
}
