"""Plots of answers, drawn with Matplotlib."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

    from palpate.laws import Law

#: How a style is drawn: line, marker.
STYLES: dict[str, dict[str, Any]] = {
    "line": {"linestyle": "-"},
    "fine_line": {"linestyle": "-", "linewidth": 0.7},
    "broad_line": {"linestyle": "-", "linewidth": 5.0, "alpha": 0.3},
    "dashed_line": {"linestyle": "--"},
    "dotted_line": {"linestyle": ":"},
    "dots": {"linestyle": "", "marker": "o", "markersize": 4.0},
    "line_with_dots": {"linestyle": "-", "marker": "o", "markersize": 4.0},
    "dashed_line_with_squares": {"linestyle": "--", "marker": "s", "markersize": 4.0},
}


def draw(plot: dict[str, Any], axes: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
    """Draw ``plot``, as an answer holds it, into ``axes`` or a figure of its own."""
    if axes is None:
        import matplotlib.pyplot

        _, axes = matplotlib.pyplot.subplots()
    for band in plot["bands"]:
        x, bounds = [point[0] for point in band["points"]], [point[1] for point in band["points"]]
        low, high = [bound[0] for bound in bounds], [bound[1] for bound in bounds]
        axes.fill_between(x, low, high, color=f"C{band['color']}", alpha=0.2, linewidth=0)
    for shade in plot["shades"]:
        axes.axvspan(*shade["span"], color=f"C{shade['color']}", alpha=0.1)
    for series in plot["series"]:
        x, y = [point[0] for point in series["points"]], [point[1] for point in series["points"]]
        name = series["name"] or None
        axes.plot(x, y, color=f"C{series['color']}", label=name, **STYLES[series["style"]])
    if any(series["name"] for series in plot["series"]):
        axes.legend(frameon=False)
    for axis, set_scale in (("x_axis", axes.set_xscale), ("y_axis", axes.set_yscale)):
        if plot[axis] == "logarithmic":
            set_scale("log")
    axes.set(title=plot["title"], xlabel=plot["x_label"], ylabel=plot["y_label"])
    return axes


def draw_fit(law: Law, against: str | None, figure: matplotlib.figure.Figure | None) -> matplotlib.figure.Figure:
    """Draw ``law`` beside the recordings that it was found from, and below it the residual."""
    if figure is None:
        import matplotlib.pyplot

        figure = matplotlib.pyplot.figure(figsize=(7.0, 5.0))
    over_time = against == "time" or (against is None and not law.is_piece)
    # Of a piece stresses [kPa], else forces [mN].
    unit, factor = ("stress [kPa]", 1e-3) if law.is_piece else ("force [mN]", 1e3)
    course, scale = ("stretch [-]", 1.0) if law.is_piece else ("depth [mm]", 1e3)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 1.0))
    for place, own in enumerate(law.recordings):
        x = own.time if over_time else scale * own.course
        color = f"C{place % 10}"
        above.plot(x, factor * own.measured, color=color, linewidth=3.0, alpha=0.3)
        above.plot(x, factor * own.best_fit, color=color, linewidth=1.0, label=Path(own.file).stem)
        low, high = own.best_fit - own.reach, own.best_fit + own.reach
        above.fill_between(x, factor * low, factor * high, color=color, alpha=0.2, linewidth=0)
        below.plot(x, factor * own.residual, color=color, linewidth=0.6)
    below.axhline(0.0, color="0.5", linewidth=0.8)
    values = ", ".join(f"{name} = {parameter.value:.4g}" for name, parameter in law.parameters.items())
    above.set(ylabel=unit, title=f"{law.name}: {values}\nmeasured (broad), fitted (thin), band of 95 %")
    below.set(xlabel="time [s]" if over_time else course, ylabel=f"fitted less\nmeasured {unit[unit.index('[') :]}")
    above.legend(frameon=False, fontsize="small")
    figure.align_ylabels()
    return figure
