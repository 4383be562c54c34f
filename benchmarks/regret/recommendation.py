"""The constant bias to recommend, from the critical biases of every scored pixel.

A pixel's critical bias is the smallest float32 bias with which it is lit. With bias b the lit pixels whose critical
bias is above b are false shadow, and the blocked ones whose critical bias is at most b are false lit. The number of
errors is therefore constant between neighbouring critical biases, and known for every float32. A bias is 0 or a
normal float32.

This shares no code with the program, so that each can be checked against the other.
"""

import bisect
import math
from dataclasses import dataclass

import numpy

UNLIMITED = numpy.float32(numpy.inf)
BROAD = 1.5  # a run is broad if its ends have at least this quotient
MARGIN_TEXELS = 3  # added to the least bias of the valley


def previous_bias(biases):
    """The largest biases below positive normal ones: 0 comes before the smallest normal float32."""
    below = numpy.nextafter(numpy.asarray(biases, numpy.float32), numpy.float32(0))
    return numpy.where(below < numpy.finfo(numpy.float32).tiny, numpy.float32(0), below)


def to_bias(value):
    """The float32 nearest to a double >= 0; 0 instead of a subnormal, which lookups do not accept."""
    bias = numpy.float32(value)
    return bias if bias >= numpy.finfo(numpy.float32).tiny else numpy.float32(0)


class ErrorCurve:
    """The number of wrong pixels with every constant bias."""

    def __init__(self, lit, blocked):
        """Critical biases of the scored pixels, in any order; infinite ones are allowed, NaN is not."""
        self.lit = numpy.sort(numpy.asarray(lit, numpy.float32))
        self.blocked = numpy.sort(numpy.asarray(blocked, numpy.float32))
        for criticals in (self.lit, self.blocked):
            if numpy.isnan(criticals).any():
                raise ValueError("ErrorCurve: a scored pixel's critical bias is NaN")

    @staticmethod
    def pooled(curves):
        """The sum of curves: every pixel of every view counts once."""
        return ErrorCurve(numpy.concatenate([curve.lit for curve in curves]),
                          numpy.concatenate([curve.blocked for curve in curves]))

    @property
    def scored(self):
        return self.lit.size + self.blocked.size

    def errors_at(self, biases):
        """False shadow plus false lit [px] with each of the biases."""
        biases = numpy.asarray(biases, numpy.float32)
        false_shadow = self.lit.size - numpy.searchsorted(self.lit, biases, side="right")
        return false_shadow + numpy.searchsorted(self.blocked, biases, side="right")

    def changes(self):
        """Finite critical biases, ascending, each once. The number of errors changes only there."""
        every = numpy.unique(numpy.concatenate([self.lit, self.blocked]))
        return every[numpy.isfinite(every)]


@dataclass(frozen=True)
class Pieces:
    """Neighbouring intervals [lo, hi] of biases >= 0 that cover all of them, each with its number of errors."""

    lo: numpy.ndarray
    hi: numpy.ndarray  # the last bias before the next change; infinite: nothing limits it
    errors: numpy.ndarray


def pieces_from_zero(curve):
    """The curve over biases >= 0."""
    changes = curve.changes()
    changes = changes[changes > 0]
    lo = numpy.concatenate([[numpy.float32(0)], changes])
    hi = numpy.concatenate([previous_bias(changes), [UNLIMITED]])
    return Pieces(lo, hi, curve.errors_at(lo))


def runs_of(chosen):
    """First and last index of every unbroken run of true values."""
    edges = numpy.diff(numpy.concatenate([[False], chosen, [False]]).astype(numpy.int8))
    return numpy.flatnonzero(edges == 1), numpy.flatnonzero(edges == -1) - 1


def lowest_broad_run(pieces, level):
    """(lo, hi) of the lowest run with at most `level` errors that holds 0 or has hi >= 1.5 lo; None without one."""
    first, last = runs_of(pieces.errors <= level)
    lo, hi = pieces.lo[first], pieces.hi[last]
    # In double the product of a float32 and 1.5 is exact, and 0 is >= 1.5 times 0.
    broad = numpy.flatnonzero(hi.astype(float) >= BROAD * lo.astype(float))
    return (lo[broad[0]], hi[broad[0]]) if broad.size else None


@dataclass(frozen=True)
class Recommendation:
    bias: numpy.float32
    low: numpy.float32
    high: numpy.float32  # infinite: nothing limits it
    level: float         # the errors that the run [low, high] stays within [px]
    least_errors: int    # of any bias >= 0 [px]


def with_margin(low, high, lengthened):
    """The smallest bias of a valley with three texels to spare, at most the geometric mean of its ends.

    lengthened(bias, texels) is the bias that is so many texels longer at the median receiver.
    """
    if low == 0:
        return numpy.float32(0)
    mean = UNLIMITED if high == UNLIMITED else to_bias(math.sqrt(float(low) * float(high)))
    return min(lengthened(low, MARGIN_TEXELS), mean)


def middle(low, high, _lengthened=None):
    """The former recommendation: the middle of the valley."""
    if low == 0:
        return numpy.float32(0)
    return to_bias(2 * float(low) if high == UNLIMITED else math.sqrt(float(low) * float(high)))


def recommend(curve, lengthened, choose=with_margin):
    """The bias to take of the lowest broad valley; None if no scored pixel is lit.

        m = least errors over b >= 0
        t = least level >= m + sqrt(m) at which a run with errors <= t is broad
        [lo, hi] = the lowest such run
        bias = 0 if lo = 0, else lo + 3 texels, at most sqrt(lo hi) where something limits hi
    """
    if curve.lit.size == 0:
        return None
    pieces = pieces_from_zero(curve)
    least = int(pieces.errors.min())
    start = least + math.sqrt(least)
    # Runs change only where the level is a number of errors, and grow with it: the first broad one is found by
    # bisection. At the highest level the run holds every bias, which is broad.
    levels = [start, *numpy.unique(pieces.errors[pieces.errors > start]).tolist()]
    level = levels[bisect.bisect_left(levels, True, key=lambda t: lowest_broad_run(pieces, t) is not None)]
    low, high = lowest_broad_run(pieces, level)
    return Recommendation(choose(low, high, lengthened), low, high, level, least)


def bare_minimum(curve):
    """The middle of the best interval, as in the findings of `gnomon compare`; None if nothing is lit.

    Takes the widest interval in [0, 1] with the fewest errors, the lowest of equal ones. Returns the mean of its ends, or
    its lower end if nothing below 1 limits it.
    """
    if curve.lit.size == 0:
        return None
    pieces = pieces_from_zero(curve)
    inside = pieces.lo <= 1
    lo, hi, errors = pieces.lo[inside], numpy.minimum(pieces.hi[inside], numpy.float32(1)), pieces.errors[inside]
    first, last = runs_of(errors == errors.min())
    lo, hi = lo[first].astype(float), hi[last].astype(float)
    widest = int(numpy.argmax(hi - lo))
    return to_bias(lo[widest] if hi[widest] >= 1 else 0.5 * (lo[widest] + hi[widest]))
