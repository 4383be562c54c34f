#!/usr/bin/python3
"""Holds benchmarks/regret to hand-made curves, and to a recommendation that tries everything.

Exit status: 77 numpy is missing.
"""

import math
import random
import sys
import unittest
from pathlib import Path

try:
    import numpy
except ImportError:
    print("SKIPPED: Debian's python3-numpy is missing")
    sys.exit(77)

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks" / "regret"))
from recommendation import ErrorCurve, bare_minimum, pieces_from_zero, recommend
from regret import carried, percentile, regret_of, smallest_worst_share
from views import in_cap, radical_inverse, turned

INFINITY = float("inf")
TINY = numpy.finfo(numpy.float32).tiny  # the smallest bias above 0


def float32(value):
    return numpy.float32(value)


def before(value):
    """The float32 just below a positive one that is no smallest normal one."""
    return numpy.nextafter(float32(value), float32(0))


def count_errors(lit, blocked, bias):
    """By definition, one pixel at a time."""
    return sum(critical > bias for critical in lit) + sum(critical <= bias for critical in blocked)


def recommend_by_trial(lit, blocked):
    """The rule word by word: every level that can matter, every run of biases, whatever it costs.

    What happens between two neighbouring critical biases is known at the first bias from the lower one on.
    """
    if not lit:
        return None
    starts = sorted({float32(0), *(c for c in [*lit, *blocked] if 0 < c < INFINITY)})
    ends = [before(c) if c > TINY else float32(0) for c in starts[1:]] + [float32(INFINITY)]
    errors = [count_errors(lit, blocked, start) for start in starts]
    least = min(errors)
    for level in sorted({least + math.sqrt(least), *(e for e in errors if e >= least + math.sqrt(least))}):
        for first, low in enumerate(starts):
            if errors[first] > level or (first > 0 and errors[first - 1] <= level):
                continue  # no run begins here
            last = first
            while last + 1 < len(starts) and errors[last + 1] <= level:
                last += 1
            high = ends[last]
            if low == 0 or float(high) >= 1.5 * float(low):
                middle = 0 if low == 0 else 2 * float(low) if high == INFINITY else math.sqrt(float(low) * float(high))
                return float32(middle), low, high
    raise AssertionError("the highest level holds every bias")


