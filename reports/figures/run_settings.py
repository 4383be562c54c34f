"""The settings that a run's configurations share, and the axes in which they differ."""

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy
import pandas
from gnomon import InputError

CONSTANT_BIASES = {"bias.constant": "depth units", "bias.constant_m": "m"}  # keys of the constant bias, and their units
NAMES = {
    "case": "case",
    "light": "light",
    "image.width": "image width [px]",
    "image.height": "image height [px]",
    "shadow_map.resolution": "map resolution [texels]",
    "shadow_map.depth_format": "depth format",
    "shadow_map.near": "near plane [m]",
    "shadow_map.far": "far plane [m]",
    "shadow_map.roll_deg": "roll of the map [°]",
    "shadow_map.cull": "culled faces",
    "shadow_map.fit": "fit of the map",
    "shadow_map.half_extent": "half extent of the map [m]",
    "shadow_map.fov_deg": "field of view of the map [°]",
    "shadow_map.reversed": "reversed depth",
    "lookup.filter": "filter",
    "lookup.outside": "outside the map",
    **{key: f"constant bias [{unit}]" for key, unit in CONSTANT_BIASES.items()},
    "bias.slope": "slope bias [depth units]",
    "bias.normal_texels": "normal offset [texels]",
    "scene.builtin": "scene",
    "scene.file": "scene",
    "light.direction": "light direction",
    "light.position": "light position [m]",
}
BIASES = {"job_bias": "job's bias", "best_bias": "best bias"}  # of errors by distance
MOST_VALUES = 100  # more values on an axis are merged into groups of equally many configurations
MOST_CATEGORIES = 24
LONGEST_TEXT = 28
LARGEST_WRITTEN_OUT = 10**7  # limit of whole numbers; others have four digits
LEAST_RATIO_OF_A_LOG_AXIS = 20


class DoesNotApply(InputError):
    """The run lacks the data of a figure; the message is one line."""


@dataclass(frozen=True)
class Axis:
    """A key in which configurations differ.

    `values` ascend if they are numbers, else keep their order of appearance; `codes` are their
    indices, one per configuration.
    """

    key: str
    values: list
    codes: numpy.ndarray
    is_numeric: bool

    @property
    def label(self):
        return name_of(self.key)

    @property
    def is_of_powers_of_two(self):
        """Whether all values are powers of two, as map resolutions are."""
        return self.is_numeric and all(value > 0 and numpy.log2(value).is_integer()
                                       for value in map(float, self.values))

    @property
    def scale(self):
        """Arguments of set_xscale for evenly spread values."""
        if not self.is_numeric or len(self.values) < 3:
            return {"value": "linear"}
        sizes = numpy.sort(numpy.abs([value for value in self.values if value != 0]))
        ratios = sizes[1:] / sizes[:-1]
        is_geometric = self.values[0] > 0 and ratios.min() > 0.99 * ratios.max() > 1.4
        if not is_geometric and sizes[-1] < LEAST_RATIO_OF_A_LOG_AXIS * sizes[0]:
            return {"value": "linear"}
        if self.values[0] > 0:
            return {"value": "log", "base": 2 if self.is_of_powers_of_two else 10}
        return {"value": "symlog", "linthresh": sizes[0]}


def name_of(key):
    """A key as an axis label, with its unit."""
    if key in NAMES:
        return NAMES[key]
    if key.startswith("lights."):
        _, light, own = key.split(".", 2)
        return f"{light}: {name_of(own if '.' in own else 'light.' + own)}"
    name = key.split(".")[-1]
    for suffix, unit in (("_m", "m"), ("_deg", "°"), ("_px", "px")):
        if name.endswith(suffix):
            return f"{name.removesuffix(suffix).replace('_', ' ')} [{unit}]"
    return name.replace("_", " ")


def text_of(value):
    """A value as text; long texts are shortened."""
    if isinstance(value, (bool, numpy.bool_)):
        return str(value).lower()
    if isinstance(value, (int, float, numpy.number)):
        if float(value).is_integer() and abs(value) < LARGEST_WRITTEN_OUT:
            return str(int(value))
        return f"{value:.4g}".replace("e-0", "e-").replace("e+0", "e") if value == value else "auto"
    if value is None:
        return "auto"
    text = "".join(c if c.isprintable() else "\ufffd" for c in str(value))
    return text if len(text) <= LONGEST_TEXT else text[: LONGEST_TEXT - 1] + "…"


@lru_cache(maxsize=1)
def done(run):
    """The configurations with results; raises DoesNotApply if there are none."""
    rows = run.results[run.results["status"] == "done"]
    if rows.empty:
        raise DoesNotApply(f"{run.folder}: no configuration is done")
    return rows.reset_index(drop=True)


def axes_of(run, rows):
    """The axes of the rows, `case` first, without those that an earlier one determines."""
    found = []
    for key in ("case", *run.light_keys, *run.job_keys):
        axis = _axis(key, rows[key])
        if axis and not any(_follows(axis, earlier) for earlier in found):
            found.append(axis)
    return found


def _axis(key, column):
    # Fast path: nearly all columns of a large sweep are constant.
    if column.isna().all() or (column == column.iloc[0]).all():
        return None
    numbers = pandas.to_numeric(column, errors="coerce")
    is_numeric = column.dtype != bool and not numbers.isna().any()
    cells = (numbers if is_numeric else column).to_numpy()
    codes, values = pandas.factorize(cells, sort=is_numeric, use_na_sentinel=False)
    if len(values) < 2:
        return None
    if is_numeric and len(values) > MOST_VALUES:
        codes, values = _unite(numbers.to_numpy())
    return Axis(key, list(values), codes, is_numeric)


