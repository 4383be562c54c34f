#!/usr/bin/python3
"""benchmarks/regret agrees with curves computed by hand, and with a recommendation by exhaustive search.

Exit status: 77 if numpy is missing.
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
from recommendation import ErrorCurve, bare_minimum, middle, pieces_from_zero, recommend
from regret import (ScoredView, carried, carried_in_texels, percentile, regret_of, shadow_lost,
                    smallest_worst_share)
from views import in_cap, radical_inverse, turned

INFINITY = float("inf")
TINY = numpy.finfo(numpy.float32).tiny  # the smallest bias above 0


def float32(value):
    return numpy.float32(value)


def before(value):
    """The float32 just below one that is greater than the smallest normal."""
    return numpy.nextafter(float32(value), float32(0))


def count_errors(lit, blocked, bias):
    """Counts the wrong pixels by definition."""
    return sum(critical > bias for critical in lit) + sum(critical <= bias for critical in blocked)


def by_wide_texels(bias, texels):
    """A texel is 8 depth units: three of them reach beyond every bounded minimum."""
    return float32(float(bias) + 8 * texels)


def by_narrow_texels(bias, texels):
    return float32(float(bias) + texels / 1024)


def recommend_by_trial(lit, blocked, lengthened):
    """Applies the rule literally to every level and every run of biases.

    Errors are constant from a critical bias up to the next one.
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
                if low == 0:
                    return float32(0), low, high
                return min(lengthened(low, 3), float32(math.sqrt(float(low) * float(high)))), low, high
    raise AssertionError("the highest level holds every bias")


class Recommend(unittest.TestCase):
    def expect(self, lit, blocked, bias, low, high, lengthened=by_wide_texels):
        found = recommend(ErrorCurve(lit, blocked), lengthened)
        self.assertEqual((found.bias, found.low, found.high), (float32(bias), float32(low), float32(high)))

    def test_is_three_texels_above_the_lower_end(self):
        self.expect([1], [4], 1 + 3 / 1024, 1, before(4), by_narrow_texels)
        self.expect([1], [100], 1 + 3 / 1024, 1, before(100), by_narrow_texels)

    def test_is_at_most_the_geometric_middle_of_a_broad_valley(self):
        self.expect([1], [4], math.sqrt(float(before(4))), 1, before(4))

    def test_is_zero_where_zero_lies_in_the_valley(self):
        self.expect([-1, 0], [1e-6], 0, 0, before(1e-6))
        # The bias before the smallest one is 0.
        self.expect([0], [TINY], 0, 0, 0)

    def test_needs_no_middle_where_nothing_limits_the_upper_end(self):
        self.expect([0.25], [], 24.25, 0.25, INFINITY)
        self.expect([0.25], [INFINITY], 24.25, 0.25, INFINITY)

    def test_was_the_middle_before(self):
        self.assertEqual(recommend(ErrorCurve([1], [4]), by_narrow_texels, middle).bias,
                         float32(math.sqrt(float(before(4)))))
        self.assertEqual(recommend(ErrorCurve([0.25], []), by_narrow_texels, middle).bias, 0.5)

    def test_is_zero_where_no_bias_matters(self):
        self.expect([-INFINITY, INFINITY], [-INFINITY], 0, 0, INFINITY)

    def test_is_nothing_where_no_scored_pixel_is_lit(self):
        self.assertIsNone(recommend(ErrorCurve([], [1, 2]), by_wide_texels))
        self.assertIsNone(recommend(ErrorCurve([], []), by_wide_texels))

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
        # At 2 one pixel is repaired and another breaks, so the errors are equal on both sides.
        self.expect([1, 1, 2], [2, 4, 4], math.sqrt(float(before(4))), 1, before(4))

    def test_sees_no_bias_below_zero(self):
        found = recommend(ErrorCurve([1] * 3, [-1, -1, 0]), by_wide_texels)
        self.assertEqual((found.bias, found.low, found.least_errors), (25, 1, 3))

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
            lengthened = source.choice((by_wide_texels, by_narrow_texels))
            found = recommend(ErrorCurve(lit, blocked), lengthened)
            with self.subTest(lit=lit, blocked=blocked):
                self.assertEqual(found and (found.bias, found.low, found.high),
                                 recommend_by_trial(lit, blocked, lengthened))


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

    def test_shadow_lost_is_the_share_of_blocked_pixels_that_are_lit(self):
        self.assertEqual(shadow_lost(2, ErrorCurve([5], [1, 2, 3, 4])), 0.5)
        self.assertIsNone(shadow_lost(2, ErrorCurve([5], [])))

    def test_percentile_is_one_of_the_values(self):
        self.assertEqual([percentile([4, 1, 3, 2], share) for share in (0.25, 0.5, 0.51, 1)], [1, 2, 3, 4])


