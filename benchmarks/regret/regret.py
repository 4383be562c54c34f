"""Regret of a bias over views, its distribution, and biases carried from one light to another."""

import math
from dataclasses import dataclass

import numpy

from recommendation import to_bias

PROMISED_POINTS = 0.1


@dataclass(frozen=True)
class BestBias:
    """The single bias whose worst share of wrong pixels over the views is the smallest, the least of several."""

    bias: numpy.float32
    share: float


def smallest_worst_share(curves, least=-numpy.inf):
    """The best single bias from `least` on, of every float32.

    The shares change only at critical biases, so that these, and a bias below all of them, are all to be tried.
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


def carried(bias, source, destination):
    """The bias that is as many metres along the axis of another light as `bias` is under its own.

        directional  metres = b (far - near)
        spot         metres = A b z^2 / (1 + A b z),  A = 1/near - 1/far,  z the median receiver's light distance

    Source: docs/bias_curve.md#units.
    """
    if not source.is_spot:
        return to_bias(float(bias) * (source.far_m - source.near_m) / (destination.far_m - destination.near_m))
    per_metre, light_distance_m = 1 / source.near_m - 1 / source.far_m, source.median_light_distance_m
    metres = per_metre * float(bias) * light_distance_m**2 / (1 + per_metre * float(bias) * light_distance_m)
    per_metre, light_distance_m = 1 / destination.near_m - 1 / destination.far_m, destination.median_light_distance_m
    return to_bias(metres / (per_metre * light_distance_m * (light_distance_m - metres)))


def percentile(values, share):
    """The smallest value that at least that share of the values does not exceed."""
    return sorted(values)[max(0, math.ceil(share * len(values)) - 1)]


WAYS = (("recommended, one view", lambda row: row.get("regret_recommended_one")),
        ("recommended, four views", lambda row: row.get("regret_recommended_four")),
        ("fewest errors, one view", lambda row: row.get("regret_minimum_one")),
        ("fewest errors, four views", lambda row: row.get("regret_minimum_four")))

LIGHT_ROWS = (("the job's own", lambda row: row.get("regret_depth") if row["turn"] == 0 else None),
              ("turned, in depth units", lambda row: row.get("regret_depth") if row["turn"] else None),
              ("turned, in metres", lambda row: row.get("regret_metres") if row["turn"] else None))


def distribution_table(rows, ways, head):
    """Markdown: how the regret of each way is distributed [percentage points]."""
    lines = [f"| {head} | number | median | 90 % | 95 % | worst | ≤ {PROMISED_POINTS} points |",
             "|---|---|---|---|---|---|---|"]
    for name, regret in ways:
        values = [value for value in map(regret, rows) if value is not None]
        if not values:
            lines.append(f"| {name} | 0 | | | | | |")
            continue
        quantiles = [f"{percentile(values, share):.3f}" for share in (0.5, 0.9, 0.95, 1)]
        kept = sum(value <= PROMISED_POINTS for value in values) / len(values)
        lines.append(f"| {name} | {len(values)} | {' | '.join(quantiles)} | {100 * kept:.1f} % |")
    return "\n".join(lines)
