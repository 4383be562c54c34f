"""Figures of depths as numbers: curves against the CSV files that they are drawn from, and axes."""

import tempfile
import unittest
from pathlib import Path

import numpy
import pandas
from numpy.testing import assert_array_equal

from figure_inputs import column, legend_labels, line, path, paths

import error_vs_z  # noqa: E402  found by figure_inputs
import measured_against_formula  # noqa: E402
import reversed_float  # noqa: E402
import shadow_errors_on_depth_error  # noqa: E402
import tables  # noqa: E402
import tolerance_vs_z  # noqa: E402


class StorageOfATable(unittest.TestCase):
    def test_is_told_by_its_depths_and_codes(self):
        for name, expected in (("formula8", "8 bits"), ("d16", "16 bits"), ("d24", "24 bits"),
                               ("d32f", "float32"), ("d32f_reversed", "float32 reversed")):
            with self.subTest(name=name):
                (table,) = tables.read_formulas(paths(name))
                storage = tables.storage_of(table)
                self.assertEqual(storage.name, expected)
                # Depths are rounded to double, 2^-53, and 1/ζ of far is 12.5 times smaller.
                self.assertAlmostEqual(storage.near_m, 4, delta=1e-12)
                self.assertAlmostEqual(storage.far_m, 50, delta=1e-12 * 50**2)


class ErrorVsZ(unittest.TestCase):
    def setUp(self):
        self.tables = error_vs_z.read(paths("formula24", "formula8"))
        self.curves = error_vs_z.data(self.tables)
        self.figure = error_vs_z.draw(self.tables)

    def test_data_are_the_columns_by_ascending_bits(self):
        self.assertEqual([curve["name"] for curve in self.curves], ["8 bits", "24 bits"])
        for curve, name in zip(self.curves, ("formula8", "formula24")):
            assert_array_equal(curve["envelope"][0], column(name, "zeta_m"))
            assert_array_equal(curve["envelope"][1], column(name, "envelope_m"))
        # The formula at far, docs/depth_precision.md#largest-error.
        self.assertAlmostEqual(self.curves[0]["envelope"][1][-1], 1.1535, delta=5e-5)
        self.assertAlmostEqual(self.curves[1]["envelope"][1][-1], 1.7136e-5, delta=5e-10)

    def test_teeth_are_drawn_where_six_samples_resolve_them(self):
        light_distance_m, error = self.curves[0]["teeth"]
        spacing = 46 / 199
        all_distances_m, envelope = self.curves[0]["envelope"]
        expected = all_distances_m[2 * envelope >= 6 * spacing * (1 - 1e-9)]
        assert_array_equal(light_distance_m, expected)
        assert_array_equal(error, abs(column("formula8", "formula_error_m")[-len(expected):]))
        self.assertEqual(self.curves[1]["teeth"][0].size, 0)
        self.assertEqual(self.curves[1]["dots"][0].size, 40)

    def test_no_sample_leaves_its_envelope(self):
        for curve in self.curves:
            for part in ("teeth", "dots"):
                light_distance_m, error = curve[part]
                bound = numpy.interp(light_distance_m, *curve["envelope"])
                self.assertTrue(numpy.all(error <= bound), (curve["name"], part))

    def test_axes(self):
        axes = self.figure.axes[0]
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("linear", "log"))
        self.assertEqual(axes.get_xlim(), (4, 50))
        low, high = axes.get_ylim()
        self.assertEqual(low, column("formula24", "envelope_m")[0] / 12)
        self.assertEqual(high, column("formula8", "envelope_m")[-1] * 2.2)
        self.assertEqual(axes.get_xlabel(), "distance ζ from the camera's plane [m]")
        self.assertEqual(axes.get_ylabel(), "|error of ζ| [m]")
        self.assertEqual(legend_labels(axes.get_legend()),
                         ["envelope (formula)", "sawtooth", "samples of a finer sawtooth"])
        self.assertEqual([text.get_text() for text in axes.texts], ["8 bits", "24 bits"])

    def test_last_codes_are_signed_and_only_those_resolved(self):
        self.assertEqual([axes.get_title() for axes in self.figure.axes[1:]],
                         ["8 bits: the last 8 codes"])
        axes = self.figure.axes[1]
        light_distance_m, error = axes.get_lines()[0].get_data()
        # Half a code below the eighth from the end: 1/ζ = 1/4 - (1/4 - 1/50)(247.5/255).
        self.assertAlmostEqual(light_distance_m[0], 1 / (0.25 - 0.23 * 247.5 / 255), delta=46 / 199)
        assert_array_equal(error, column("formula8", "formula_error_m")[-len(light_distance_m):])
        self.assertEqual(axes.get_ylabel(), "error of ζ [m]")
        self.assertEqual(self.curves[1]["last_codes"][0].size, 0)

    def test_refuses_floats_and_another_frustum(self):
        with self.assertRaisesRegex(tables.InputError, "d32f.csv: codes of a float"):
            error_vs_z.draw(error_vs_z.read(paths("d32f")))
        with self.assertRaisesRegex(tables.InputError, "orthographic.csv: the projection is not perspective"):
            error_vs_z.draw(error_vs_z.read(paths("orthographic")))
        with self.assertRaisesRegex(tables.InputError, "r16f.csv: the codes are neither evenly spaced"):
            error_vs_z.draw(error_vs_z.read(paths("r16f")))


