"""Published numbers and how they are measured here: the rows of docs/methods/published.md."""

import math
import shlex
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "lessons"))

from claim import Limited, Verdict  # noqa: E402
from measured_job import NotMeasured, gnomon, measure_beforehand, once, printed  # noqa: E402

__all__ = ["NotMeasured", "Number", "Row", "Run", "Verdict", "compared", "layers", "measure_beforehand", "settings"]


def settings(**keys):
    """`--set KEY=VALUE` for each key. Two underscores stand for a key's dot."""
    return tuple(word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}"))


@dataclass(frozen=True)
class Run:
    """One `gnomon compare` of a scene or a job, with settings."""

    what: tuple
    keys: tuple = ()

    @property
    def arguments(self):
        return ("compare", *self.what, *self.keys)

    @property
    def command(self):
        """The command line that a reader types in the checkout."""
        words = [str(Path(word).relative_to(ROOT)) if word.startswith(str(ROOT)) else word for word in self.arguments]
        return shlex.join(["gnomon", *words])


def compared(run):
    """The JSON of a run."""
    return printed(*run.arguments, "--json")


def layers(run):
    """The layers of the run's pixels, by name."""
    def made():
        with tempfile.TemporaryDirectory() as folder:
            image = Path(folder) / "layers.exr"
            gnomon.call(*run.arguments, "--aov", str(image))
            return gnomon.load_layers(image)

    return once((*run.arguments, "--aov"), made)


@dataclass(frozen=True)
class Number(Limited):
    """A measured number beside a published one.

    published: their number, as they write it. unit: the unit of ours.
    low, high: the row's verdict holds for numbers from low to high.
    control: measures something else, which must leave the limits.
    """

    name: str
    published: str
    measure: Callable[[], float]
    control: Callable[[], float]
    low: float = -math.inf
    high: float = math.inf
    unit: str = ""
    digits: int = 3
    spread: float = 0.1


@dataclass(frozen=True)
class Row:
    """A published claim and the numbers that decide it.

    run: the document shows its command. slow: it takes minutes, so only --full measures it.
    """

    name: str
    title: str
    claim: str
    source: str
    ours: str
    numbers: tuple
    verdict: Verdict
    why: str
    differs: str
    run: Run
    slow: bool = False
