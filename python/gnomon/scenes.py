"""Scenes: triangles that a camera sees and that cast shadows."""

import os
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from gnomon import _gnomon
from gnomon.keys import pairs, whole_number


class Object(NamedTuple):
    """A named run of triangles."""

    name: str
    first_triangle: int
    triangle_count: int
    casts: bool
    receives: bool


class Scene:
    """Triangles for both renderers, with corners rounded to float32 once.

    Parameters
    ----------
    vertices : array_like, shape (n, 3)
        Corners, right-handed, finite and within ±1e15.
    triangles : array_like of int, shape (m, 3)
        Indices of `vertices`, counter-clockwise seen from outside. Triangles without
        an area in float32 are dropped; `kept_triangles` lists the others.
    objects : dict of str to int, optional
        The number of triangles of each object, in order; by default all belong to object "mesh".
    no_cast, no_receive : sequence of str, optional
        Objects that cast no shadow, and objects that the camera does not see.

    Attributes
    ----------
    kept_triangles : array of uint32, or None
        The caller's index of each triangle; None for a loaded or built-in scene.

    Raises
    ------
    InputError
        If an argument is invalid; the message names it and the index.
    """

    kept_triangles: npt.NDArray[np.uint32] | None

    def __init__(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        objects: Mapping[str, int] | None = None,
        no_cast: Sequence[str] = (),
        no_receive: Sequence[str] = (),
    ) -> None:
        runs = [
            (str(name), whole_number(count, f'objects["{name}"]', 0, 2**32))
            for name, count in (objects or {}).items()
        ]
        names = [[str(name) for name in names] for names in (no_cast, no_receive)]
        self._scene, kept_triangles = _gnomon.make_scene(vertices, triangles, runs, *names)
        kept_triangles.flags.writeable = False
        self.kept_triangles = kept_triangles
        self._job: tuple[str, str, Mapping[str, Any]] | None = None

    @classmethod
    def _of_job(cls, path: str, builtin_name: str, keys: Mapping[str, Any]) -> "Scene":
        """The scene of a job with these keys, which jobs made from the scene inherit."""
        self = cls.__new__(cls)
        self._scene = _gnomon.load(path, builtin_name, pairs(keys))
        self.kept_triangles = None
        self._job = path, builtin_name, keys
        return self

    @property
    def vertices(self) -> npt.NDArray[np.float32]:
        """float32 array, shape (n, 3): a read-only view of the scene's memory."""
        return self._scene.vertices

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """uint32 array, shape (m, 3): a read-only view of the scene's memory."""
        return self._scene.triangles

    @property
    def objects(self) -> list[Object]:
        """List of `Object`: the runs of triangles, in order."""
        return [Object(*each) for each in self._scene.objects]

    @property
    def dropped_triangles(self) -> int:
        """int: the number of triangles dropped because they have no area."""
        return self._scene.dropped_triangles

    @property
    def content_hash(self) -> str:
        """str: a hash of everything that the truth depends on, 16 hexadecimal digits."""
        return self._scene.content_hash

    def __len__(self) -> int:
        return len(self.triangles)

    def __repr__(self) -> str:
        return f"<gnomon.Scene: {len(self):,} triangles, {len(self._scene.objects)} objects>"


def load(path: str | os.PathLike[str], **keys: Any) -> Scene:
    """Load a scene file, or the scene of a job file.

    Parameters
    ----------
    path : path_like
        A file that `gnomon compare` accepts: .glb, .gltf, .obj, .ply, .stl, … or a job's .toml.
    **keys
        Keys of [scene]: `ground=True`, `unit_m=0.01`, `up="z"`, `no_cast=["glass"]`, …

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        If the file cannot be read, or a key is unknown or out of range.
    """
    return Scene._of_job(os.path.abspath(path), "", {"scene": keys})


def builtin(name: str, **parameters: Any) -> Scene:
    """Make a built-in scene.

    Parameters
    ----------
    name : str
        One of `builtins()`.
    **parameters
        Its parameters, as `gnomon scenes` lists them: `builtin("tilted-plane", angle_deg=10)`. Other
        keys of [scene], such as `ground`, are allowed as well.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        If there is no such scene or parameter; the message suggests the nearest name.
    """
    known = set(_gnomon.key_names())
    keys = {}
    for key, value in parameters.items():
        is_scene_key = f"scene.{key}" in known and f"scene.{name}.{key}" not in known
        keys[f"scene.{key}" if is_scene_key else f"scene.{name}.{key}"] = value
    return Scene._of_job("", name, keys)


def builtins() -> list[str]:
    """The names of the built-in scenes, a list of str."""
    return _gnomon.builtin_names()
