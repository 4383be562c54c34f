"""Runs the jobs of lessons, and caches the results."""

import contextlib
import json
import os
import sys
import tempfile
import threading
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
JOBS = ROOT / "examples" / "lessons"
sys.path.insert(0, str(ROOT / "notebooks"))

import gnomon  # noqa: E402

program = gnomon.program.find  # the path of the program
CLASSES = gnomon.CLASSES  # of pixels, by the values in the layer `class`


class NotMeasured(Exception):
    """Why there is no number: the driver lacks a format, or writes no trace."""


_kept = {}
_lock = threading.Lock()


def once(command, make):
    """The result of `make`, which is called once per command."""
    with _lock:
        entry = _kept.setdefault(tuple(command), {"lock": threading.Lock()})
    with entry["lock"]:
        if "result" not in entry:
            entry["result"] = make()
        return entry["result"]


def measure_beforehand(measurements):
    """Calls all measurements, in as many threads as there are processors. Tests then find the cached results."""
    def measure(measurement):
        with contextlib.suppress(Exception):  # the test reports it
            measurement()

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(measure, measurements))


def printed(*arguments):
    """The JSON that `gnomon ARGUMENT…` prints."""
    return once(arguments, lambda: json.loads(gnomon.call(*arguments)))


def _merge(into, table):
    for key, value in table.items():
        if isinstance(value, dict):
            _merge(into.setdefault(key, {}), value)
        else:
            into[key] = value


@dataclass(frozen=True)
class MeasuredJob:
    """A job file, and the changes of its control run.

    instead: cases that replace others. keys: KEY=VALUE for every case.
    """

    name: str
    instead: dict = field(default_factory=dict)
    keys: tuple = ()

    @property
    def path(self):
        return JOBS / f"{self.name}.toml"

    def _case(self, case):
        return self.instead.get(case, case)

    def options(self, case):
        """Command-line options."""
        options = ["--case", self._case(case)] if case else []
        for key in self.keys:
            options += ["--set", key]
        return options

    def compare(self, case=""):
        """The JSON of `gnomon compare` with this case."""
        return printed("compare", str(self.path), "--json", *self.options(case))

    def layers(self, case=""):
        """The layers of the case's pixels, by name."""
        command = ("compare", str(self.path), *self.options(case), "--aov")

        def run():
            with tempfile.TemporaryDirectory() as folder:
                image = Path(folder) / "layers.exr"
                gnomon.call(*command, str(image))
                return gnomon.load_layers(image)

        return once(command, run)

    def plan(self):
        """The passes of a sweep over the job, by stage."""
        command = ["sweep", str(self.path), "--dry-run", "--json", *self.options("")]
        return printed(*command)["plan"]

    def settings(self, case=""):
        """The job file's tables, overridden by the case."""
        tables = tomllib.loads(self.path.read_text())
        cases = {table.pop("name"): table for table in tables.pop("case", [])}
        if case:
            _merge(tables, cases[self._case(case)])
        for key in self.keys:
            _merge(tables, tomllib.loads(key))
        return tables

    def depth(self, case=""):
        """The JSON of `gnomon depth` for the map's planes, format and content."""
        settings = self.settings(case)
        shadow_map = settings["shadow_map"]
        command = ["depth", "--json", "--near", shadow_map["near"], "--far", shadow_map["far"],
                   "--format", shadow_map["depth_format"]]
        if shadow_map.get("reversed"):
            command.append("--reversed")
        if settings["light"]["type"] == "directional":
            command += ["--projection", "orthographic"]
        result = printed(*map(str, command))
        if result["measured"] is None:
            raise NotMeasured(result["not_measured_because"])
        return result
