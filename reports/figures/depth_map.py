"""The light's view of the scene: what the shadow map stores, as distances."""

from dataclasses import dataclass

import matplotlib
import numpy
import pandas
from gnomon import InputError, MissingPackage, load_depth_map, read_table

import acne
import run_settings
import style

TITLE = "The shadow map: the light's view"
COLOURS = "cividis"
# Keys of the job that stand under the title of an EXR's figure.
KEYS = ("scene.builtin", "scene.file", "light.type", "shadow_map.resolution",
        "shadow_map.depth_format")


@dataclass(frozen=True)
class Tables:
    """Distances from the light's plane [m], (height, width); NaN where nothing was drawn."""

    settings: str
    distance_m: numpy.ndarray
    range_m: tuple  # of the colours: near and far where the job gives them


def read(paths):
    """A depth map in EXR, or a crop of one in CSV with `light_distance_m`."""
    if len(paths) != 1:
        raise InputError(f"{len(paths)} files given; this figure needs one depth map")
    path = paths[0]
    which = ""
    if path.suffix == ".exr":
        keys, distance_m, which = _read_exr(path)
    else:
        keys = read_table(path, ("x_px", "y_px", "light_distance_m"))
        distance_m = acne.image_of(keys, "light_distance_m", path)
    if numpy.isnan(distance_m).all():
        raise InputError(f"{path}: nothing was drawn there; crop another part of the map")
    range_m = [numpy.nanmin(distance_m), numpy.nanmax(distance_m)]
    for index, key in enumerate(("shadow_map.near", "shadow_map.far")):
        if key in keys and isinstance(keys[key].iloc[0], (int, float, numpy.number)):
            range_m[index] = float(keys[key].iloc[0])
    return Tables(run_settings.settings_text(keys) + which, distance_m, tuple(range_m))


def _read_exr(path):
    """The job's keys as a table, the distances of the first map, and which of several it is."""
    try:
        layers = load_depth_map(path)
    except ModuleNotFoundError as missing:
        raise MissingPackage(f"{path}: Python has no {missing.name}, which reads EXR files"
                             " (Debian: apt-get install python3-openimageio)")
    keys = {key: layers.job[key] for key in KEYS if key in layers.job}
    is_single = "near" in layers.attributes  # of several maps each has its own: near_0
    if is_single:
        keys |= {f"shadow_map.{end}": float.fromhex(layers.attributes[end]) for end in ("near", "far")}
    return (pandas.DataFrame([keys]), layers["light_distance_m"].astype(float),
            "" if is_single else "; the first of several maps")


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
    axes.set_xlabel("x [texels]")
    axes.set_ylabel("y [texels]")
    bar = figure.colorbar(image, cax=figure.add_subplot(grid[1]))
    bar.set_label(style.LIGHT_DISTANCE_LABEL)
    return figure