class ToleranceVsZ(unittest.TestCase):
    def setUp(self):
        self.tables = tolerance_vs_z.read(paths("tolerance32"))
        self.figure = tolerance_vs_z.draw(self.tables)

    def test_fails_where_the_envelope_exceeds_it(self):
        self.assertEqual(self.tables.tolerance, 1e-8)
        # sqrt(T/(AΔ)) with A = 0.23/m and Δ = 1/2/(2^32 - 1), to half a step between codes, 1e-8 m.
        self.assertAlmostEqual(self.tables.exceeded_from, (2e-8 * (2**32 - 1) / 0.23)**0.5, delta=1e-8)
        light_distance_m, envelope = self.tables.envelope
        self.assertTrue(numpy.all((envelope > 1e-8) == (light_distance_m >= self.tables.exceeded_from)))

    def test_shows_single_codes_with_their_sign_at_three_places(self):
        self.assertEqual([name for name, *_ in self.tables.details],
                         ["near", "where it begins to fail", "far"])
        ratios = []
        for name, light_distance_m, error, envelope in self.tables.details:
            with self.subTest(place=name):
                stored = column("tolerance32", "formula_error_m",
                                lambda row: light_distance_m[0] <= float(row["zeta_m"]) <= light_distance_m[-1])
                assert_array_equal(error, stored)
                # Sixteen samples a code: a tooth's tips are missed by an eighth at most.
                self.assertGreater(error.max(), 0.87 * envelope[0])
                self.assertLess(error.min(), -0.87 * envelope[0])
                self.assertGreaterEqual(numpy.count_nonzero(numpy.diff(numpy.sign(error)) > 0), 7)
                ratios.append(numpy.abs(error).max() / self.tables.tolerance)
        self.assertLess(ratios[0], 0.05)
        self.assertAlmostEqual(ratios[1], 1, delta=0.13)
        self.assertGreater(ratios[2], 5.8)

    def test_axes(self):
        above, *below = self.figure.axes
        self.assertEqual((above.get_xlim(), above.get_yscale()), ((4, 50), "log"))
        self.assertEqual(legend_labels(self.figure.legends[0]),
                         ["errors that it does not cover", "|error|, samples", "envelope (formula)",
                          "tolerance"])
        self.assertEqual([axes.get_ylabel() for axes in below], ["error of ζ [nm]"] * 3)
        self.assertEqual([axes.get_xlabel() for axes in below],
                         ["ζ − 4 m [nm]", "ζ − 19.33 m [nm]", "ζ − 50 m [µm]"])

    def test_of_a_tolerance_that_holds_everywhere_shows_both_ends(self):
        with tempfile.TemporaryDirectory() as folder:
            larger = Path(folder) / "larger.csv"
            larger.write_text(path("tolerance32").read_text().replace(",1e-08\n", ",1e-06\n"))
            held = tolerance_vs_z.read([larger])
        self.assertIsNone(held.exceeded_from)
        self.assertEqual([name for name, *_ in held.details], ["near", "far"])
        tolerance_vs_z.draw(held)

    def test_refuses_what_has_no_tolerance_or_no_single_codes(self):
        for names, reason in ((("formula24",), "formula24.csv: no column tolerance_m"),
                              (("tolerance32", "tolerance32"), "2 files given")):
            with self.assertRaisesRegex(tables.InputError, reason):
                tolerance_vs_z.read(paths(*names))
        with tempfile.TemporaryDirectory() as folder:
            even = Path(folder) / "even.csv"
            lines = path("formula24").read_text().splitlines()
            even.write_text("\n".join([lines[0] + ",tolerance_m", *(line + ",1e-6" for line in lines[1:])]))
            with self.assertRaisesRegex(tables.InputError, "even.csv: no place where single codes"):
                tolerance_vs_z.read([even])


