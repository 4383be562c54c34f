"""Rates of wrong pixels by distance from the light, at the job's and at the best bias."""

from dataclasses import dataclass

import numpy

import distance_panels
import run_settings
import style

TITLE = "Wrong pixels by distance from the light"
COUNTS = ("lit", "blocked", "false_shadow", "false_lit")


@dataclass(frozen=True)
class Curve:
    """The bins of a curve: edges [m], pixel counts, and wrong pixels at each bias."""

    name: str
    edges: numpy.ndarray
    lit: numpy.ndarray
    blocked: numpy.ndarray
    at: dict  # "job_bias", "best_bias": (bias, false_shadow_rate, false_lit_rate), rates in [0, 1]


@dataclass(frozen=True)
class Tables:
    """The curves to draw, and the settings that they share."""

    settings: str
    curves: list


def read(run):
    """The curves of a run; only the best of a large one."""
    rows = run_settings.done(run)
    bins = run.error_vs_z
    rows = rows[rows["curve"].isin(bins["curve"])].reset_index(drop=True)
    if rows.empty:
        raise run_settings.DoesNotApply(f"{run.folder}: no errors by distance")
    chosen, why = run_settings.curves_of(run, rows)
    titles = run_settings.panel_titles(run, rows, chosen)
    settings = run_settings.settings_text(chosen.drop(columns=list(run_settings.CONSTANT_BIASES)))
    curves = [_curve(bins[bins["curve"] == curve], rows, title)
              for curve, title in zip(chosen["curve"], titles)]
    biases = [run_settings.biases_text(name, [curve.at[at][0] for curve in curves if at in curve.at])
              for at, name in run_settings.BIASES.items()]
    return Tables("; ".join(filter(None, (settings, *biases, why))), curves)


def _curve(bins, rows, name):
    blocks = {}
    for at in run_settings.BIASES:
        block = bins[bins["at"] == at]
        if len(block):
            blocks[at] = block[block["bias"] == block["bias"].iloc[0]]
    job = blocks.get("job_bias")
    if "best_bias" in blocks and job is not None and not run_settings.has_bias(
            rows, job["curve"].iloc[0], job["bias"].iloc[0]):
        del blocks["job_bias"]  # the sweep has other biases
    first = next(iter(blocks.values()))
    return Curve(
        name,
        numpy.append(first["lower_m"], first["upper_m"].iloc[-1]),
        first["lit"].to_numpy(dtype=float),
        first["blocked"].to_numpy(dtype=float),
        {at: (block["bias"].iloc[0], block["false_shadow_rate"].to_numpy(dtype=float),
              block["false_lit_rate"].to_numpy(dtype=float)) for at, block in blocks.items()},
    )


def draw(tables):
    """One column per curve: rates above, numbers of pixels below."""
    curves = tables.curves
    figure = style.TitledFigure(TITLE, tables.settings, 5.6)
    titles = style.panel_titles([curve.name for curve in curves], len(curves))
    grid = style.lay_out(figure, top_in=1.25 + style.title_height(titles), nrows=2,
                         ncols=len(curves), hspace=0.12, wspace=0.2, height_ratios=(1.7, 1))
    for column, (curve, title) in enumerate(zip(curves, titles)):
        rates = figure.add_subplot(grid[0, column])
        _draw_rates(rates, curve)
        style.set_rate_scale(rates)
        rates.set_title(title)
        rates.tick_params(labelbottom=False)
        counts = figure.add_subplot(grid[1, column], sharex=rates)
        _draw_counts(counts, curve)
        style.label_columns(counts, column, len(curves), style.LIGHT_DISTANCE_LABEL)
        if column == 0:
            rates.set_ylabel(distance_panels.RATES_LABEL)
            counts.set_ylabel("pixels in a bin")
    style.add_legend(figure, ncol=3, markerscale=1.3)
    return figure


def _draw_rates(axes, curve):
    """Steps at the job's bias, marks in the middle of each bin at the best bias."""
    if "job_bias" in curve.at:
        _, false_shadow, false_lit = curve.at["job_bias"]
        distance_panels.draw_rates(axes, curve.edges, false_shadow, false_lit, ", job's bias")
    if "best_bias" in curve.at:
        _, false_shadow, false_lit = curve.at["best_bias"]
        middle = 0.5 * (curve.edges[1:] + curve.edges[:-1])
        for rate, marker, colour, label in (
            (false_shadow, "o", style.FALSE_SHADOW, "false shadow, best bias"),
            (false_lit, "s", style.FALSE_LIT, "false lit, best bias"),
        ):
            axes.plot(middle, 100 * rate, marker, color=colour, markerfacecolor="none",
                      markersize=4.5, markeredgewidth=1.3, label=label, clip_on=False)


def _draw_counts(axes, curve):
    for count, colour, label in ((curve.lit, style.ORANGE, "lit pixels"),
                                 (curve.blocked, style.GREY, "blocked pixels")):
        axes.stairs(count, curve.edges, color=colour, label=label, linewidth=1.5)
    axes.set_yscale("symlog", linthresh=1, linscale=0.3)
    top = max(curve.lit.max(initial=1), curve.blocked.max(initial=1))
    decades = int(numpy.ceil(numpy.log10(max(top, 2))))
    axes.set_ylim(0, 10.0**decades)
    first = 0 if decades < 3 else 1
    axes.set_yticks([0, *(10.0**power for power in range(first, decades + 1, 1 + first))])
    axes.set_xlim(curve.edges[0], curve.edges[-1])


def words(tables):
    """Title, caption and alternative text."""
    said = []
    for curve in tables.curves:
        text = f"{curve.name}: " if curve.name else ""
        text += f"Light distances from {curve.edges[0]:.3g} to {curve.edges[-1]:.3g} m."
        for at, (bias, false_shadow, false_lit) in curve.at.items():
            worst = [_worst(rate, curve.edges) for rate in (false_shadow, false_lit)]
            text += (f" At the {run_settings.BIASES[at]}, {run_settings.text_of(bias)}, the false-shadow rate is"
                     f" {worst[0]} and the false-lit rate {worst[1]}.")
        said.append(text)
    return TITLE, tables.settings, " ".join(said)


def _worst(rate, edges):
    if numpy.isnan(rate).all():
        return "without a pixel"
    index = int(numpy.nanargmax(rate))
    if rate[index] == 0:
        return "0 everywhere"
    return f"{run_settings.percent(rate[index])} at most, at {edges[index]:.3g} m"
