"""The figures of the lessons as numbers: pixels of an image, a depth map, sweeps of wall and of resolutions.

The stored files are crops and rows of what examples/figures/lessons.sh measures.
"""

import importlib.util
import math
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from numpy.testing import assert_allclose, assert_array_equal

import figure_inputs
from figure_inputs import by_label, legend_labels, numbers

import acne  # noqa: E402  found by figure_inputs
import depth_map  # noqa: E402
import gnomon  # noqa: E402
import map_resolution  # noqa: E402
import pcf_edge  # noqa: E402
import peter_panning  # noqa: E402


def path(name):
    return figure_inputs.path(f"lessons/{name}")


def rows_of(name, **where):
    return figure_inputs.rows_of(f"lessons/{name}", **where)


class Acne(unittest.TestCase):
    def setUp(self):
        self.tables = acne.read([path("acne")])
        self.figure = acne.draw(self.tables)

    def test_shows_each_pixel_as_its_critical_bias_says(self):
        rows = rows_of("acne")
        self.assertEqual(self.tables.panels[0][0], 0)
        self.assertGreater(self.tables.panels[0][2], 0.3)
        for (bias, _, _, _), axes in zip(self.tables.panels, self.figure.axes):
            shown = axes.images[0].get_array().ravel()
            for row, code in zip(rows, shown):
                lit = float(row["critical_bias"] or "nan") <= bias
                expected = {"5": "lit" if lit else "false shadow",
                            "6": "false lit" if lit else "in shadow"}.get(row["class"], "not scored")
                self.assertEqual(acne.LOOKS[code][0], expected, row)

    def test_biases_grow_and_acne_fades(self):
        biases = [panel[0] for panel in self.tables.panels]
        rates = [panel[2] for panel in self.tables.panels]
        self.assertEqual(biases, sorted(biases))
        self.assertEqual(rates, sorted(rates, reverse=True))
        for (bias, codes, rate, _), axes in zip(self.tables.panels, self.figure.axes):
            scored = (codes == acne.LIT) | (codes == acne.FALSE_SHADOW)
            self.assertEqual(rate, (codes == acne.FALSE_SHADOW).sum() / scored.sum())
            self.assertIn("bias ", axes.get_title())
            self.assertEqual(list(axes.get_xticks()), [])

    def test_names_every_look(self):
        self.assertEqual(legend_labels(self.figure.legends[0]),
                         ["not scored", "lit", "in shadow", "false shadow", "false lit"])

    def test_refuses_pixels_that_are_no_rectangle(self):
        lines = path("acne").read_text().splitlines(keepends=True)
        with tempfile.TemporaryDirectory() as folder:
            torn = Path(folder) / "torn.csv"
            for text in (lines[:-1], [*lines, lines[-1]], [*lines[:-1], lines[1]]):
                torn.write_text("".join(text))
                with self.assertRaisesRegex(gnomon.InputError, "do not form a rectangle"):
                    acne.read([torn])


class PcfEdge(unittest.TestCase):
    names = ("nearest", "pcf3", "pcf9")

    def setUp(self):
        self.tables = pcf_edge.read([path(name) for name in self.names])
        (self.axes,) = pcf_edge.draw(self.tables).axes

    def test_draws_verdicts_over_texels_from_the_true_edge(self):
        # 8 m of map in 64 texels, under a light at 45 degrees.
        texel_m = 8 / 64 * math.sqrt(2)
        self.assertAlmostEqual(self.tables.texel_m, texel_m, delta=1e-12)
        drawn = by_label(self.axes)
        for name, label in zip(self.names, ("1 tap", "3 × 3 taps", "9 × 9 taps")):
            rows = [row for row in rows_of(name) if row["class"] in ("5", "6")]
            distance, light = drawn[label].get_data()
            assert_array_equal(light, 100 * numbers(rows, "verdict"))
            place = numbers(rows, "P.X")
            assert_allclose(distance[1:] - distance[:-1], numpy.diff(place) / texel_m, rtol=1e-9,
                            atol=1e-12)
            # The edge is between the last blocked pixel and the first lit one.
            is_lit = numpy.array([row["class"] == "5" for row in rows])
            self.assertEqual(distance[is_lit].min(), -distance[~is_lit].max())

    def test_k_taps_have_k_steps(self):
        for name, taps in zip(self.names, (1, 3, 9)):
            levels = {round(taps * verdict) for verdict in self.tables.profiles[name][1]}
            self.assertEqual(levels, set(range(taps + 1)))

    def test_axes(self):
        self.assertEqual(self.axes.get_xlabel(), "distance from the true edge [texels on the ground]")
        self.assertEqual(self.axes.get_ylabel(), "light shown [%]")
        self.assertEqual(self.axes.get_ylim(), (-3, 103))

    def test_refuses_other_pixels(self):
        with self.assertRaisesRegex(gnomon.InputError, "acne.csv: no column lookup.filter|P.X"):
            pcf_edge.read([path("acne")])


