"""Runs the program as `python -m gnomon`."""

import os
import shutil
import sys


def main():
    """Run the program with this command line's arguments."""
    package = os.path.dirname(os.path.abspath(__file__))
    places = [os.path.join(package, "gnomon"), os.path.join(package, "..", "..", "bin", "gnomon")]
    found = [place for place in places if os.path.isfile(place) and os.access(place, os.X_OK)]
    program = found[0] if found else shutil.which("gnomon")
    if program is None:
        sys.exit("gnomon: the program is neither beside the package nor in PATH")
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()
