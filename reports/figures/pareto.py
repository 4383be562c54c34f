"""False shadow against false lit, one dot per configuration, and the Pareto front."""

import textwrap
from dataclasses import dataclass

import numpy
import pandas

import run_settings
import style

TITLE = "False shadow against false lit"
LEAST_CONFIGURATIONS = 3
DOTS_ACROSS = 400  # dots that would fall on another are left out
MOST_NAMED = 6
LEAST_APART = 0.05  # of the axes, between dots that are named


@dataclass(frozen=True)
class Tables:
    """Rates in [0, 1] of all configurations, and of each case's front by ascending false shadow.

    A configuration competes only with those of its own case.
    """

    settings: str
    rates: numpy.ndarray  # (configurations, 2): false shadow, false lit
    fronts: list  # of each case; one without cases
    best: numpy.ndarray  # (cases, 2), of each case's configuration with the fewest errors
    best_texts: list
    front_texts: list  # what each of the fronts is, one front after the other

    @property
    def front(self):
        """All fronts, concatenated."""
        return numpy.concatenate(self.fronts)


def read(run):
    """The configurations with both rates."""
    rows = run_settings.done(run).dropna(subset=["false_shadow_rate", "false_lit_rate"])
    rows = rows.reset_index(drop=True)
    if len(rows) < LEAST_CONFIGURATIONS:
        raise run_settings.DoesNotApply(f"{run.folder}: {len(rows)} configurations with both rates;"
                                        f" {LEAST_CONFIGURATIONS} are needed")
    rates = rows[["false_shadow_rate", "false_lit_rate"]].to_numpy(dtype=float)
    axes = run_settings.axes_of(run, rows)
    cases = [group.index.to_numpy() for _, group in rows.groupby("case", sort=False, dropna=False)]
    errors = rows["error_rate"].astype(float)
    best = [int(errors[case].idxmin()) for case in cases]
    fronts = [case[front_of(rates[case])] for case in cases]
    texts = [run_settings.description(axes, index) for index in best]
    settings = f"{run_settings.settings_text(rows)}; {len(rows):,} configurations"
    settings += f"; fewest errors: {'; '.join(texts)}" if texts[0] else ""
    return Tables(settings, rates, [rates[front] for front in fronts], rates[best], texts,
                  [run_settings.description(axes, index) for front in fronts for index in front])


def front_of(rates):
    """Indices of the Pareto-optimal pairs, by ascending first value; one of equal pairs."""
    order = numpy.lexsort((rates[:, 1], rates[:, 0]))
    lowest = numpy.minimum.accumulate(rates[order, 1])
    is_new = numpy.append(True, lowest[1:] < lowest[:-1])
    return order[is_new]


def named_of(places, best):
    """Indices of the front's points to label: the one with the fewest errors, both ends, and others
    that are far enough apart. Places are on axes [0, 1]."""
    def is_free(index, chosen):
        return all(numpy.abs(places[index] - places[other]).max() >= LEAST_APART for other in chosen)

    chosen = []
    between = numpy.linspace(0, len(places) - 1, MOST_NAMED).round().astype(int)
    for index in (*best, 0, len(places) - 1, *between):
        if len(chosen) < MOST_NAMED and index not in chosen and is_free(index, chosen):
            chosen.append(index)
    return sorted(int(index) for index in chosen)


def draw(tables):
    """Both rates on one scale."""
    key_in = style.LINE_IN * min(MOST_NAMED, len(tables.front)) + 0.1
    figure = style.TitledFigure(TITLE, tables.settings, 5.6 + key_in)
    grid = style.lay_out(figure, top_in=1.0, right_in=0.3, bottom_in=0.55 + key_in, nrows=1, ncols=1)
    axes = figure.add_subplot(grid[0])
    for which in ("x", "y"):
        style.set_rate_scale(axes, which)
    dots = _distinct(axes, 100 * tables.rates)
    axes.plot(*dots.T, ".", color=style.GREY, alpha=0.7, markersize=6, markeredgewidth=0,
              label="a configuration", clip_on=False)
    for number, front in enumerate(tables.fronts):
        axes.plot(*(100 * front).T, "o-", color=style.FALSE_SHADOW, markersize=4.5, linewidth=1.3,
                  drawstyle="steps-post", clip_on=False,
                  label="front: none is better in both" if number == 0 else None)
    axes.plot(*(100 * tables.best).T, "D", color=style.BLUE, markersize=9, markerfacecolor="none",
              markeredgewidth=2, label="fewest errors", clip_on=False)
    axes.set_xlabel("false shadow [% of lit pixels]")
    axes.set_ylabel("false lit [% of blocked pixels]")
    style.add_legend(figure, ncol=3, markerscale=1.3)
    _write_names(figure, axes, tables, key_in)
    return figure


def _write_names(figure, axes, tables, key_in):
    """Numbers beside dots of the front, and a legend of their configurations below the figure."""
    places = (axes.transScale + axes.transLimits).transform(100 * tables.front)
    is_best = (tables.front[:, None] == tables.best[None]).all(axis=2).any(axis=1)
    best = numpy.flatnonzero(is_best)
    lines = []
    for number, index in enumerate(named_of(places, best), start=1):
        axes.annotate(str(number), 100 * tables.front[index], (7, 6), textcoords="offset points",
                      size=10, weight="bold", annotation_clip=False)
        text = tables.front_texts[index] or "the configuration"
        lines.append(textwrap.shorten(f"{number}  {text}", style.LETTERS_IN_A_LINE, placeholder=" …"))
    height_in = figure.get_size_inches()[1]
    figure.text(0.012, key_in / height_in, style.plain("\n".join(lines)), size=10,
                color="#444444", va="top")


def _distinct(axes, percent):
    places = (axes.transScale + axes.transLimits).transform(percent)
    cells = pandas.DataFrame(numpy.round(DOTS_ACROSS * places))
    return percent[~cells.duplicated().to_numpy()]


def words(tables):
    """Title, caption and alternative text."""
    def pair(rates):
        return (f"{run_settings.percent(rates[0])} false shadow with"
                f" {run_settings.percent(rates[1])} false lit")

    said = f"{len(tables.rates):,} configurations."
    for front, best, text in zip(tables.fronts, tables.best, tables.best_texts):
        said += (f" {len(front)} of them on the front, from {pair(front[0])} to {pair(front[-1])}."
                 f" The fewest errors: {pair(best)}") + (f", at {text}." if text else ".")
    return TITLE, tables.settings, said
