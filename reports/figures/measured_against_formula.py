"""GL's stored depths against the formula: errors within the envelope, and what is left over."""

import style
import tables as csv_tables

read = csv_tables.read_measured


def data(tables):
    """One series a table, all [m] over ζ [m]: GL's error, the envelope, the bound of the driver
    model, the residual (GL's error less the formula's) and the vertex transform's share of it.
    """
    storages = csv_tables.common_frustum(tables)
    return [
        {
            "name": storage.name,
            "frustum": storage.frustum,
            "zeta": table["zeta_m"].to_numpy(),
            "error": table["error_m"].to_numpy(),
            "envelope": table["envelope_m"].to_numpy(),
            "model": table["model_m"].to_numpy(),
            "residual": (table["error_m"] - table["formula_error_m"]).to_numpy(),
            "transform": table["transform_error_m"].to_numpy(),
        }
        for table, storage in zip(tables, storages)
    ]


def draw(tables):
    """A column a table: errors above, residuals below."""
    curves = data(tables)
    figure = style.new_figure(
        "Depth as GL stores it, against the formula",
        f"{curves[0]['frustum']}; {len(curves[0]['zeta']):,} planes that face the camera",
        6.0,
    )
    grid = style.lay_out(figure, top_in=1.45, nrows=2, ncols=len(curves), hspace=0.12,
                         wspace=0.28, height_ratios=(1.5, 1))
    for column, curve in enumerate(curves):
        errors = figure.add_subplot(grid[0, column])
        residuals = figure.add_subplot(grid[1, column], sharex=errors)
        factor, unit = style.length_unit(curve["model"].max())
        _draw_errors(errors, curve, factor)
        _draw_residuals(residuals, curve, factor)
        errors.set_ylabel(f"error of ζ [{unit}]")
        residuals.set_ylabel(f"residual [{unit}]")
    _add_legend(figure)
    return figure


def _draw_errors(axes, curve, factor):
    zeta = curve["zeta"]
    axes.plot(zeta, factor * curve["error"], ".", color=style.BLUE, markersize=2, alpha=0.5,
              label="GL's error (measured)")
    for name, colour, dashes, label in (
        ("envelope", style.VERMILION, "-", "envelope (formula)"),
        ("model", style.BLACK, "--", "bound of the driver model"),
    ):
        axes.plot(zeta, factor * curve[name], dashes, color=colour, linewidth=1.5, label=label)
        axes.plot(zeta, -factor * curve[name], dashes, color=colour, linewidth=1.5)
    axes.set_xlim(zeta[0], zeta[-1])
    axes.set_title(curve["name"])
    axes.tick_params(labelbottom=False)


def _draw_residuals(axes, curve, factor):
    axes.plot(curve["zeta"], factor * curve["residual"], ".", color=style.GREEN, markersize=2.5,
              alpha=0.6, label="residual: measured − formula")
    axes.plot(curve["zeta"], factor * curve["transform"], ".", color=style.ORANGE, markersize=2,
              alpha=0.6, label="vertex transform's share")
    axes.set_xlabel("distance ζ [m]")


def _add_legend(figure):
    entries = {}
    for axes in figure.axes:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    height_in = figure.get_size_inches()[1]
    figure.legend(entries.values(), entries.keys(), loc="upper center", ncol=3, markerscale=4,
                  bbox_to_anchor=(0.5, 1 - 0.55 / height_in), handlelength=1.6)
