"""`python -m gnomon` is the program."""

import os
import shutil
import sys


def main():
    """Run the program with this command line's arguments."""
    beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), "gnomon")
    program = beside if os.access(beside, os.X_OK) else shutil.which("gnomon")
    if program is None:
        sys.exit("gnomon: the program is not installed beside the package, nor in PATH")
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    main()
