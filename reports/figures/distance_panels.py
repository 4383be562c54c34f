"""Panels over the distance from the light: rates of wrong pixels, and the map's depth errors."""

import numpy

import style

RATES_LABEL = "wrong pixels [%]"
# A multiple of the usual largest error: a pixel at an edge may be off by the whole scene.
LARGEST_SHOWN = 30
MOST_POWERS = 4  # labelled on each side of 0


def draw_rates(axes, edges, false_shadow_rate, false_lit_rate, suffix="", **line):
    """Both rates in percent, as steps over the bins between `edges` [m]."""
    for rate, colour, label in (
        (false_shadow_rate, style.FALSE_SHADOW, "false shadow, per lit pixel"),
        (false_lit_rate, style.FALSE_LIT, "false lit, per blocked pixel"),
    ):
        axes.stairs(100 * rate, edges, baseline=None, color=colour, label=label + suffix,
                    **{"linewidth": 1.8, **line})


def draw_map_errors(axes, curve):
    """Quantiles of the map's error at the middle of each bin, and the formula's envelope; all [m].

    The scale is logarithmic on both sides of 0 beyond a tenth of the envelope, so that large errors do
    not hide the format's. It is cut at LARGEST_SHOWN times the largest 95 % quantile or envelope, and
    a text gives the largest error.
    """
    usual = max(numpy.nanmax(numpy.abs(curve[name])) for name in ("envelope", "median", "p95"))
    largest = max(numpy.nanmax(curve["max"]), -numpy.nanmin(curve["min"]))
    is_cut = largest > LARGEST_SHOWN * usual
    factor, unit = style.length_unit(usual)
    shown = LARGEST_SHOWN * usual if is_cut else max(usual, 1.3 * largest)
    _set_error_scale(axes, factor * numpy.nanmax(curve["envelope"]), factor * shown)
    if is_cut:
        axes.annotate(f"largest beyond\nthe axis: {style.length_text(largest)}", (0.02, 0.03),
                      xycoords="axes fraction", size=9, color="#444444",
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5}, zorder=5)
    light_distance_m = curve["light_distance_m"]
    axes.fill_between(light_distance_m, factor * curve["min"], factor * curve["max"],
                      color=style.SKY, alpha=0.45, linewidth=0, label="map error, smallest to largest")
    axes.plot(light_distance_m, factor * curve["p95"], color=style.GREEN, linewidth=1.5, linestyle="-.",
              label="95 % are below")
    axes.plot(light_distance_m, factor * curve["median"], color=style.BLACK, linewidth=1.5, label="median")
    axes.plot(curve["upper"], factor * curve["envelope"], color=style.ORANGE,
              label="envelope (formula)")
    axes.plot(curve["upper"], -factor * curve["envelope"], color=style.ORANGE)
    axes.set_xlim(curve["edges"][0], curve["edges"][-1])
    axes.set_ylabel(f"depth error [{unit}]")


def _set_error_scale(axes, envelope, shown):
    """A logarithmic scale for both signs: powers of ten from a tenth of the envelope to `shown`."""
    first = int(numpy.floor(numpy.log10(envelope))) - 1
    last = int(numpy.floor(numpy.log10(shown)))
    axes.set_yscale("symlog", linthresh=10.0**first, linscale=0.6)
    axes.set_ylim(-shown, shown)
    powers = range(last, first - 1, -max(1, -(-(last - first + 1) // MOST_POWERS)))
    ticks = [0, *(sign * 10.0**power for power in powers for sign in (-1, 1))]
    axes.set_yticks(ticks, labels=[f"{tick:g}".replace("-", "−") for tick in ticks])
