"""Gnomon as a library: the accuracy of shadow maps, and the exact truth.

    >>> import gnomon
    >>> scene = gnomon.builtin("columns")
    >>> truth = gnomon.truth(scene, points=[[0, 1, 0]], light={"direction": [0, -1, 0]})
    >>> result = gnomon.compare("columns", bias={"constant": 0.001})

`truth` and `evaluate` need no GL. Lengths are in the scene's units, which Gnomon calls metres.
Invalid input raises `InputError`, a missing device or library `EnvironmentError`. Each message is one
line that names the problem, its place and a remedy.
"""

from gnomon._gnomon import EnvironmentError, InputError, embree_version
from gnomon._gnomon import version as __version__
from gnomon.comparison import BiasCurve, Comparison, compare, evaluate, methods, settings
from gnomon.depths import DepthStudy, depth
from gnomon.points import CLASSES, REASONS, PointTruth, truth
from gnomon.scenes import Object, Scene, builtin, builtins, load
from gnomon.sun import sun_direction, sun_position
from gnomon.sweeps import Run, open_run, sweep
from gnomon.tuning import Tuning, tune

__all__ = [
    "CLASSES",
    "REASONS",
    "BiasCurve",
    "Comparison",
    "DepthStudy",
    "EnvironmentError",
    "InputError",
    "Object",
    "PointTruth",
    "Run",
    "Scene",
    "Tuning",
    "__version__",
    "builtin",
    "builtins",
    "compare",
    "depth",
    "embree_version",
    "evaluate",
    "load",
    "methods",
    "open_run",
    "settings",
    "sun_direction",
    "sun_position",
    "sweep",
    "truth",
    "tune",
]
