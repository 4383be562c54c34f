"""GL's stored depths against the formula: errors within the envelope, and residuals."""

import numpy

import style
import tables as csv_tables

read = csv_tables.read_measured


def data(tables):
    """One series per table, all [m] over ζ [m]: GL's error, the envelope, the bound of the driver
    model, the residual (GL's error less the formula's) and the vertex transform's share of it.
    """
    storages = csv_tables.common_frustum(tables)
    return [
        {
            "name": storage.name,
            "frustum": storage.frustum,
            "light_distance_m": table["zeta_m"].to_numpy(),
            "error": table["error_m"].to_numpy(),
            "envelope": table["envelope_m"].to_numpy(),
            "model": table["model_m"].to_numpy(),
            "residual": (table["error_m"] - table["formula_error_m"]).to_numpy(),
            "transform": table["transform_error_m"].to_numpy(),
        }
        for table, storage in zip(tables, storages)
    ]


def draw(tables):
    """One column per table: errors above, residuals below."""
    curves = data(tables)
    figure = style.TitledFigure(
        "Depth as GL stores it, against the formula",
        f"{curves[0]['frustum']}; {len(curves[0]['light_distance_m']):,} planes",
        6.0,
    )
    grid = style.lay_out(figure, top_in=1.35, nrows=2, ncols=len(curves), hspace=0.12,
                         wspace=0.28, height_ratios=(1.5, 1))
    for column, curve in enumerate(curves):
        errors = figure.add_subplot(grid[0, column])
        residuals = figure.add_subplot(grid[1, column], sharex=errors)
        _draw_errors(errors, curve)
        _draw_residuals(residuals, curve)
    style.add_legend(figure, ncol=3)
    return figure


def _draw_errors(axes, curve):
    light_distance_m = curve["light_distance_m"]
    axes.plot(light_distance_m, numpy.abs(curve["error"]), ".", color=style.BLUE, markersize=2.2, alpha=0.6,
              label="GL's |error| (measured)")
    axes.plot(light_distance_m, curve["envelope"], color=style.VERMILION, label="envelope (formula)")
    axes.plot(light_distance_m, curve["model"], color=style.BLACK, linewidth=1,
              label="bound of the driver model")
    axes.set_xlim(light_distance_m[0], light_distance_m[-1])
    axes.set_yscale("log")
    axes.set_ylim(curve["envelope"].min() / 20, 2 * curve["model"].max())
    axes.set_ylabel("|error of ζ| [m]")
    axes.set_title(curve["name"])
    axes.tick_params(labelbottom=False)


def _draw_residuals(axes, curve):
    factor, unit = style.length_unit(numpy.abs(curve["residual"]).max())
    axes.plot(curve["light_distance_m"], factor * curve["transform"], ".", color=style.ORANGE, markersize=2.2,
              alpha=0.6, label="vertex transform's share")
    axes.plot(curve["light_distance_m"], factor * curve["residual"], ".", color=style.GREEN, markersize=2.2,
              alpha=0.7, label="residual: measured − formula")
    axes.set_ylabel(f"residual [{unit}]")
    axes.set_xlabel("distance ζ [m]")
