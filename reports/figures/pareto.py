"""False shadow against false lit, one dot a configuration, and those that none other beats in both."""

from dataclasses import dataclass

import numpy
import pandas

import run_settings
import style

TITLE = "False shadow against false lit"
LEAST_CONFIGURATIONS = 3
DOTS_ACROSS = 400  # dots that would fall on another are left out


@dataclass(frozen=True)
class Tables:
    """Rates in [0, 1] of all configurations, and of the front by ascending false shadow."""

    settings: str
    rates: numpy.ndarray  # (configurations, 2): false shadow, false lit
    front: numpy.ndarray
    best: numpy.ndarray  # (2,), of the configuration with the fewest errors
    best_text: str


def read(run):
    """The configurations that have both rates."""
    rows = run_settings.done(run).dropna(subset=["false_shadow_rate", "false_lit_rate"])
    rows = rows.reset_index(drop=True)
    if len(rows) < LEAST_CONFIGURATIONS:
        raise run_settings.DoesNotApply(f"{run.folder}: {len(rows)} configurations with both rates;"
                                        f" {LEAST_CONFIGURATIONS} are needed")
    rates = rows[["false_shadow_rate", "false_lit_rate"]].to_numpy(dtype=float)
    best = int(rows["error_rate"].astype(float).idxmin())
    axes = run_settings.axes_of(run, rows)
    text = run_settings.description(axes, best)
    settings = f"{run_settings.settings_text(rows)}; {len(rows):,} configurations"
    settings += f"; fewest errors: {text}" if text else ""
    return Tables(settings, rates, front_of(rates), rates[best], text)


def front_of(rates):
    """The pairs that no other is below in one and not above in the other, by ascending first."""
    ordered = rates[numpy.lexsort((rates[:, 1], rates[:, 0]))]
    lowest = numpy.minimum.accumulate(ordered[:, 1])
    is_new = numpy.append(True, lowest[1:] < lowest[:-1])
    return ordered[is_new]


def draw(tables):
    """Both rates on one scale."""
    figure = style.TitledFigure(TITLE, tables.settings, 5.6)
    grid = style.lay_out(figure, top_in=1.0, right_in=0.3, nrows=1, ncols=1)
    axes = figure.add_subplot(grid[0])
    for which in ("x", "y"):
        style.set_rate_scale(axes, which)
    dots = _distinct(axes, 100 * tables.rates)
    axes.plot(*dots.T, ".", color=style.GREY, alpha=0.7, markersize=6, markeredgewidth=0,
              label="a configuration", clip_on=False)
    axes.plot(*(100 * tables.front).T, "o-", color=style.FALSE_SHADOW, markersize=4.5,
              linewidth=1.3, drawstyle="steps-post", label="front: none is better in both",
              clip_on=False)
    axes.plot(*(100 * tables.best), "D", color=style.BLUE, markersize=9, markerfacecolor="none",
              markeredgewidth=2, label="fewest errors", clip_on=False)
    axes.set_xlabel("false shadow [% of lit pixels]")
    axes.set_ylabel("false lit [% of blocked pixels]")
    style.add_legend(figure, ncol=3, markerscale=1.3)
    return figure


def _distinct(axes, percent):
    places = (axes.transScale + axes.transLimits).transform(percent)
    cells = pandas.DataFrame(numpy.round(DOTS_ACROSS * places))
    return percent[~cells.duplicated().to_numpy()]


def words(tables):
    """Title, caption and text for who cannot see it."""
    def pair(rates):
        return (f"{run_settings.percent(rates[0])} false shadow with"
                f" {run_settings.percent(rates[1])} false lit")

    said = (f"{len(tables.rates):,} configurations, {len(tables.front)} of them on the front, from"
            f" {pair(tables.front[0])} to {pair(tables.front[-1])}. The fewest errors:"
            f" {pair(tables.best)}")
    return TITLE, tables.settings, said + (f", at {tables.best_text}." if tables.best_text else ".")
