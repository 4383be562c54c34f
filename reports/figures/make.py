#!/usr/bin/python3
"""Draws a figure from CSV files that Gnomon wrote; docs/depth_precision.md#figures shows them."""

import argparse
import sys
from pathlib import Path

import matplotlib

import error_vs_z
import measured_against_formula
import reversed_float
import shadow_errors_on_depth_error
import style
import tables

FIGURES = {
    "error-vs-z": error_vs_z,
    "reversed-float": reversed_float,
    "measured-against-formula": measured_against_formula,
    "shadow-errors-on-depth-error": shadow_errors_on_depth_error,
}


class Parser(argparse.ArgumentParser):
    """Errors are one line."""

    def error(self, message):
        self.exit(2, f"make.py: {message}; see make.py --help\n")


def parse(arguments):
    """The command line, checked."""
    parser = Parser(description=__doc__)
    parser.add_argument("name", metavar="NAME", choices=FIGURES, help=", ".join(FIGURES))
    parser.add_argument("csv", metavar="CSV", nargs="+", type=Path,
                        help="of `gnomon depth --csv`; for the last figure error_vs_z.csv and"
                        " results.csv of a run")
    parser.add_argument("-o", dest="output", metavar="FILE", type=Path, required=True,
                        help=".svg or .png")
    options = parser.parse_args(arguments)
    if options.output.suffix not in (".svg", ".png"):
        parser.error(f"-o {options.output}: the name must end in .svg or .png")
    return options


def main(arguments):
    """0 when the figure is written, 2 on bad input, 4 where the output cannot be written."""
    options = parse(arguments)
    figure = FIGURES[options.name]
    try:
        with matplotlib.rc_context(style.RC):
            style.save(figure.draw(figure.read(options.csv)), options.output)
    except tables.InputError as error:
        print(f"make.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"make.py: {options.output}: {error.strerror}", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
