"""Figures of a sweep's axes and of its configurations side by side, as numbers."""

import statistics
import unittest

import numpy
from numpy.testing import assert_allclose, assert_array_equal

from figure_inputs import by_label, legend_labels, load, numbers, rows_of
from run_figures_test import PERCENT_TICKS, best_row

import error_vs_axis  # noqa: E402  found by figure_inputs
import heat_map  # noqa: E402
import pareto  # noqa: E402
import run_settings  # noqa: E402
import style  # noqa: E402


class ErrorVsAxis(unittest.TestCase):
    def setUp(self):
        self.tables = error_vs_axis.read(load("sweep"))
        self.figure = error_vs_axis.draw(self.tables)

    def test_has_a_panel_for_each_axis(self):
        self.assertEqual({axes.get_xlabel() for axes in self.figure.axes},
                         {"constant bias [depth units]", "map resolution [texels]", "filter"})
        self.assertEqual(self.figure.axes[0].get_xlabel(), "constant bias [depth units]")

    def test_draws_median_and_range_over_the_others(self):
        for axes, panel in zip(self.figure.axes, self.tables.panels):
            drawn = by_label(axes)
            for name, key, rates in (("false shadow", "false_shadow_rate", panel.false_shadow),
                                     ("false lit", "false_lit_rate", panel.false_lit)):
                groups = [numbers([row for row in rows_of("sweep/results")
                                   if run_settings.text_of(value) == row[panel.axis.key]], key)
                          for value in panel.axis.values]
                # The median of an even number is the mean of two: an ulp.
                assert_allclose(rates[0], [statistics.median(group) for group in groups], rtol=1e-15)
                assert_array_equal(rates[1], [group.min() for group in groups])
                assert_array_equal(rates[2], [group.max() for group in groups])
                assert_array_equal(drawn[f"{name}, median"].get_ydata(), 100 * rates[0])

    def test_axes(self):
        scales = {axes.get_xlabel(): axes.get_xscale() for axes in self.figure.axes}
        self.assertEqual(scales, {"constant bias [depth units]": "symlog",
                                  "map resolution [texels]": "linear", "filter": "linear"})
        for axes in self.figure.axes:
            assert_array_equal(axes.get_yticks(), PERCENT_TICKS)
        self.assertEqual(legend_labels(self.figure.legends[0]), [
            "false shadow, smallest to largest", "false shadow, median",
            "false lit, smallest to largest", "false lit, median"])

    def test_resolutions_have_ticks_at_powers_of_two(self):
        for count in (3, 9, 11):
            values = [32 << index for index in range(count)]
            axis = run_settings.Axis("shadow_map.resolution", values, numpy.arange(count), True)
            rates = numpy.full((3, count), 0.01)
            (axes,) = error_vs_axis.draw(error_vs_axis.Tables(
                "", [error_vs_axis.Panel(axis, rates, rates)], count)).axes
            ticks = axes.get_xticks()
            self.assertLessEqual(set(ticks), set(values))
            self.assertEqual(ticks[0], 32)
            texts = [label.get_text() for label in axes.get_xticklabels()]
            self.assertEqual(texts, [str(int(tick)) for tick in ticks])
            self.assertTrue(style.fit(axes, ticks, texts))

    def test_does_not_apply_without_an_axis(self):
        with self.assertRaises(run_settings.DoesNotApply):
            error_vs_axis.read(load("compare"))


class HeatMap(unittest.TestCase):
    def test_cells_are_medians_on_a_fixed_scale(self):
        tables = heat_map.read(load("sweep"))
        axes, bar = heat_map.draw(tables).axes
        for (row, column), rate in numpy.ndenumerate(tables.rates):
            cell = [float(one["error_rate"]) for one in rows_of("sweep/results")
                    if one[tables.y.key] == run_settings.text_of(tables.y.values[row])
                    and one[tables.x.key] == run_settings.text_of(tables.x.values[column])]
            # The median of an even number is the mean of two: an ulp.
            assert_allclose(rate, statistics.median(cell), rtol=1e-15)
        drawn = axes.collections[0]
        assert_array_equal(drawn.get_array().ravel(),
                           numpy.clip(100 * tables.rates.ravel(), 0.001, 100))
        self.assertEqual(drawn.get_clim(), (0.001, 100))
        self.assertEqual(axes.get_xlabel(), "constant bias [depth units]")
        self.assertEqual([label.get_text() for label in axes.get_xticklabels()],
                         ["0", "0.001", "0.003", "0.01", "0.03"])
        self.assertEqual(bar.get_ylabel(), "error rate [%]")
        self.assertEqual([label.get_text() for label in bar.get_yticklabels()],
                         ["≤ 0.001", "0.01", "0.1", "1", "10", "100"])

    def test_names_stand_from_the_top_down_and_numbers_upwards(self):
        for key, is_downwards in (("lookup.filter", True), ("shadow_map.resolution", False)):
            run = load("sweep")
            other = {"lookup.filter": "shadow_map.resolution"}.get(key, "lookup.filter")
            run.results = run.results[run.results[other] == run.results[other].iloc[0]]
            axes = heat_map.draw(heat_map.read(run)).axes[0]
            self.assertEqual(axes.get_ylabel(), run_settings.name_of(key))
            bottom, top = axes.get_ylim()
            self.assertEqual(bottom > top, is_downwards)

    def test_many_numbers_have_round_ticks_in_their_places(self):
        values = [2.0**power for power in range(4, 20)]
        axis = run_settings.Axis("shadow_map.resolution", values, numpy.arange(16), True)
        places, texts = heat_map._ticks(axis)
        assert_array_equal(places, range(16))
        self.assertEqual(texts[:3], ["16", "32", "64"])
        biases = list(numpy.geomspace(1e-5, 1e-1, 41))
        places, texts = heat_map._ticks(run_settings.Axis("bias.constant", biases, None, True))
        assert_allclose(places, [0, 10, 20, 30, 40], atol=1e-9)
        self.assertEqual(texts, ["1e-5", "0.0001", "0.001", "0.01", "0.1"])

    def test_does_not_apply_with_fewer_than_two_axes(self):
        run = load("sweep")
        run.results = run.results[(run.results["lookup.filter"] == "nearest")
                                  & (run.results["shadow_map.resolution"] == 32)]
        with self.assertRaisesRegex(run_settings.DoesNotApply, "fewer than two axes"):
            heat_map.read(run)


