"""How every figure looks: sizes, colours that any colour vision can tell apart, files."""

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

# Okabe and Ito's colours; their yellow is too light for lines on white.
BLACK = "#000000"
ORANGE = "#E69F00"
SKY = "#56B4E9"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILION = "#D55E00"
PURPLE = "#CC79A7"
GREY = "#777777"

WIDTH_IN = 8.0
PNG_DPI = 150
PNG_COLOURS = 96

RC = {
    "font.family": "DejaVu Sans",
    "font.size": 11,
    "axes.titlesize": 11,
    "axes.labelsize": 11,
    "axes.edgecolor": "#444444",
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.7,
    "legend.fontsize": 10,
    "legend.frameon": False,
    "lines.linewidth": 1.8,
    "xtick.labelsize": 10,
    "ytick.labelsize": 10,
    "svg.hashsalt": "gnomon",
}

DISTANCE_LABEL = "distance ζ from the camera's plane [m]"


def new_figure(title, settings, height_in):
    """An empty figure with its title, and under it the settings that it was measured with."""
    figure = Figure(figsize=(WIDTH_IN, height_in))
    figure.text(0.012, 1 - 0.10 / height_in, title, size=13, weight="bold", va="top")
    figure.text(0.012, 1 - 0.36 / height_in, settings, size=10, color="#444444", va="top")
    return figure


def lay_out(figure, left_in=0.85, right_in=0.15, bottom_in=0.55, top_in=1.0, **spacing):
    """Margins in inches, so that figures of any height agree."""
    width_in, height_in = figure.get_size_inches()
    return figure.add_gridspec(
        left=left_in / width_in,
        right=1 - right_in / width_in,
        bottom=bottom_in / height_in,
        top=1 - top_in / height_in,
        **spacing,
    )


def add_legend(figure, ncol):
    """One legend for all panels, under the settings; each label once."""
    entries = {}
    for axes in figure.axes:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    height_in = figure.get_size_inches()[1]
    figure.legend(entries.values(), entries.keys(), loc="upper center", ncol=ncol,
                  bbox_to_anchor=(0.5, 1 - 0.55 / height_in), columnspacing=1.4,
                  handlelength=1.6, markerscale=3)


def length_unit(largest_m):
    """The factor and the name of the unit in which a length reads as a number from 1 to 1000."""
    for factor, name in ((1, "m"), (1e3, "mm"), (1e6, "µm")):
        if largest_m * factor >= 1:
            return factor, name
    return 1e9, "nm"


def save(figure, path):
    """Writes .svg or .png; the same figure gives the same bytes."""
    if path.suffix == ".svg":
        figure.savefig(path, metadata={"Date": None})
        return
    figure.set_dpi(PNG_DPI)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    # A palette, as dots make a PNG in full colour three times as large.
    pixels = Image.fromarray(numpy.asarray(canvas.buffer_rgba())).convert("RGB")
    pixels.quantize(PNG_COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)
