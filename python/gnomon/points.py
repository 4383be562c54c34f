"""Exact truth of points: whether the light reaches them."""

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from gnomon import _gnomon
from gnomon.keys import pairs, thread_count
from gnomon.scenes import Scene
from gnomon.sun import sun_direction, sun_position

CLASSES = ("background", "unmatched", "attached", "out_of_light", "indeterminate", "lit", "blocked")
"""The names of the codes in `PointTruth.point_class` and in a comparison's layer "class"."""

REASONS = ("none", "snap", "tie", "mismatch", "silhouette", "vertex", "graze", "rounding")
"""The names of the codes in `PointTruth.reason` and in a comparison's layer "reason"."""

_SIDES = {"light": "to_light", "front": "front", "back": "back"}


class PointTruth:
    """The truth of n points, in order. Arrays are read-only views of the result's memory.

    A point is `lit` if nothing touches the open segment from it to the light, `blocked` if a
    triangle, or the edge between two, crosses it; `indeterminate` if it only touches an edge or a
    corner, or runs in a triangle's plane (`reason` says which); `attached` if its triangle is
    turned away from the light; `out_of_light` outside a spot's cone.
    """

    def __init__(self, truth: Any, distance_m: npt.NDArray[np.float64] | None = None) -> None:
        self._truth = truth
        self.distance_m = distance_m
        """float64 array, shape (n,): how far `project="nearest"` moved each point, or None."""

    @property
    def point_class(self) -> npt.NDArray[np.uint8]:
        """uint8 array, shape (n,): class codes, named by `CLASSES`."""
        return self._truth.point_class

    @property
    def reason(self) -> npt.NDArray[np.uint8]:
        """uint8 array, shape (n,): why a point is indeterminate, named by `REASONS`."""
        return self._truth.reason

    @property
    def witness(self) -> npt.NDArray[np.int32]:
        """int32 array, shape (n,): a triangle that blocks the light, or −1."""
        return self._truth.witness.view(np.int32)

    @property
    def share(self) -> npt.NDArray[np.float32]:
        """float32 array, shape (n, 2): the interval of the visible share of the light."""
        return self._truth.shares()

    @property
    def lit(self) -> npt.NDArray[np.bool_]:
        """bool array, shape (n,)."""
        return self.point_class == CLASSES.index("lit")

    @property
    def blocked(self) -> npt.NDArray[np.bool_]:
        """bool array, shape (n,)."""
        return self.point_class == CLASSES.index("blocked")

    @property
    def exact_signs(self) -> int:
        """int: the number of signs decided by exact arithmetic, where doubles did not suffice."""
        return self._truth.exact_signs

    def __len__(self) -> int:
        return len(self.point_class)

    def __repr__(self) -> str:
        counts = np.bincount(self.point_class, minlength=len(CLASSES))
        words = ", ".join(f"{count:,} {name}" for name, count in zip(CLASSES, counts) if count)
        return f"<gnomon.PointTruth of {len(self):,} points: {words or 'none'}>"


def _direction_of_sun(sun: Mapping[str, Any], scene: Scene) -> list[float]:
    for name in (*sun, "latitude_deg", "longitude_deg", "time"):
        if name not in sun or name not in ("latitude_deg", "longitude_deg", "time"):
            raise _gnomon.InputError(f"light: a sun needs latitude_deg, longitude_deg and time, not {sorted(sun)}")
    place = sun["latitude_deg"], sun["longitude_deg"], sun["time"]
    _, elevation_deg = sun_position(*place)
    if not np.ndim(elevation_deg) == 0:
        raise _gnomon.InputError("light: a sun needs a single time")
    if elevation_deg <= 0:
        raise _gnomon.InputError(f"light: the sun is {-elevation_deg:.1f} degrees below the horizon at {sun['time']}")
    return sun_direction(*place, north=scene._scene.north).tolist()


