"""A lookup's verdict across the edge of a shadow, for filters of growing width."""

from dataclasses import dataclass

import numpy
from gnomon import CLASSES, InputError, read_table

import run_settings
import style

TITLE = "The edge of a shadow by percentage-closer filtering"
TAPS = {"nearest": "1 tap", **{f"pcf{k}": f"{k} × {k} taps" for k in (3, 5, 7, 9)}}
COLOURS = (style.BLACK, style.VERMILION, style.ORANGE, style.GREEN, style.BLUE)
LINES = ("-", "--", "-.", ":", (0, (5, 1)))
ANGLE = "scene.wall.light_angle_deg"


@dataclass(frozen=True)
class Tables:
    """Verdicts in [0, 1] over the distance from the true edge [texels on the ground], by filter."""

    settings: str
    profiles: dict
    texel_m: float  # on the ground, across the edge


def read(paths):
    """Rows of pixels across the edge of the built-in wall's shadow, one file per filter."""
    profiles, settings = {}, set()
    for path in paths:
        table = read_table(path, ("P.X", "class", "verdict", "shadow_map.half_extent", ANGLE,
                                  "shadow_map.resolution"), ("lookup.filter",))
        filters = set(table["lookup.filter"])
        if len(filters) != 1 or not filters <= set(TAPS):
            raise InputError(f"{path}: filter {', '.join(sorted(filters))}; one of"
                             f" {', '.join(TAPS)} is needed")
        distance, verdict, texel_m = _profile(table, path)
        profiles[filters.pop()] = (distance, verdict)
        settings.add((run_settings.settings_text(table.drop(columns="lookup.filter")), texel_m))
    if len(settings) != 1:
        raise InputError(f"{paths[-1]}: settings differ from {paths[0]}; give files of one shadow map")
    text, texel_m = settings.pop()
    return Tables(f"{text}, texels of {style.length_text(texel_m)} across the edge",
                  {name: profiles[name] for name in TAPS if name in profiles}, texel_m)


def _profile(table, path):
    scored = [CLASSES.index(name) for name in ("lit", "blocked")]
    table = table[table["class"].isin(scored)].sort_values("P.X")
    is_lit = (table["class"] == CLASSES.index("lit")).to_numpy()
    place = table["P.X"].to_numpy()
    edges = numpy.flatnonzero(is_lit[1:] != is_lit[:-1])
    if len(edges) != 1:
        raise InputError(f"{path}: {len(edges)} edges of the true shadow; crop a row of pixels"
                         " with one")
    edge_m = 0.5 * (place[edges[0]] + place[edges[0] + 1])
    first = table.iloc[0]
    # The light falls at θ from the vertical, so a texel is longer on the ground by 1/cos θ.
    texel_m = (2 * first["shadow_map.half_extent"] / first["shadow_map.resolution"]
               / numpy.cos(numpy.radians(first[ANGLE])))
    return (place - edge_m) / texel_m, table["verdict"].to_numpy(), float(texel_m)


def draw(tables):
    """The verdicts of all filters, centred on the true edge."""
    figure = style.TitledFigure(TITLE, tables.settings, 4.6)
    grid = style.lay_out(figure, top_in=1.1, nrows=1, ncols=1)
    axes = figure.add_subplot(grid[0])
    axes.axvline(0, color=style.GREY, linewidth=1, label="true edge")
    for (name, (distance, verdict)), colour, line in zip(tables.profiles.items(), COLOURS, LINES):
        axes.plot(distance, 100 * verdict, color=colour, linestyle=line, label=TAPS[name])
    low = min(distance[0] for distance, _ in tables.profiles.values())
    high = max(distance[-1] for distance, _ in tables.profiles.values())
    axes.set_xlim(low, high)
    axes.set_ylim(-3, 103)
    axes.set_xlabel("distance from the true edge [texels on the ground]")
    axes.set_ylabel("light shown [%]")
    style.add_legend(figure, ncol=6, markerscale=1)
    return figure
