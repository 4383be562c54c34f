"""A folder that `gnomon sweep --out` or `gnomon compare --out` wrote, as tables."""

from functools import cached_property
from pathlib import Path

from .csv_table import read_table
from .errors import InputError
from .layers import load_layers

SCHEMAS = (1, 2)  # the first lacks the amounts


class Run:
    """The tables of a run, with the columns of docs/csv_schema.md; each is read on first use.

    A cell without a value is NaN, in texts None; numbers are bit for bit the doubles that
    Gnomon wrote. Raises InputError if a file is missing or is not CSV of a run.
    """

    def __init__(self, folder, results):
        self.folder = Path(folder)
        self.results = results  # one row a configuration, in the order of the sweep

    @cached_property
    def totals(self):
        """With several lights, the rows for all of them together; `results` has those of each."""
        return read_table(self.folder / "results.csv", ("schema",), ("curve", "scene_hash"),
                          may_be_empty=True, totals=True)

    @cached_property
    def error_vs_z(self):
        """Errors and depth errors by light distance, by curve."""
        return read_table(self.folder / "error_vs_z.csv", ("bias", "lower_m", "upper_m"),
                          ("curve", "at"), may_be_empty=True)

    @cached_property
    def bias_curves(self):
        """Errors at every bias at which their number changes, by curve."""
        return read_table(self.folder / "bias_curves.csv", ("bias", "false_shadow", "false_lit"),
                          ("curve",), may_be_empty=True)

    @property
    def job_keys(self):
        """The columns of `results` that are keys of the job."""
        first = self.results.columns.get_loc("scene_hash") + 1
        last = self.results.columns.get_loc("map_near_m")
        return list(self.results.columns[first:last])

    @property
    def light_keys(self):
        """With several lights `light`, and the axes of single lights, `lights.NAME.KEY`."""
        return [name for name in self.results.columns
                if name == "light" or name.startswith("lights.")]

    @cached_property
    def axes(self):
        """The keys that differ between configurations, in the order of the columns."""
        return [name for name in (*self.light_keys, *self.job_keys)
                if self.results[name].nunique(dropna=False) > 1]

    def curve_of(self, row):
        """The bias curve of a row of `results`, by bias.

        Reads only this curve, as a large sweep has many.
        """
        path = self.folder / "bias_curves.csv"
        try:
            lines = path.read_bytes()
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}; is {self.folder} a run of gnomon sweep?")
        key = str(row["curve"]).encode() + b","
        begin = lines.find(b"\n" + key) + 1
        end = lines.rfind(b"\n" + key) + 1
        header = lines[: lines.find(b"\n") + 1]
        block = lines[begin : lines.find(b"\n", end) + 1] if begin else b""
        return read_table(path, ("bias", "false_shadow", "false_lit"), ("curve",),
                          may_be_empty=True, lines=header + block)

    def layers_of(self, row):
        """The pixels of a row of `results`; InputError if the run kept none."""
        path = self.folder / "pixels" / f"{row['id']}.exr"
        if not path.exists():
            raise InputError(f"{path}: no such file; run the sweep with --keep-pixels")
        return load_layers(path)


def load_run(folder, columns=None):
    """The run in a folder; `columns`: a predicate of the columns of results.csv to read, all by default.

    Raises InputError if results.csv is missing, is not CSV, or has another schema.
    """
    folder = Path(folder)
    path = folder / "results.csv"
    if not path.exists():
        raise InputError(f"{path}: no such file; is {folder} a run of gnomon sweep?")
    results = read_table(path, ("schema",), ("curve", "scene_hash"), may_be_empty=True,
                         columns=columns)
    if "map_near_m" not in results:
        raise InputError(f"{path}: no column map_near_m; see docs/csv_schema.md")
    foreign = results[~results["schema"].isin(SCHEMAS)]
    if len(foreign):
        raise InputError(
            f"{path}: schema {foreign['schema'].iloc[0]:g}, this package reads 1 and 2; take the"
            " package of the Gnomon that wrote it"
        )
    return Run(folder, results)
