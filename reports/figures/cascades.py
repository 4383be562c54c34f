"""Cascades and a single map of equal memory: texel widths and wrong pixels by view depth."""

import json
from dataclasses import dataclass

import numpy
from gnomon import InputError, read_table
from matplotlib.lines import Line2D

import run_settings
import style

TITLE = "Cascades against one map, by view depth"
DEPTH_LABEL = "view depth, from the eye along the camera's axis [m]"
ERRORS = ("false_shadow", "false_lit", "shadow_amount", "light_amount")
NUMBERS = ("lower_m", "upper_m", "lit", "blocked", *ERRORS, *(f"{name}_rate" for name in ERRORS),
           "texel_m.min", "texel_m.median", "texel_m.max", "shadow_map.resolution")
SAME = ("lower_m", "upper_m", "lit", "blocked")  # for every map
TEXTS = ("shadow_map.layout", "slice_edges_m", "slice_texels_m")
CASCADES_LINE = {"linewidth": 2.0}
ONE_MAP_LINE = {"linewidth": 1.4, "linestyle": (0, (3, 1))}
DIGITS = ((1, 2, 5), (1, 2, 3, 5, 7), range(1, 10), numpy.arange(1, 10, 0.5))  # of ticks, until there are enough
LEAST_TICKS = 4


@dataclass(frozen=True)
class Layout:
    """A table of `gnomon compare --view-depths`."""

    table: object
    slice_edges_m: list  # empty: one map
    slice_texels_m: list

    @property
    def edges_m(self):
        return numpy.append(self.table["lower_m"], self.table["upper_m"].iloc[-1])

    @property
    def name(self):
        """For a legend: "4 cascades of 1024²"."""
        size = f"{self.table['shadow_map.resolution'].iloc[0]:.0f}²"
        count = len(self.slice_texels_m)
        return f"{count} cascades of {size}" if count else f"one map of {size}"

    def rates(self, measure):
        """False shadow and false lit in percent, by `measure`: "counts" or "amounts"."""
        names = ERRORS[:2] if measure == "counts" else ERRORS[2:]
        return [100 * self.table[f"{name}_rate"].to_numpy() for name in names]


@dataclass(frozen=True)
class Tables:
    """The cascades, and optionally a single map to compare with."""

    settings: str
    cascades: Layout
    one_map: Layout | None
    measure: str  # "amounts" where verdicts are fractions, else "counts"


def read(paths):
    """Tables of `gnomon compare --view-depths`: one of cascades, and optionally one of a single map."""
    layouts = [_read_layout(path) for path in paths]
    cascades = [layout for layout in layouts if layout.slice_texels_m]
    one_map = [layout for layout in layouts if not layout.slice_texels_m]
    if len(cascades) != 1 or len(one_map) > 1:
        raise InputError(f"{len(cascades)} tables of cascades and {len(one_map)} of one map given; this figure needs"
                         " one of cascades, and takes one of a single map beside it")
    for path, layout in zip(paths, layouts):
        if not all(layout.table[name].equals(layouts[0].table[name]) for name in SAME):
            raise InputError(f"{path}: other view depths or other truth than in {paths[0]}; compare one camera and one"
                             " light, with as many bands")
    return Tables(_settings(cascades[0], layouts), cascades[0], next(iter(one_map), None),
                  "amounts" if any(map(_has_fractions, layouts)) else "counts")


def _read_layout(path):
    table = read_table(path, NUMBERS, TEXTS)
    edges_m, texels_m = (_read_list(path, table, name) for name in ("slice_edges_m", "slice_texels_m"))
    if len(edges_m) != len(texels_m) + bool(texels_m):
        raise InputError(f"{path}: {len(edges_m)} edges of {len(texels_m)} slices; write it again with gnomon")
    return Layout(table, edges_m, texels_m)


def _read_list(path, table, name):
    """The numbers "[1, 2]" of the first row; none if the cell is empty."""
    try:
        return [float(number) for number in json.loads(table[name].iloc[0] or "[]")]
    except (TypeError, ValueError):
        raise InputError(f"{path}: {name} is not a list of numbers; write it again with gnomon")


def _has_fractions(layout):
    return any((layout.table[count] != layout.table[amount]).any()
               for count, amount in (ERRORS[::2], ERRORS[1::2]))


def _settings(cascades, layouts):
    """The shared settings, and how the view is split."""
    shared = {key: column for key, column in cascades.table.items()
              if all(layout.table[key].equals(column) for layout in layouts)}
    first = cascades.table.iloc[0]
    split = first["shadow_map.split"]
    if split == "practical":
        split += f" (λ = {run_settings.text_of(first['shadow_map.split_lambda'])})"
    return (f"{run_settings.settings_text(type(cascades.table)(shared))}; {split} split,"
            f" {first['shadow_map.cascade_fit']} fit, maps chosen by {first['shadow_map.select'].replace('_', ' ')}")