class ReversedFloat(unittest.TestCase):
    names = ("d24", "d32f", "d32f_reversed")

    def setUp(self):
        self.figure = reversed_float.draw(reversed_float.read(paths(*self.names)))

    def test_panels_show_the_formulas_and_the_measured_errors(self):
        for axes, key in zip(self.figure.axes, ("formula_error_m", "error_m")):
            dots = [one for one in axes.get_lines() if one.get_marker() == "."]
            for one, name in zip(dots, self.names):
                assert_array_equal(one.get_xdata(), column(name, "zeta_m"))
                assert_array_equal(one.get_ydata(), abs(column(name, key)))
            for label, name in zip(("24 bits", "float32", "float32 reversed"), self.names):
                assert_array_equal(line(axes, label)[1], column(name, "envelope_m"))

    def test_axes(self):
        formula, measured = self.figure.axes
        self.assertEqual(formula.get_title(), "ideal storage (formula)")
        self.assertEqual(measured.get_title(), "as GL stored it (measured)")
        for axes in (formula, measured):
            self.assertEqual(axes.get_yscale(), "log")
            self.assertEqual(axes.get_xlabel(), "distance ζ [m]")
            self.assertEqual(axes.get_xlim(), tuple(column("d24", "zeta_m")[[0, -1]]))
        self.assertEqual(formula.get_ylabel(), "|error of ζ| [m]")
        self.assertEqual(formula.get_ylim(), measured.get_ylim())
        self.assertEqual(legend_labels(self.figure.legends[0]),
                         ["24 bits", "float32", "float32 reversed"])

    def test_marks_where_float32_is_no_finer_than_24_bits(self):
        (note,) = self.figure.axes[0].texts
        # 2fn/(f + n) for near 4, far 50.
        self.assertAlmostEqual(note.xy[0], 400 / 54, delta=1e-9)
        self.assertIn("from 7.41 m on", note.get_text())