class PeterPanning(unittest.TestCase):
    def setUp(self):
        self.tables = peter_panning.read([path("wall")])
        (self.axes,) = peter_panning.draw(self.tables).axes

    def test_marks_are_counts_and_lines_the_formula(self):
        lines = self.axes.get_lines()
        for index, angle in enumerate(("30", "60")):
            rows = rows_of("wall", **{"scene.wall.light_angle_deg": angle})
            formula, marks = lines[2 * index], lines[2 * index + 1]
            largest = numbers(rows, "bias.constant_m").max()
            assert_array_equal(formula.get_xdata(), [0, largest])
            assert_allclose(formula.get_ydata(), [0, largest * math.sin(math.radians(float(angle)))])
            bias, width = marks.get_data()
            assert_array_equal(bias, numbers(rows, "bias.constant_m"))
            # 2 m of view are 400 pixels high, and 400 rows cross the strip.
            assert_allclose(width, numbers(rows, "labels.peter_panning") / 400 * 2 / 400)

    def test_strip_is_as_wide_as_the_formula_to_a_pixel(self):
        for angle_rad, bias_m, width_m, pixel_m in self.tables.series:
            # Pixels are counted by their centres.
            assert_allclose(width_m, bias_m * math.sin(angle_rad), rtol=0, atol=pixel_m)

    def test_axes(self):
        self.assertEqual(self.axes.get_xlabel(), "constant bias b along the light's axis [m]")
        self.assertEqual(self.axes.get_ylabel(), "width of the strip [m]")
        self.assertEqual([text.get_text() for text in self.axes.texts], ["θ = 30°", "θ = 60°"])

    def test_refuses_another_scene(self):
        with self.assertRaisesRegex(gnomon.InputError, "no sweep of the built-in wall"):
            peter_panning.read([path("resolution")])


class MapResolution(unittest.TestCase):
    def test_draws_edge_errors_by_filter(self):
        (axes,) = map_resolution.draw(map_resolution.read([path("resolution")])).axes
        drawn = by_label(axes)
        self.assertEqual(list(drawn), ["nearest", "pcf3", "pcf5", "∝ 1 / resolution"])
        for name in ("nearest", "pcf3", "pcf5"):
            rows = rows_of("resolution", **{"lookup.filter": name})
            texels, percent = drawn[name].get_data()
            assert_array_equal(texels, numbers(rows, "shadow_map.resolution"))
            scored = numbers(rows, "pixels.lit") + numbers(rows, "pixels.blocked")
            assert_array_equal(percent, 100 * numbers(rows, "labels.edge") / scored)
        self.assertEqual((axes.get_xscale(), axes.get_yscale()), ("log", "log"))
        self.assertEqual([label.get_text() for label in axes.get_xticklabels()],
                         ["128", "256", "512", "1024", "2048", "4096"])
        self.assertEqual(axes.get_xlabel(), "map resolution [texels]")
        self.assertEqual(axes.get_ylabel(), "wrong at edges [% of scored pixels]")

    def test_has_room_for_its_label_and_a_place_for_no_error(self):
        tables = map_resolution.read([path("resolution")])
        texels, percent = tables.series["nearest"]
        for scale in (1, 1e-4):
            series = {"nearest": (texels, numpy.append(scale * percent[:-1], 0))}
            figure = map_resolution.draw(map_resolution.Tables("", series))
            (axes,) = figure.axes
            self.assertEqual(axes.get_yscale(), "symlog")
            self.assertEqual(axes.get_ylim()[0], 0)
            FigureCanvasAgg(figure).draw()
            self.assertGreaterEqual(axes.yaxis.label.get_window_extent().x0, 0)

    def test_draws_every_filter(self):
        texels = numpy.array([1000.0, 2000.0])
        series = {f"filter{index}": (texels, numpy.array([2.0, 1.0])) for index in range(7)}
        (axes,) = map_resolution.draw(map_resolution.Tables("", series)).axes
        self.assertEqual(len(by_label(axes)), 8)
        self.assertEqual(list(axes.get_xticks()), list(texels))  # one power of two is no scale

    def test_refuses_one_resolution(self):
        with self.assertRaisesRegex(gnomon.InputError, "one resolution"):
            map_resolution.read([path("wall")])


