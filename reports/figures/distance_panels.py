"""Panels over the distance from the light: rates of wrong pixels, and the map's depth errors."""

import numpy

import style


def draw_rates(axes, edges, false_shadow_rate, false_lit_rate, suffix="", **line):
    """Both rates in percent, as steps over the bins between `edges` [m]."""
    for rate, colour, label in (
        (false_shadow_rate, style.FALSE_SHADOW, "false shadow, per lit pixel"),
        (false_lit_rate, style.FALSE_LIT, "false lit, per blocked pixel"),
    ):
        axes.stairs(100 * rate, edges, baseline=None, color=colour, label=label + suffix,
                    **{"linewidth": 1.8, **line})
    axes.set_ylabel("wrong pixels [%]")


def draw_map_errors(axes, curve, largest_shown=None):
    """Quantiles of the map's error at the middle of each bin, and the formula's envelope; all [m].

    Errors beyond `largest_shown` times the largest that 95 % of a bin or the formula have are cut
    off, and what the largest is, is written.
    """
    usual = max(numpy.nanmax(numpy.abs(curve[name])) for name in ("envelope", "median", "p95"))
    largest = max(numpy.nanmax(curve["max"]), -numpy.nanmin(curve["min"]))
    is_cut = largest_shown is not None and largest > largest_shown * usual
    factor, unit = style.length_unit(usual if is_cut else max(usual, numpy.nanmax(curve["max"])))
    if is_cut:
        axes.set_ylim(*(sign * factor * largest_shown * usual for sign in (-1, 1)))
        axes.annotate(f"largest beyond the axis: {style.length_text(largest)}", (0.02, 0.03),
                      xycoords="axes fraction", size=9, color="#444444",
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5}, zorder=5)
    zeta = curve["zeta"]
    axes.fill_between(zeta, factor * curve["min"], factor * curve["max"], color=style.SKY,
                      alpha=0.45, linewidth=0, label="map error, smallest to largest")
    axes.plot(zeta, factor * curve["p95"], color=style.GREEN, linewidth=1.5, linestyle="-.",
              label="95 % are below")
    axes.plot(zeta, factor * curve["median"], color=style.BLACK, linewidth=1.5, label="median")
    axes.plot(curve["upper"], factor * curve["envelope"], color=style.ORANGE,
              label="envelope (formula)")
    axes.plot(curve["upper"], -factor * curve["envelope"], color=style.ORANGE)
    axes.set_xlim(curve["edges"][0], curve["edges"][-1])
    axes.set_xlabel(style.LIGHT_DISTANCE_LABEL)
    axes.set_ylabel(f"depth error [{unit}]")
