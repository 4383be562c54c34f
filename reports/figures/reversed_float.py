"""The effect of reversed depth on float32: the formula's error and GL's, standard and reversed."""

import numpy

import style
import tables as csv_tables

read = csv_tables.read_measured

COLOURS = (style.ORANGE, style.BLUE, style.VERMILION, style.GREEN, style.PURPLE)


def data(tables):
    """One series per table: the envelope, the formula's and GL's |error|, all [m] over ζ [m]."""
    storages = csv_tables.common_frustum(tables)
    return [
        {
            "name": storage.name,
            "frustum": storage.frustum,
            "light_distance_m": table["zeta_m"].to_numpy(),
            "envelope": table["envelope_m"].to_numpy(),
            "formula": numpy.abs(table["formula_error_m"].to_numpy()),
            "measured": numpy.abs(table["error_m"].to_numpy()),
        }
        for table, storage in zip(tables, storages)
    ]


def draw(tables):
    """The format's limit on the left, GL's stored depths on the right, on the same axes."""
    curves = data(tables)
    storage = csv_tables.storage_of(tables[0])
    figure = style.TitledFigure(
        "Reversed depth makes float32 precise far away",
        f"{storage.frustum}; {len(curves[0]['light_distance_m']):,} planes; lines: envelope, dots: |error|",
        4.6,
    )
    grid = style.lay_out(figure, top_in=1.15, nrows=1, ncols=2, wspace=0.08)
    formula = figure.add_subplot(grid[0])
    measured = figure.add_subplot(grid[1], sharex=formula, sharey=formula)
    for curve, colour in zip(curves, COLOURS):
        _draw_panel(formula, curve, "formula", colour)
        _draw_panel(measured, curve, "measured", colour)
    _set_axes(formula, curves)
    _mark_float_limit(formula, storage)
    formula.set_title("ideal storage (formula)")
    measured.set_title("as GL stored it (measured)")
    measured.tick_params(labelleft=False)
    style.add_legend(figure, ncol=len(curves))
    return figure


def _draw_panel(axes, curve, which, colour):
    axes.plot(curve["light_distance_m"], curve[which], ".", color=colour, markersize=2, alpha=0.45, zorder=2)
    axes.plot(curve["light_distance_m"], curve["envelope"], color=colour, zorder=3, label=curve["name"])


def _set_axes(axes, curves):
    largest = max(max(curve["measured"].max(), curve["envelope"].max()) for curve in curves)
    # The envelope of reversed floats ends at 0, which a logarithmic axis cannot show.
    smallest = min(curve["envelope"][0] for curve in curves)
    axes.set_xlim(curves[0]["light_distance_m"][0], curves[0]["light_distance_m"][-1])
    axes.set_yscale("log")
    axes.set_ylim(smallest / 40, 2.5 * largest)
    axes.set_ylabel("|error of ζ| [m]")
    for panel in axes.figure.axes:
        panel.set_xlabel("distance ζ [m]")


def _mark_float_limit(axes, storage):
    """The distance beyond which float32 is coarser than 24 bits: docs/depth_precision.md#float32."""
    limit_m = 2 * storage.near_m * storage.far_m / (storage.near_m + storage.far_m)
    axes.axvline(limit_m, color=style.GREY, linewidth=1, linestyle="--")
    axes.annotate(f"from {limit_m:.2f} m on float32\nis no finer than 24 bits", (limit_m, 0.03),
                  (5, 0), xycoords=("data", "axes fraction"), textcoords="offset points", size=9,
                  color="#444444", bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5})
