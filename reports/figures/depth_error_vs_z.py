"""Errors of stored depths by distance from the light, and the formula's share."""

from dataclasses import dataclass

import numpy

import distance_panels
import run_settings
import style

TITLE = "Error of the shadow map's depths by distance from the light"
COLUMNS = {"min": "map_error_m.min", "median": "map_error_m.median", "p95": "map_error_m.p95",
           "max": "map_error_m.max", "envelope": "envelope_m", "upper": "upper_m"}


@dataclass(frozen=True)
class Tables:
    """The curves to draw, dictionaries of arrays [m], and the settings that they share."""

    settings: str
    curves: list


def read(run):
    """The maps of a run; only the best configuration's of a large one."""
    rows = run_settings.done(run)
    bins = run.error_vs_z
    measured = bins.dropna(subset=["map_error_m.median", "envelope_m"])["curve"]
    rows = rows[rows["curve"].isin(measured)].reset_index(drop=True)
    if rows.empty:
        raise run_settings.DoesNotApply(f"{run.folder}: no depth errors by distance")
    chosen, why = run_settings.curves_of(run, rows)
    titles = run_settings.panel_titles(run, rows, chosen)
    settings = run_settings.settings_text(chosen.drop(columns=list(run_settings.CONSTANT_BIASES)))
    curves = [_curve(bins[bins["curve"] == curve], title)
              for curve, title in zip(chosen["curve"], titles)]
    return Tables("; ".join(filter(None, (settings, why))), curves)


def _curve(bins, name):
    first = bins.iloc[0]
    block = bins[(bins["at"] == first["at"]) & (bins["bias"] == first["bias"])]
    return {
        "name": name,
        "light_distance_m": 0.5 * (block["lower_m"] + block["upper_m"]).to_numpy(),
        "edges": numpy.append(block["lower_m"], block["upper_m"].iloc[-1]),
        **{key: block[column].to_numpy(dtype=float) for key, column in COLUMNS.items()},
    }


def draw(tables):
    """One column per map."""
    figure = style.TitledFigure(TITLE, tables.settings, 4.6)
    count = len(tables.curves)
    titles = style.panel_titles([curve["name"] for curve in tables.curves], count)
    grid = style.lay_out(figure, top_in=1.0 + style.title_height(titles), nrows=1, ncols=count,
                         wspace=0.42)
    for column, (curve, title) in enumerate(zip(tables.curves, titles)):
        axes = figure.add_subplot(grid[column])
        distance_panels.draw_map_errors(axes, curve)
        style.label_columns(axes, column, count, style.LIGHT_DISTANCE_LABEL)
        axes.set_title(title)
    style.add_legend(figure, ncol=4)
    return figure


def words(tables):
    """Title, caption and alternative text."""
    said = []
    for curve in tables.curves:
        largest = max(numpy.nanmax(curve["max"]), -numpy.nanmin(curve["min"]))
        text = f"{curve['name']}: " if curve["name"] else ""
        said.append(
            f"{text}Stored depths are off by {style.length_text(largest)} at most, between"
            f" {curve['edges'][0]:.3g} and {curve['edges'][-1]:.3g} m from the light, and 95 % of a"
            f" bin by less than {style.length_text(numpy.nanmax(curve['p95']))}; the format alone"
            f" may be off by {style.length_text(numpy.nanmax(curve['envelope']))}."
        )
    return TITLE, tables.settings, " ".join(said)
