"""Error rate over two axes of a sweep, on the same scale for every run."""

from dataclasses import dataclass

import matplotlib
import numpy
from matplotlib.colors import LogNorm
from matplotlib.ticker import MaxNLocator

import run_settings
import style

TITLE = "Error rate over two axes"
SCALE_PERCENT = (0.001, 100)
COLOURS = "cividis"  # the same to readers who see red and green alike
MOST_NUMBERS = 80  # more cells are too small to write in
MOST_NAMES = 10
LEAST_HEIGHT_IN = 1.9  # of the cells, or the name of their axis would not fit


@dataclass(frozen=True)
class Tables:
    """Two axes, and the error rates in [0, 1], (values of y, values of x)."""

    settings: str
    x: run_settings.Axis
    y: run_settings.Axis
    rates: numpy.ndarray
    others: int  # axes over which a cell is the median


def read(run):
    """The two most influential axes; the one with more values is horizontal."""
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
    """Cells of equal size, as the values of an axis may be unevenly spaced.

    Numbers ascend to the right and upwards; names keep the order of the run, from the top down.
    """
    figure = style.TitledFigure(
        TITLE, tables.settings,
        2.0 + numpy.clip(0.45 * len(tables.y.values), LEAST_HEIGHT_IN, 3.6))
    longest = max(len(run_settings.text_of(value)) for value in tables.y.values)
    grid = style.lay_out(figure, left_in=0.75 + 0.088 * longest, right_in=0.95, bottom_in=0.9,
                         top_in=0.72, nrows=1, ncols=2, width_ratios=(30, 1), wspace=0.06)
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
    _set_values(axes, tables)
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


def _set_values(axes, tables):
    axes.set_xlabel(style.plain(tables.x.label))
    axes.set_ylabel(style.plain(tables.y.label))
    axes.tick_params(length=4)
    places, texts = _ticks(tables.x)
    if tables.x.is_numeric:
        style.set_ticks(axes, places, texts)
    else:
        axes.set_xticks(places, labels=[style.plain(text) for text in texts])
        if not style.fit(axes, places, texts):
            style.turn(axes)
    places, texts = _ticks(tables.y)
    axes.set_yticks(places, labels=[style.plain(text) for text in texts])
    if not tables.y.is_numeric:
        axes.invert_yaxis()


def _ticks(axis):
    """Tick cells and texts: each value, or round numbers if there are many."""
    values = axis.values
    if not axis.is_numeric or len(values) <= MOST_NAMES:
        return range(len(values)), [run_settings.text_of(value) for value in values]
    numbers = numpy.array(values, dtype=float)
    if axis.scale["value"] == "linear":
        round_ones = MaxNLocator(MOST_NAMES - 1).tick_values(numbers[0], numbers[-1])
    elif axis.is_of_powers_of_two:
        round_ones = numbers
    else:
        powers = numpy.arange(-15, 16)
        round_ones = numpy.array([*(-(10.0 ** powers[::-1])), 0, *(10.0**powers)])
    inside = round_ones[(round_ones >= numbers[0] * (1 - 1e-9)) & (round_ones <= numbers[-1] * (1 + 1e-9))]
    return numpy.interp(inside, numbers, numpy.arange(len(numbers))), [
        run_settings.text_of(value) for value in inside]


def words(tables):
    """Title, caption and alternative text."""
    alt = f"Error rate over {tables.x.label} and {tables.y.label}."
    for name, choose in (("smallest", numpy.nanargmin), ("largest", numpy.nanargmax)):
        if not numpy.isnan(tables.rates).all():
            row, column = numpy.unravel_index(choose(tables.rates), tables.rates.shape)
            alt += (f" The {name}, {run_settings.percent(tables.rates[row, column])}, is at"
                    f" {run_settings.text_of(tables.x.values[column])} and"
                    f" {run_settings.text_of(tables.y.values[row])}.")
    return TITLE, tables.settings, alt
