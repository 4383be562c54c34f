"""The stored CSV files of the tests of figures of depths, and how to read what is drawn of them.

They are small ones of `gnomon depth --near 4 --far 50` and of a sweep of two-distances (320 x 180
pixels, a map of 1024 texels, d16 and d24, bias 4e-6).
"""

import csv
import sys
from pathlib import Path

import numpy

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "reports" / "figures"))


def paths(*names):
    return [HERE / f"{name}.csv" for name in names]


def column(name, key, rows=None):
    """A column of a stored file, read without the code under test; rows: those to keep."""
    with open(HERE / f"{name}.csv", newline="") as file:
        return numpy.array([float(row[key]) for row in csv.DictReader(file)
                            if rows is None or rows(row)])


def line(axes, label):
    """The points of the one line with this label."""
    (found,) = [one for one in axes.get_lines() if one.get_label() == label]
    return found.get_data()


def legend_labels(legend):
    return [text.get_text() for text in legend.get_texts()]
