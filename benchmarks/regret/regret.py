"""Regret of a bias over views, its distribution, and biases carried to other lights and maps."""

import math
from dataclasses import dataclass

import numpy

from recommendation import ErrorCurve, to_bias


@dataclass(frozen=True)
class ScoredView:
    """The error curve of a view, and the conversion of its biases to lengths and back."""

    curve: ErrorCurve
    median_light_distance_m: float  # light distance of the median scored pixel; NaN if none is scored
    near_m: float
    far_m: float
    texel_m: float  # a texel's width, of a spot 1 m from it
    is_spot: bool

    def metres(self, bias):
        """The bias's length along the light's axis at the median receiver [m].

            directional  b (far - near)
            spot         A b z^2 / (1 + A b z),  A = 1/near - 1/far,  z the median receiver's light distance

        Source: docs/bias_curve.md#units.
        """
        if not self.is_spot:
            return float(bias) * (self.far_m - self.near_m)
        per_metre, distance_m = 1 / self.near_m - 1 / self.far_m, self.median_light_distance_m
        return per_metre * float(bias) * distance_m**2 / (1 + per_metre * float(bias) * distance_m)

    def bias_of(self, metres):
        """The bias of a length; at most 1, which lights the whole map."""
        if not self.is_spot:
            return to_bias(min(metres / (self.far_m - self.near_m), 1))
        per_metre, distance_m = 1 / self.near_m - 1 / self.far_m, self.median_light_distance_m
        if metres >= distance_m:
            return to_bias(1)
        return to_bias(min(metres / (per_metre * distance_m * (distance_m - metres)), 1))

    @property
    def median_texel_m(self):
        return self.texel_m * (self.median_light_distance_m if self.is_spot else 1)

    def texels(self, bias):
        return self.metres(bias) / self.median_texel_m

    def lengthened(self, bias, texels):
        """The bias that is `texels` texels longer."""
        return max(self.bias_of(self.metres(bias) + texels * self.median_texel_m), bias)


@dataclass(frozen=True)
class BestBias:
    """The least single bias that minimizes the worst share of wrong pixels over the views."""

    bias: numpy.float32
    share: float


def smallest_worst_share(curves, least=-numpy.inf):
    """The best single bias from `least` on, of every float32.

    Tries a bias below all critical biases, and each of them, because the shares change only there.
    """
    changes = numpy.unique(numpy.concatenate([curve.changes() for curve in curves]))
    lowest = numpy.float32(max(least, numpy.finfo(numpy.float32).min))
    biases = numpy.concatenate([[lowest], changes[changes > lowest]])
    worst = numpy.max([curve.errors_at(biases) / curve.scored for curve in curves], axis=0)
    at = int(numpy.argmin(worst))
    return BestBias(biases[at], float(worst[at]))


def regret_of(bias, curves, best_share):
    """The bias's worst share over the views less the best one's [percentage points]."""
    return 100 * (max(float(curve.errors_at(bias)) / curve.scored for curve in curves) - best_share)


def shadow_lost(bias, curve):
    """The share of the blocked pixels that the bias lights; None without any."""
    if curve.blocked.size == 0:
        return None
    return float(numpy.searchsorted(curve.blocked, numpy.float32(bias), side="right")) / curve.blocked.size


def carried(bias, source, destination):
    """The bias with the same length [m] along the axis of another light."""
    return destination.bias_of(source.metres(bias))


def carried_in_texels(bias, source, destination):
    """The bias with the same length in texels of another map."""
    return destination.bias_of(source.texels(bias) * destination.median_texel_m)


def percentile(values, share):
    """The smallest value that at least that share of the values does not exceed."""
    return sorted(values)[max(0, math.ceil(share * len(values)) - 1)]


RULES = ("margin", "middle", "fewest")
RULE_NAMES = {"margin": "three texels above the valley's lower end", "middle": "the valley's middle",
              "fewest": "fewest errors"}


def distribution_table(head, unit, series, promised):
    """A Markdown table of the distribution of each series."""
    lines = [f"| {head} | number | median | 90 % | 95 % | worst | ≤ {promised} {unit} |",
             "|---|---|---|---|---|---|---|"]
    for name, every in series:
        values = [value for value in every if value is not None]
        if not values:
            lines.append(f"| {name} | 0 | | | | | |")
            continue
        quantiles = [f"{percentile(values, share):.3f}" for share in (0.5, 0.9, 0.95, 1)]
        kept = sum(value <= promised for value in values) / len(values)
        lines.append(f"| {name} | {len(values)} | {' | '.join(quantiles)} | {100 * kept:.1f} % |")
    return "\n".join(lines)
