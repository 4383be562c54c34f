"""Searches for settings: `gnomon tune`."""

import json
import tomllib
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gnomon import _gnomon
from gnomon.comparison import Job, _device, advice_request, one_or_all, place_of
from gnomon.keys import pairs, real_number, thread_count, whole_number

if TYPE_CHECKING:
    import pandas


class Tuning:
    """The result of a search for the cheapest shadow map."""

    def __init__(self, found: Any) -> None:
        self._found = found
        self._json: dict[str, Any] | None = None

    @property
    def light(self) -> str:
        """str: the name of the light; empty if the job has only one."""
        return self._found.light

    @property
    def meets_limits(self) -> bool:
        """bool: whether a setting within the limits was found."""
        return self.to_dict()["meets_limits"]

    @property
    def keys(self) -> dict[str, Any]:
        """dict: the recommended keys of the job, for `compare(job, **keys)`; empty if nothing is recommended."""
        keys = tomllib.loads(self.toml)
        return {"lights": {self.light: keys["lights"]}} if "lights" in keys else keys

    @property
    def toml(self) -> str:
        """str: the keys as TOML to paste into a job file; with several lights, after the light's [[lights]]."""
        return self.to_dict()["toml"]

    @property
    def why(self) -> list[str]:
        """List of str: the errors of the recommended setting, or why nothing is recommended."""
        return self.to_dict()["why"]

    def to_dict(self) -> dict[str, Any]:
        """The output of `gnomon tune --json` for the light (docs/tune.md)."""
        if self._json is None:
            found = json.loads(self._found.json())
            self._json = found["lights"][0] if "lights" in found else found
        return self._json

    def to_pandas(self) -> "pandas.DataFrame":
        """pandas.DataFrame: a row for each considered setting."""
        import pandas

        return pandas.DataFrame(self.to_dict()["considered"])

    def __str__(self) -> str:
        return self._found.text()

    def __repr__(self) -> str:
        return f"<gnomon.Tuning: {'meets' if self.meets_limits else 'does not meet'} the limits>"


def _share(value, name):
    share = real_number(value, name)
    if not 0 <= share <= 1:
        raise _gnomon.InputError(f"{name} = {value!r}: must be a share from 0 to 1")
    return share


def _seconds(value):
    seconds = real_number(value, "time_s")
    if not 1 <= seconds <= 86400:
        raise _gnomon.InputError(f"time_s = {value!r}: must be 1 to 86400 seconds")
    return seconds


def tune(
    job: Job,
    *,
    case: str = "",
    only_light: str = "",
    max_false_shadow: float | None = None,
    max_false_lit: float | None = None,
    max_false_shadow_count: float = 1,
    max_false_lit_count: float = 1,
    max_resolution: int = 4096,
    time_s: float = 30,
    views: int | Mapping[str, int] | None = None,
    methods: str | Iterable[str] | None = None,
    max_bytes: int | None = None,
    device: int | None = None,
    threads: int = 0,
    **keys: Any,
) -> Tuning | Any:
    """Search the cheapest shadow map that meets the limits, or is as good as the scene allows.

    Parameters
    ----------
    job, case, only_light, device, threads
        As for `compare`.
    max_false_shadow : float, optional
        Largest amount of shadow on lit pixels, as a share of them, 0 to 1, not counting intended
        softening by a filter. By default 1.25 times that of the least wrong setting tried, plus 0.0002.
    max_false_lit : float, optional
        Largest amount of light on blocked pixels, likewise.
    max_false_shadow_count, max_false_lit_count : float
        Largest share of wrong pixels, by count, among the lit and among the blocked.
    max_resolution : int
        The largest map [texels].
    time_s : float
        Seconds after which the search returns its best result; a search over methods tries all.
    views : int or dict, optional
        As for `compare`.
    methods : str or list of str, optional
        Further shadow methods to search: names, or "all".
    max_bytes : int, optional
        With methods: the largest size of a method's maps [bytes].
    **keys
        Keys that override the job's.

    Returns
    -------
    Tuning, or a list of them if the job has several lights and `only_light` names none.

    Raises
    ------
    InputError
        If the job or a limit is invalid, with the program's message.
    EnvironmentError
        If there is no GL driver, or GL or Embree fails.
    """
    goal = _gnomon.TuneGoal()
    if max_false_shadow is not None:
        goal.max_shadow_amount_rate = _share(max_false_shadow, "max_false_shadow")
    if max_false_lit is not None:
        goal.max_light_amount_rate = _share(max_false_lit, "max_false_lit")
    goal.max_false_shadow_rate = _share(max_false_shadow_count, "max_false_shadow_count")
    goal.max_false_lit_rate = _share(max_false_lit_count, "max_false_lit_count")
    goal.max_resolution = whole_number(max_resolution, "max_resolution", 1, 16384)
    goal.time_s = _seconds(time_s)
    found = _gnomon.tune(
        place_of(job, keys),
        pairs(keys),
        _gnomon.JobChoice(str(case), str(only_light)),
        advice_request(views, methods, max_bytes),
        goal,
        _device(device),
        thread_count(threads),
    )
    return one_or_all([Tuning(each) for each in found])
