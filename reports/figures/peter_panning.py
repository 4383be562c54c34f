"""The width of the strip of light under a wall against the bias, compared with b·sin θ."""

from dataclasses import dataclass

import numpy
from gnomon import InputError, read_table

import run_settings
import style

TITLE = "Peter-panning: the strip of light at a wall's foot"
COLOURS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE)
MARKERS = "osD^"
ANGLE = "scene.wall.light_angle_deg"
NUMBERS = (ANGLE, "bias.constant_m", "camera.orthographic_height", "image.height",
           "labels.peter_panning", "peter_panning_gap_m.max")


@dataclass(frozen=True)
class Tables:
    """Biases, widths and lengths of the strip, all [m], by the light's angle from the vertical."""

    settings: str
    series: list  # (angle_rad, bias_m, width_m, pixel_m)


def read(paths):
    """results.csv of a sweep of `wall` over bias.constant_m, seen straight from above."""
    if len(paths) != 1:
        raise InputError(f"{len(paths)} files given; results.csv of one run is needed")
    table = read_table(paths[0], NUMBERS, ("scene.builtin", "status"))
    table = table[table["status"] == "done"]
    if set(table["scene.builtin"]) != {"wall"} or table[list(NUMBERS[:4])].isna().any(axis=None):
        raise InputError(f"{paths[0]}: no sweep of the built-in wall over bias.constant_m with an"
                         " orthographic camera; docs/figures.md has one")
    series = []
    for angle_deg, rows in table.groupby(ANGLE):
        rows = rows.sort_values("bias.constant_m")
        pixel_m = rows["camera.orthographic_height"] / rows["image.height"]
        # Each row of pixels crosses the strip once.
        width_m = rows["labels.peter_panning"] / rows["image.height"] * pixel_m
        series.append((numpy.radians(angle_deg), rows["bias.constant_m"].to_numpy(),
                       width_m.to_numpy(), float(pixel_m.iloc[0])))
    shared = table.drop(columns=["bias.constant_m", ANGLE])
    return Tables(f"{run_settings.settings_text(shared)}; pixels of"
                  f" {style.length_text(series[0][3])}", series)


def draw(tables):
    """Measured widths as marks, the formula as lines."""
    figure = style.TitledFigure(TITLE, tables.settings, 4.6)
    grid = style.lay_out(figure, top_in=0.8, right_in=0.95, nrows=1, ncols=1)
    axes = figure.add_subplot(grid[0])
    for (angle_rad, bias_m, width_m, _), colour, marker in zip(tables.series, COLOURS, MARKERS):
        line_m = numpy.array([0, bias_m.max()])
        axes.plot(line_m, line_m * numpy.sin(angle_rad), color=colour, linewidth=1.3)
        axes.plot(bias_m, width_m, marker, color=colour, markersize=6, markerfacecolor="none",
                  markeredgewidth=1.6, clip_on=False)
        axes.annotate(f"θ = {numpy.degrees(angle_rad):.3g}°",
                      (line_m[1], line_m[1] * numpy.sin(angle_rad)), (10, 0), color=colour,
                      textcoords="offset points", va="center", weight="bold", size=10,
                      annotation_clip=False)
    axes.plot([], [], "o", color=style.GREY, markerfacecolor="none", markeredgewidth=1.6,
              label="measured width")
    axes.plot([], [], color=style.GREY, linewidth=1.3, label="b·sin θ (formula)")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("constant bias b along the light's axis [m]")
    axes.set_ylabel("width of the strip [m]")
    axes.legend(loc="upper left")
    return figure
