"""Comparisons of shadow maps, and of other renderers' masks, with the truth."""

import base64
import html
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from gnomon import _gnomon
from gnomon.keys import flat, pairs, thread_count, whole_number
from gnomon.points import job_light
from gnomon.scenes import Scene

if TYPE_CHECKING:
    import pandas

Job = str | os.PathLike[str] | Mapping[str, Any] | Scene
"""A job file, a scene file, the name of a built-in scene, a job's tables, or a scene."""


class BiasCurve:
    """The exact number of wrong pixels at every constant bias."""

    def __init__(self, lit: npt.NDArray[np.float32], blocked: npt.NDArray[np.float32]) -> None:
        self.lit = lit
        """float32 array: the smallest bias that lights each scored lit pixel, ascending."""
        self.blocked = blocked
        """float32 array: the smallest bias that lights each scored blocked pixel, ascending."""

    def false_shadow(self, bias: npt.ArrayLike) -> Any:
        """Number of lit pixels that are shadowed at a bias, or at each of several [px]."""
        return len(self.lit) - np.searchsorted(self.lit, np.asarray(bias, np.float32), side="right")

    def false_lit(self, bias: npt.ArrayLike) -> Any:
        """Number of blocked pixels that are lit at a bias, or at each of several [px]."""
        return np.searchsorted(self.blocked, np.asarray(bias, np.float32), side="right")


class Comparison:
    """The verdict of GL's shadow map, or of another renderer's mask, for each pixel, and the truth.

    Layers are numpy arrays over the result's own memory, read-only, by their names in an EXR file
    (docs/aov.md): `result.layers["verdict"]`, or `result["verdict"]`.
    """

    def __init__(self, compared: Any) -> None:
        self._compared = compared
        self._json: dict[str, Any] | None = None

    @property
    def light(self) -> str:
        """str: the name of the light; empty if the job has only one."""
        return self._compared.light

    @property
    def layers(self) -> dict[str, npt.NDArray[Any]]:
        """dict of str to array, shape (height, width) or (height, width, 2)."""
        return self._compared.layers()

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self.truth if name == "truth" else self.layers[name]

    @property
    def truth(self) -> npt.NDArray[np.float32]:
        """float32 array, shape (height, width): 1 lit, 0 blocked, −1 not scored."""
        return self._compared.truth()

    @property
    def verdict(self) -> npt.NDArray[np.float32]:
        """float32 array, shape (height, width): 1 lit, 0 shadowed, between for filtered lookups."""
        return self.layers["verdict"]

    @property
    def positions(self) -> npt.NDArray[np.float32]:
        """float32 array, shape (height, width, 3): the point that each pixel shows; NaN for background."""
        return self._compared.positions()

    @property
    def metrics(self) -> dict[str, float | None]:
        """dict of str to number: counts, rates and amounts of error (docs/metrics.md).

        None means a rate without a denominator, or a metric that was not measured.
        """
        return {
            name: value
            for name, value in self.to_dict().items()
            if name != "schema" and (value is None or isinstance(value, (int, float)))
        }

    @property
    def findings(self) -> list[str]:
        """List of str: the errors, their causes and the remedies."""
        return self.to_dict().get("findings") or []

    @property
    def remedies(self) -> list[dict[str, Any]]:
        """List of dict: further changes that reduce the errors, with the errors that remain."""
        return self.to_dict().get("remedies") or []

    @property
    def curve(self) -> BiasCurve | None:
        """BiasCurve, or None if the method has none."""
        found = self._compared.curve()
        return None if found is None else BiasCurve(*found)

    def to_dict(self) -> dict[str, Any]:
        """The output of `gnomon compare --json` (docs/json_schema.md)."""
        if self._json is None:
            self._json = json.loads(self._compared.json())
        return self._json

    def settings(self, engine: str, *, recommended: bool = True) -> dict[str, Any]:
        """What to type in an engine to get this shadow map: `gnomon settings --json` (docs/json_schema.md).

        Parameters
        ----------
        engine : str
            Its name or alias: "three", "unity", "godot4", …; or "glsl", "hlsl", "gl", "direct3d", "vulkan"
            (docs/presets.md#settings).
        recommended : bool
            Take the recommended constant bias; else the job's own.

        Raises
        ------
        InputError
            If the engine is unknown, or does not support the job's type of light.
        """
        return json.loads(self._compared.settings(str(engine), bool(recommended)))[0]

    def to_pandas(self) -> "pandas.Series[Any]":
        """pandas.Series of the metrics."""
        import pandas

        return pandas.Series(self.metrics, name="metrics")

    def picture(self) -> npt.NDArray[np.uint8]:
        """uint8 array, shape (height, width, 3): the picture of `gnomon compare --picture`."""
        return self._compared.picture()

    def save_picture(self, path: str | os.PathLike[str]) -> None:
        """Write the picture into a file whose name ends with .png."""
        if Path(path).suffix.lower() != ".png":
            raise _gnomon.InputError(f"path = {os.fspath(path)!r}: must end with .png")
        Path(path).write_bytes(self._compared.picture_png())

    def _repr_html_(self) -> str:
        picture = base64.b64encode(self._compared.picture_png()).decode()
        listed = "".join(f"<li>{html.escape(each)}</li>" for each in self.findings)
        to_paste = f"<pre>{html.escape(self.remedies[0]['toml'])}</pre>" if self.remedies else ""
        return f'<img src="data:image/png;base64,{picture}" style="max-width:100%"><ul>{listed}</ul>{to_paste}'

    def __repr__(self) -> str:
        found = self.findings
        return f"<gnomon.Comparison: {found[0] if found else self.metrics}>"


