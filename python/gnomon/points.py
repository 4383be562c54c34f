"""What is true of points: does the light reach them? Decided exactly, not by float rays."""

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from gnomon import _gnomon
from gnomon.keys import pairs, thread_count
from gnomon.scenes import Scene
from gnomon.sun import sun_direction, sun_position

CLASSES = ("background", "unmatched", "attached", "out_of_light", "indeterminate", "lit", "blocked")
"""What the codes of `PointTruth.point_class` and of a comparison's layer "class" mean."""

REASONS = ("none", "snap", "tie", "mismatch", "silhouette", "vertex", "graze", "rounding")
"""What the codes of `PointTruth.reason` and of a comparison's layer "reason" mean."""

_SIDES = {"light": "to_light", "front": "front", "back": "back"}


class PointTruth:
    """What is true of n points, in their order. Arrays are the result's own memory, read-only.

    A point is `lit` if nothing touches the open segment from it to the light, `blocked` if a
    triangle, or the edge between two, crosses it; `indeterminate` if it only touches an edge or a
    corner, or runs in a triangle's plane (`reason` says which); `attached` if its triangle is
    turned from the light; `out_of_light` outside a spot's cone.
    """

    def __init__(self, truth: Any, distance_m: npt.NDArray[np.float64] | None = None) -> None:
        self._truth = truth
        self.distance_m = distance_m
        """float64 array, shape (n,): how far `project="nearest"` moved each point; else None."""

    @property
    def point_class(self) -> npt.NDArray[np.uint8]:
        """uint8 array, shape (n,): a code, whose names are `CLASSES`."""
        return self._truth.point_class

    @property
    def reason(self) -> npt.NDArray[np.uint8]:
        """uint8 array, shape (n,): why a point is indeterminate; names are `REASONS`."""
        return self._truth.reason

    @property
    def witness(self) -> npt.NDArray[np.int32]:
        """int32 array, shape (n,): a triangle that blocks the light, or −1."""
        return self._truth.witness.view(np.int32)

    @property
    def share(self) -> npt.NDArray[np.float32]:
        """float32 array, shape (n, 2): the interval of the share of the light that is seen."""
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
        """int: decisions that doubles could not make, and integers did."""
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
            raise _gnomon.InputError(f"light: a sun has latitude_deg, longitude_deg and time, not {sorted(sun)}")
    place = sun["latitude_deg"], sun["longitude_deg"], sun["time"]
    _, elevation_deg = sun_position(*place)
    if not np.ndim(elevation_deg) == 0:
        raise _gnomon.InputError("light: a sun has one time")
    if elevation_deg <= 0:
        raise _gnomon.InputError(f"light: the sun is {-elevation_deg:.1f} degrees below the horizon at {sun['time']}")
    return sun_direction(*place, north=scene._scene.north).tolist()


def job_light(light: Mapping[str, Any], scene: Scene) -> dict[str, Any]:
    """Keys of a job's [light] of a light as callers give it; the type follows from what is given.

    A sun becomes the direction that it has in the scene.
    """
    if not isinstance(light, Mapping):
        raise _gnomon.InputError('light must be a dict, such as {"direction": [0, -1, 0]} or {"position": [0, 5, 0]}')
    if not light:
        raise _gnomon.InputError("light is empty: give a direction, or a position")
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
    """Decide for each point whether it sees the light. Exact: no offset, no float rounding.

    Points are given in space or on triangles. A point in space is taken as its three doubles are:
    no triangle is its own, so one that was rounded below its surface is in that surface's shadow.
    A point on a triangle, a + u(b − a) + v(c − a), is exactly there, and its own triangle never
    blocks it. Points are independent: order, number and threads change nothing.

    Parameters
    ----------
    scene : Scene
    points : array_like, shape (n, 3)
        Points in space.
    light : dict
        `{"direction": …}`, the way a sun's light travels; `{"position": …}`, a point light; or
        `{"position": …, "target": …, "cone_deg": 60}`, a spot with its full opening angle. Its keys
        are those of a job's [light]. Numbers other than 0 are from 1e-28 to 1e15 in size.
    triangles, barycentrics : array_like of int, shape (n,), and array_like, shape (n, 2)
        Points on triangles of the scene, in place of `points`: u, v ≥ 0 and u + v ≤ 1. Where
        triangles without an area were left out, `Scene.kept_triangles` has the caller's indices.
    side : {"light", "front", "back"}
        On which side of their triangles such points are: the one that faces the light, or the one
        that sees the corners counter-clockwise, or the other. `attached` where the light is on the
        other side.
    project : {None, "nearest"}
        "nearest" moves points in space onto the nearest triangles, where they are points of the
        second kind; `PointTruth.distance_m` says how far.
    light_precision : {"float32", "double"}
        Whether the light's numbers are rounded to float32 once, as a job's are, or kept.
    threads : int
        0: all cores.

    Returns
    -------
    PointTruth

    Raises
    ------
    InputError
        Naming argument and index.
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
