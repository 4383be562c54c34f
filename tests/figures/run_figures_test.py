"""Figures of runs as numbers: what is plotted against the CSV files, axes, words, which apply.

`compare` is a stored run of schema 1 (without the cause `filter` and the label `bleed`), a comparison of sphere-plane
with a map of 64 texels (64 x 48 pixels). Its bias_curves.csv has every 64th line.
"""

import contextlib
import dataclasses
import io
import json
import shutil
import statistics
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy
import pandas
from numpy.testing import assert_allclose, assert_array_equal

from figure_inputs import FIGURES, by_label, legend_labels, load, numbers, rows_of, run_folder

import bias_curve  # noqa: E402  found by figure_inputs
import causes  # noqa: E402
import depth_error_vs_z  # noqa: E402
import distance_panels  # noqa: E402
import errors_vs_z  # noqa: E402
import gnomon  # noqa: E402
import make  # noqa: E402
import run_settings  # noqa: E402
import style  # noqa: E402

PERCENT_TICKS = [0, 0.01, 0.1, 1, 10, 100]


def best_row():
    return min(rows_of("sweep/results"), key=lambda row: float(row["error_rate"]))


class BiasCurve(unittest.TestCase):
    def setUp(self):
        self.tables = bias_curve.read(load("compare"))
        (self.axes,) = bias_curve.draw(self.tables).axes
        (self.row,) = rows_of("compare/results")

    def test_draws_the_curve_in_percent(self):
        points = rows_of("compare/bias_curves")
        drawn = by_label(self.axes)
        for label, key in (("false shadow, per lit pixel", "false_shadow_rate"),
                           ("false lit, per blocked pixel", "false_lit_rate")):
            bias, percent = drawn[label].get_data()
            assert_array_equal(bias, numbers(points, "bias"))
            assert_array_equal(percent, 100 * numbers(points, key))
            self.assertEqual(drawn[label].get_drawstyle(), "steps-post")

    def test_marks_the_biases_of_the_results(self):
        drawn = by_label(self.axes)
        (job_bias,) = {row["bias"] for row in rows_of("compare/error_vs_z", at="job_bias")}
        for label, bias in (("the job's bias", job_bias),
                            ("no acne from here", self.row["bias_curve.acne_free"]),
                            ("no false light below", self.row["bias_curve.panning_free"])):
            assert_array_equal(drawn[label].get_xdata(), [float(bias)] * 2, label)
        patch = drawn["fewest errors"]  # a Polygon, or since Matplotlib 3.9 a Rectangle
        span = patch.get_patch_transform().transform(patch.get_path().vertices)[:, 0]
        self.assertEqual(span.min(), float(self.row["bias_curve.best_interval.lo"]))
        self.assertEqual(span.max(), float(self.row["bias_curve.best_interval.hi"]))

    def test_axes(self):
        self.assertEqual(self.axes.get_xscale(), "symlog")
        self.assertEqual(self.axes.get_yscale(), "symlog")
        self.assertEqual(self.axes.get_xlabel(), "constant bias [depth units]")
        self.assertEqual(self.axes.get_ylabel(), "wrong pixels [%]")
        assert_array_equal(self.axes.get_yticks(), PERCENT_TICKS)
        low, high = self.axes.get_xlim()
        self.assertLess(low, float(self.row["bias_curve.panning_free"]))
        self.assertGreater(high, numbers(rows_of("compare/bias_curves"), "bias").max())
        ticks = self.axes.get_xticks()
        self.assertIn(0, ticks)
        # Powers of ten on both sides.
        powers = numpy.log10(numpy.abs(ticks[ticks != 0]))
        assert_allclose(powers, numpy.round(powers), rtol=0, atol=1e-12)

    def test_of_a_large_sweep_is_the_best_configurations(self):
        tables = bias_curve.read(load("sweep"))
        self.assertEqual(len(tables.curves), 1)
        points = rows_of("sweep/bias_curves", curve=best_row()["curve"])
        assert_array_equal(tables.curves[0].bias, numbers(points, "bias"))
        self.assertIn("of 4 bias curves that of the configuration with the fewest errors",
                      tables.settings)

    def test_of_several_cases_is_of_each_the_best_configurations(self):
        rows = pandas.DataFrame({"case": ["fence", "fence", "wall", "wall"], "curve": [0, 1, 2, 3],
                                 "error_rate": [0.2, 0.1, numpy.nan, 0.5]})
        chosen, why = run_settings.curves_of(None, rows)
        self.assertEqual(list(chosen["curve"]), [1, 3])
        self.assertEqual(why, "of 4 bias curves each case's of the configuration with the fewest errors")

    def test_says_its_numbers(self):
        title, caption, alt = bias_curve.words(self.tables)
        self.assertEqual(title, "Wrong pixels at every constant bias")
        self.assertEqual(caption, "sphere-plane, 64 × 48 px, spot light, map 64², d24, near 0.5 m,"
                                  " far 10 m, filter nearest; job's bias 0.006 depth units")
        self.assertIn(f"Fewest errors, {self.row['bias_curve.best_errors']}, from bias", alt)

    def test_marks_no_bias_that_the_sweep_has_not(self):
        run = load("sweep")  # of 0 to 0.03; the job has 0.006
        tables = bias_curve.read(run)
        drawn = by_label(bias_curve.draw(tables).axes[0])
        self.assertNotIn("the job's bias", drawn)
        self.assertNotIn("job's bias", tables.settings)
        assert_array_equal(drawn["biases of the sweep"].get_xdata(), [0, 0.001, 0.003, 0.01, 0.03])
        run = load("sweep")
        run.results.loc[run.results["bias.constant"] == 0.01, "bias.constant"] = 0.006
        tables = bias_curve.read(run)
        self.assertIn("job's bias 0.006 depth units", tables.settings)
        self.assertIn("the job's bias", by_label(bias_curve.draw(tables).axes[0]))

    def test_ticks_keep_apart(self):
        run = load("compare")
        for scale in (1, 1e-3, 1e3):
            (curve,) = bias_curve.read(run).curves
            bias = curve.bias * scale
            table = bias_curve.Tables("", [dataclasses.replace(curve, bias=bias)])
            (axes,) = bias_curve.draw(table).axes
            texts = [label.get_text() for label in axes.get_xticklabels()]
            self.assertIn("0", texts)
            self.assertTrue(style.fit(axes, axes.get_xticks(), texts), texts)

    def test_has_one_scale_for_all_curves(self):
        (curve,) = bias_curve.read(load("compare")).curves
        larger = dataclasses.replace(curve, bias=1e3 * curve.bias)
        panels = bias_curve.draw(bias_curve.Tables("", [curve, larger])).axes
        self.assertEqual(panels[0].get_xlim(), panels[1].get_xlim())
        self.assertEqual(panels[0].get_ylim(), panels[1].get_ylim())
        self.assertEqual(list(panels[0].get_xticks()), list(panels[1].get_xticks()))
        self.assertLessEqual(panels[0].xaxis.get_transform().linthresh, bias_curve.threshold(curve))
        self.assertGreater(panels[0].get_xlim()[1], larger.bias.max())

    def test_joins_the_points_of_a_sampled_curve_by_lines(self):
        (curve,) = bias_curve.read(load("compare")).curves
        self.assertFalse(bias_curve.is_sampled(curve))
        biases = numpy.concatenate([[0], 1e-6 * 10.0 ** (numpy.arange(25) / 4)])
        rates = numpy.linspace(1, 0, len(biases))
        sampled = dataclasses.replace(curve, bias=biases.astype(numpy.float32).astype(float),
                                      false_shadow_rate=rates, false_lit_rate=1 - rates)
        self.assertTrue(bias_curve.is_sampled(sampled))
        (axes,) = bias_curve.draw(bias_curve.Tables("", [sampled])).axes
        self.assertEqual({line.get_drawstyle() for line in axes.lines[:2]}, {"default"})

    def test_does_not_apply_without_a_curve(self):
        run = load("compare")
        run.results["bias_source"] = "rerun"
        with self.assertRaisesRegex(run_settings.DoesNotApply, "no configuration has a bias curve"):
            bias_curve.read(run)