class MeasuredAgainstFormula(unittest.TestCase):
    def setUp(self):
        tables_ = measured_against_formula.read(paths("d16", "d24"))
        self.curves = measured_against_formula.data(tables_)
        self.figure = measured_against_formula.draw(tables_)

    def test_plots_gls_errors_over_the_envelope(self):
        for axes, name, title in zip(self.figure.axes[::2], ("d16", "d24"), ("16 bits", "24 bits")):
            light_distance_m, error = line(axes, "GL's |error| (measured)")
            assert_array_equal(light_distance_m, column(name, "zeta_m"))
            assert_array_equal(error, abs(column(name, "error_m")))
            assert_array_equal(line(axes, "envelope (formula)")[1], column(name, "envelope_m"))
            assert_array_equal(line(axes, "bound of the driver model")[1],
                               column(name, "model_m"))
            self.assertEqual(axes.get_title(), title)
            self.assertEqual(axes.get_ylabel(), "|error of ζ| [m]")
            self.assertEqual(axes.get_yscale(), "log")
            self.assertEqual(axes.get_ylim(), (column(name, "envelope_m")[0] / 20,
                                               2 * column(name, "model_m").max()))

    def test_residual_is_measured_less_formula(self):
        for axes, name, curve in zip(self.figure.axes[1::2], ("d16", "d24"), self.curves):
            residual = column(name, "error_m") - column(name, "formula_error_m")
            assert_array_equal(curve["residual"], residual)
            factor = {"nm": 1e9, "µm": 1e6, "mm": 1e3}[axes.get_ylabel()[-3:-1]]
            assert_array_equal(line(axes, "residual: measured − formula")[1], factor * residual)
            assert_array_equal(line(axes, "vertex transform's share")[1],
                               factor * column(name, "transform_error_m"))
            self.assertEqual(axes.get_yscale(), "linear")
            self.assertEqual(axes.get_xlabel(), "distance ζ [m]")

    def test_legend_names_everything_once(self):
        self.assertEqual(legend_labels(self.figure.legends[0]),
                         ["GL's |error| (measured)", "envelope (formula)",
                          "bound of the driver model", "vertex transform's share",
                          "residual: measured − formula"])

    def test_needs_what_gl_measured(self):
        with self.assertRaisesRegex(tables.InputError, "only 0 rows .*--theory-only"):
            measured_against_formula.read(paths("formula24"))


