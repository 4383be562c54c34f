"""The position of the sun at a place and time."""

import math
from collections.abc import Iterable
from datetime import datetime
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from gnomon import _gnomon
from gnomon.keys import one_line, real_number

Time = str | datetime | np.datetime64
"""A string that ends with Z or an offset, a datetime with a time zone, or a datetime64 in UTC."""


def _milliseconds(time: Any) -> int:
    if isinstance(time, str):
        return _gnomon.utc_milliseconds(time)
    if isinstance(time, datetime) and time == time:  # pandas' NaT does not equal itself
        if time.tzinfo is None:
            raise _gnomon.InputError(f"time = {time.isoformat()}: has no time zone; add one, such as timezone.utc")
        return round(time.timestamp() * 1000)
    if isinstance(time, np.datetime64) and not np.isnat(time):
        return int(time.astype("datetime64[ms]").astype(np.int64))
    raise _gnomon.InputError(f"time = {one_line(time)}: must be a string, a datetime or a datetime64")


def _positions(latitude_deg: float, longitude_deg: float, time: Any) -> tuple[npt.NDArray[np.float64], bool]:
    """Azimuth and elevation for each time, and whether a single time was given."""
    dimensions = time.ndim if isinstance(time, np.ndarray) else 1
    is_one = isinstance(time, (str, bytes, np.datetime64)) or not isinstance(time, Iterable) or dimensions == 0
    if dimensions > 1:
        raise _gnomon.InputError(f"time has {dimensions} dimensions: must be a time or a sequence of times")
    each = [time[()] if isinstance(time, np.ndarray) else time] if is_one else list(time)
    times = np.array([_milliseconds(one) for one in each], np.int64)
    place = real_number(latitude_deg, "latitude_deg"), real_number(longitude_deg, "longitude_deg")
    return _gnomon.sun_positions(*place, times), is_one


def _north(north: Any) -> tuple[float, float]:
    try:
        x, y, z = (float(each) for each in north)
    except (TypeError, ValueError, OverflowError):
        x = y = z = math.nan
    length = math.hypot(x, z)
    if not (math.isfinite(length) and math.isfinite(y) and length > 0):
        raise _gnomon.InputError(f"north = {one_line(north)}: must be three numbers with a horizontal part")
    return x / length, z / length


@overload
def sun_position(  # type: ignore[misc]  # a string is an iterable as well
    latitude_deg: float, longitude_deg: float, time: Time
) -> tuple[float, float]: ...
@overload
def sun_position(
    latitude_deg: float, longitude_deg: float, time: Iterable[Any]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
def sun_position(latitude_deg: float, longitude_deg: float, time: Any) -> tuple[Any, Any]:
    """The position of the sun's centre in the sky, within 0.007° (R. Grena, 2012, algorithm 5, with UTC for UT1).

    Ignores refraction, which lifts the sun by half a degree at the horizon and by 0.1° at 10°.

    Parameters
    ----------
    latitude_deg, longitude_deg : float
        The place; longitudes are positive to the east. At the south pole azimuths count from the
        longitude's meridian, at the north pole from the opposite one.
    time : str, datetime or datetime64, or several of them
        In the years 2010 to 2109: `"2026-06-21T12:00:00Z"`, `"2026-06-21T14:00+02:00"`, a datetime with a
        time zone, or a datetime64 in UTC.

    Returns
    -------
    azimuth_deg, elevation_deg : float, or arrays of shape (n,) for n times
        Clockwise from north, and above the horizon.

    Raises
    ------
    InputError
        If the place or a time is invalid, or the year is out of range.
    """
    found, is_one = _positions(latitude_deg, longitude_deg, time)
    return (float(found[0, 0]), float(found[0, 1])) if is_one else (found[:, 0], found[:, 1])


def sun_direction(
    latitude_deg: float,
    longitude_deg: float,
    time: Time | Iterable[Time],
    north: npt.ArrayLike = (0, 0, -1),
) -> npt.NDArray[np.float64]:
    """The direction in which sunlight travels in a scene whose y points up, for `light={"direction": …}`.

    Parameters
    ----------
    latitude_deg, longitude_deg, time
        As for `sun_position`.
    north : array_like, shape (3,)
        The direction of north in the scene; only its horizontal part counts. By default x points east.

    Returns
    -------
    array, shape (3,), or (n, 3) for n times
        Of length 1. It points up if the sun is below the horizon.

    Raises
    ------
    InputError
        As for `sun_position`, and if `north` has no horizontal part.
    """
    toward = _north(north)
    found, is_one = _positions(latitude_deg, longitude_deg, time)
    directions = _gnomon.sun_directions(found, *toward)
    return directions[0] if is_one else directions