class ErrorsVsZ(unittest.TestCase):
    def setUp(self):
        self.tables = errors_vs_z.read(load("compare"))
        self.figure = errors_vs_z.draw(self.tables)
        self.job = rows_of("compare/error_vs_z", at="job_bias")
        self.best = rows_of("compare/error_vs_z", at="best_bias")

    def two_curves(self):
        """The sweep without its pcf3, of two map resolutions."""
        run = load("sweep")
        curves = run.results["curve"][run.results["lookup.filter"] == "nearest"]
        run.error_vs_z = run.error_vs_z[run.error_vs_z["curve"].isin(curves)]
        return run

    def test_draws_rates_at_both_biases(self):
        drawn = by_label(self.figure.axes[0])
        edges = numpy.append(numbers(self.job, "lower_m"), numbers(self.job, "upper_m")[-1])
        for label, key in (("false shadow, per lit pixel, job's bias", "false_shadow_rate"),
                           ("false lit, per blocked pixel, job's bias", "false_lit_rate")):
            steps = drawn[label].get_data()
            assert_array_equal(steps.values, 100 * numbers(self.job, key))
            assert_array_equal(steps.edges, edges)
        for label, key in (("false shadow, best bias", "false_shadow_rate"),
                           ("false lit, best bias", "false_lit_rate")):
            light_distance_m, percent = drawn[label].get_data()
            assert_array_equal(percent, 100 * numbers(self.best, key))
            assert_array_equal(light_distance_m, 0.5 * (edges[1:] + edges[:-1]))

    def test_draws_the_pixels_of_each_bin(self):
        drawn = by_label(self.figure.axes[1])
        for label, key in (("lit pixels", "lit"), ("blocked pixels", "blocked")):
            assert_array_equal(drawn[label].get_data().values, numbers(self.job, key))

    def test_axes(self):
        rates, counts = self.figure.axes
        assert_array_equal(rates.get_yticks(), PERCENT_TICKS)
        self.assertEqual(rates.get_ylabel(), "wrong pixels [%]")
        self.assertEqual(counts.get_ylabel(), "pixels in a bin")
        self.assertEqual(counts.get_xlabel(), "distance ζ from the light's plane [m]")
        self.assertEqual(counts.get_ylim()[0], 0)
        self.assertGreater(counts.get_ylim()[1], numbers(self.job, "lit").max())

    def test_draws_no_bias_that_the_sweep_has_not(self):
        tables = errors_vs_z.read(self.two_curves())
        self.assertEqual(len(tables.curves), 2)
        for curve in tables.curves:
            self.assertEqual(list(curve.at), ["best_bias"])
        texts = ", ".join(run_settings.text_of(curve.at["best_bias"][0]) for curve in tables.curves)
        self.assertIn(f"best bias {texts} depth units", tables.settings)
        self.assertIn("job's bias 0.006 depth units; best bias ", self.tables.settings)

    def test_has_a_column_for_each_of_few_curves(self):
        figure = errors_vs_z.draw(errors_vs_z.read(self.two_curves()))
        self.assertEqual(len(figure.axes), 4)
        self.assertEqual([axes.get_title() for axes in figure.axes[::2]],
                         ["map resolution 32 texels", "map resolution 64 texels"])