class Recommend(unittest.TestCase):
    def expect(self, lit, blocked, bias, low, high):
        found = recommend(ErrorCurve(lit, blocked))
        self.assertEqual((found.bias, found.low, found.high), (float32(bias), float32(low), float32(high)))

    def test_is_the_geometric_middle_of_a_broad_valley(self):
        self.expect([1], [4], math.sqrt(float(before(4))), 1, before(4))

    def test_is_zero_where_zero_lies_in_the_valley(self):
        self.expect([-1, 0], [1e-6], 0, 0, before(1e-6))
        # The bias before the smallest one is 0.
        self.expect([0], [TINY], 0, 0, 0)

    def test_is_twice_the_lower_end_where_nothing_limits_the_upper(self):
        self.expect([0.25], [], 0.5, 0.25, INFINITY)
        self.expect([0.25], [INFINITY], 0.5, 0.25, INFINITY)

    def test_is_zero_where_no_bias_matters(self):
        self.expect([-INFINITY, INFINITY], [-INFINITY], 0, 0, INFINITY)

    def test_is_nothing_where_no_scored_pixel_is_lit(self):
        self.assertIsNone(recommend(ErrorCurve([], [1, 2])))
        self.assertIsNone(recommend(ErrorCurve([], [])))

    def test_passes_over_a_narrow_minimum(self):
        # [1, 1.5) has no error but is not broad, for its last bias is below 1.5. With one error [0.5, 1.5) is.
        self.expect([0.5, 1], [1.5] * 2, math.sqrt(0.5 * float(before(1.5))), 0.5, before(1.5))

    def test_takes_a_run_of_exactly_one_and_a_half(self):
        above = numpy.nextafter(float32(1.5), float32(2))
        self.expect([0.5, 1], [above] * 2, math.sqrt(1.5), 1, 1.5)

    def test_takes_the_lowest_of_equally_good_valleys(self):
        # 3 errors in [1, 2) and in [8, 20), 6 between them: more than the root of 3 above.
        self.expect([1] * 99 + [8] * 3, [2] * 3 + [20] * 99, math.sqrt(float(before(2))), 1, before(2))

    def test_lets_errors_rise_by_the_root_of_the_fewest(self):
        # Four errors at best, in [2, 4), and six within the root of it: from 1 on.
        lit = [1] * 9 + [2] * 2 + [INFINITY] * 4
        self.expect(lit, [4] * 9, math.sqrt(float(before(4))), 1, before(4))
        # A seventh is one too many.
        self.expect([*lit, 2], [4] * 9, math.sqrt(2 * float(before(4))), 2, before(4))

    def test_joins_neighbouring_pieces(self):
        # At 2 one pixel is mended and another breaks: the same number on both sides.
        self.expect([1, 1, 2], [2, 4, 4], math.sqrt(float(before(4))), 1, before(4))

    def test_sees_no_bias_below_zero(self):
        found = recommend(ErrorCurve([1] * 3, [-1, -1, 0]))
        self.assertEqual((found.bias, found.low, found.least_errors), (2, 1, 3))

    def test_rejects_a_bias_that_is_no_number(self):
        with self.assertRaises(ValueError):
            ErrorCurve([float("nan")], [])

    def test_agrees_with_trial_on_random_curves(self):
        source = random.Random(20250401)
        grids = ([-INFINITY, -1, 0, TINY, 1, 1.25, 1.5, 1.75, 2, 3, 4, 8, 64, INFINITY],
                 [float(numpy.nextafter(float32(1), float32(2))) if k == 1 else (1 + k / 8) for k in range(12)],
                 [10 ** (-k / 4) for k in range(24)])
        for _ in range(4000):
            grid = [float32(value) for value in source.choice(grids)]
            lit = source.choices(grid, k=source.randrange(12))
            blocked = source.choices(grid, k=source.randrange(12))
            found = recommend(ErrorCurve(lit, blocked))
            with self.subTest(lit=lit, blocked=blocked):
                self.assertEqual(found and (found.bias, found.low, found.high), recommend_by_trial(lit, blocked))


class Curve(unittest.TestCase):
    def test_counts_pixels_by_definition(self):
        source = random.Random(3)
        grid = [float32(value) for value in (-INFINITY, -2, -TINY, 0, TINY, 0.5, 1, 3, INFINITY)]
        for _ in range(200):
            lit, blocked = (source.choices(grid, k=source.randrange(8)) for _ in range(2))
            curve = ErrorCurve(lit, blocked)
            for bias in grid[1:-1]:
                self.assertEqual(curve.errors_at(bias), count_errors(lit, blocked, bias))

    def test_covers_every_bias_from_zero_without_gaps(self):
        pieces = pieces_from_zero(ErrorCurve([TINY, 1, 2, -3], [1, INFINITY]))
        self.assertEqual(pieces.lo.tolist(), [0, TINY, 1, 2])
        self.assertEqual(pieces.hi.tolist(), [0, before(1), before(2), INFINITY])

    def test_pools_views_pixel_by_pixel(self):
        one, two = ErrorCurve([1, 3], [2]), ErrorCurve([5], [4, 6])
        pooled = ErrorCurve.pooled([one, two])
        for bias in (0, 1, 2.5, 4, 7):
            self.assertEqual(pooled.errors_at(bias), one.errors_at(bias) + two.errors_at(bias))


class BareMinimum(unittest.TestCase):
    def test_is_the_mean_of_the_widest_best_interval(self):
        self.assertEqual(bare_minimum(ErrorCurve([0.125, 0.5], [0.25, 0.75])),
                         float32(0.5 * (0.5 + float(before(0.75)))))

    def test_is_the_lower_end_where_nothing_below_one_limits_it(self):
        self.assertEqual(bare_minimum(ErrorCurve([0.25], [3])), 0.25)

    def test_is_nothing_where_no_scored_pixel_is_lit(self):
        self.assertIsNone(bare_minimum(ErrorCurve([], [1])))


