"""Loads Gnomon's output: runs into pandas, images into numpy.

    import gnomon
    gnomon.call("sweep", "job.toml", "--out", "out/bias")
    run = gnomon.load_run("out/bias")
    run.results                             # one row per configuration
    layers = gnomon.load_layers("out/view/pixels/0123456789abcdef.exr")
    layers["critical_bias"]                 # (height, width) float32

docs/csv_schema.md explains the columns, docs/aov.md the layers.
"""

from .csv_table import read_table
from .errors import InputError, MissingPackage
from .layers import CAUSES, CLASSES, LABELS, Layers, load_depth_map, load_layers
from .program import call
from .run import Run, load_run

__all__ = [
    "CAUSES", "CLASSES", "LABELS", "InputError", "Layers", "MissingPackage", "Run", "call",
    "load_depth_map", "load_layers", "load_run", "read_table",
]
