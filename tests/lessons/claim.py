"""What a lesson claims, and how that is measured: the rows of docs/lessons.md."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum

from measured_job import MeasuredJob


class Verdict(Enum):
    """What the measurement says of a claim."""

    CONFIRMED = "confirmed"
    BOUNDED = "bounded"  # true within limits that the sentence beside it names
    REFUTED = "refuted"


@dataclass(frozen=True)
class Control:
    """A run in which the number must leave its limits, because something else is measured.

    job: another job; empty: the claim's own. instead: cases that stand in for others. keys: KEY=VALUE
    over every case.
    """

    job: str = ""
    instead: dict = field(default_factory=dict)
    keys: tuple = ()


@dataclass(frozen=True)
class Claim:
    """One claim, one job, one number, one verdict.

    job: the file's name in the lesson's folder, without its ending.
    number: what is measured; unit: of it, empty for none, "%" for a share.
    why: one sentence beside the verdict.
    measure: the number of a job, a share as a fraction.
    low, high: the verdict holds for numbers from low to high.
    spread: share of the number by which the document's may differ, as on another driver; below 1.
    off_by: by how many pixels it may, in place of a share, where the number counts few or none.
    """

    job: str
    claim: str
    number: str
    verdict: Verdict
    why: str
    measure: Callable[[MeasuredJob], float]
    control: Control
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    spread: float = 0.1
    off_by: int = 0
    digits: int = 3

    def holds(self, number):
        return self.low <= number <= self.high

    def in_unit(self, number):
        return number * (100 if self.unit == "%" else 1)

    def is_near(self, written, number):
        """Whether the document may give this number, in its unit, of the measured one."""
        if self.off_by:
            return abs(written - number) <= self.off_by
        number = self.in_unit(number)
        # Less than a step of the last digit by printing, the rest by another driver.
        step = 10.0 ** (1 - self.digits) * abs(number)
        return abs(written - number) <= self.spread * max(abs(number), abs(written)) + step

    def printed(self, number):
        """The number in its unit, as the document has it."""
        text = f"{self.in_unit(number):.{self.digits}g}"
        # 0.000027, 1.2e-8 and 12000 in place of Python's 2.7e-05, 1.2e-08 and 1.2e+04
        mantissa, _, exponent = text.partition("e")
        if not exponent:
            return text
        if 0 < int(exponent) < 9:
            return f"{float(text):.0f}"
        return f"{mantissa}e{int(exponent)}"


@dataclass(frozen=True)
class Lesson:
    """A lesson: its folder in examples/lessons, how the document calls it, and its claims in its order."""

    folder: str
    title: str
    claims: tuple

    def job(self, claim):
        return MeasuredJob(f"{self.folder}/{claim.job}")

    def control(self, claim):
        """The claim's control run, as a job."""
        name = claim.control.job or f"{self.folder}/{claim.job}"
        return MeasuredJob(name, claim.control.instead, claim.control.keys)