class Regret(unittest.TestCase):
    def test_best_bias_makes_the_worst_view_best(self):
        # Below 2 one of ten is wrong in the first view, from 2 on two of four are in the second.
        views = [ErrorCurve([2] + [0] * 9, []), ErrorCurve([0, 0], [2, 2])]
        best = smallest_worst_share(views)
        self.assertEqual((best.bias, best.share), (0, 0.1))
        self.assertAlmostEqual(regret_of(2, views, best.share), 40, delta=1e-12)  # half less a tenth, in points

    def test_best_bias_may_be_negative(self):
        view = [ErrorCurve([-2], [-1])]
        self.assertEqual((smallest_worst_share(view).bias, smallest_worst_share(view).share), (-2, 0))
        self.assertEqual(smallest_worst_share(view, least=0).share, 0.5)

    def test_best_bias_agrees_with_trial_on_random_views(self):
        source = random.Random(11)
        grid = [float32(k / 4) for k in range(-3, 9)]
        for _ in range(300):
            views = [ErrorCurve(source.choices(grid, k=source.randrange(1, 7)), source.choices(grid, k=5))
                     for _ in range(3)]
            worst = {bias: max(count_errors(v.lit, v.blocked, bias) / v.scored for v in views)
                     for bias in [float32(-1), *grid]}
            self.assertEqual(smallest_worst_share(views).share, min(worst.values()))

    def test_percentile_is_one_of_the_values(self):
        self.assertEqual([percentile([4, 1, 3, 2], share) for share in (0.25, 0.5, 0.51, 1)], [1, 2, 3, 4])


class Frustum:
    """What `carried` reads of a view."""

    def __init__(self, near_m, far_m, light_distance_m=None):
        self.near_m, self.far_m, self.median_light_distance_m = near_m, far_m, light_distance_m
        self.is_spot = light_distance_m is not None


class Carried(unittest.TestCase):
    def test_keeps_metres_of_a_directional_light(self):
        self.assertEqual(carried(float32(0.5), Frustum(-2, 2), Frustum(0, 8)), 0.25)

    def test_keeps_metres_of_a_spot(self):
        source, destination = Frustum(1, 10, 4.0), Frustum(2, 30, 7.0)

        def metres(bias, frustum):
            """How far the bias moves the median receiver towards the light, by way of its depth."""
            per_metre = 1 / frustum.near_m - 1 / frustum.far_m
            depth = (1 / frustum.near_m - 1 / frustum.median_light_distance_m) / per_metre - bias
            return frustum.median_light_distance_m - 1 / (1 / frustum.near_m - per_metre * depth)

        bias = float32(0.01)
        # The bias is rounded to float32 once, and metres are nearly in proportion to it.
        self.assertAlmostEqual(metres(float(carried(bias, source, destination)), destination),
                               metres(float(bias), source), delta=1e-7)

    def test_keeps_a_bias_under_the_same_light(self):
        spot = Frustum(1, 10, 4.0)
        self.assertEqual(carried(float32(0.01), spot, spot), float32(0.01))


class Views(unittest.TestCase):
    def test_radical_inverse_mirrors_digits(self):
        self.assertEqual([radical_inverse(k, 2) for k in range(1, 6)], [0.5, 0.25, 0.75, 0.125, 0.625])
        self.assertAlmostEqual(radical_inverse(5, 3), 7 / 9, delta=1e-15)  # 12 in base 3, mirrored 0.21

    def test_cap_reaches_from_the_axis_to_its_rim(self):
        axis, across, up = numpy.eye(3)
        self.assertEqual(in_cap(axis, across, up, 0, 0.3, 60).tolist(), axis.tolist())
        rim = in_cap(axis, across, up, 1, 0.25, 60)
        for found, expected in zip(rim, (0.5, 0, math.sqrt(0.75))):
            self.assertAlmostEqual(found, expected, delta=1e-15)

    def test_turned_lights_stay_within_the_cap(self):
        for direction in ((-0.4, -1, -0.3), (0, -1, 0)):
            for index in range(1, 50):
                result, angle_deg = turned(numpy.array(direction), index)
                self.assertAlmostEqual(float(numpy.linalg.norm(result)), 1, delta=1e-14)
                self.assertTrue(0 < angle_deg < 30)


if __name__ == "__main__":
    unittest.main()
