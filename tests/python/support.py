"""Shared parts of the tests of the Python package, as its users call it.

Run them with the package's folder in PYTHONPATH and the program in GNOMON. GNOMON_FULL_TESTS=1 takes more scenes,
methods, calls and repetitions.
"""

import json
import os
import subprocess

import gnomon
import numpy as np
from gnomon.keys import pairs

PROGRAM = os.environ["GNOMON"]
IS_FULL = os.environ.get("GNOMON_FULL_TESTS") == "1"
SMALL = {"image": {"width": 96, "height": 54}, "shadow_map": {"resolution": 256}}
SUN = {"direction": [-0.4, -1, -0.3]}


def program_says(builtin, keys, command="compare", *options):
    """The program's JSON for the same job, or the line with which it refuses."""
    settings = [word for name, value in pairs(keys) for word in ("--set", f"{name}={value}")]
    done = subprocess.run([PROGRAM, command, "--builtin", builtin, "--json", *options, *settings], capture_output=True, text=True)
    if done.returncode != 0:
        return done.stderr
    said = json.loads(done.stdout)
    return without_times(said) if command == "compare" else said


def module_says(builtin, keys):
    try:
        return without_times(gnomon.compare(builtin, **keys).to_dict())
    except gnomon.InputError as error:
        return f"gnomon: {error}\n"


def without_times(result):
    return {key: value for key, value in result.items() if key != "seconds"}


def plate():
    """A ground at y = 0 and a plate at y = 1, x and z from −1 to 1."""
    vertices = [[x, 0, z] for x in (-4, 4) for z in (-4, 4)] + [[x, 1, z] for x in (-1, 1) for z in (-1, 1)]
    triangles = [[0, 1, 3], [0, 3, 2], [4, 5, 7], [4, 7, 6]]
    return gnomon.Scene(np.array(vertices, float), triangles, objects={"ground": 2, "plate": 2})
