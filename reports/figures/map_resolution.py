"""Wrong pixels at the edges of shadows against the map's resolution."""

from dataclasses import dataclass

import numpy
from gnomon import InputError, read_table

import run_settings
import style

TITLE = "Errors at the edges of shadows against the map's resolution"
COLOURS = (style.BLACK, style.VERMILION, style.GREEN, style.BLUE, style.PURPLE)
MARKERS = "osD^v"
NUMBERS = ("shadow_map.resolution", "labels.edge", "pixels.lit", "pixels.blocked")


@dataclass(frozen=True)
class Tables:
    """By filter: resolutions [texels] and wrong pixels at edges, in percent of the scored."""

    settings: str
    series: dict


def read(paths):
    """results.csv of a sweep over shadow_map.resolution, and over filters if you like."""
    if len(paths) != 1:
        raise InputError(f"{len(paths)} files given; results.csv of one run is needed")
    table = read_table(paths[0], NUMBERS, ("status", "lookup.filter"))
    table = table[table["status"] == "done"]
    if table["shadow_map.resolution"].nunique() < 2:
        raise InputError(f"{paths[0]}: one resolution; sweep over shadow_map.resolution")
    scored = table["pixels.lit"] + table["pixels.blocked"]
    shares = table.assign(percent=100 * table["labels.edge"] / scored)
    series = {}
    for name, rows in shares.groupby("lookup.filter", sort=False):
        medians = rows.groupby("shadow_map.resolution")["percent"].median()
        series[name] = (medians.index.to_numpy(), medians.to_numpy())
    return Tables(run_settings.settings_text(table), series)


def draw(tables):
    """Both axes logarithmic, with the line of errors that halve as the resolution doubles."""
    figure = style.TitledFigure(TITLE, tables.settings, 4.6)
    grid = style.lay_out(figure, top_in=0.8, nrows=1, ncols=1)
    axes = figure.add_subplot(grid[0])
    for (name, (texels, percent)), colour, marker in zip(tables.series.items(), COLOURS, MARKERS):
        axes.plot(texels, percent, marker + "-", color=colour, markersize=6, label=name)
    texels, percent = next(iter(tables.series.values()))
    axes.plot(texels, percent[0] * texels[0] / texels, color=style.GREY, linestyle=":",
              linewidth=1.5, label="∝ 1 / resolution")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xticks(texels, labels=[run_settings.text_of(int(value)) for value in texels])
    axes.set_xticks([], minor=True)
    axes.yaxis.set_major_formatter(lambda value, _: run_settings.text_of(value))
    axes.set_xlabel("map resolution [texels]")
    axes.set_ylabel("wrong at edges [% of scored pixels]")
    axes.legend()
    return figure
