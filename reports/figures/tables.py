"""The CSV files that Gnomon writes, and the depth storage that they describe."""

from dataclasses import dataclass

import numpy
from gnomon import InputError, read_table

FORMULA_COLUMNS = ("zeta_m", "depth", "envelope_m", "formula_code", "formula_error_m")
MEASURED_COLUMNS = ("error_m", "transform_error_m", "model_m")


@dataclass(frozen=True)
class Storage:
    """The storage of a `gnomon depth` table; bits is None for float32."""

    near_m: float
    far_m: float
    is_reversed: bool
    bits: int | None

    @property
    def name(self):
        """For a legend: "16 bits", "float32 reversed"."""
        kind = "float32" if self.bits is None else f"{self.bits} bits"
        return f"{kind} reversed" if self.is_reversed else kind

    @property
    def frustum(self):
        """For a subtitle."""
        return f"perspective, near {self.near_m:g} m, far {self.far_m:g} m"


def read_formulas(paths):
    """Tables of `gnomon depth --csv`, with or without GL's columns."""
    return [_read_depths(path, FORMULA_COLUMNS) for path in paths]


def read_measured(paths):
    """Tables of `gnomon depth --csv` with GL's columns, without planes that GL did not draw."""
    return [_read_depths(path, FORMULA_COLUMNS + MEASURED_COLUMNS) for path in paths]


def _read_depths(path, columns):
    table = read_table(path, columns)
    rows = table.dropna(subset=list(columns)).reset_index(drop=True)
    if len(rows) < 3:
        raise InputError(
            f"{path}: only {len(rows)} rows have all of {', '.join(columns)};"
            " was it written with --theory-only?"
        )
    rows.attrs["path"] = str(path)
    return rows


def storage_of(table):
    """Near, far and bits of a table, from its depths and codes: 1/ζ is linear in depth.

    Raises InputError for other projections.
    """
    depth = table["depth"].to_numpy()
    inverse = 1 / table["zeta_m"].to_numpy()
    slope = (inverse[-1] - inverse[0]) / (depth[-1] - depth[0])
    at_0 = inverse[0] - slope * depth[0]
    if not numpy.allclose(at_0 + slope * depth, inverse, rtol=1e-9, atol=0):
        raise InputError(
            f"{table.attrs['path']}: the projection is not perspective; omit"
            " --projection orthographic and --content distance"
        )
    far_m, near_m = sorted((1 / at_0, 1 / (at_0 + slope)), reverse=True)
    return Storage(near_m, far_m, is_reversed=slope > 0, bits=_bits_of(table))


def _bits_of(table):
    """The bit width of the table's codes; None for float32.

    Raises InputError for other formats.
    """
    depth = table["depth"].to_numpy()
    code = table["formula_code"].to_numpy()
    for bits in range(8, 33):
        # Rounding a depth to double moves its code by at most 2^-21.
        if numpy.all(numpy.abs(code - depth * (2**bits - 1)) <= 0.5 + 2**-20):
            return bits
    floats = code.astype(numpy.uint32).view(numpy.float32)
    # A float32 in [½, 1) and its z_ndc each round by at most 2^-25.
    if not numpy.allclose(floats, depth, rtol=0, atol=2**-24):
        raise InputError(
            f"{table.attrs['path']}: the codes are neither evenly spaced nor float32;"
            " omit r16f and rgba8"
        )
    return None


def common_frustum(tables):
    """The storages of tables that share near and far.

    Raises InputError if they differ.
    """
    storages = [storage_of(table) for table in tables]
    for table, storage in zip(tables, storages):
        if storage.frustum != storages[0].frustum:
            raise InputError(
                f"{table.attrs['path']}: {storage.frustum}, but the first table has"
                f" {storages[0].frustum}; give one frustum"
            )
    return storages
