"""The claims of the lessons and how they are measured: the rows of docs/lessons.md."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum

from measured_job import MeasuredJob


class Verdict(Enum):
    """The result of measuring a claim."""

    CONFIRMED = "confirmed"
    BOUNDED = "bounded"  # true within limits, which the sentence beside it names
    REFUTED = "refuted"


class Limited:
    """A number with the limits of its verdict (`low`, `high`), and how a document gives it.

    spread: the share by which the document's number may differ, as on another driver; below 1.
    """

    def holds(self, number):
        return self.low <= number <= self.high

    def is_near(self, written, number):
        """Whether the document may give this number: printing moves it by less than a step of its last digit."""
        step = 10.0 ** (1 - self.digits) * abs(number)
        return abs(written - number) <= self.spread * max(abs(number), abs(written)) + step

    def printed(self, number):
        """The number as the document has it: 2.7e-5 and 12000, not Python's 2.7e-05 and 1.2e+04."""
        text = f"{number:.{self.digits}g}"
        mantissa, _, exponent = text.partition("e")
        if not exponent:
            return text
        if 0 < int(exponent) < 9:
            return f"{float(text):.0f}"
        return f"{mantissa}e{int(exponent)}"


@dataclass(frozen=True)
class Control:
    """A run that measures something else, so that the number must leave its limits.

    job: another job; empty for the claim's own. instead: cases that replace others. keys: KEY=VALUE for every case.
    """

    job: str = ""
    instead: dict = field(default_factory=dict)
    keys: tuple = ()


@dataclass(frozen=True)
class Claim(Limited):
    """One claim, one job, one number, one verdict.

    job: the file's name in the lesson's folder, without its ending.
    number: the quantity that is measured. unit: its unit, "%" for a share.
    why: one sentence beside the verdict.
    measure: measures a job; gives a share as a fraction.
    low, high: the verdict holds for numbers from low to high.
    off_by: the pixels by which the document's number may differ, if it counts few or none.
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

    def in_unit(self, number):
        return number * (100 if self.unit == "%" else 1)

    def is_near(self, written, number):
        """Compares the document's number, in its unit, with the measured one."""
        if self.off_by:
            return abs(written - number) <= self.off_by
        return super().is_near(written, self.in_unit(number))

    def printed(self, number):
        return super().printed(self.in_unit(number))


@dataclass(frozen=True)
class Lesson:
    """A lesson: its folder in examples/lessons, its title in the document, and its claims in their order."""

    folder: str
    title: str
    claims: tuple

    def job(self, claim):
        return MeasuredJob(f"{self.folder}/{claim.job}")

    def control(self, claim):
        """The job of the claim's control run."""
        name = claim.control.job or f"{self.folder}/{claim.job}"
        return MeasuredJob(name, claim.control.instead, claim.control.keys)
