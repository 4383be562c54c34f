"""A CSV file that Gnomon wrote, as a table."""

import io

import pandas

from .errors import InputError

# Ids are hexadecimal, so some look like numbers; a message may be any text.
TEXTS = ("id", "curve", "case", "light", "status", "message", "scene_hash", "at", "bias_source")


def read_table(path, numbers=(), texts=(), may_be_empty=False, columns=None, lines=None,
               totals=False):
    """A file's table, which must have the columns `numbers` and `texts`.

    A cell without a value is NaN, in texts None; numbers are bit for bit the doubles that Gnomon wrote.
    `columns`: a predicate of the names to read, all by default; `lines`: the file's bytes, or its header
    and a part of its rows, if they were read before; `totals`: reads the rows of all lights together, in
    place of those of each light. Raises InputError if the file is missing, is not CSV, lacks a column, has
    text in a column of `numbers`, or has no rows, unless it `may_be_empty`.
    """
    try:
        table = pandas.read_csv(
            path if lines is None else io.BytesIO(lines),
            dtype=dict.fromkeys((*TEXTS, *texts), object),
            usecols=columns,
            low_memory=False,
            # The default parser of pandas is sometimes off by an ulp.
            float_precision="round_trip",
        )
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; docs/csv_schema.md says which files a run has")
    except pandas.errors.EmptyDataError:
        raise InputError(f"{path}: cannot be read as CSV: the file is empty; write it again")
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: cannot be read as CSV: {' '.join(str(error).split())}")
    missing = [name for name in (*texts, *numbers) if name not in table]
    if missing:
        raise InputError(f"{path}: no column {missing[0]}; see docs/csv_schema.md")
    if table.empty and not may_be_empty:
        raise InputError(f"{path}: no rows under the header; write it again with gnomon")
    for name in numbers:
        table[name] = _numbers(path, table[name])
    for name in table.columns.intersection((*TEXTS, *texts)):
        table[name] = table[name].where(table[name].notna(), None)
    if "light" in table:
        return table[table["light"].isna() == totals].reset_index(drop=True)
    return table.iloc[:0] if totals else table


def _numbers(path, column):
    found = pandas.to_numeric(column, errors="coerce")
    bad = found.isna() & column.notna()
    if bad.any():
        row = int(bad.to_numpy().argmax())
        raise InputError(f"{path}: line {row + 2}: {column.name} is not a number: {column[row]}")
    return found.astype(float)
