"""How every figure looks: sizes, colours that any colour vision can tell apart, files."""

import matplotlib

matplotlib.use("Agg")

from matplotlib.figure import Figure  # noqa: E402  the backend has to be chosen first

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
PNG_DPI = 160

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


def length_unit(largest_m):
    """The factor and the name of the unit in which a length reads as a number from 1 to 1000."""
    for factor, name in ((1, "m"), (1e3, "mm"), (1e6, "µm")):
        if largest_m * factor >= 1:
            return factor, name
    return 1e9, "nm"


def save(figure, path):
    """Writes .svg or .png; the same figure gives the same bytes."""
    metadata = {"Date": None} if path.suffix == ".svg" else {"Software": None}
    figure.savefig(path, dpi=PNG_DPI, metadata=metadata)
