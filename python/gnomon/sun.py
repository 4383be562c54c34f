"""Where the sun stands over a place at a time."""

import math
from collections.abc import Iterable
from datetime import datetime
from typing import Any

import numpy as np
import numpy.typing as npt

from gnomon import _gnomon
from gnomon.keys import real_number

Time = str | datetime | np.datetime64
"""A text with Z or an offset at its end, a datetime with a time zone, or a datetime64, which is UTC."""


def _milliseconds(time: Any) -> int:
    if isinstance(time, str):
        return _gnomon.utc_milliseconds(time)
    if isinstance(time, datetime):
        if time.tzinfo is None:
            raise _gnomon.InputError(f"time = {time.isoformat()}: has no time zone; give it one, such as timezone.utc")
        return round(time.timestamp() * 1000)
    if isinstance(time, np.datetime64) and not np.isnat(time):
        return int(time.astype("datetime64[ms]").astype(np.int64))
    raise _gnomon.InputError(f"time = {time!r}: must be a text, a datetime or a datetime64")


def _positions(latitude_deg: float, longitude_deg: float, time: Any) -> tuple[npt.NDArray[np.float64], bool]:
    """Azimuth and elevation of each time, and whether there is but one."""
    is_one = isinstance(time, (str, datetime, np.datetime64))
    times = np.array([_milliseconds(each) for each in ([time] if is_one else time)], np.int64)
    place = real_number(latitude_deg, "latitude_deg"), real_number(longitude_deg, "longitude_deg")
    return _gnomon.sun_positions(*place, times), is_one


def sun_position(
    latitude_deg: float, longitude_deg: float, time: Time | Iterable[Time]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Where the sun's centre stands in the sky, within 0.0027° (R. Grena, 2012, algorithm 5).

    The air's refraction, which lifts the sun by half a degree at the horizon and by 0.1° at 10°, is left out.

    Parameters
    ----------
    latitude_deg, longitude_deg : float
        The place; longitudes are positive in the east. At a pole azimuths count from the longitude's
        meridian.
    time : str, datetime or datetime64, or several of them
        Of the years 2010 to 2109: `"2026-06-21T12:00:00Z"`, `"2026-06-21T14:00+02:00"`, a datetime with a
        time zone, or a datetime64, which is UTC.

    Returns
    -------
    azimuth_deg, elevation_deg : float, or arrays of shape (n,) for n times
        Clockwise from north, and above the horizon.

    Raises
    ------
    InputError
        If the place or a time is none, or of another year.
    """
    found, is_one = _positions(latitude_deg, longitude_deg, time)
    return (found[0, 0], found[0, 1]) if is_one else (found[:, 0], found[:, 1])


def sun_direction(
    latitude_deg: float,
    longitude_deg: float,
    time: Time | Iterable[Time],
    north: npt.ArrayLike = (0, 0, -1),
) -> npt.NDArray[np.float64]:
    """The way that the sun's light travels in a scene whose y points up, for `light={"direction": …}`.

    Parameters
    ----------
    latitude_deg, longitude_deg, time
        As `sun_position` has them.
    north : array_like, shape (3,)
        The way that is north in the scene; its horizontal part counts. By default x points east.

    Returns
    -------
    array, shape (3,), or (n, 3) for n times
        Of length 1. It points up where the sun is below the horizon.

    Raises
    ------
    InputError
        As `sun_position`, and for a north without a horizontal part.
    """
    ways = np.asarray(north, float)
    if ways.shape != (3,) or not np.isfinite(ways).all() or math.hypot(ways[0], ways[2]) == 0:
        raise _gnomon.InputError(f"north = {north!r}: must be three numbers with a horizontal part")
    found, is_one = _positions(latitude_deg, longitude_deg, time)
    length = math.hypot(ways[0], ways[2])
    directions = _gnomon.sun_directions(found, ways[0] / length, ways[2] / length)
    return directions[0] if is_one else directions
