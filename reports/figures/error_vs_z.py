"""Error against distance for evenly spaced codes, one curve per bit depth: envelope and sawtooth."""

import numpy

import style
import tables as csv_tables

read = csv_tables.read_formulas

COLOURS = (style.VERMILION, style.ORANGE, style.GREEN, style.BLUE, style.PURPLE)
SAMPLES_PER_TOOTH = 6
TEETH_ACROSS = 150  # more of them than this across the axis run into each other
LAST_CODES = 8
DOTS = 240


def data(tables):
    """One series per table, by bits: envelope, teeth if they can be resolved, else dots.

    `last_codes` is the signed error just before far, or empty if there are too few samples.
    All are pairs of arrays (ζ, error) in metres.
    """
    storages = csv_tables.common_frustum(tables)
    series = [_series(table, storage) for table, storage in zip(tables, storages)]
    return sorted(series, key=lambda one: one["bits"])


def _series(table, storage):
    if storage.bits is None:
        raise csv_tables.InputError(
            f"{table.attrs['path']}: codes of a float are not evenly spaced; use --bits"
        )
    light_distance_m = table["zeta_m"].to_numpy()
    envelope = table["envelope_m"].to_numpy()
    error = table["formula_error_m"].to_numpy()
    tooth = 2 * envelope
    spacing = numpy.gradient(light_distance_m)
    is_resolved = tooth >= numpy.maximum(
        SAMPLES_PER_TOOTH * spacing, (storage.far_m - storage.near_m) / TEETH_ACROSS
    )
    first = len(light_distance_m) if not is_resolved.any() else int(is_resolved.argmax())
    dots = numpy.arange(0, first, max(1, len(light_distance_m) // DOTS))
    code = table["formula_code"].to_numpy()
    last = numpy.abs(code - code[-1]) < LAST_CODES
    if last.sum() < LAST_CODES * SAMPLES_PER_TOOTH:
        last[:] = False
    return {
        "bits": storage.bits,
        "name": storage.name,
        "frustum": storage.frustum,
        "envelope": (light_distance_m, envelope),
        "teeth": (light_distance_m[first:], numpy.abs(error[first:])),
        "dots": (light_distance_m[dots], numpy.abs(error[dots])),
        "last_codes": (light_distance_m[last], error[last]),
        "last_envelope": (light_distance_m[last], envelope[last]),
    }


def draw(tables):
    """The full range on a logarithmic axis; below it the last codes of each densely sampled curve."""
    curves = data(tables)
    zoomed = [(curve, colour) for curve, colour in zip(curves, _colours(curves))
              if curve["last_codes"][0].size > 0]
    figure = style.TitledFigure(
        "Error of a stored depth against distance",
        f"{curves[0]['frustum']}; ideal storage, nearest of 2ⁿ evenly spaced codes",
        6.8 if zoomed else 4.6,
    )
    grid = style.lay_out(figure, top_in=0.98, right_in=0.95, nrows=2 if zoomed else 1, ncols=1,
                         height_ratios=(1.75, 1) if zoomed else None, hspace=0.42)
    _draw_all(figure.add_subplot(grid[0]), curves)
    if zoomed:
        row = grid[1].subgridspec(1, len(zoomed), wspace=0.45)
        for column, (curve, colour) in enumerate(zoomed):
            _draw_last_codes(figure.add_subplot(row[column]), curve, colour)
    return figure


def _colours(curves):
    return [COLOURS[index % len(COLOURS)] for index in range(len(curves))]


def _draw_all(axes, curves):
    for curve, colour in zip(curves, _colours(curves)):
        light_distance_m, envelope = curve["envelope"]
        axes.plot(*curve["dots"], ".", color=colour, markersize=2.2, alpha=0.55, zorder=2)
        axes.plot(*curve["teeth"], color=colour, linewidth=0.9, alpha=0.8, zorder=2)
        axes.plot(light_distance_m, envelope, color=colour, zorder=3)
        axes.annotate(curve["name"], (light_distance_m[-1], envelope[-1]), (6, 0), color=colour,
                      textcoords="offset points", va="center", weight="bold", size=10,
                      annotation_clip=False)
    axes.plot([], [], color=style.GREY, label="envelope (formula)")
    axes.plot([], [], color=style.GREY, linewidth=0.9, label="sawtooth")
    axes.plot([], [], ".", color=style.GREY, markersize=4, label="samples of a finer sawtooth")
    axes.set_yscale("log")
    light_distance_m, envelope = curves[0]["envelope"]
    axes.set_xlim(light_distance_m[0], light_distance_m[-1])
    axes.set_ylim(min(curve["envelope"][1][0] for curve in curves) / 12, 2.2 * envelope[-1])
    axes.set_xlabel(style.DISTANCE_LABEL)
    axes.set_ylabel("|error of ζ| [m]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 0.99), ncol=3, columnspacing=1.4,
                handlelength=1.6)


def _draw_last_codes(axes, curve, colour):
    light_distance_m, error = curve["last_codes"]
    envelope = curve["last_envelope"][1]
    factor, unit = style.length_unit(envelope[-1])
    axes.plot(light_distance_m, factor * error, color=colour, linewidth=1.1)
    for sign in (-1, 1):
        axes.plot(light_distance_m, sign * factor * envelope, color=style.GREY, linewidth=1.2)
    axes.set_xlim(light_distance_m[0], light_distance_m[-1])
    axes.locator_params(axis="x", nbins=3)
    axes.ticklabel_format(axis="x", useOffset=False)
    axes.set_title(f"{curve['name']}: the last {LAST_CODES} codes", color=colour, size=10)
    axes.set_xlabel("ζ [m]")
    axes.set_ylabel(f"error of ζ [{unit}]", labelpad=2)