class DepthMap(unittest.TestCase):
    def test_draws_distances_from_near_to_far(self):
        axes, bar = depth_map.draw(depth_map.read([path("depth_map")])).axes
        image = axes.images[0]
        expected = numbers(rows_of("depth_map"), "light_distance_m").reshape(8, 6)
        self.assertTrue(0 < numpy.isnan(expected).sum() < expected.size)
        assert_array_equal(image.get_array().filled(math.nan), expected)
        self.assertEqual(image.get_clim(), (0.5, 10))
        self.assertEqual(bar.get_ylabel(), "distance ζ from the light's plane [m]")
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("x [texels]", "y [texels]"))

    @unittest.skipUnless(importlib.util.find_spec("OpenImageIO"), "needs python3-openimageio")
    def test_draws_the_image_of_a_comparison(self):
        with tempfile.TemporaryDirectory() as folder:
            exr = Path(folder) / "map.exr"
            gnomon.call("compare", "--builtin", "sphere-plane", "--set", "image.width=16", "--set",
                        "image.height=9", "--set", "shadow_map.resolution=32", "--depth-map", exr)
            tables = depth_map.read([exr])
            crop = Path(folder) / "map.csv"
            layers = gnomon.load_depth_map(exr)
            layers.crop(["light_distance_m"], keys=["scene.builtin", "light.type", *(
                f"shadow_map.{key}" for key in ("resolution", "depth_format", "near", "far"))]
            ).to_csv(crop, index=False)
            expected = depth_map.read([crop])
        self.assertEqual(tables.distance_m.shape, (32, 32))
        assert_array_equal(tables.distance_m, expected.distance_m)
        self.assertEqual(tables.range_m, expected.range_m)
        self.assertEqual(tables.settings, expected.settings)

    @unittest.skipUnless(importlib.util.find_spec("OpenImageIO"), "needs python3-openimageio")
    def test_draws_the_first_of_several_maps(self):
        with tempfile.TemporaryDirectory() as folder:
            exr = Path(folder) / "maps.exr"
            gnomon.call("compare", "--builtin", "yard", "--set", "image.width=16", "--set",
                        "image.height=9", "--set", "shadow_map.resolution=32", "--set",
                        "shadow_map.layout=cascades", "--depth-map", exr)
            tables = depth_map.read([exr])
        self.assertTrue(tables.settings.endswith("; the first of several maps"), tables.settings)
        drawn = tables.distance_m[~numpy.isnan(tables.distance_m)]
        self.assertEqual(tables.range_m, (drawn.min(), drawn.max()))

    @unittest.skipUnless(importlib.util.find_spec("OpenImageIO"), "needs python3-openimageio")
    def test_refuses_a_missing_file(self):
        with self.assertRaisesRegex(gnomon.InputError, "nowhere.exr: no such file"):
            depth_map.read([Path("nowhere.exr")])

    def test_names_the_package_that_reads_images(self):
        with unittest.mock.patch.dict(sys.modules, {"OpenImageIO": None}):
            with self.assertRaisesRegex(gnomon.MissingPackage, "^map.exr: .*python3-openimageio"):
                depth_map.read([Path("map.exr")])


if __name__ == "__main__":
    unittest.main()
