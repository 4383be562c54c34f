"""What others published, and how it is measured here: the rows of docs/methods/published.md."""

import math
import shlex
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "lessons"))

from claim import Verdict  # noqa: E402
from measured_job import NotMeasured, gnomon, once, printed  # noqa: E402

__all__ = ["NotMeasured", "Number", "Row", "Run", "Verdict", "compared", "layers", "settings"]


def settings(**keys):
    """`--set KEY=VALUE` for each; a key's dots are written as two underscores."""
    return tuple(word for key, value in keys.items() for word in ("--set", f"{key.replace('__', '.')}={value}"))


@dataclass(frozen=True)
class Run:
    """One `gnomon compare`: its scene or job, and settings."""

    what: tuple
    keys: tuple = ()

    @property
    def arguments(self):
        return ("compare", *self.what, *self.keys)

    @property
    def command(self):
        """As a reader types it, in the checkout."""
        words = [str(Path(word).relative_to(ROOT)) if word.startswith(str(ROOT)) else word for word in self.arguments]
        return shlex.join(["gnomon", *words])


def compared(run):
    """The JSON of a run."""
    return printed(*run.arguments, "--json")


def layers(run):
    """The layers of its pixels, by name."""
    def made():
        with tempfile.TemporaryDirectory() as folder:
            image = Path(folder) / "layers.exr"
            gnomon.call(*run.arguments, "--aov", str(image))
            return gnomon.load_layers(image)

    return once((*run.arguments, "--aov"), made)


@dataclass(frozen=True)
class Number:
    """A number beside the published one.

    name: what it is; published: theirs, as they say it. unit: of ours, empty for none.
    low, high: what the row's verdict needs of it. spread: share of it by which the document's may differ.
    control: the same of something else, which must leave the limits.
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

    def holds(self, number):
        return self.low <= number <= self.high

    def printed(self, number):
        """As the document has it: 3e-6 in place of Python's 3e-06."""
        return f"{number:.{self.digits}g}".replace("e-0", "e-")

    def is_near(self, written, number):
        """Whether the document may give this number: less than a step of its last digit by printing, the rest by
        another driver."""
        return abs(written - number) <= self.spread * max(abs(written), abs(number)) + 10.0 ** (1 - self.digits) * abs(
            number)


@dataclass(frozen=True)
class Row:
    """A claim: its name in the document, theirs, ours, and the numbers that decide it.

    run: whose command the document shows. slow: takes minutes, and is measured with --full alone.
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
