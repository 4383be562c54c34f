"""Rates of wrong pixels along each axis of a sweep: the median over all others, and their range."""

from dataclasses import dataclass

import numpy

import run_settings
import style

TITLE = "Wrong pixels along each axis"
MOST_PANELS = 6
COLUMNS = 2
FEW_VALUES = 8  # up to as many are marked


@dataclass(frozen=True)
class Panel:
    """An axis, with the median, smallest and largest rate in [0, 1] for each of its values."""

    axis: run_settings.Axis
    false_shadow: numpy.ndarray  # (3, values)
    false_lit: numpy.ndarray


@dataclass(frozen=True)
class Tables:
    """The panels, the settings that all configurations share, and the number of configurations."""

    settings: str
    panels: list
    configurations: int


def read(run):
    """The axes of a sweep, the most influential first."""
    rows = run_settings.done(run)
    axes = run_settings.by_influence(run_settings.axes_of(run, rows), rows["error_rate"])
    if not axes:
        raise run_settings.DoesNotApply(f"{run.folder}: no axis; its configurations do not differ")
    panels = [Panel(axis, *(_ranges(rows[rate], axis)
                            for rate in ("false_shadow_rate", "false_lit_rate")))
              for axis in axes[:MOST_PANELS]]
    settings = f"{run_settings.settings_text(rows)}; {len(rows):,} configurations"
    return Tables(settings, panels, len(rows))


def _ranges(rate, axis):
    groups = rate.astype(float).groupby(axis.codes)
    found = numpy.full((3, len(axis.values)), numpy.nan)
    for row, values in enumerate((groups.median(), groups.min(), groups.max())):
        found[row, values.index] = values
    return found


def draw(tables):
    """Small multiples with the same scale of rates."""
    panels = tables.panels
    columns = min(COLUMNS, len(panels))
    count = -(-len(panels) // columns)
    figure = style.TitledFigure(TITLE, tables.settings, 1.1 + 2.9 * count)
    grid = style.lay_out(figure, top_in=1.3, nrows=count, ncols=columns, hspace=0.45, wspace=0.22)
    for index, panel in enumerate(panels):
        axes = figure.add_subplot(grid[index // columns, index % columns])
        _draw(axes, panel, 70 // columns)
        style.set_rate_scale(axes)
        if index % columns == 0:
            axes.set_ylabel("wrong pixels [%]")
    style.add_legend(figure, ncol=2, markerscale=1)
    return figure


def _draw(axes, panel, letters):
    axis = panel.axis
    places = numpy.array(axis.values, dtype=float) if axis.is_numeric else numpy.arange(
        len(axis.values))
    for shift, (rates, colour, label, marker) in zip((-0.08, 0.08), (
        (panel.false_shadow, style.FALSE_SHADOW, "false shadow, median", "o"),
        (panel.false_lit, style.FALSE_LIT, "false lit, median", "s"),
    )):
        median, low, high = 100 * rates
        range_label = label.replace("median", "smallest to largest")
        if axis.is_numeric:
            axes.fill_between(places, low, high, color=colour, alpha=0.18, linewidth=0,
                              label=range_label)
            axes.plot(places, median, color=colour, label=label,
                      marker=marker if len(places) <= FEW_VALUES else None, markersize=5)
        else:
            axes.vlines(places + shift, low, high, color=colour, alpha=0.3, linewidth=6,
                        label=range_label)
            axes.plot(places + shift, median, marker, color=colour, label=label, markersize=6)
    axes.set_xlabel(style.plain(axis.label))
    if not axis.is_numeric:
        style.set_categories(axes, [run_settings.text_of(value) for value in axis.values], letters)
        return
    axes.set_xscale(**axis.scale)
    if axis.is_of_powers_of_two or axis.key == "shadow_map.resolution":
        style.set_ticks(axes, *run_settings.resolution_ticks(places))
    elif len(places) <= FEW_VALUES:
        style.set_ticks(axes, places, [run_settings.text_of(value) for value in axis.values])


def words(tables):
    """Title, caption and alternative text."""
    said = [f"{tables.configurations:,} configurations."]
    for panel in tables.panels:
        total = panel.false_shadow[0] + panel.false_lit[0]
        is_subject = panel.axis.key == "case"  # what is looked at: none is better than another
        if is_subject or numpy.isnan(total).all():
            continue
        best, worst = int(numpy.nanargmin(total)), int(numpy.nanargmax(total))
        texts = [
            f"{run_settings.text_of(panel.axis.values[index])} ("
            f"{run_settings.percent(panel.false_shadow[0][index])} false shadow,"
            f" {run_settings.percent(panel.false_lit[0][index])} false lit)"
            for index in (best, worst)
        ]
        said.append(f"Along {panel.axis.label} the medians are smallest together at {texts[0]} and"
                    f" largest at {texts[1]}.")
    return TITLE, tables.settings, " ".join(said)
