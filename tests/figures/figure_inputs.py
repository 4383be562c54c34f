"""Inputs of the tests of figures, and helpers that read them and drawn figures without the code under test.

`gnomon` ($GNOMON) measures the inputs of figures of depths and a small sweep. The rest is stored: crops and rows of
what examples/figures/lessons.sh measures, tables of cascades, and `compare`, a run of schema 1.
"""

import atexit
import csv
import functools
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy

HERE = Path(__file__).resolve().parent
FIGURES = HERE.parents[1] / "reports" / "figures"
sys.path.insert(0, str(FIGURES))

import gnomon  # noqa: E402
import make  # noqa: E402

# Options of `gnomon depth --near 4 --far 50`.
DEPTHS = {
    "formula8": "--bits 8 --theory-only --samples 200",
    "formula24": "--bits 24 --theory-only --samples 40",
    "tolerance32": "--bits 32 --theory-only --samples 16 --tolerance 1e-8",
    "orthographic": "--bits 16 --theory-only --samples 24 --projection orthographic",
    "r16f": "--format r16f --theory-only --samples 16",
    "d16": "--format d16 --samples 48",
    "d24": "--format d24 --samples 48",
    "d32f": "--format d32f --samples 48",
    "d32f_reversed": "--format d32f --reversed --samples 48",
}
# Options of `gnomon sweep`.
SWEEPS = {
    "two-distances": "--builtin two-distances --set image.width=320 --set image.height=180"
                     " --set shadow_map.resolution=1024 --set bias.constant=4e-6"
                     " --axis shadow_map.depth_format=d16,d24",
    "sweep": "--builtin sphere-plane --set image.width=24 --set image.height=16"
             " --axis shadow_map.resolution=32,64 --axis lookup.filter=nearest,pcf3"
             " --axis bias.constant=0,0.001,0.003,0.01,0.03",
}


@functools.cache
def _work_folder():
    folder = Path(tempfile.mkdtemp(prefix="gnomon-figures-"))
    atexit.register(shutil.rmtree, folder)
    return folder


@functools.cache
def _measured(name):
    """A CSV file of depths, or the folder of a run."""
    target = _work_folder() / name
    if name in SWEEPS:
        command = ["sweep", *SWEEPS[name].split(), "--quiet", "--no-keep-pixels", "--out", target]
    else:
        target = target.with_suffix(".csv")
        command = ["depth", "--near", "4", "--far", "50", *DEPTHS[name].split(), "--csv", target]
    subprocess.run([os.environ["GNOMON"], *command], check=True, stdout=subprocess.DEVNULL)
    return target


def run_folder(name):
    return HERE / name if (HERE / name).exists() else _measured(name)


def path(name):
    """The path of a CSV file by its name, FILE or RUN/FILE."""
    run, _, file = name.rpartition("/")
    return run_folder(run) / f"{file}.csv" if run else _measured(file)


def paths(*names):
    return [path(name) for name in names]


def load(name):
    """A run, as make.py loads it."""
    return gnomon.load_run(run_folder(name), columns=make.is_needed)


def rows_of(name, **where):
    """The rows of a CSV file that have these cells."""
    with open(path(name), newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if all(row[key] == value for key, value in where.items())]


def numbers(rows, key):
    """A column of rows; NaN for an empty cell."""
    return numpy.array([float(row[key]) if row[key] else numpy.nan for row in rows])


def column(name, key, rows=None):
    """A column of a CSV file; rows: a predicate of those to keep."""
    return numbers([row for row in rows_of(name) if rows is None or rows(row)], key)


def by_label(axes):
    """Lines, steps, areas and bars by their labels."""
    handles, labels = axes.get_legend_handles_labels()
    return dict(zip(labels, handles))


def line(axes, label):
    """The points of the one line with this label."""
    (found,) = [one for one in axes.get_lines() if one.get_label() == label]
    return found.get_data()


def legend_labels(legend):
    return [text.get_text() for text in legend.get_texts()]
