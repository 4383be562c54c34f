"""False-shadow and false-lit rate at every constant bias, with the important biases marked."""

import itertools
from dataclasses import dataclass

import numpy
import pandas

import run_settings
import style

TITLE = "Wrong pixels at every constant bias"
DECADES_SHOWN = 9  # at most, on each side of zero


@dataclass(frozen=True)
class Curve:
    """A bias curve: rates in [0, 1] over constant biases [depth units], and its marked biases."""

    name: str
    bias: numpy.ndarray
    false_shadow_rate: numpy.ndarray
    false_lit_rate: numpy.ndarray
    job_bias: float  # NaN where no configuration has it
    swept: numpy.ndarray  # biases of the sweep, where it has several
    best: tuple  # from, to
    best_errors: float
    acne_free: float
    panning_free: float


@dataclass(frozen=True)
class Tables:
    """The curves to draw, and the settings that they share."""

    settings: str
    curves: list


def read(run):
    """The curves of a run; only the best of a large one."""
    rows = run_settings.done(run)
    rows = rows[rows["bias_source"] == "curve"].reset_index(drop=True)
    if rows.empty:
        raise run_settings.DoesNotApply(f"{run.folder}: no configuration has a bias curve")
    chosen, why = run_settings.curves_of(run, rows)
    titles = run_settings.panel_titles(run, rows, chosen)
    settings = run_settings.settings_text(chosen.drop(columns=list(run_settings.CONSTANT_BIASES)))
    curves = [_curve(run, rows, row, title) for (_, row), title in zip(chosen.iterrows(), titles)]
    job_biases = [curve.job_bias for curve in curves if numpy.isfinite(curve.job_bias)]
    return Tables("; ".join(filter(None, (
        settings, run_settings.biases_text("job's bias", job_biases), why))), curves)


def _curve(run, rows, row, name):
    points = run.curve_of(row)
    bins = run.error_vs_z
    at_job = bins[(bins["curve"] == row["curve"]) & (bins["at"] == "job_bias")]["bias"]
    job_bias = at_job.iloc[0] if len(at_job) else row["bias.constant"]
    swept = rows.loc[rows["curve"] == row["curve"], "bias.constant"].dropna().unique()
    return Curve(
        name,
        *(points[key].to_numpy(dtype=float)
          for key in ("bias", "false_shadow_rate", "false_lit_rate")),
        job_bias=job_bias if run_settings.has_bias(rows, row["curve"], job_bias) else numpy.nan,
        swept=numpy.sort(swept.astype(float)) if len(swept) > 1 else numpy.array([]),
        best=(row["bias_curve.best_interval.lo"], row["bias_curve.best_interval.hi"]),
        best_errors=row["bias_curve.best_errors"],
        acne_free=row["bias_curve.acne_free"],
        panning_free=row["bias_curve.panning_free"],
    )


def is_sampled(curve):
    """Whether GL measured each point (docs/bias_curve.md#bisection); the curve between them is unknown."""
    ladder = (1e-6 * 10.0 ** (numpy.arange(25) / 4)).astype(numpy.float32)
    return bool(numpy.isin(ladder, curve.bias.astype(numpy.float32)).all())


def threshold(curve):
    """The power of ten below which the bias scale is linear."""
    marked = numpy.abs([curve.job_bias, *curve.best, curve.acne_free, curve.panning_free])
    sizes = numpy.concatenate([numpy.abs(curve.bias), marked])
    sizes = sizes[numpy.isfinite(sizes) & (sizes > 0)]
    if len(sizes) == 0:
        return 1e-6
    smallest = numpy.quantile(sizes, 0.1)
    marked = marked[numpy.isfinite(marked) & (marked > 0)]
    smallest = min(smallest, marked.min()) if len(marked) else smallest
    largest = sizes.max()
    return 10.0 ** numpy.floor(numpy.log10(max(smallest, largest * 10.0**-DECADES_SHOWN)))


@dataclass(frozen=True)
class BiasScale:
    """The bias axis of all panels: linear below a threshold, and its ends [depth units]."""

    linear: float
    low: float
    high: float


def marked_biases(curve):
    """The biases of a curve that lines and the band mark."""
    marked = (curve.job_bias, *curve.best, curve.acne_free, curve.panning_free)
    return [bias for bias in marked if numpy.isfinite(bias)]


def scale_of(curves):
    """One scale that shows every curve and its marked biases."""
    linear = min(threshold(curve) for curve in curves)
    marked = [bias for curve in curves for bias in marked_biases(curve)]
    largest = max(curve.bias.max(initial=linear) for curve in curves)
    return BiasScale(linear, min([-3 * linear, *(3 * bias for bias in marked if bias < 0)]),
                     1.6 * max(largest, *marked, linear))