def draw(tables):
    """Texel widths above, rates below, over a logarithmic axis of view depths."""
    figure = style.TitledFigure(TITLE, tables.settings, 6.0)
    grid = style.lay_out(figure, top_in=1.18, right_in=0.2, nrows=2, ncols=1, hspace=0.1, height_ratios=(1, 1.35))
    widths = figure.add_subplot(grid[0])
    rates = figure.add_subplot(grid[1], sharex=widths)
    _draw_widths(widths, tables)
    _draw_rates(rates, tables)
    widths.set_xscale("log")
    widths.set_xlim(tables.cascades.edges_m[0], tables.cascades.edges_m[-1])
    style.set_ticks(rates, *_round_lengths(*rates.get_xlim()))
    for axes in (widths, rates):
        for edge_m in tables.cascades.slice_edges_m:
            axes.axvline(edge_m, color=style.GREY, linewidth=0.8, linestyle=":", zorder=1)
    _name_slices(widths, tables.cascades)
    widths.tick_params(labelbottom=False)
    rates.set_xlabel(DEPTH_LABEL)
    style.add_legend(figure, ncol=5, entries=_legend(tables))
    return figure


def _legend(tables):
    """Legend handles by label: colours for quantities, line styles for layouts."""
    entries = {"texel width": Line2D([], [], color=style.BLACK, **CASCADES_LINE),
               "false shadow": Line2D([], [], color=style.FALSE_SHADOW, **CASCADES_LINE),
               "false lit": Line2D([], [], color=style.FALSE_LIT, **CASCADES_LINE),
               tables.cascades.name: Line2D([], [], color=style.GREY, **CASCADES_LINE)}
    if tables.one_map:
        entries[tables.one_map.name] = Line2D([], [], color=style.GREY, **ONE_MAP_LINE)
    return entries


def _draw_widths(axes, tables):
    cascades, one_map = tables.cascades, tables.one_map
    table = cascades.table
    if table["shadow_map.select"].iloc[0] == "view_depth":
        axes.stairs(cascades.slice_texels_m, cascades.slice_edges_m, baseline=None, color=style.BLACK,
                    label=cascades.name, **CASCADES_LINE)
    else:  # pixels of one view depth read several maps
        axes.stairs(table["texel_m.max"], cascades.edges_m, baseline=table["texel_m.min"], fill=True,
                    color=style.GREY, alpha=0.35)
        axes.stairs(table["texel_m.median"], cascades.edges_m, baseline=None, color=style.BLACK,
                    label=cascades.name, **CASCADES_LINE)
    if one_map:
        axes.stairs(one_map.table["texel_m.median"], one_map.edges_m, baseline=None, color=style.BLACK,
                    label=one_map.name, **ONE_MAP_LINE)
    axes.set_yscale("log")
    lower_m, upper_m = axes.get_ylim()
    # Leave room below the lines for the ends of slices.
    axes.set_ylim(lower_m / (upper_m / lower_m) ** 0.2, upper_m)
    places_m, texts = _round_lengths(*axes.get_ylim())
    axes.set_yticks(places_m, labels=texts)
    axes.set_yticks([], minor=True)
    axes.set_ylabel("texel width [m]")


def _draw_rates(axes, tables):
    for layout, line in ((tables.cascades, CASCADES_LINE), (tables.one_map, ONE_MAP_LINE)):
        if layout is None:
            continue
        for rate, colour, word in zip(layout.rates(tables.measure), (style.FALSE_SHADOW, style.FALSE_LIT),
                                      ("false shadow", "false lit")):
            axes.stairs(rate, layout.edges_m, baseline=None, color=colour, label=f"{layout.name}: {word}", **line)
    style.set_rate_scale(axes)
    axes.set_ylabel("wrong pixels [%]" if tables.measure == "counts" else "amounts that are wrong [%]")


def _name_slices(axes, cascades):
    """The number of each slice above the middle of its visible part, and its end."""
    lower_m, upper_m = axes.get_xlim()
    edges_m = numpy.clip(cascades.slice_edges_m, lower_m, upper_m)
    for index, (begin_m, end_m) in enumerate(zip(edges_m[:-1], edges_m[1:])):
        if begin_m < end_m:
            axes.annotate(f"slice {index}" if index == 0 else str(index), (numpy.sqrt(begin_m * end_m), 1), (0, 3),
                          xycoords=("data", "axes fraction"), textcoords="offset points", ha="center",
                          color="#444444", size=10)
    for edge_m in cascades.slice_edges_m[1:]:
        if lower_m < edge_m <= upper_m:
            axes.annotate(f"{edge_m:.3g} m", (edge_m, 0), (-3, 4), xycoords=("data", "axes fraction"),
                          textcoords="offset points", ha="right", color="#444444", size=9)


def _round_lengths(lower_m, upper_m):
    """Tick places and texts at round lengths in the range."""
    exponents = numpy.arange(numpy.floor(numpy.log10(lower_m)), numpy.ceil(numpy.log10(upper_m)) + 1)
    for digits in DIGITS:
        places = numpy.outer(10.0**exponents, digits).ravel()
        places = places[(places >= lower_m) & (places <= upper_m)]
        if len(places) >= LEAST_TICKS:
            break
    return places, [f"{place:.6g}" for place in places]