def frustum(near_m, far_m, light_distance_m=None, texel_m=0.25):
    """A view without pixels; of a spot where a light distance is given."""
    return ScoredView(ErrorCurve([], []), light_distance_m, near_m, far_m, texel_m, light_distance_m is not None)


class Lengths(unittest.TestCase):
    def test_are_metres_and_texels_of_a_directional_light(self):
        view = frustum(2, 10)
        self.assertEqual((view.metres(0.5), view.texels(0.5)), (4, 16))
        self.assertEqual(view.lengthened(0.5, 3), float32(4.75 / 8))

    def test_grow_with_the_distance_from_a_spot(self):
        view = frustum(2, 10, 5.0)
        self.assertEqual(view.median_texel_m, 1.25)
        # The bias is rounded to float32 once: 6e-8 of 0.1 m.
        self.assertAlmostEqual(view.metres(view.lengthened(float32(0.05), 0.5)) - view.metres(float32(0.05)), 0.625,
                               delta=1e-6)

    def test_end_where_a_map_is_lit_as_a_whole(self):
        self.assertEqual(frustum(2, 10, 5.0).lengthened(float32(0.5), 100), 1)
        self.assertEqual(frustum(2, 10).lengthened(float32(2), 100), 2)


class Carried(unittest.TestCase):
    def test_keeps_metres_of_a_directional_light(self):
        self.assertEqual(carried(float32(0.5), frustum(-2, 2), frustum(0, 8)), 0.25)

    def test_keeps_metres_of_a_spot(self):
        source, destination = frustum(1, 10, 4.0), frustum(2, 30, 7.0)

        def metres(bias, view):
            """How far the bias moves the median receiver towards the light, by way of its depth."""
            per_metre = 1 / view.near_m - 1 / view.far_m
            depth = (1 / view.near_m - 1 / view.median_light_distance_m) / per_metre - bias
            return view.median_light_distance_m - 1 / (1 / view.near_m - per_metre * depth)

        bias = float32(0.01)
        # The bias is rounded to float32 once, and metres are nearly in proportion to it.
        self.assertAlmostEqual(metres(float(carried(bias, source, destination)), destination),
                               metres(float(bias), source), delta=1e-7)

    def test_keeps_a_bias_under_the_same_light(self):
        spot = frustum(1, 10, 4.0)
        # There and back in double, rounded to float32 once.
        self.assertAlmostEqual(carried(float32(0.01), spot, spot), float32(0.01), delta=1e-9)

    def test_keeps_texels_of_another_map(self):
        self.assertEqual(carried_in_texels(float32(0.125), frustum(2, 10), frustum(2, 10, texel_m=0.5)), 0.25)


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

    def test_lights_are_turned_by_ten_degrees_four_ways(self):
        for direction in ((-0.4, -1, -0.3), (0, -1, 0)):
            own = numpy.array(direction) / numpy.linalg.norm(direction)
            ways = [turned(numpy.array(direction), index) for index in range(4)]
            for way in ways:
                # Products and sums of a few doubles of order 1.
                self.assertAlmostEqual(float(numpy.linalg.norm(way)), 1, delta=1e-14)
                self.assertAlmostEqual(float(way @ own), math.cos(math.radians(10)), delta=1e-14)
            self.assertAlmostEqual(float((ways[0] + ways[2]) @ (ways[1] - ways[3])), 0, delta=1e-14)


if __name__ == "__main__":
    unittest.main()