class ShadowErrorsOnDepthError(unittest.TestCase):
    def setUp(self):
        tables_ = shadow_errors_on_depth_error.read(paths("two-distances/error_vs_z", "two-distances/results"))
        self.hashes = list(tables_[1]["curve"])
        self.curves = shadow_errors_on_depth_error.data(tables_)
        self.figure = shadow_errors_on_depth_error.draw(tables_)

    def rows_of(self, curve):
        return lambda row: row["curve"] == self.hashes[curve] and row["at"] == "job_bias"

    def test_map_errors_are_the_runs_bins(self):
        for index, axes in enumerate(self.figure.axes[1::2]):
            rows = self.rows_of(index)
            factor = {"µm": 1e6, "mm": 1e3}[axes.get_ylabel()[-3:-1]]
            for label, key in (("median", "map_error_m.median"), ("95 % are below",
                                                                  "map_error_m.p95")):
                light_distance_m, error = line(axes, label)
                assert_array_equal(error, factor * column("two-distances/error_vs_z", key, rows))
                assert_array_equal(light_distance_m, 0.5 * (column("two-distances/error_vs_z", "lower_m", rows)
                                                            + column("two-distances/error_vs_z", "upper_m", rows)))
            upper, envelope = line(axes, "envelope (formula)")
            assert_array_equal(upper, column("two-distances/error_vs_z", "upper_m", rows))
            assert_array_equal(envelope, factor * column("two-distances/error_vs_z", "envelope_m", rows))
            band = axes.collections[0].get_paths()[0].vertices[:, 1]
            self.assertEqual(band.max(), factor * column("two-distances/error_vs_z", "map_error_m.max",
                                                         rows).max())
            self.assertEqual(band.min(), factor * column("two-distances/error_vs_z", "map_error_m.min",
                                                         rows).min())

    def test_united_bins_keep_every_pixel_and_have_enough(self):
        for index, curve in enumerate(self.curves):
            rows = self.rows_of(index)
            lower, upper, lit, blocked, wrong = (
                column("two-distances/error_vs_z", key, rows)
                for key in ("lower_m", "upper_m", "lit", "blocked", "false_shadow"))
            edges = curve["edges"]
            self.assertEqual((edges[0], edges[-1]), (lower[0], upper[-1]))
            self.assertLess(len(edges), len(lower))
            for low, high, rate in zip(edges, edges[1:], curve["false_shadow_rate"]):
                inside = (lower >= low) & (upper <= high)
                self.assertGreaterEqual(lit[inside].sum(), 1000)
                self.assertGreaterEqual(blocked[inside].sum(), 200)
                self.assertEqual(rate, wrong[inside].sum() / lit[inside].sum())

    def test_rates_are_drawn_in_percent(self):
        for axes, curve in zip(self.figure.axes[::2], self.curves):
            stairs = {patch.get_label(): patch.get_data() for patch in axes.patches}
            assert_array_equal(stairs["false shadow, per lit pixel"].values,
                               100 * curve["false_shadow_rate"])
            assert_array_equal(stairs["false lit, per blocked pixel"].values,
                               100 * curve["false_lit_rate"])
            assert_array_equal(stairs["false lit, per blocked pixel"].edges, curve["edges"])

    def test_axes(self):
        rates, errors = self.figure.axes[:2]
        self.assertEqual([axes.get_title() for axes in self.figure.axes[::2]], ["depth format d16", "depth format d24"])
        self.assertEqual(rates.get_ylabel(), "wrong pixels [%]")
        self.assertEqual(rates.get_yscale(), "symlog")
        assert_array_equal(rates.get_yticks(), [0, 0.01, 0.1, 1, 10, 100])
        self.assertEqual(rates.get_ylim(), (-0.002, 100))
        self.assertEqual(errors.get_xlabel(), "distance ζ from the light's plane [m]")
        self.assertEqual(errors.get_ylabel(), "depth error [mm]")
        self.assertEqual(rates.get_xlim(), errors.get_xlim())
        self.assertEqual(legend_labels(self.figure.legends[0]), [
            "false shadow, per lit pixel", "false lit, per blocked pixel",
            "map error, smallest to largest", "95 % are below", "median", "envelope (formula)"])
        caption = " ".join(text.get_text() for text in self.figure.texts).replace("\n", " ")
        self.assertIn("map 1024², near 4 m, far 50 m, filter linear; job's bias 4e-6 depth units",
                      caption)

    def test_of_many_curves_is_the_best_and_says_so(self):
        bins, results = shadow_errors_on_depth_error.read(paths("two-distances/error_vs_z", "two-distances/results"))
        copies = 5
        many = [pandas.concat([one.assign(curve=one["curve"] + str(copy)) for copy in range(copies)],
                              ignore_index=True) for one in (bins, results)]
        many[1]["shadow_map.resolution"] = range(2 * copies)
        (curve,) = shadow_errors_on_depth_error.data(many)
        figure = shadow_errors_on_depth_error.draw(many)
        self.assertEqual(len(figure.axes), 2)
        best = int(results["error_rate"].idxmin())
        expected = shadow_errors_on_depth_error.data([bins, results])[best]
        assert_array_equal(curve["false_shadow_rate"], expected["false_shadow_rate"])
        self.assertIn("of 10 bias curves", " ".join(text.get_text() for text in figure.texts))

    def test_draws_the_best_bias_where_the_sweep_has_not_the_jobs(self):
        bins, results = shadow_errors_on_depth_error.read(paths("two-distances/error_vs_z", "two-distances/results"))
        results["bias.constant"] = 0.5
        job = bins[bins["at"] == "job_bias"]
        best = job.assign(at="best_bias", bias=0.25, false_shadow=0)
        tables_ = [pandas.concat([job, best], ignore_index=True), results]
        for curve in shadow_errors_on_depth_error.data(tables_):
            self.assertEqual((curve["at"], curve["bias"]), ("best_bias", 0.25))
        figure = shadow_errors_on_depth_error.draw(tables_)
        caption = " ".join(text.get_text() for text in figure.texts).replace("\n", " ")
        self.assertIn("best bias 0.25 depth units", caption)
        self.assertNotIn("job's bias", caption)

    def test_refuses_results_of_another_run(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "results.csv"
            lines = path("two-distances/results").read_text().splitlines(keepends=True)
            other.write_text("".join(lines[:-1]))
            with self.assertRaisesRegex(tables.InputError, "from another run"):
                shadow_errors_on_depth_error.read([path("two-distances/error_vs_z"), other])


if __name__ == "__main__":
    unittest.main()