class DepthErrorVsZ(unittest.TestCase):
    def test_draws_the_runs_quantiles(self):
        (axes,) = depth_error_vs_z.draw(depth_error_vs_z.read(load("compare"))).axes
        rows = rows_of("compare/error_vs_z", at="job_bias")
        factor = {"m": 1, "mm": 1e3, "µm": 1e6}[axes.get_ylabel().split("[")[1][:-1]]
        drawn = by_label(axes)
        for label, key in (("median", "map_error_m.median"), ("95 % are below", "map_error_m.p95")):
            assert_array_equal(drawn[label].get_ydata(), factor * numbers(rows, key))
        upper, envelope = drawn["envelope (formula)"].get_data()
        assert_array_equal(envelope, factor * numbers(rows, "envelope_m"))
        assert_array_equal(upper, numbers(rows, "upper_m"))
        self.assertEqual(axes.get_xlabel(), "distance ζ from the light's plane [m]")

    def test_cuts_off_what_a_few_pixels_at_edges_have_and_says_so(self):
        run = load("compare")
        usual = numpy.nanmax(numpy.abs(run.error_vs_z[["map_error_m.p95", "map_error_m.median",
                                                      "envelope_m"]].to_numpy()))
        run.error_vs_z["map_error_m.max"] = numpy.where(
            run.error_vs_z["map_error_m.max"].notna(), 2.5, numpy.nan)
        (axes,) = depth_error_vs_z.draw(depth_error_vs_z.read(run)).axes
        factor = {"mm": 1e3, "µm": 1e6}[axes.get_ylabel().split("[")[1][:-1]]
        shown = distance_panels.LARGEST_SHOWN * factor * usual
        assert_allclose(axes.get_ylim(), [-shown, shown])
        self.assertEqual([text.get_text() for text in axes.texts],
                         ["largest beyond\nthe axis: 2.5 m"])

    def test_shows_the_envelope_beside_larger_errors(self):
        run = load("compare")
        run.error_vs_z["map_error_m.max"] = numpy.where(
            run.error_vs_z["map_error_m.max"].notna(), 2.5, numpy.nan)
        (axes,) = depth_error_vs_z.draw(depth_error_vs_z.read(run)).axes
        envelope = numpy.nanmax(by_label(axes)["envelope (formula)"].get_ydata())
        _, low = axes.transAxes.inverted().transform(axes.transData.transform((0, 0)))
        _, high = axes.transAxes.inverted().transform(axes.transData.transform((0, envelope)))
        self.assertGreater(high - low, 0.1)


