"""A folder that `gnomon sweep --out` or `gnomon compare --out` wrote, as tables."""

from dataclasses import dataclass
from pathlib import Path

import pandas

from .errors import InputError
from .layers import load_layers

SCHEMA = 1
TEXTS = ("id", "curve", "case", "status", "message", "scene_hash", "at", "bias_source")


@dataclass(frozen=True)
class Run:
    """The tables of a run, with the columns of docs/csv_schema.md.

    A cell without a value is NaN, in texts None; numbers are the doubles that Gnomon wrote, bit by
    bit.
    """

    folder: Path
    results: pandas.DataFrame  # one row a configuration, in the order of the sweep
    error_vs_z: pandas.DataFrame  # errors and depth errors by light distance, by curve
    bias_curves: pandas.DataFrame  # errors at every bias where their number changes, by curve

    @property
    def axes(self):
        """The job's keys that differ between configurations, in the order of the columns."""
        first = self.results.columns.get_loc("scene_hash") + 1
        last = self.results.columns.get_loc("map_near_m")
        keys = self.results.iloc[:, first:last]
        return [name for name in keys if keys[name].nunique(dropna=False) > 1]

    def curve_of(self, row):
        """The bias curve of a row of `results`, by bias."""
        curve = self.bias_curves[self.bias_curves["curve"] == row["curve"]]
        return curve.reset_index(drop=True)

    def layers_of(self, row):
        """The pixels of a row of `results`; InputError where the run kept none."""
        path = self.folder / "pixels" / f"{row['id']}.exr"
        if not path.exists():
            raise InputError(f"{path}: no such file; run the sweep with --keep-pixels")
        return load_layers(path)


def load_run(folder):
    """The run in a folder.

    Raises InputError where a file is missing, is no CSV, or is of another schema.
    """
    folder = Path(folder)
    results = _read(folder / "results.csv", ("schema", "id", "scene_hash", "map_near_m"))
    foreign = results[results["schema"] != SCHEMA]
    if len(foreign):
        raise InputError(
            f"{folder / 'results.csv'}: schema {foreign['schema'].iloc[0]}, this package reads"
            f" {SCHEMA}; take the package of the Gnomon that wrote it"
        )
    return Run(
        folder,
        results,
        _read(folder / "error_vs_z.csv", ("curve", "at", "lower_m", "upper_m")),
        _read(folder / "bias_curves.csv", ("curve", "bias", "false_shadow", "false_lit")),
    )


def _read(path, needed):
    try:
        # The default parser of pandas is off by an ulp now and then.
        table = pandas.read_csv(
            path, dtype=dict.fromkeys(TEXTS, object), float_precision="round_trip"
        )
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; is {path.parent} a run of gnomon sweep?")
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as CSV: {' '.join(str(error).split())}")
    missing = [name for name in needed if name not in table]
    if missing:
        raise InputError(f"{path}: no column {missing[0]}; see docs/csv_schema.md")
    texts = table.columns.intersection(TEXTS)
    table[texts] = table[texts].where(table[texts].notna(), None)
    return table