def _unite(numbers):
    edges = numpy.unique(numpy.quantile(numbers, numpy.linspace(0, 1, MOST_VALUES + 1)))
    codes = numpy.clip(numpy.searchsorted(edges, numbers, side="right") - 1, 0, len(edges) - 2)
    medians = pandas.Series(numbers).groupby(codes).median()
    return numpy.searchsorted(medians.index, codes), medians.to_numpy()


def _follows(axis, earlier):
    pairs = earlier.codes.astype(numpy.int64) * len(axis.values) + axis.codes
    return len(numpy.unique(pairs)) == len(earlier.values)


def influence(axis, rate):
    """The range of the median rate along an axis."""
    medians = rate.groupby(axis.codes).median()
    return medians.max() - medians.min()


def by_influence(axes, rate):
    """Axes with few enough categories to draw, the most influential first."""
    drawable = [axis for axis in axes if axis.is_numeric or len(axis.values) <= MOST_CATEGORIES]
    return sorted(drawable, key=lambda axis: -numpy.nan_to_num(influence(axis, rate)))


def resolution_ticks(values):
    """Tick places and texts for resolutions: powers of two, or the values if there are too few."""
    powers = 2.0 ** numpy.arange(numpy.ceil(numpy.log2(values[0])), numpy.log2(values[-1]) + 1e-9)
    places = powers if len(powers) > 1 else values
    return places, [text_of(place) for place in places]


def differences(axes, index):
    """The values that distinguish a row: "2048, pcf3"."""
    return ", ".join(text_of(axis.values[axis.codes[index]]) for axis in axes)


def description(axes, index):
    """A row's place on each axis, with its name and unit: "near plane 0.1 m, filter pcf3"."""
    def place(axis):
        name, _, unit = axis.label.removesuffix("]").partition(" [")
        value = text_of(axis.values[axis.codes[index]])
        return f"{name} {value} {unit}".rstrip() if value != "auto" else f"{name} auto"

    return ", ".join(place(axis) for axis in axes)


def settings_text(rows):
    """The settings that all rows share, with units, in the order of the job file."""
    def same(key):
        return key in rows and rows[key].nunique(dropna=False) == 1

    def value(key):
        return text_of(rows[key].iloc[0])

    def given(key):
        return same(key) and pandas.notna(rows[key].iloc[0])

    parts = []
    scene = next((key for key in ("scene.builtin", "scene.file") if given(key)), None)
    if scene:  # of a file the name, which the folders would crowd out
        parts.append(text_of(Path(str(rows[scene].iloc[0])).name))
    if same("image.width") and same("image.height"):
        parts.append(f"{value('image.width')} × {value('image.height')} px")
    parts += [f"{value('light.type')} light"] if given("light.type") else []
    parts += [f"map {value('shadow_map.resolution')}²"] if given("shadow_map.resolution") else []
    for key, text in (
        ("shadow_map.depth_format", "{}"),
        ("map_near_m", "near {} m"),
        ("map_far_m", "far {} m"),
        ("lookup.filter", "filter {}"),
        *((key, f"constant bias {{}} {unit}") for key, unit in CONSTANT_BIASES.items()),
        ("bias.slope", "slope bias {}"),
        ("bias.normal_texels", "normal offset {} texels"),
    ):
        if given(key) and not (key in ("bias.slope", "bias.normal_texels")
                               and rows[key].iloc[0] == 0):
            parts.append(text.format(value(key)))
    return ", ".join(parts)


def curves_of(run, rows, most=3):
    """One row for each bias curve to draw, and the reason for the choice.

    If there are too many curves, only that of the configuration with the fewest errors, for each of the first
    cases.
    """
    curves = rows.drop_duplicates("curve")
    if len(curves) <= most:
        return curves, ""
    errors = rows["error_rate"].fillna(numpy.inf)
    best = errors.groupby(rows["case"], sort=False, dropna=False).idxmin()
    whose = "that" if len(best) == 1 else "each case's"
    if len(best) > most:
        whose = f"each of the first {most} cases'"
    return rows.loc[best.iloc[:most]], (f"of {len(curves)} bias curves {whose} of the configuration with the fewest "
                                        "errors")


def has_bias(rows, curve, bias):
    """Whether a configuration of the curve has this constant bias [depth units].

    A sweep over biases may lack the job's own. For biases in another unit, a single one counts as the job's.
    Biases of bins are rounded to float32, as in the lookup.
    """
    own = rows[rows["curve"] == curve]
    given = own["bias.constant"].dropna()
    if len(given):
        return bool((given.astype(numpy.float32) == numpy.float32(bias)).any())
    return all(own[key].nunique() <= 1 for key in CONSTANT_BIASES)


def biases_text(name, biases):
    """"job's bias 0.006 depth units": one bias for all panels, or all from left to right."""
    texts = [text_of(bias) for bias in biases]
    texts = texts[:1] if len(set(texts)) == 1 else texts
    return f"{name} {', '.join(texts)} depth units" if texts else ""


def panel_titles(run, rows, chosen):
    """A title that distinguishes each chosen curve; empty for a single one."""
    if len(chosen) < 2:
        return [""] * len(chosen)
    axes = [axis for axis in axes_of(run, chosen.reset_index(drop=True))
            if axis.key not in CONSTANT_BIASES]
    return [description(axes, index) for index in range(len(chosen))]


def percent(rate):
    """A rate in words."""
    return "no pixel to count" if pandas.isna(rate) else f"{100 * rate:.3g} %"
