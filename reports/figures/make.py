#!/usr/bin/python3
"""Draws figures from CSV files that Gnomon wrote; docs/figures.md shows them."""

import argparse
import importlib
import json
import sys
import types
import warnings
from pathlib import Path

try:
    import gnomon
    import matplotlib

    import run_settings
    import style

    # The program reads this list of figures, too. The module with a figure's name has draw(tables). `reads` is its
    # input: "run": read(run), which may raise DoesNotApply, and words(tables); "tables": read(paths) of CSV files;
    # file names: read(paths) of these files of a run.
    FIGURES = {
        figure["name"]: types.SimpleNamespace(
            **figure, module=importlib.import_module(figure["name"].replace("-", "_")))
        for figure in json.loads((Path(__file__).parent / "figures.json").read_text(encoding="utf-8"))
    }
except ModuleNotFoundError as missing:
    print(f"make.py: {sys.executable} has no {missing.name}", file=sys.stderr)
    sys.exit(3)

SUFFIXES = (".pdf", ".svg", ".png")


class Parser(argparse.ArgumentParser):
    """Errors are one line."""

    def error(self, message):
        self.exit(2, f"make.py: {message}; see `gnomon figure --help`\n")


def parse(arguments):
    """The command line, checked."""
    parser = Parser(description=__doc__)
    parser.add_argument("name", metavar="NAME", help=", ".join(FIGURES) + "; or run: all that apply to a run, into a folder")
    parser.add_argument("inputs", metavar="RUN|CSV", nargs="+", type=Path,
                        help="a folder of gnomon sweep or compare --out, or its CSV files")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("-o", dest="output", metavar="FILE", type=Path,
                       help="the figure: .pdf, .svg or .png")
    where.add_argument("--out", metavar="DIR", type=Path, help="the folder, for run")
    options = parser.parse_args(arguments)
    if options.name not in ("run", *FIGURES):
        parser.error(f"invalid choice: '{options.name}'")
    if (options.name == "run") != (options.out is not None):
        parser.error("--out goes with run, and -o with a figure")
    if options.output and options.output.suffix not in SUFFIXES:
        parser.error(f"-o {options.output}: the name must end in .pdf, .svg or .png")
    return options


def is_needed(column):
    """Whether figures need a column of results.csv, which may have 200,000 rows."""
    return column not in ("id", "message") and not column.startswith(
        ("bias_curve.allowances", "peter_panning_gap", "unmatched_kinds", "indeterminate_kinds",
         "pixels.un", "pixels.in", "pixels.at", "pixels.out"))


def load(inputs):
    """The run in a folder, given by the folder or its results.csv."""
    if len(inputs) != 1:
        raise gnomon.InputError(f"{len(inputs)} files given; this figure needs one run")
    folder = inputs[0].parent if inputs[0].name == "results.csv" else inputs[0]
    return gnomon.load_run(folder, columns=is_needed)


def draw(name, inputs):
    """Draws the figure with that name."""
    is_run = len(inputs) == 1 and inputs[0].is_dir()
    if name == "error-vs-z" and is_run:
        name = "errors-vs-z"
    figure = FIGURES[name]
    module = figure.module
    if figure.reads == "run":
        return module.draw(module.read(load(inputs)))
    if is_run:
        files = ["results.csv"] if figure.reads == "tables" else figure.reads
        inputs = [inputs[0] / file for file in files]
    return module.draw(module.read(inputs))


def applying(run):
    """The names, modules and tables of the figures that apply to a run."""
    for figure in FIGURES.values():
        if figure.reads == "run":
            try:
                yield figure.name, figure.module, figure.module.read(run)
            except run_settings.DoesNotApply:
                continue


def draw_run(run, folder):
    """Writes every figure that applies as SVG and PNG; returns their descriptions for a page."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, module, tables in applying(run):
        figure = module.draw(tables)
        files = {kind: f"{name}.{kind}" for kind in ("svg", "png")}
        for file in files.values():
            style.save(figure, folder / file)
        title, caption, alt = module.words(tables)
        written.append({"name": name, "title": title, "caption": caption, "alt": alt, **files})
    return written


def main(arguments):
    """Returns 0 on success, 2 on bad input, 4 if the output cannot be written or a package that an
    input needs is missing.

    The script exits with 3 before if a Debian package is missing.
    """
    options = parse(arguments)
    # A scene's name may be in any script; missing glyphs are drawn as boxes.
    warnings.filterwarnings("ignore", message="Glyph .* missing from current font")
    try:
        with matplotlib.rc_context():
            matplotlib.rcdefaults()  # ignore the user's settings
            matplotlib.rcParams.update(style.RC)
            if options.out:
                json.dump(draw_run(load(options.inputs), options.out), sys.stdout)
                print()
            else:
                style.save(draw(options.name, options.inputs), options.output)
    except gnomon.InputError as error:
        print(f"make.py: {error}", file=sys.stderr)
        return 2
    except gnomon.MissingPackage as missing:
        print(f"make.py: {missing}", file=sys.stderr)
        return 4
    except OSError as error:
        print(f"make.py: {options.out or options.output}: {error.strerror}", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
