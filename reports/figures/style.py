"""The style of all figures: sizes, colours that are distinct for any colour vision, files."""

import os
import re
import textwrap

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

# Figures, pictures and pages use the same colours.
FALSE_SHADOW = VERMILION
FALSE_LIT = BLUE
CAUSES = {"bias": ORANGE, "precision": GREEN, "resolution": SKY, "coverage": PURPLE, "filter": BLUE}

WIDTH_IN = 8.0
PNG_DPI = 150
PNG_COLOURS = 256

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
LIGHT_DISTANCE_LABEL = "distance ζ from the light's plane [m]"

LINE_IN = 0.19  # of the settings
LETTERS_IN_A_LINE = 96
TITLE_LINE_IN = 0.2  # of a panel
LETTERS_OF_TITLES = 72  # over panels side by side
TICK_LETTER_PT = 6.6
TICK_GAP_PT = 9


class TitledFigure(Figure):
    """A figure with its title and the measured settings below it.

    Long settings take several lines and make the figure higher.
    """

    def __init__(self, title, settings, height_in):
        lines = textwrap.wrap(settings, LETTERS_IN_A_LINE) or [""]
        self.added_in = (len(lines) - 1) * LINE_IN
        height_in += self.added_in
        super().__init__(figsize=(WIDTH_IN, height_in))
        self.text(0.012, 1 - 0.10 / height_in, plain(title), size=13, weight="bold", va="top")
        self.text(0.012, 1 - 0.36 / height_in, plain("\n".join(lines)), size=10, color="#444444",
                  va="top")


def plain(text):
    """Escapes dollars, which matplotlib would read as formulas."""
    return text.replace("$", "\\$")


def panel_titles(names, columns):
    """Panel names, wrapped to the width of a panel."""
    return [plain(textwrap.fill(name, LETTERS_OF_TITLES // columns)) for name in names]


def title_height(titles):
    """The height of the longest title [in]; 0 if all are empty."""
    lines = max(title.count("\n") + 1 if title else 0 for title in titles)
    return lines * TITLE_LINE_IN


def label_columns(axes, column, columns, x_label):
    """Labels the x axis of a panel; with three or more columns only the middle one."""
    if columns < 3 or column == columns // 2:
        axes.set_xlabel(x_label)


def lay_out(figure, left_in=0.85, right_in=0.15, bottom_in=0.55, top_in=1.0, **spacing):
    """Sets margins in inches, equal for figures of any height."""
    width_in, height_in = figure.get_size_inches()
    return figure.add_gridspec(
        left=left_in / width_in,
        right=1 - right_in / width_in,
        bottom=bottom_in / height_in,
        top=1 - (top_in + figure.added_in) / height_in,
        **spacing,
    )


def add_legend(figure, ncol, markerscale=3, entries=None):
    """One legend for all panels, below the settings: each label once, or the given entries."""
    if entries is None:
        entries = {}
        for axes in figure.axes:
            for handle, label in zip(*axes.get_legend_handles_labels()):
                entries.setdefault(label, handle)
    height_in = figure.get_size_inches()[1]
    figure.legend(entries.values(), entries.keys(), loc="upper center", ncol=ncol,
                  bbox_to_anchor=(0.5, 1 - (0.55 + figure.added_in) / height_in),
                  columnspacing=1.4, handlelength=1.6, markerscale=markerscale)


def set_categories(axes, texts, letters):
    """Names along the lower axis, slanted if they would overlap."""
    axes.set_xticks(range(len(texts)), labels=[plain(text) for text in texts])
    axes.set_xlim(-0.6, len(texts) - 0.4)
    if len(texts) * max(map(len, texts)) > letters:
        turn(axes)


def turn(axes):
    """Slants the names along the lower axis."""
    for label in axes.get_xticklabels():
        label.set(rotation=25, ha="right", rotation_mode="anchor")


def set_ticks(axes, places, texts):
    """Sets ticks along the lower axis, all or every n-th, as many as fit without overlap.

    The axis needs its limits and scale before.
    """
    places, texts = numpy.asarray(places, dtype=float), list(texts)
    step = next((step for step in range(1, len(places)) if fit(axes, places[::step], texts[::step])),
                max(1, len(places) - 1))
    axes.set_xticks(places[::step], labels=[plain_text(text) for text in texts[::step]])
    axes.set_xticks([], minor=True)


def plain_text(text):
    """A tick's text: a power of ten, or `plain`."""
    return text if re.fullmatch(r"\$-?10\^\{-?\d+\}\$", text) else plain(text)


def power_of_ten(exponent, sign=1):
    """A power of ten as a tick's text."""
    return f"${'-' if sign < 0 else ''}10^{{{exponent:.0f}}}$"


def fit(axes, places, texts):
    """Whether texts at these places of the lower axis do not overlap."""
    width_pt = 72 * axes.get_position().width * axes.figure.get_size_inches()[0]
    points = numpy.column_stack([places, numpy.full(len(places), axes.get_ylim()[1])])
    at_pt = width_pt * (axes.transScale + axes.transLimits).transform(points)[:, 0]
    half_pt = 0.5 * TICK_LETTER_PT * numpy.array([len(re.sub(r"[${}^]", "", text)) for text in texts])
    return bool(numpy.all(numpy.diff(at_pt) >= half_pt[1:] + half_pt[:-1] + TICK_GAP_PT))


def set_rate_scale(axes, which="y"):
    """A percent scale, linear below 0.01 so that it can show 0, and logarithmic above."""
    getattr(axes, f"set_{which}scale")("symlog", linthresh=0.01, linscale=0.5)
    getattr(axes, f"set_{which}lim")(-0.002, 100)
    getattr(axes, f"set_{which}ticks")([0, 0.01, 0.1, 1, 10, 100],
                                       labels=["0", "0.01", "0.1", "1", "10", "100"])


def length_unit(largest_m):
    """Factor and name of the unit in which a length is from 1 to 1000."""
    for factor, name in ((1, "m"), (1e3, "mm"), (1e6, "µm")):
        if largest_m * factor >= 1:
            return factor, name
    return 1e9, "nm"


def length_text(length_m):
    """A length in its unit: "2.65 µm"."""
    factor, unit = length_unit(abs(length_m))
    return f"{factor * length_m:.3g} {unit}"


def save(figure, path):
    """Writes .pdf, .svg or .png atomically and reproducibly."""
    unfinished = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        _write(figure, unfinished, path.suffix[1:])
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def _write(figure, path, kind):
    if kind != "png":
        no_date = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
        figure.savefig(path, format=kind, dpi=PNG_DPI, metadata=no_date[kind])
        return
    figure.set_dpi(PNG_DPI)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    # With many dots, a palette makes the PNG a third as large.
    pixels = Image.fromarray(numpy.asarray(canvas.buffer_rgba())).convert("RGB")
    pixels.quantize(PNG_COLOURS, dither=Image.Dither.NONE).save(path, "PNG",
                                                                     optimize=True)