class Pareto(unittest.TestCase):
    def test_front_is_what_no_other_pair_dominates(self):
        seed = 20261122
        random = numpy.random.default_rng(seed)
        for trial in range(50):
            rates = random.integers(0, 12, (random.integers(1, 40), 2)) / 12
            expected = sorted({(a, b) for a, b in rates
                               if not any((c <= a and d <= b) and (c < a or d < b)
                                          for c, d in rates)})
            front = [tuple(pair) for pair in rates[pareto.front_of(rates)]]
            self.assertEqual(front, expected, (seed, trial, rates.tolist()))

    def test_names_the_ends_of_the_front_and_the_best(self):
        run = load("sweep")
        rates = numpy.geomspace(1e-4, 1, len(run.results))  # all are on the front
        run.results = run.results.assign(false_shadow_rate=rates, false_lit_rate=rates[::-1])
        tables = pareto.read(run)
        figure = pareto.draw(tables)
        numbers_ = [text.get_text() for text in figure.axes[0].texts]
        self.assertEqual(numbers_, [str(1 + index) for index in range(len(numbers_))])
        self.assertTrue(2 <= len(numbers_) <= pareto.MOST_NAMED)
        lines = figure.texts[-1].get_text().splitlines()
        self.assertEqual(len(lines), len(numbers_))
        self.assertTrue(any(line.endswith(tables.best_texts[0]) for line in lines))
        for place, line in zip((0, -1), (lines[0], lines[-1])):
            row = rows_of("sweep/results")[place]
            self.assertIn(f"map resolution {row['shadow_map.resolution']} texels", line)
            self.assertIn(f"constant bias {row['bias.constant']} depth units", line)

    def test_never_ranks_one_case_against_another(self):
        run = load("sweep")
        half = len(run.results) // 2
        easy = numpy.arange(len(run.results)) < half  # each of its rows beats all others
        rates = numpy.where(easy, 0.001, 0.1) * (1 + numpy.arange(len(run.results)))
        run.results = run.results.assign(case=numpy.where(easy, "easy", "hard"),
                                         false_shadow_rate=rates, false_lit_rate=rates,
                                         error_rate=rates)
        tables = pareto.read(run)
        self.assertEqual([len(front) for front in tables.fronts], [1, 1])
        assert_allclose(tables.best, rates[[0, half], None].repeat(2, axis=1))
        for text, case in zip(tables.best_texts, ("easy", "hard")):
            self.assertIn(f"case {case}", text)
        pareto.draw(tables)
        panels = error_vs_axis.words(error_vs_axis.read(run))[2]
        self.assertNotIn("Along case", panels)

    def test_names_dots_that_keep_apart(self):
        places = numpy.array([[0.1, 0.9], [0.11, 0.89], [0.5, 0.5], [0.51, 0.5], [0.9, 0.1]])
        self.assertEqual(pareto.named_of(places, [3]), [0, 3, 4])

    def test_draws_every_distinct_pair_and_the_best(self):
        tables = pareto.read(load("sweep"))
        (axes,) = pareto.draw(tables).axes
        drawn = by_label(axes)
        rows = rows_of("sweep/results")
        pairs = {(100 * float(row["false_shadow_rate"]), 100 * float(row["false_lit_rate"]))
                 for row in rows}
        self.assertLessEqual(set(zip(*drawn["a configuration"].get_data())), pairs)
        assert_array_equal(numpy.transpose(drawn["front: none is better in both"].get_data()),
                           100 * tables.front)
        best = best_row()
        self.assertEqual([line[0] for line in drawn["fewest errors"].get_data()],
                         [100 * float(best["false_shadow_rate"]),
                          100 * float(best["false_lit_rate"])])
        self.assertEqual(axes.get_xlabel(), "false shadow [% of lit pixels]")
        self.assertEqual(axes.get_ylabel(), "false lit [% of blocked pixels]")
        assert_array_equal(axes.get_xticks(), PERCENT_TICKS)
        assert_array_equal(axes.get_yticks(), PERCENT_TICKS)


if __name__ == "__main__":
    unittest.main()