class Causes(unittest.TestCase):
    def test_of_one_configuration_are_its_counts(self):
        (row,) = rows_of("compare/results")
        above, below = causes.draw(causes.read(load("compare"))).axes
        for axes, names in ((above, [f"causes.{name}" for name in style.CAUSES]),
                            (below, [f"labels.{name}" for name in causes.LABELS])):
            counts = [int(row.get(name, 0)) for name in names]
            self.assertEqual([bar.get_width() for bar in axes.patches], counts)
            self.assertEqual([text.get_text() for text in axes.texts],
                             [f"{count:,}" for count in counts])
            self.assertEqual([label.get_text() for label in axes.get_yticklabels()],
                             [name.split(".")[1].replace("_", "-") for name in names])
        self.assertEqual(below.get_xlabel(), "wrong pixels")

    def test_have_the_filter_and_what_bleeds_where_they_are_counted(self):
        run = load("compare")
        run.results["causes.filter"] = 7
        run.results["labels.bleed"] = 3
        above, below = causes.draw(causes.read(run)).axes
        self.assertEqual(above.patches[list(style.CAUSES).index("filter")].get_width(), 7)
        self.assertEqual(below.patches[causes.LABELS.index("bleed")].get_width(), 3)

    def test_of_a_sweep_are_means_along_the_axis_that_matters_most(self):
        (axes,) = causes.draw(causes.read(load("sweep"))).axes
        self.assertEqual(axes.get_xlabel(), "constant bias [depth units]")
        self.assertEqual([label.get_text() for label in axes.get_xticklabels()],
                         ["0", "0.001", "0.003", "0.01", "0.03"])
        bottom = numpy.zeros(5)
        for cause, bars in zip(style.CAUSES, axes.containers):
            expected = [statistics.mean(
                100 * int(row.get(f"causes.{cause}", 0)) / (int(row["pixels.lit"])
                                                            + int(row["pixels.blocked"]))
                for row in rows_of("sweep/results", **{"bias.constant": bias}))
                for bias in ("0", "0.001", "0.003", "0.01", "0.03")]
            # Sums of four quotients in another order: some ulp.
            assert_allclose([bar.get_height() for bar in bars], expected, rtol=1e-14, atol=1e-14)
            assert_allclose([bar.get_y() for bar in bars], bottom, rtol=1e-14, atol=1e-14)
            bottom = bottom + expected


class WholeRun(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def draw(self, run, folder):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            self.assertEqual(make.main(["run", str(run), "--out", str(folder)]), 0)
        return json.loads(printed.getvalue())

    def draw_in_a_process(self, run, folder):
        command = ["/usr/bin/python3", "-B", str(FIGURES / "make.py"), "run", str(run), "--out",
                   str(folder)]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(done.stdout)

    def test_draws_what_applies_the_same_twice(self):
        names = ["bias-curve", "errors-vs-z", "depth-error-vs-z", "causes", "error-vs-axis",
                 "heat-map", "pareto"]
        once = self.draw(run_folder("sweep"), self.folder / "a")
        twice = self.draw_in_a_process(run_folder("sweep"), self.folder / "b")
        self.assertEqual([figure["name"] for figure in once], names)
        self.assertEqual(once, twice)
        self.assertEqual(len(list((self.folder / "a").iterdir())), 2 * len(names))
        for figure in once:
            self.assertEqual(list(figure), ["name", "title", "caption", "alt", "svg", "png"])
            for kind in ("svg", "png"):
                pictures = [(self.folder / one / figure[kind]).read_bytes() for one in ("a", "b")]
                self.assertEqual(*pictures)

    def test_of_a_comparison_has_no_figure_of_axes(self):
        self.assertEqual([name for name, _, _ in make.applying(load("compare"))],
                         ["bias-curve", "errors-vs-z", "depth-error-vs-z", "causes"])

    def test_takes_any_names(self):
        shutil.copytree(run_folder("sweep"), self.folder / "run")
        hostile = '</script><img onerror=alert(1)> $x^2$ \u202eabc 😀 _ ' + 5000 * "long "
        for path in (self.folder / "run").glob("results.csv"):
            path.write_text(path.read_text().replace(",sphere-plane,", f',"{hostile}",')
                            .replace(",pcf3,", f",{hostile}3,"))
        drawn = 0
        for name, module, tables in make.applying(gnomon.load_run(self.folder / "run")):
            _, caption, alt = module.words(tables)
            self.assertLess(len(caption), 300, name)
            self.assertLess(len(alt), 1000, name)
            svg = self.folder / "figure.svg"
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of glyphs that the font lacks
                style.save(module.draw(tables), svg)
            self.assertNotIn("<img", svg.read_text(), name)
            drawn += 1
        self.assertEqual(drawn, 7)


if __name__ == "__main__":
    unittest.main()
