"""Runs the program gnomon."""

import os
import shutil
import subprocess
from pathlib import Path

from .errors import InputError

BUILT = Path(__file__).resolve().parents[3] / "build" / "release" / "bin" / "gnomon"


def find():
    """The program: $GNOMON, else that of ./dev build, else the one on the PATH.

    Raises InputError where there is none.
    """
    if os.environ.get("GNOMON"):
        return os.environ["GNOMON"]
    found = str(BUILT) if BUILT.exists() else shutil.which("gnomon")
    if found is None:
        raise InputError("no program gnomon; build it with ./dev build, or name it in $GNOMON")
    return found


def call(*arguments):
    """What `gnomon ARGUMENT…` prints; each argument is turned into text.

    Raises InputError with the program's own line where it fails.
    """
    command = [find(), *map(str, arguments)]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError as error:
        raise InputError(f"{command[0]}: {error.strerror}; build it with ./dev build")
    if done.returncode != 0:
        raise InputError(f"gnomon {arguments[0]}: exit {done.returncode}: {done.stderr.strip()}")
    return done.stdout
