"""Pixels as the shadow map shows them at growing constant biases: acne, then false light."""

from dataclasses import dataclass

import numpy
from gnomon import CLASSES, InputError, read_table
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

import run_settings
import style

TITLE = "Shadow acne at zero bias, and its disappearance"
PANELS = 4
# Indexed by the codes of `shown`.
LOOKS = (
    ("not scored", "#BBBBBB"),
    ("lit", "#FFFFFF"),
    ("in shadow", "#555555"),
    ("false shadow", style.FALSE_SHADOW),
    ("false lit", style.FALSE_LIT),
)
NOT_SCORED, LIT, SHADOWED, FALSE_SHADOW, FALSE_LIT = range(len(LOOKS))


@dataclass(frozen=True)
class Tables:
    """An image at several biases [depth units]: its codes, (height, width), and both rates."""

    settings: str
    panels: list  # (bias, codes, false_shadow_rate, false_lit_rate)


def read(paths):
    """One crop of an image's layers with `class` and `critical_bias`."""
    if len(paths) != 1:
        raise InputError(f"{len(paths)} files given; this figure needs one crop of an image")
    table = read_table(paths[0], ("x_px", "y_px", "class", "critical_bias"))
    classes = image_of(table, "class", paths[0])
    critical = image_of(table, "critical_bias", paths[0])
    is_lit, is_blocked = (classes == CLASSES.index(name) for name in ("lit", "blocked"))
    if not is_lit.any():
        raise InputError(f"{paths[0]}: no lit pixel; crop another part of the image")
    panels = []
    for bias in biases(critical[is_lit]):
        shows_lit = critical <= bias
        codes = numpy.full(classes.shape, NOT_SCORED)
        codes[is_lit] = numpy.where(shows_lit, LIT, FALSE_SHADOW)[is_lit]
        codes[is_blocked] = numpy.where(shows_lit, FALSE_LIT, SHADOWED)[is_blocked]
        with numpy.errstate(invalid="ignore"):
            panels.append((bias, codes, (codes == FALSE_SHADOW).sum() / is_lit.sum(),
                           numpy.divide((codes == FALSE_LIT).sum(), is_blocked.sum())))
    settings = run_settings.settings_text(table.drop(columns=["bias.constant"], errors="ignore"))
    height, width = classes.shape
    return Tables(f"{settings}; {width} × {height} px of the image", panels)


def image_of(table, name, path):
    """A column of a crop, (height, width); InputError if its pixels do not form a rectangle."""
    columns, rows = (table[key].astype(int) for key in ("x_px", "y_px"))
    shape = (rows.max() - rows.min() + 1, columns.max() - columns.min() + 1)
    places = ((rows - rows.min()) * shape[1] + columns - columns.min()).to_numpy()
    if len(table) != shape[0] * shape[1] or len(numpy.unique(places)) != len(table):
        raise InputError(f"{path}: its pixels do not form a rectangle; write the crop again")
    image = numpy.empty(len(table))
    image[places] = table[name]
    return image.reshape(shape)


def biases(critical):
    """Zero, then biases with one digit, up to one that removes nearly all acne."""
    finite = critical[numpy.isfinite(critical) & (critical > 0)]
    if len(finite) == 0:
        return [0.0]
    # From the bias that removes half of the acne to the one that leaves a thousandth.
    first, last = (numpy.quantile(finite, share) for share in (0.5, 0.999))
    steps = numpy.geomspace(first, max(last, 1.001 * first), PANELS - 1)
    return [0.0, *(float(f"{step:.1g}") for step in steps)]


def draw(tables):
    """Two by two panels, pixel by pixel."""
    height, width = tables.panels[0][1].shape
    columns = 2
    count = -(-len(tables.panels) // columns)
    panel_in = (style.WIDTH_IN - 0.6) / columns
    figure = style.TitledFigure(TITLE, tables.settings,
                                1.0 + count * (panel_in * height / width + 0.45))
    grid = style.lay_out(figure, left_in=0.15, right_in=0.15, bottom_in=0.15, top_in=1.1,
                         nrows=count, ncols=columns, wspace=0.05, hspace=0.16)
    colours = ListedColormap([colour for _, colour in LOOKS])
    for index, (bias, codes, false_shadow, false_lit) in enumerate(tables.panels):
        axes = figure.add_subplot(grid[index // columns, index % columns])
        axes.imshow(codes, cmap=colours, vmin=-0.5, vmax=len(LOOKS) - 0.5, interpolation="nearest")
        axes.set_title(f"bias {run_settings.text_of(bias)}: false shadow"
                       f" {run_settings.percent(false_shadow)}, false lit"
                       f" {run_settings.percent(false_lit)}", size=10)
        axes.set(xticks=[], yticks=[])
        axes.grid(False)
        axes.spines[:].set_visible(True)
    height_in = figure.get_size_inches()[1]
    figure.legend([Patch(facecolor=colour, edgecolor="#444444", linewidth=0.6)
                   for _, colour in LOOKS], [name for name, _ in LOOKS], loc="upper center",
                  ncol=len(LOOKS), bbox_to_anchor=(0.5, 1 - (0.55 + figure.added_in) / height_in),
                  handlelength=1.2, columnspacing=1.4)
    return figure
