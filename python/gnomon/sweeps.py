"""Sweeps over many configurations, and their runs as tables."""

import os
import shlex
import sqlite3
import sys
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gnomon import _gnomon
from gnomon.comparison import Job, _device, place_of
from gnomon.keys import flat, pairs, thread_count, toml

if TYPE_CHECKING:
    import pandas


class Run:
    """The folder of a run (docs/runs.md) as tables, which are read on first use."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        if not (self.folder / "results.sqlite").exists():
            raise _gnomon.InputError(f"{self.folder}: contains no results.sqlite; is it a run of gnomon sweep?")

    def _table(self, name):
        import pandas

        path = self.folder / name
        if not path.exists():
            raise _gnomon.InputError(f"{path}: no such file; `gnomon sweep` writes it at its end")
        return pandas.read_csv(path, float_precision="round_trip")

    @cached_property
    def results(self) -> "pandas.DataFrame":
        """pandas.DataFrame: a row for each configuration (docs/csv_schema.md)."""
        return self._table("results.csv")

    @cached_property
    def bias_curves(self) -> "pandas.DataFrame":
        """pandas.DataFrame: error counts at every bias at which they change, by curve."""
        return self._table("bias_curves.csv")

    @cached_property
    def error_vs_z(self) -> "pandas.DataFrame":
        """pandas.DataFrame: errors by light distance, by curve."""
        return self._table("error_vs_z.csv")

    def connect(self) -> sqlite3.Connection:
        """A read-only sqlite3.Connection to the run's database."""
        return sqlite3.connect(f"file:{self.folder / 'results.sqlite'}?mode=ro", uri=True)

    def __repr__(self) -> str:
        return f"<gnomon.Run: {self.folder}>"


def open_run(folder: str | os.PathLike[str]) -> Run:
    """Open the run in a folder.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        If the folder contains no run.
    """
    return Run(folder)


class _Progress:
    """Shows the progress of a sweep with tqdm, if it is installed."""

    def __init__(self, is_shown):
        self._bar = None
        self._is_shown = is_shown

    def __call__(self, what, first, second):
        if what == "begin" and self._is_shown:
            try:
                from tqdm.auto import tqdm

                self._bar = tqdm(total=first + second, initial=second, unit="configuration", file=sys.stderr)
            except ImportError:
                self._bar = None
        elif what == "advance" and self._bar is not None:
            self._bar.update(first + second)

    def close(self):
        if self._bar is not None:
            self._bar.close()


def _command(verb, place, keys, axes=()):
    words = ["gnomon", verb, *(["--builtin", place.builtin] if place.builtin else [place.path])]
    words += [word for name, value in [*place.keys, *keys] for word in ("--set", f"{name}={value}")]
    words += [word for axis in axes for word in ("--axis", axis)]
    return shlex.join(words)


def sweep(
    job: Job,
    axes: Mapping[str, Iterable[Any]] | None = None,
    out: str | os.PathLike[str] | None = None,
    *,
    case: str = "",
    keep_pixels: bool = False,
    verify: bool = False,
    retry_failed: bool = False,
    force: bool = False,
    progress: bool = True,
    device: int | None = None,
    threads: int = 0,
    **keys: Any,
) -> Run:
    """Compute many configurations into a run: `gnomon sweep`. The same call resumes.

    Parameters
    ----------
    job : path_like, dict or Scene
        As for `compare`, but no scene from arrays, as a run must be able to read its scene again.
    axes : dict, optional
        Keys with their values: `{"bias.constant": [0, 0.001], "shadow_map.resolution": [512, 1024]}`;
        in addition to those of the job's [sweep].
    out : path_like
        The run's folder.
    case : str
        The only `[[case]]` to run; by default all of them.
    keep_pixels : bool
        Whether to keep every configuration's layers.
    verify : bool
        Whether to check each bias curve against reruns of GL.
    retry_failed : bool
        Whether to retry failed configurations.
    force : bool
        Whether to replace results of another scene.
    progress : bool
        Whether to show a bar, if tqdm is installed.
    device, threads
        As for `compare`.
    **keys
        Keys that override the job's.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        If the job or an axis is invalid, or another process writes to the folder.
    EnvironmentError
        If GL, Embree or the disk fails; recorded results stay.
    KeyboardInterrupt
        After Ctrl-C, once work in progress is recorded.
    """
    if out is None:
        raise TypeError("sweep() needs out, the folder for the results")
    place = place_of(job, keys)
    if place.is_in_memory:
        raise TypeError("sweep() cannot use a scene from arrays: save it as a file and give its path")
    of_job = pairs(keys)
    request = _gnomon.SweepRequest()
    request.axes = [f"{name}={toml(list(values))}" for name, values in flat(axes or {})]
    request.case_name = case
    request.folder = os.fspath(out)
    request.keeps_pixels = keep_pixels
    request.verifies = verify
    request.retries_failed = retry_failed
    request.may_replace = force
    is_file = place.path.endswith(".toml") and os.path.exists(place.path)
    request.job_text = Path(place.path).read_text(encoding="utf-8") if is_file else ""
    request.command = _command("sweep", place, of_job, request.axes)
    request.compare_command = _command("compare", place, of_job)
    reporter = _Progress(progress)
    try:
        _gnomon.sweep(place, of_job, request, reporter, _device(device), thread_count(threads))
    finally:
        reporter.close()
    return Run(out)
