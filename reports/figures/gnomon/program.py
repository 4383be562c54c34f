"""Runs the program gnomon."""

import os
import shutil
import subprocess
from pathlib import Path

from .errors import InputError

BUILT = Path(__file__).resolve().parents[3] / "build" / "release" / "bin" / "gnomon"


def find():
    """The program: $GNOMON, else that of ./dev build, else the one on the PATH.

    Raises InputError if there is none.
    """
    if os.environ.get("GNOMON"):
        return os.environ["GNOMON"]
    found = str(BUILT) if BUILT.exists() else shutil.which("gnomon")
    if found is None:
        raise InputError("gnomon was not found; build it with ./dev build, or set $GNOMON to its path")
    return found


def call(*arguments):
    """The output of `gnomon ARGUMENT…`; each argument is converted to text.

    Raises InputError with the program's message if it fails.
    """
    command = [find(), *map(str, arguments)]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError as error:
        raise InputError(f"{command[0]}: {error.strerror}; build it with ./dev build")
    if done.returncode != 0:
        raise InputError(f"gnomon {arguments[0]}: exit {done.returncode}: {done.stderr.strip()}")
    return done.stdout