def draw(tables):
    """One row per curve, all on one scale."""
    curves = tables.curves
    scale = scale_of(curves)
    figure = style.TitledFigure(TITLE, tables.settings, 1.85 + 2.75 * len(curves))
    titles = style.panel_titles([curve.name for curve in curves], 1)
    grid = style.lay_out(figure, left_in=1.0, top_in=1.3 + style.title_height(titles),
                         nrows=len(curves), ncols=1, hspace=0.42)
    for row, (curve, title) in enumerate(zip(curves, titles)):
        axes = figure.add_subplot(grid[row])
        _draw(axes, curve, scale)
        axes.set_title(title)
    axes.set_xlabel("constant bias [depth units]")
    style.add_legend(figure, ncol=3, markerscale=1)
    return figure


def _draw(axes, curve, scale):
    between = "default" if is_sampled(curve) else "steps-post"
    for rate, colour, label in (
        (curve.false_shadow_rate, style.FALSE_SHADOW, "false shadow, per lit pixel"),
        (curve.false_lit_rate, style.FALSE_LIT, "false lit, per blocked pixel"),
    ):
        axes.plot(curve.bias, 100 * rate, color=colour, label=label, drawstyle=between)
    axes.axvspan(*curve.best, color=style.GREEN, alpha=0.35, linewidth=2, zorder=1,
                 label="fewest errors")
    for bias, line, colour, label in (
        (curve.job_bias, "-", style.BLACK, "the job's bias"),
        (curve.acne_free, "--", style.FALSE_SHADOW, "no acne from here"),
        (curve.panning_free, ":", style.FALSE_LIT, "no false light below"),
    ):
        if numpy.isfinite(bias):
            axes.axvline(bias, color=colour, linestyle=line, linewidth=1.5, label=label, zorder=1.5)
    axes.set_xscale("symlog", linthresh=scale.linear, linscale=0.4)
    axes.set_xlim(scale.low, scale.high)
    style.set_rate_scale(axes)
    _set_ticks(axes, scale.linear)
    if len(curve.swept):
        axes.plot(curve.swept, numpy.full(len(curve.swept), 0.016), "|", color=style.BLACK,
                  transform=axes.get_xaxis_transform(), markersize=8, markeredgewidth=1.2,
                  label="biases of the sweep")
    axes.set_ylabel("wrong pixels [%]")


def _set_ticks(axes, linear):
    """Zero and powers of ten, as many as fit."""
    limits = axes.get_xlim()
    low, high = (numpy.floor(numpy.log10(max(linear, abs(limit)))) for limit in limits)
    first = numpy.log10(linear)
    lefts = [[low], []] if limits[0] <= -(10.0**low) else [[]]
    for step in range(1, max(2, int(high - first) + 1)):
        # The first powers may be too close to zero.
        for start, left in itertools.product((first - 0.5, first + 0.5), lefts):
            right = numpy.arange(high, start, -step)[::-1]
            places = [*(-(10.0**power) for power in left), 0, *10.0**right]
            texts = [*(style.power_of_ten(power, -1) for power in left), "0",
                     *(style.power_of_ten(power) for power in right)]
            if style.fit(axes, places, texts):
                axes.set_xticks(places, labels=texts)
                return


def words(tables):
    """Title, caption and alternative text."""
    said = [
        f"False-shadow and false-lit rate over the constant bias, {len(tables.curves)}"
        f" {'curve' if len(tables.curves) == 1 else 'curves'}."
    ]
    for curve in tables.curves:
        text = f"{curve.name}: " if curve.name else ""
        if pandas.notna(curve.best_errors):
            text += (f"Fewest errors, {curve.best_errors:.0f}, from bias"
                     f" {run_settings.text_of(curve.best[0])} to {run_settings.text_of(curve.best[1])};")
        shown = curve.false_shadow_rate[curve.bias <= curve.job_bias]
        lit = curve.false_lit_rate[curve.bias <= curve.job_bias]
        if len(shown):
            text += (f" at the job's bias {run_settings.text_of(curve.job_bias)}"
                     f" {run_settings.percent(shown[-1])} of the lit pixels are falsely in shadow and"
                     f" {run_settings.percent(lit[-1])} of the blocked falsely lit;")
        for bias, name in ((curve.acne_free, "no acne from"),
                           (curve.panning_free, "no false light below")):
            if numpy.isfinite(bias):
                text += f" {name} {run_settings.text_of(bias)};"
        said.append(text.rstrip(";") + ".")
    return TITLE, tables.settings, " ".join(said)
