"""Error rate over two axes of a sweep, on a scale that is the same for every run."""

from dataclasses import dataclass

import matplotlib
import numpy
from matplotlib.colors import LogNorm

import run_settings
import style

TITLE = "Error rate over two axes"
SCALE_PERCENT = (0.001, 100)
COLOURS = "cividis"  # the same to readers who see red and green alike
MOST_NUMBERS = 80  # more cells are too small to write in
MOST_NAMES = 10
MOST_TICKS = 7  # of values that are too many to write each


@dataclass(frozen=True)
class Tables:
    """Two axes, and the error rate in [0, 1] of the cells, (values of y, values of x)."""

    settings: str
    x: run_settings.Axis
    y: run_settings.Axis
    rates: numpy.ndarray
    others: int  # axes over which a cell is the median


def read(run):
    """The two axes that the error rate depends on most; the one with more values lies across."""
    rows = run_settings.done(run)
    axes = run_settings.by_influence(run_settings.axes_of(run, rows), rows["error_rate"])
    if len(axes) < 2:
        raise run_settings.DoesNotApply(f"{run.folder}: fewer than two axes")
    y, x = sorted(axes[:2], key=lambda axis: len(axis.values))
    cells = rows["error_rate"].astype(float).groupby(y.codes * len(x.values) + x.codes).median()
    rates = numpy.full(len(x.values) * len(y.values), numpy.nan)
    rates[cells.index] = cells
    others = len(axes) - 2
    settings = run_settings.settings_text(rows)
    settings += f"; {len(rows):,} configurations"
    settings += f", the median over {others} other {'axis' if others == 1 else 'axes'}" * (others > 0)
    return Tables(settings, x, y, rates.reshape(len(y.values), len(x.values)), others)


def draw(tables):
    """Cells of equal size, as the values of an axis need not be evenly spaced."""
    figure = style.TitledFigure(TITLE, tables.settings,
                                2.0 + numpy.clip(0.45 * len(tables.y.values), 1.4, 3.6))
    grid = style.lay_out(figure, left_in=1.5, right_in=0.95, bottom_in=0.9, top_in=0.72, nrows=1,
                         ncols=2, width_ratios=(30, 1), wspace=0.06)
    axes = figure.add_subplot(grid[0])
    axes.grid(False)
    colours = matplotlib.colormaps[COLOURS].copy()
    colours.set_bad("white")
    low, high = SCALE_PERCENT
    percent = 100 * tables.rates
    mesh = axes.pcolormesh(numpy.arange(len(tables.x.values) + 1) - 0.5,
                           numpy.arange(len(tables.y.values) + 1) - 0.5,
                           numpy.ma.masked_invalid(numpy.clip(percent, low, high)),
                           norm=LogNorm(low, high), cmap=colours, rasterized=True)
    if percent.size <= MOST_NUMBERS and len(tables.x.values) <= 10:
        _write_numbers(axes, percent)
    for axis, which in ((tables.x, "x"), (tables.y, "y")):
        _set_values(axes, axis, which)
    bar = figure.colorbar(mesh, cax=figure.add_subplot(grid[1]))
    bar.set_label("error rate [%]")
    bar.set_ticks([0.001, 0.01, 0.1, 1, 10, 100],
                  labels=["≤ 0.001", "0.01", "0.1", "1", "10", "100"])
    bar.ax.tick_params(which="minor", length=0)
    return figure


def _write_numbers(axes, percent):
    for (row, column), value in numpy.ndenumerate(percent):
        if not numpy.isnan(value):
            axes.text(column, row, f"{value:.2g}", ha="center", va="center", size=9.5,
                      color="white" if value < 0.7 else "black")


def _set_values(axes, axis, which):
    count = len(axis.values)
    is_thinned = axis.is_numeric and count > MOST_NAMES
    places = range(0, count, -(-count // MOST_TICKS) if is_thinned else 1)
    values = [axis.values[index] for index in places]
    texts = [style.plain(run_settings.text_of(float(f"{value:.2g}") if is_thinned else value))
             for value in values]
    getattr(axes, f"set_{which}ticks")(places, labels=texts)
    getattr(axes, f"set_{which}label")(style.plain(axis.label))
    if which == "x" and sum(map(len, texts)) > 64:
        style.turn(axes)


def words(tables):
    """Title, caption and text for who cannot see it."""
    alt = f"Error rate over {tables.x.label} and {tables.y.label}."
    for name, choose in (("smallest", numpy.nanargmin), ("largest", numpy.nanargmax)):
        if not numpy.isnan(tables.rates).all():
            row, column = numpy.unravel_index(choose(tables.rates), tables.rates.shape)
            alt += (f" The {name}, {run_settings.percent(tables.rates[row, column])}, is at"
                    f" {run_settings.text_of(tables.x.values[column])} and"
                    f" {run_settings.text_of(tables.y.values[row])}.")
    return TITLE, tables.settings, alt
