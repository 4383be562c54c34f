"""A constant tolerance in metres against the sawtooth of stored depths: too large near, too small far."""

from dataclasses import dataclass

import numpy

import style
import tables as csv_tables
from gnomon import InputError, read_table

TITLE = "A constant tolerance against the error of a stored depth"
CODES = 8
SAMPLES_PER_CODE = 8  # fewer draw no tooth
DOTS = 600


@dataclass(frozen=True)
class Tables:
    """The curves, with distances ζ and errors in metres.

    `dots` and `envelope` are pairs of arrays from near to far. `details` has (title, ζ, signed error, envelope)
    for places where single codes are sampled. `exceeded_from` is the distance from which the envelope exceeds
    the tolerance, None if it never does.
    """

    settings: str
    tolerance: float
    exceeded_from: float | None
    dots: tuple
    envelope: tuple
    details: list


def read(paths):
    """One table of `gnomon depth --theory-only --bits B --tolerance T --csv`."""
    if len(paths) != 1:
        raise InputError(f"{len(paths)} files given; this figure needs one table of gnomon depth")
    (path,) = paths
    (table,) = csv_tables.read_formulas(paths)
    tolerance = read_table(path, ("tolerance_m",))["tolerance_m"].iloc[0]
    storage = csv_tables.storage_of(table)
    if storage.bits is None:
        raise InputError(f"{path}: codes of a float are not evenly spaced; use --bits")
    light_distance_m, error, envelope = (table[name].to_numpy()
                                         for name in ("zeta_m", "formula_error_m", "envelope_m"))
    beyond = numpy.flatnonzero(envelope > tolerance)
    first = beyond[0] if beyond.size else None
    places = [("near", 0)]
    if first is not None and 0 < first < len(light_distance_m) - 1:
        places.append(("where it begins to fail", first))
    places.append(("far", len(light_distance_m) - 1))
    details = [_detail(table, name, index) for name, index in places]
    details = [detail for detail in details if detail is not None]
    if not details:
        raise InputError(f"{path}: no place where single codes are sampled; was it written with"
                         " --theory-only?")
    # Even in distance, as the detailed places have many rows.
    evenly_m = numpy.linspace(light_distance_m[0], light_distance_m[-1], DOTS)
    every = numpy.unique(numpy.searchsorted(light_distance_m, evenly_m))
    return Tables(
        f"{storage.frustum}; ideal storage, {storage.bits} bits, evenly spaced codes;"
        f" tolerance {style.length_text(tolerance)}",
        tolerance, None if first is None else light_distance_m[first],
        (light_distance_m[every], numpy.abs(error[every])), (light_distance_m, envelope), details)


def _detail(table, name, index):
    """The codes around a row, or None if they are not sampled one by one."""
    code = table["formula_code"].to_numpy()
    middle = numpy.clip(code[index], code.min() + CODES / 2, code.max() - CODES / 2)
    around = numpy.abs(code - middle) <= CODES / 2
    if around.sum() < CODES * SAMPLES_PER_CODE:
        return None
    light_distance_m, error, envelope = (table[key].to_numpy()[around]
                                         for key in ("zeta_m", "formula_error_m", "envelope_m"))
    return name, light_distance_m, error, envelope


def draw(tables):
    """The whole range on a logarithmic axis; below it signed errors of single codes."""
    figure = style.TitledFigure(TITLE, tables.settings, 6.6)
    grid = style.lay_out(figure, top_in=0.98, nrows=2, ncols=1, height_ratios=(1.5, 1), hspace=0.5)
    _draw_range(figure.add_subplot(grid[0]), tables)
    row = grid[1].subgridspec(1, len(tables.details), wspace=0.42)
    for column, detail in enumerate(tables.details):
        _draw_detail(figure.add_subplot(row[column]), detail, tables.tolerance)
    style.add_legend(figure, ncol=4)
    return figure


def _draw_range(axes, tables):
    light_distance_m, envelope = tables.envelope
    axes.fill_between(light_distance_m, tables.tolerance, envelope, where=envelope > tables.tolerance,
                      color=style.VERMILION, alpha=0.15, linewidth=0,
                      label="errors that it does not cover")
    axes.plot(*tables.dots, ".", color=style.SKY, markersize=2.5, label="|error|, samples")
    axes.plot(light_distance_m, envelope, color=style.VERMILION, label="envelope (formula)")
    axes.axhline(tables.tolerance, color=style.BLUE, label="tolerance")
    if tables.exceeded_from is not None:
        axes.axvline(tables.exceeded_from, color=style.BLUE, linewidth=1, linestyle=":")
    axes.set_yscale("log")
    axes.set_xlim(light_distance_m[0], light_distance_m[-1])
    axes.set_ylim(0.1 * min(envelope[0], tables.tolerance), 2.2 * max(envelope[-1], tables.tolerance))
    axes.set_xlabel(style.DISTANCE_LABEL)
    axes.set_ylabel("|error of ζ| [m]")


def _draw_detail(axes, detail, tolerance):
    name, light_distance_m, error, envelope = detail
    factor, unit = style.length_unit(max(envelope[-1], tolerance))
    middle = 0 if name == "near" else -1 if name == "far" else len(light_distance_m) // 2
    centre = light_distance_m[middle]
    along, along_unit = style.length_unit(light_distance_m[-1] - light_distance_m[0])
    offset = along * (light_distance_m - centre)
    axes.plot(offset, factor * error, color=style.SKY, linewidth=1.2)
    for sign in (-1, 1):
        axes.fill_between(offset, sign * factor * tolerance, factor * error,
                          where=sign * error > tolerance, color=style.VERMILION, alpha=0.35,
                          linewidth=0, interpolate=True)
        axes.plot(offset, sign * factor * envelope, color=style.VERMILION, linewidth=1.2)
        axes.axhline(sign * factor * tolerance, color=style.BLUE, linewidth=1.4)
    limit = 1.25 * factor * max(envelope[-1], tolerance)
    axes.set_ylim(-limit, limit)
    axes.set_xlim(offset[0], offset[-1])
    axes.locator_params(axis="x", nbins=4)
    axes.set_title(name, size=10)
    axes.set_xlabel(f"ζ − {centre:.4g} m [{along_unit}]")
    axes.set_ylabel(f"error of ζ [{unit}]", labelpad=2)
