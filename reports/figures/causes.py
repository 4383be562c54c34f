"""Why pixels are wrong: their share by cause, for each configuration or along an axis."""

from dataclasses import dataclass

import numpy

import run_settings
import style

TITLE = "Why pixels are wrong"
MOST_CONFIGURATIONS = 12
MOST_BARS = 16
LABELS = ("acne", "peter_panning", "leak", "edge", "overshadow", "bleed")


@dataclass(frozen=True)
class Tables:
    """Percent of the scored pixels by cause, (5, bars).

    `axis` is the axis of the bars, None if each bar is a configuration; `labels` counts the wrong
    pixels by label, for a single configuration.
    """

    settings: str
    names: list
    percent: numpy.ndarray
    axis: run_settings.Axis | None
    counts: dict
    labels: dict


def read(run):
    """Every configuration of a small run; for a larger one the mean along the most influential axis."""
    rows = run_settings.done(run)
    columns = [f"causes.{cause}" for cause in style.CAUSES]
    labels = [f"labels.{label}" for label in LABELS]
    rows = rows.reindex(columns=list(dict.fromkeys([*rows.columns, *columns, *labels])))
    rows = rows.dropna(subset=["causes.resolution"]).reset_index(drop=True)
    # Runs of schema 1 lack the cause `filter` and the label `bleed`.
    rows = rows.fillna({name: 0 for name in (*columns, *labels)})
    if rows.empty:
        raise run_settings.DoesNotApply(f"{run.folder}: no causes")
    scored = (rows["pixels.lit"] + rows["pixels.blocked"]).to_numpy(dtype=float)
    with numpy.errstate(invalid="ignore", divide="ignore"):
        shares = 100 * rows[columns].div(scored, axis=0)
    settings = run_settings.settings_text(rows)
    axes = run_settings.axes_of(run, rows)
    if len(rows) <= MOST_CONFIGURATIONS or not axes:
        rows, shares = rows.iloc[:MOST_CONFIGURATIONS], shares.iloc[:MOST_CONFIGURATIONS]
        names = [run_settings.differences(axes, index) for index in range(len(rows))]
        counts = {cause: rows[f"causes.{cause}"].iloc[0] for cause in style.CAUSES}
        labels = {label: rows[f"labels.{label}"].iloc[0] for label in LABELS}
        return Tables(settings, names, shares.to_numpy().T, None, counts, labels)
    ranked = run_settings.by_influence(axes, rows["error_rate"])
    if not ranked:
        raise run_settings.DoesNotApply(f"{run.folder}: no axis with few enough values")
    means = shares.groupby(ranked[0].codes).mean()
    settings += f"; the mean of {len(rows):,} configurations"
    names = [run_settings.text_of(value) for value in ranked[0].values]
    return Tables(settings, names, means.to_numpy().T, ranked[0], {}, {})


def draw(tables):
    """Stacked bars, or areas for an axis with many values; for one configuration a bar per cause."""
    if len(tables.names) == 1:
        return _draw_one(tables)
    height_in = 4.4 if tables.axis else 1.75 + 0.36 * len(tables.names)
    figure = style.TitledFigure(TITLE, tables.settings, height_in)
    longest = 0 if tables.axis else max(map(len, tables.names))
    grid = style.lay_out(figure, left_in=0.85 if tables.axis else 0.4 + 0.085 * longest,
                         top_in=1.1, nrows=1, ncols=1)
    axes = figure.add_subplot(grid[0])
    if tables.axis is None:
        _draw_configurations(axes, tables)
    else:
        _draw_axis(axes, tables)
    style.add_legend(figure, ncol=len(style.CAUSES))
    return figure


def _draw_configurations(axes, tables):
    places = numpy.arange(len(tables.names))
    left = numpy.zeros(len(places))
    for (cause, colour), percent in zip(style.CAUSES.items(), tables.percent):
        axes.barh(places, percent, left=left, color=colour, label=cause, height=0.7)
        left = left + numpy.nan_to_num(percent)
    axes.set_yticks(places, labels=[style.plain(name) for name in tables.names])
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set_xlabel("wrong pixels [% of scored pixels]")


def _draw_axis(axes, tables):
    axis = tables.axis
    axes.set_xlabel(style.plain(axis.label))
    axes.set_ylabel("wrong pixels [% of scored]")
    if axis.is_numeric and len(axis.values) > MOST_BARS:
        axes.stackplot(numpy.array(axis.values, dtype=float), numpy.nan_to_num(tables.percent),
                       colors=style.CAUSES.values(), labels=style.CAUSES, step="mid", linewidth=0)
        axes.set_xscale(**axis.scale)
        axes.set_xlim(axis.values[0], axis.values[-1])
        return
    places = numpy.arange(len(tables.names))
    bottom = numpy.zeros(len(places))
    for (cause, colour), percent in zip(style.CAUSES.items(), tables.percent):
        axes.bar(places, percent, bottom=bottom, color=colour, label=cause, width=0.7)
        bottom = bottom + numpy.nan_to_num(percent)
    axes.grid(False, axis="x")
    style.set_categories(axes, tables.names, 76)


def _draw_one(tables):
    figure = style.TitledFigure(TITLE, tables.settings, 3.9)
    grid = style.lay_out(figure, left_in=1.35, right_in=0.7, top_in=0.85, nrows=2, ncols=1,
                         hspace=0.28, height_ratios=(len(style.CAUSES), len(LABELS)))
    above, below = (figure.add_subplot(grid[row]) for row in range(2))
    _draw_counts(above, tables.counts, list(style.CAUSES.values()))
    _draw_counts(below, tables.labels, style.GREY)
    top = 1.02 * max(1, *tables.counts.values(), *tables.labels.values())
    for axes in (above, below):
        axes.set_xlim(0, top)
    above.tick_params(labelbottom=False)
    above.set_title("by cause", loc="left")
    below.set_title("by name", loc="left")
    below.set_xlabel("wrong pixels")
    return figure


def _draw_counts(axes, counts, colours):
    places = range(len(counts))
    axes.barh(places, counts.values(), color=colours, height=0.7)
    for place, count in zip(places, counts.values()):
        axes.annotate(f"{count:,.0f}", (count, place), (4, 0), textcoords="offset points",
                      va="center", size=10, annotation_clip=False)
    axes.set_yticks(places, labels=[name.replace("_", "-") for name in counts])
    axes.invert_yaxis()
    axes.grid(False, axis="y")


def words(tables):
    """Title, caption and alternative text."""
    if len(tables.names) == 1:
        parts = [", ".join(f"{count:,.0f} {name.replace('_', '-')}" for name, count in one.items())
                 for one in (tables.counts, tables.labels)]
        return TITLE, tables.settings, f"Wrong pixels by cause: {parts[0]}; by name: {parts[1]}."
    total = numpy.nan_to_num(tables.percent).sum(axis=0)
    said = []
    for name, index in (("Fewest", int(total.argmin())), ("Most", int(total.argmax()))):
        shares = ", ".join(f"{cause} {share:.3g} %"
                           for cause, share in zip(style.CAUSES, tables.percent[:, index]))
        said.append(f"{name} wrong pixels at {tables.names[index]}: {shares}.")
    over = f"by {tables.axis.label}" if tables.axis else "by configuration"
    return TITLE, tables.settings, f"Shares of the scored pixels by cause, {over}. " + " ".join(said)