def _three_numbers(value, name):
    try:
        numbers = [float(each) for each in value]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != 3:
        raise _gnomon.InputError(f"{name} = {value!r}: must be three numbers")
    return numbers


def _device(device):
    return None if device is None else whole_number(device, "device", 0, 1024)


def _parts(job):
    """A job argument as path, built-in name, scene in memory and keys."""
    if isinstance(job, Scene):
        if job._job is None:
            return "", "", job._scene, {}
        path, builtin, keys = job._job
        return path, builtin, None, dict(flat(keys))
    if isinstance(job, Mapping):
        keys = dict(flat(job))
        if "scene.builtin" in keys:
            return "", keys.pop("scene.builtin"), None, keys
        if "scene.file" in keys:
            return os.fspath(keys.pop("scene.file")), "", None, keys
        raise _gnomon.InputError("job: no scene given: add scene.builtin or scene.file")
    name = os.fspath(job)
    if name in _gnomon.builtin_names() and not os.path.exists(name):
        return "", name, None, {}
    return name, "", None, {}


def place_of(job, keys):
    """A job's source and its own keys; `keys` override these."""
    for key in ("scene.file", "scene.builtin"):
        if isinstance(job, Scene) and key in dict(flat(keys)):
            raise _gnomon.InputError(f"{key}: the job already is a scene; omit the key")
    path, builtin, scene, own_keys = _parts(job)
    return _gnomon.JobPlace(path, builtin, scene, pairs(own_keys))


_VIEWS = {"cameras": 64, "lights": 64}


def advice_request(views, methods, max_bytes):
    """The checked search space of advice and tuning."""
    views = {} if views is None else views if isinstance(views, Mapping) else {"cameras": views}
    for name in views:
        if name not in (*_VIEWS, "all_cases"):
            raise _gnomon.InputError(f"views: unknown {name!r}: use cameras, lights or all_cases")
    counts = [whole_number(views.get(name, 0), f"views[{name!r}]", 0, most) for name, most in _VIEWS.items()]
    methods = "" if methods is None else methods
    methods = [each for each in methods.split(",") if each] if isinstance(methods, str) else [str(each) for each in methods]
    max_bytes = None if max_bytes is None else whole_number(max_bytes, "max_bytes", 1, 2**40)
    return _gnomon.AdviceRequest(*counts, bool(views.get("all_cases", False)), methods, max_bytes)


def one_or_all(of_lights: list[Any]) -> Any:
    """The only result of a job with one light, else the list of results."""
    return of_lights[0] if len(of_lights) == 1 else of_lights


def _require_same_scene(job, keys, compared):
    """Require that a scene's file has not changed since it was loaded, as the job reads it again."""
    if not isinstance(job, Scene) or any(key.startswith("scene.") for key in keys):
        return
    if compared.to_dict()["scene"]["hash"] != job.content_hash:
        raise _gnomon.InputError("the scene's file has changed since it was loaded: load it again")


