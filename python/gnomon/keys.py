"""Converts keys of a job from Python to the text that the library reads."""

import json
import math
import operator
import os
from collections.abc import Mapping
from datetime import datetime

import numpy as np

from gnomon import _gnomon


def toml(value):
    """A value as TOML text.

    Raises
    ------
    InputError
        If no key of a job has this type.
    """
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        number = float(value)
        return repr(number) if math.isfinite(number) else str(number)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, datetime) and value.tzinfo is not None:
        return json.dumps(value.isoformat())
    if isinstance(value, np.datetime64) and not np.isnat(value):
        return json.dumps(f"{value.astype('datetime64[ms]')}Z")
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(toml(each) for each in value) + "]"
    raise _gnomon.InputError(f"a key cannot be a {type(value).__name__}: use a number, a string, a bool or a list of them")


def whole_number(value, name, least, most):
    """Convert an argument to an int.

    Raises
    ------
    InputError
        If it is not a whole number in the range; the message names the argument.
    """
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or not least <= number <= most:
        raise _gnomon.InputError(f"{name} = {one_line(value)}: must be a whole number from {least} to {most}")
    return number


def real_number(value, name):
    """Convert an argument to a float.

    Raises
    ------
    InputError
        If it is not a number; the message names the argument.
    """
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise _gnomon.InputError(f"{name} = {one_line(value)}: must be a number") from None


def one_line(value):
    """The value in one line of at most 60 characters, for messages."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:59] + "…"


def thread_count(threads):
    """The checked number of threads; 0 means all cores."""
    return whole_number(threads, "threads", 0, 1024)


def flat(keys, prefix=""):
    """Flatten nested tables to pairs of a dotted key and its value, in order, without values of None.

        >>> list(flat({"bias": {"constant": 0.01}, "image.width": 64}))
        [('bias.constant', 0.01), ('image.width', 64)]
    """
    for key, value in keys.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            yield from flat(value, name + ".")
        elif value is not None:
            yield name, value


def pairs(keys):
    """Keys for the library: dotted keys with values as TOML text."""
    return [(name, toml(value)) for name, value in flat(keys)]
