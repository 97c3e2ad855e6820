"""Plots of answers, drawn with Matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import matplotlib.axes

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