def compare(
    job: Job,
    *,
    case: str = "",
    only_light: str = "",
    advise: bool = False,
    views: int | Mapping[str, int] | None = None,
    methods: str | Iterable[str] | None = None,
    max_bytes: int | None = None,
    device: int | None = None,
    threads: int = 0,
    **keys: Any,
) -> Comparison | Any:
    """Draw a job's shadow map with GL, and compare every pixel with the truth: `gnomon compare`.

    Parameters
    ----------
    job : path_like, dict or Scene
        A job file, a scene file, the name of a built-in scene, a job's tables as a dict with
        `scene.builtin` or `scene.file`, or a scene in memory.
    case : str
        One of the job file's `[[case]]`.
    only_light : str
        The name of one of the job's several lights.
    advise : bool
        Rerun with changes that suit the errors, for `remedies`.
    views : int or dict, optional
        With advise: further views in which advice must hold: `{"cameras": 4, "lights": 2}` around the
        job's own, or `{"all_cases": True}`; a number counts cameras (docs/tune.md#views).
    methods : str or list of str, optional
        With advise: further shadow methods to try: names, or "all".
    max_bytes : int, optional
        With methods: the largest size of a method's maps [bytes]; by default that of the job's.
    device : int, optional
        EGL device, as `gnomon doctor` numbers them; by default the first that works.
    threads : int
        For the truth; 0 for all cores.
    **keys
        Keys that override the job's (docs/job_file.md): `bias={"constant": 0.001}`, or
        `**{"bias.constant": 0.001}`.

    Returns
    -------
    Comparison, or a list of them if the job has several lights and `only_light` names none.

    Raises
    ------
    InputError
        If the job is invalid, with the program's message.
    EnvironmentError
        If there is no GL driver, or GL or Embree fails.
    """
    if not advise and (views is not None or methods is not None or max_bytes is not None):
        raise _gnomon.InputError("views, methods and max_bytes need advise=True")
    place = place_of(job, keys)
    given = dict(flat(keys))
    found = _gnomon.compare(
        place,
        pairs(given),
        _gnomon.JobChoice(str(case), str(only_light)),
        advice_request(views, methods, max_bytes) if advise else None,
        _device(device),
        thread_count(threads),
    )
    comparisons = [Comparison(each) for each in found]
    _require_same_scene(job, given, comparisons[0])
    return one_or_all(comparisons)


def settings(job: Job, engine: str, *, recommended: bool = True, **options: Any) -> dict[str, Any] | Any:
    """What to type in an engine to get a job's shadow map: `gnomon settings`.

    Parameters
    ----------
    job, **options
        As for `compare`.
    engine, recommended
        As for `Comparison.settings`.

    Returns
    -------
    dict, or a list of them if the job has several lights and `only_light` names none.

    Raises
    ------
    InputError, EnvironmentError
        As `compare` and `Comparison.settings`.
    """
    compared = compare(job, **options)
    several = compared if isinstance(compared, list) else [compared]
    return one_or_all([each.settings(engine, recommended=recommended) for each in several])


def evaluate(
    mask: npt.ArrayLike,
    scene: Scene,
    light: Mapping[str, Any],
    positions: npt.ArrayLike | None = None,
    *,
    normals: npt.ArrayLike | None = None,
    camera: Mapping[str, Any] | None = None,
    eye: npt.ArrayLike | None = None,
    fractions: bool = False,
    tolerance_m: float | None = None,
    threads: int = 0,
    **keys: Any,
) -> Comparison:
    """Compare another renderer's shadow mask with the truth: `gnomon evaluate`. Needs no GL.

    Parameters
    ----------
    mask : array_like, shape (height, width)
        1 lit, 0 shadowed, between for filtered lookups; row 0 on top.
    scene : Scene
        The mesh that the renderer drew, in the same space.
    light : dict
        As for `truth`.
    positions : array_like, shape (height, width, 3), optional
        The point that each pixel shows, as float32; NaN for pixels that are not scored. By default
        they follow from the camera.
    normals : array_like, shape (height, width, 3), optional
        Geometric normals on the visible side.
    camera : dict, optional
        Keys of [camera]: `eye`, `target`, `vertical_fov_deg`, `up`, …
    eye : array_like, shape (3,), optional
        The camera's position, if nothing else of it is known.
    fractions : bool
        Whether values between 0 and 1 are intended. By default they are taken as a mistake.
    tolerance_m : float, optional
        The largest distance from the mesh of 99 % of the positions.
    threads : int
        0 for all cores.
    **keys
        Other known keys of a job: `shadow_map={"resolution": 2048}`.

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        If an argument is invalid, or the mask has a recognised mistake: axes, units, row order, …
    """
    if not isinstance(scene, Scene):
        raise TypeError("scene must be a gnomon.Scene: gnomon.Scene(…), gnomon.load(…) or gnomon.builtin(…)")
    of_job = pairs({"light": job_light(light, scene), **({"camera": camera} if camera else {}), **keys})
    eye = None if eye is None else _three_numbers(eye, "eye")
    tolerance_m = None if tolerance_m is None else float(tolerance_m)
    return Comparison(
        _gnomon.evaluate(
            scene._scene, mask, positions, normals, eye, bool(fractions), of_job, tolerance_m, thread_count(threads)
        )
    )


def methods() -> list[dict[str, Any]]:
    """The shadow methods, their filters and bias terms, as `gnomon methods --json` prints them."""
    return json.loads(_gnomon.methods_json())
