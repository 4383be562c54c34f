"""The light's view of the scene: what the shadow map stores, as distances."""

from dataclasses import dataclass

import matplotlib
import numpy
from gnomon import InputError, read_table

import acne
import run_settings
import style

TITLE = "The shadow map: the light's view"
COLOURS = "cividis"


@dataclass(frozen=True)
class Tables:
    """Distances from the light's plane [m], (height, width); NaN where nothing was drawn."""

    settings: str
    distance_m: numpy.ndarray
    range_m: tuple  # of the colours: near and far where the job gives them


def read(paths):
    """One crop of a depth map with `light_distance_m`."""
    if len(paths) != 1:
        raise InputError(f"{len(paths)} files given; this figure needs one crop of a depth map")
    table = read_table(paths[0], ("x_px", "y_px", "light_distance_m"))
    distance_m = acne.image_of(table, "light_distance_m", paths[0])
    if numpy.isnan(distance_m).all():
        raise InputError(f"{paths[0]}: nothing was drawn there; crop another part of the map")
    range_m = [numpy.nanmin(distance_m), numpy.nanmax(distance_m)]
    for index, key in enumerate(("shadow_map.near", "shadow_map.far")):
        if key in table and isinstance(table[key].iloc[0], (int, float, numpy.number)):
            range_m[index] = float(table[key].iloc[0])
    return Tables(run_settings.settings_text(table), distance_m, tuple(range_m))


def draw(tables):
    """Texel by texel, with a colour bar."""
    height, width = tables.distance_m.shape
    figure = style.TitledFigure(TITLE, tables.settings, 0.9 + 5.6 * height / width)
    grid = style.lay_out(figure, left_in=0.85, right_in=0.95, top_in=0.75, nrows=1, ncols=2,
                         width_ratios=(24, 1), wspace=0.06)
    axes = figure.add_subplot(grid[0])
    colours = matplotlib.colormaps[COLOURS].copy()
    colours.set_bad("white")
    image = axes.imshow(tables.distance_m, cmap=colours, vmin=tables.range_m[0],
                        vmax=tables.range_m[1], interpolation="nearest")
    axes.grid(False)
    axes.spines[:].set_visible(True)
    axes.set_xlabel("texel")
    axes.set_ylabel("texel")
    bar = figure.colorbar(image, cax=figure.add_subplot(grid[1]))
    bar.set_label(style.LIGHT_DISTANCE_LABEL)
    return figure
