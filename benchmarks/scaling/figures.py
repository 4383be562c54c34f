#!/usr/bin/python3
"""Plots time and memory against the sizes that a sweep's cost depends on: docs/images/scaling.

    figures.py [MEASUREMENTS.csv [FOLDER]]
"""

import csv
import pathlib
import sys

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

ROOT = pathlib.Path(__file__).resolve().parents[2]
MEASUREMENTS = ROOT / "docs" / "scaling_measurements.csv"
FOLDER = ROOT / "docs" / "images" / "scaling"

# Okabe and Ito's colours, which are safe for any colour vision; shapes and labels differ, too.
PARTS = {"scene_s": ("scene file", "#56B4E9", "v"), "hierarchies_s": ("hierarchies", "#CC79A7", "^"),
         "receivers_s": ("receivers", "#009E73", "s"), "truth_s": ("truth", "#D55E00", "D"),
         "map_s": ("map", "#E69F00", "P"), "lookup_s": ("lookup", "#777777", "X"),
         "curve_s": ("curve", "#0072B2", "h"), "sweep_s": ("whole sweep", "#000000", "o")}
SHOWN = {"triangles": ("scene_s", "hierarchies_s", "receivers_s", "truth_s", "map_s", "sweep_s"),
         "pixels": ("receivers_s", "truth_s", "lookup_s", "curve_s", "sweep_s"),
         "texels": ("map_s", "sweep_s"), "biases": ("sweep_s",), "configurations": ("sweep_s",)}
AXES = {"triangles": "triangles", "pixels": "pixels of the image", "texels": "texels of the map",
        "biases": "biases of one curve", "configurations": "configurations (50 a curve)"}
COLUMN = {"triangles": "triangles", "pixels": "pixels", "texels": "texels", "biases": "biases"}


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def size_of(row):
    if row["series"] == "configurations":
        return int(row["biases"]) * int(row["curves"])
    return int(row[COLUMN[row["series"]]])


def points(rows, series, quantity):
    """Sizes, values and whether they are checks, ascending."""
    return sorted((size_of(row), float(row["value"]), row["is_check"] == "1") for row in rows if row["series"] == series and row["quantity"] == quantity)


def draw_line(axes, found, label, colour, marker):
    sizes, values, _ = zip(*found)
    checked = [(size, value) for size, value, is_check in found if is_check]
    axes.plot(sizes, values, color=colour, marker=marker, markersize=8, linewidth=2, label=label)
    axes.plot(*zip(*checked), color="white", marker=marker, markersize=4, linestyle="none")


def draw_theory(axes, found, word):
    """A line of slope 1 below the last point, for costs proportional to the size."""
    first, (last, value, _) = found[0][0], found[-1]
    below = value / 2.5
    axes.plot((first, last), (below * first / last, below), color="#444444", linestyle=(0, (5, 4)), linewidth=1.8,
              label=f"∝ {word}")


def limit(axes, lines, legend_room):
    """Sets the limits of the y axis, with room for the legend above the lines."""
    values = [value for found in lines for _, value, _ in found]
    axes.set_ylim(min(values) / 2, max(values) * legend_room)


def finish(axes, series, title, unit):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(AXES[series], fontsize=15)
    axes.set_ylabel(unit, fontsize=15)
    axes.set_title(title, fontsize=16, loc="left")
    axes.tick_params(labelsize=13)
    axes.grid(True, color="#E3E3E3", linewidth=0.8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(fontsize=12, frameon=False, loc="upper left")


def figure_of(rows, series):
    figure = Figure(figsize=(13, 6), layout="constrained")
    time, memory = figure.subplots(1, 2)
    times = {quantity: points(rows, series, quantity) for quantity in SHOWN[series]}
    for quantity, found in times.items():
        draw_line(time, found, *PARTS[quantity])
    draw_theory(time, times["sweep_s"], series)
    finish(time, series, "Processor time", "processor time [s]")
    limit(time, times.values(), 2 * 4 ** (len(times) / 2))
    found = [(size, value / 2**20, is_check) for size, value, is_check in points(rows, series, "memory_bytes")]
    draw_line(memory, found, "whole sweep", "#000000", "o")
    draw_theory(memory, found, series)
    finish(memory, series, "Memory", "largest resident set [MiB]")
    limit(memory, [found], 4)
    return figure


def main():
    rows = read(sys.argv[1] if len(sys.argv) > 1 else MEASUREMENTS)
    folder = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    for series in SHOWN:
        figure = figure_of(rows, series)
        FigureCanvasAgg(figure)
        figure.savefig(folder / f"{series}.png", dpi=80, metadata={"Software": None})


if __name__ == "__main__":
    main()