def job_light(light: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """The [light] keys of a caller's light; the type follows from the given keys.

    A sun becomes a direction in the scene.
    """
    if not isinstance(light, Mapping):
        raise _gnomon.InputError('light must be a dict, such as {"direction": [0, -1, 0]} or {"position": [0, 5, 0]}')
    if not light:
        raise _gnomon.InputError("light is empty: give a direction or a position")
    keys = dict(light)
    if isinstance(keys.get("sun"), Mapping):
        keys["direction"] = _direction_of_sun(keys.pop("sun"), scene)
    if "type" not in keys and "direction" not in keys and "position" in keys:
        keys["type"] = "spot" if "target" in keys else "point"
    return keys


def truth(
    scene: Scene,
    points: npt.ArrayLike | None = None,
    light: Mapping[str, Any] | None = None,
    *,
    triangles: npt.ArrayLike | None = None,
    barycentrics: npt.ArrayLike | None = None,
    side: Literal["light", "front", "back"] = "light",
    project: Literal["nearest"] | None = None,
    light_precision: Literal["float32", "double"] = "float32",
    threads: int = 0,
) -> PointTruth:
    """Decide exactly for each point whether it sees the light, without offsets or float rounding.

    Points lie in space or on triangles. A point in space is taken as exactly its three doubles. No
    triangle is its own, so a point rounded to below its surface is in that surface's shadow. A point
    on a triangle is exactly a + u(b − a) + v(c − a), and its own triangle never blocks it. The answer
    for a point does not depend on other points or on the number of threads.

    Parameters
    ----------
    scene : Scene
    points : array_like, shape (n, 3)
        Points in space.
    light : dict
        `{"direction": …}`, in which a sun's light travels; `{"position": …}`, a point light; or
        `{"position": …, "target": …, "cone_deg": 60}`, a spot with its full opening angle. Its keys
        are those of a job's [light]. Numbers must be 0, or from 1e-28 to 1e15 in size.
    triangles, barycentrics : array_like of int, shape (n,), and array_like, shape (n, 2)
        Points on triangles of the scene, instead of `points`: u, v ≥ 0 and u + v ≤ 1. Indices count
        the scene's triangles; `Scene.kept_triangles` maps them to the caller's.
    side : {"light", "front", "back"}
        The side of their triangles that points on triangles lie on: the side that faces the light,
        the front, which sees the corners counter-clockwise, or the back. A point is `attached` if
        the light is on the other side.
    project : {None, "nearest"}
        "nearest" moves points in space to points on the nearest triangles; `PointTruth.distance_m`
        is the distance.
    light_precision : {"float32", "double"}
        Whether the light's numbers are rounded to float32 once, as in a job, or kept as doubles.
    threads : int
        0 for all cores.

    Returns
    -------
    PointTruth

    Raises
    ------
    InputError
        If an argument is invalid; the message names it and the index.
    """
    if not isinstance(scene, Scene):
        raise TypeError("scene must be a gnomon.Scene: gnomon.Scene(…), gnomon.load(…) or gnomon.builtin(…)")
    if light is None:
        raise TypeError('truth() needs a light, such as light={"direction": [0, -1, 0]}')
    if light_precision not in ("float32", "double"):
        raise _gnomon.InputError(f'light_precision = "{light_precision}": must be "float32" or "double"')
    threads = thread_count(threads)
    if not isinstance(side, str) or side not in _SIDES:
        raise _gnomon.InputError(f'side = "{side}": must be "light", "front" or "back"')
    if project not in (None, "nearest"):
        raise _gnomon.InputError(f'project = "{project}": must be None or "nearest"')
    on_triangles = triangles is not None or barycentrics is not None
    if on_triangles == (points is not None) or (triangles is None) != (barycentrics is None):
        raise TypeError("truth() needs either points, or triangles and barycentrics")
    of_light = _gnomon.Light(pairs({"light": job_light(light, scene)}), light_precision == "double")
    distance_m = None
    if points is not None and project == "nearest":
        projected = _gnomon.project(scene._scene, points, threads)
        triangles, barycentrics, distance_m = projected.triangles, projected.barycentrics, projected.distance_m
        on_triangles = True
    if on_triangles:
        found = _gnomon.truth_on_triangles(scene._scene, of_light, triangles, barycentrics, _SIDES[side], threads)
    else:
        found = _gnomon.truth_in_space(scene._scene, of_light, points, threads)
    return PointTruth(found, distance_m)
