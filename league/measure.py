"""Runs gnomon for a measurement of the league, or takes its result from the store."""

import hashlib
import json
import os
import shlex
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

from scenes import ROOT

TIMEOUT_S = 180  # for each answer of a renderer
TRIES = 4
REFUSED = 2  # gnomon's exit status if a renderer refuses the request
DROPPED = ("by_object", "by_light_distance_m", "by_receiver_angle_rad", "bias_curve", "slope_curves", "findings", "exact_inputs")


def machine():
    """The number and model of the processors."""
    names = [line.partition(":")[2].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    return f"{os.cpu_count()} x {names[0] if names else 'an unnamed processor'}"


def program():
    """The program: $GNOMON, else that of ./dev build."""
    return os.environ.get("GNOMON") or str(ROOT / "build" / "release" / "bin" / "gnomon")


def toml(value):
    """A value for `--set`."""
    return json.dumps(value) if isinstance(value, (bool, str)) else repr(value)


@dataclass(frozen=True)
class Measurement:
    """One call of gnomon for a scene, with an engine or, without one, with GL.

    name: of the file in the store. command: compare or tune. settings: the engine's keys to set. options: further options.
    variant: of the engine's program, as in Engine.words.
    """

    name: str
    command: str
    engine: object
    scene: object
    settings: dict = field(default_factory=dict)
    options: tuple = ()
    variant: str = "first"

    def arguments(self):
        """The arguments of `gnomon`, run in the checkout's root, for JSON output."""
        path = self.scene.path
        job = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
        words = [self.command, job, *self.options, *(self.engine.words(self.variant) if self.engine else [])]
        for key, value in self.settings.items():
            words += ["--set", f"engine.{key}={toml(value)}"]
        return words + (["--renderer-timeout-s", str(TIMEOUT_S)] if self.engine else []) + ["--json"]

    def text(self):
        """The command with which a reader repeats it."""
        words = [word for word in self.arguments() if word not in ("--json", "--renderer-timeout-s", str(TIMEOUT_S))]
        return shlex.join(["gnomon", *words])


class Store:
    """A folder of results, named by a hash of all that they depend on. Files appear atomically, so killing the league loses none."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def _path(self, name, depends_on):
        text = json.dumps(depends_on, sort_keys=True)
        return self.folder / f"{name}.{hashlib.sha256(text.encode()).hexdigest()[:16]}.json"

    def read(self, name, depends_on):
        """The stored outcome; None if there is none."""
        try:
            return json.loads(self._path(name, depends_on).read_text())["outcome"]
        except (FileNotFoundError, json.JSONDecodeError, KeyError):
            return None

    def write(self, name, depends_on, outcome):
        path = self._path(name, depends_on)
        with tempfile.NamedTemporaryFile("w", dir=self.folder, suffix=".part", delete=False) as file:
            json.dump({"depends_on": depends_on, "outcome": outcome}, file, indent=1)
            file.flush()
            os.fsync(file.fileno())
        os.replace(file.name, path)


class Bench:
    """Measures, and stores the results.

    again: also measure what the store has, and report differences. say: prints a line of progress.
    """

    def __init__(self, store, again=False, say=None):
        self.store, self.again = store, again
        self.say = say or (lambda line: print(line, file=sys.stderr, flush=True))
        self.version = subprocess.run([program(), "--version"], capture_output=True, text=True, check=True).stdout.strip()
        self.measured = self.kept = 0

    def depends_on(self, measurement, title):
        """Everything that the numbers depend on. title: the engine's version and device."""
        return {"arguments": measurement.arguments(), "scene": hashlib.sha256(measurement.scene.contents()).hexdigest(),
                "adapter": measurement.engine.adapter_hash() if measurement.engine else "", "renderer": title, "gnomon": self.version}

    def outcome(self, measurement, title):
        """`status` (done, refused, failed), `message`, `json` of gnomon's output, `wall_s`; `again` if it was measured twice.

        Failures, unlike refusals, are tried again by every run.
        """
        depends_on = self.depends_on(measurement, title)
        kept = self.store.read(measurement.name, depends_on)
        if kept and not self.again and kept["status"] != "failed":
            self.kept += 1
            return kept
        outcome = self.run(measurement)
        self.measured += 1
        if kept and kept["status"] == "done":
            outcome["again"] = difference(kept, outcome)
        self.store.write(measurement.name, depends_on, outcome)
        self.say(f"{measurement.name}: {told(outcome)} ({outcome['wall_s']:.1f} s)")
        return outcome

    @staticmethod
    def run(measurement):
        """The outcome of a new run, which is not stored. Failures are retried, because a busy machine may cause timeouts."""
        for _ in range(TRIES):
            outcome = _run(measurement)
            if outcome["status"] != "failed":
                break
        return outcome


def _run(measurement):
    began = time.monotonic()
    done = subprocess.run([program(), *measurement.arguments()], cwd=ROOT, capture_output=True, text=True)
    outcome = {"wall_s": round(time.monotonic() - began, 2), "machine": machine(), "message": "", "json": None}
    if done.returncode == 130:
        raise KeyboardInterrupt
    if done.returncode == 0:
        result = json.loads(done.stdout)
        return {"status": "done", **outcome, "json": {key: value for key, value in result.items() if key not in DROPPED}}
    lines = [line for line in done.stderr.splitlines() if line.startswith("gnomon: ")] or done.stderr.splitlines() or ["it said nothing"]
    status = "refused" if done.returncode == REFUSED else "failed"
    return {**outcome, "status": status, "message": lines[-1].removeprefix("gnomon: ").strip()}


def told(outcome):
    """A short summary of an outcome."""
    if outcome["status"] != "done":
        return f"{outcome['status']}: {outcome['message']}"
    result = outcome["json"]
    if "tried" in result:
        own, best = (result[key]["shadow_amount"] + result[key]["light_amount"] for key in ("own", "recommended"))
        return f"{len(result['tried'])} settings, from {own:.0f} to {best:.0f} px of error"
    rates = ((result[key] or 0) * 100 for key in ("false_shadow_rate", "false_lit_rate", "mean_abs_error"))
    return "{:.2f} % false shadow, {:.2f} % false lit, {:.2f} % mean |error|".format(*rates)


NUMBERS = ("false_shadow", "false_lit", "shadow_amount", "light_amount")


def difference(before, now):
    """The numbers that changed: `KEY: BEFORE, now NOW`; `same` if none did."""
    if now["status"] != "done":
        return f"{now['status']}: {now['message']}"
    pairs = [(before["json"], now["json"])]
    if "tried" in now["json"]:
        pairs = [(before["json"]["recommended"], now["json"]["recommended"])]
    differ = [f"{key}: {old[key]:g}, now {new[key]:g}" for old, new in pairs for key in NUMBERS if old[key] != new[key]]
    return "; ".join(differ) or "same"
