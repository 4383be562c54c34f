"""Wrong pixels at the edges of shadows against the map's resolution."""

from dataclasses import dataclass

import numpy
from gnomon import InputError, read_table
from matplotlib.ticker import LogLocator, NullLocator

import run_settings
import style

TITLE = "Errors at the edges of shadows against the map's resolution"
COLOURS = (style.BLACK, style.VERMILION, style.GREEN, style.BLUE, style.PURPLE, style.ORANGE,
           style.SKY)  # one for each filter there is
MARKERS = "osD^vPX"
LEGEND_COLUMNS = 5
NUMBERS = ("shadow_map.resolution", "labels.edge", "pixels.lit", "pixels.blocked")


@dataclass(frozen=True)
class Tables:
    """Resolutions [texels] and wrong pixels at edges, in percent of the scored pixels, by filter."""

    settings: str
    series: dict


def read(paths):
    """results.csv of a sweep over shadow_map.resolution, and optionally over filters."""
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
    """Logarithmic axes, with a line along which errors halve as the resolution doubles."""
    figure = style.TitledFigure(TITLE, tables.settings, 4.6)
    grid = style.lay_out(figure, left_in=1.1, right_in=0.35,
                         top_in=1.1 if len(tables.series) < LEGEND_COLUMNS else 1.3, nrows=1,
                         ncols=1)
    axes = figure.add_subplot(grid[0])
    for index, ((name, (texels, percent)), colour, marker) in enumerate(
            zip(tables.series.items(), COLOURS, MARKERS)):
        # Hollow marks of decreasing size, as similar filters overlap.
        axes.plot(texels, percent, marker + "-", color=colour, markersize=13 - 1.6 * index,
                  markerfacecolor="none", markeredgewidth=1.4, linewidth=2.6 - 0.3 * index,
                  label=name)
    texels, percent = next(iter(tables.series.values()))
    axes.plot(texels, percent[0] * texels[0] / texels, color=style.GREY, linestyle=":",
              linewidth=1.5, label="∝ 1 / resolution")
    axes.set_xscale("log", base=2)
    _set_rates(axes, numpy.concatenate([percent for _, percent in tables.series.values()]))
    resolutions = numpy.unique(numpy.concatenate([texels for texels, _ in tables.series.values()]))
    style.set_ticks(axes, *run_settings.resolution_ticks(resolutions))
    axes.set_xlabel("map resolution [texels]")
    axes.set_ylabel("wrong at edges [% of scored pixels]")
    style.add_legend(figure, ncol=LEGEND_COLUMNS, markerscale=1)
    return figure


def _set_rates(axes, percent):
    """A logarithmic scale with room for resolutions without such pixels."""
    if (percent > 0).all() or not (percent > 0).any():
        axes.set_yscale("log" if (percent > 0).all() else "linear")
        if (percent > 0).all() and percent.max() < 100 * percent.min():
            axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axes.yaxis.set_minor_locator(NullLocator())
    else:
        axes.set_yscale("symlog", linthresh=10.0 ** numpy.floor(numpy.log10(percent[percent > 0].min())),
                        linscale=0.5)
        axes.set_ylim(bottom=0)
    axes.yaxis.set_major_formatter(lambda value, _: run_settings.text_of(value))
