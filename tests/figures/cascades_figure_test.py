"""The figure of cascades as numbers: widths of texels and errors by view depth.

The stored files are of `gnomon compare examples/cascades_columns.toml --view-depths --view-depth-bands 8` at
160 x 90 pixels: four maps of 256 texels, the same with mixed verdicts and with another choice, and one map of 512.
"""

import json
import tempfile
import unittest
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from numpy.testing import assert_array_equal

import figure_inputs
from figure_inputs import legend_labels

import cascades  # noqa: E402  found by figure_inputs
import gnomon  # noqa: E402


def path(name):
    return figure_inputs.path(f"cascades/{name}")


def column(name, key):
    return figure_inputs.column(f"cascades/{name}", key)


def slices(name, key):
    return json.loads(figure_inputs.rows_of(f"cascades/{name}")[0][key])


def stairs(axes):
    """The drawn steps by label."""
    return {label: handle.get_data() for label, handle in figure_inputs.by_label(axes).items()}


class Cascades(unittest.TestCase):
    def setUp(self):
        self.tables = cascades.read([path("tight"), path("one_map")])
        self.figure = cascades.draw(self.tables)
        self.widths, self.rates = self.figure.axes

    def test_draws_the_texels_of_each_slice_between_its_ends(self):
        drawn = stairs(self.widths)
        self.assertEqual(list(drawn), ["4 cascades of 256²", "one map of 512²"])
        texels_m, edges_m, _ = drawn["4 cascades of 256²"]
        assert_array_equal(texels_m, slices("tight", "slice_texels_m"))
        assert_array_equal(edges_m, slices("tight", "slice_edges_m"))
        texels_m, edges_m, _ = drawn["one map of 512²"]
        assert_array_equal(texels_m, column("one_map", "texel_m.median"))
        assert_array_equal(edges_m[:-1], column("one_map", "lower_m"))

    def test_draws_both_rates_of_both_layouts_in_percent(self):
        drawn = stairs(self.rates)
        self.assertEqual(len(drawn), 4)
        for name, layout in (("tight", "4 cascades of 256²"), ("one_map", "one map of 512²")):
            for key, word in (("false_shadow_rate", "false shadow"), ("false_lit_rate", "false lit")):
                rates, edges_m, _ = drawn[f"{layout}: {word}"]
                assert_array_equal(rates, 100 * column(name, key))
                assert_array_equal(edges_m[:-1], column(name, "lower_m"))
                self.assertEqual(edges_m[-1], column(name, "upper_m")[-1])

    def test_marks_and_names_the_slices(self):
        edges_m = slices("tight", "slice_edges_m")
        for axes in (self.widths, self.rates):
            marked = [line.get_xdata()[0] for line in axes.get_lines()]
            self.assertEqual(marked, edges_m)
        texts = [text.get_text() for text in self.widths.texts]
        # The last slice ends beyond the farthest pixel.
        self.assertGreater(edges_m[-1], self.widths.get_xlim()[1])
        self.assertEqual(texts, ["slice 0", "1", "2", "3", *(f"{edge_m:.3g} m" for edge_m in edges_m[1:-1])])

    def test_axes(self):
        self.assertEqual(self.widths.get_ylabel(), "texel width [m]")
        self.assertEqual(self.rates.get_ylabel(), "wrong pixels [%]")
        self.assertEqual(self.rates.get_xlabel(), "view depth, from the eye along the camera's axis [m]")
        for axes in self.figure.axes:
            self.assertEqual(axes.get_xscale(), "log")
            self.assertEqual(axes.get_xlim(), (column("tight", "lower_m")[0], column("tight", "upper_m")[-1]))
        for text in ("columns, 160 × 90 px", "practical (λ = 0.5) split, tight fit, maps chosen by view depth"):
            self.assertIn(text, self.tables.settings)
        self.assertNotIn("map 256", self.tables.settings)  # the legend says it of each

    def test_names_colours_and_lines_in_its_legend(self):
        (legend,) = self.figure.legends
        self.assertEqual(legend_labels(legend),
                         ["texel width", "false shadow", "false lit", "4 cascades of 256²", "one map of 512²"])

    def test_has_room_for_its_texts(self):
        FigureCanvasAgg(self.figure).draw()
        for axes in self.figure.axes:
            self.assertGreaterEqual(axes.yaxis.label.get_window_extent().x0, 0)
        self.assertGreaterEqual(self.figure.legends[0].get_window_extent().x0, 0)

    def test_draws_cascades_alone(self):
        figure = cascades.draw(cascades.read([path("tight")]))
        self.assertEqual([len(stairs(axes)) for axes in figure.axes], [1, 2])

    def test_draws_amounts_where_verdicts_are_mixed(self):
        _, rates = cascades.draw(cascades.read([path("mixed"), path("one_map")])).axes
        self.assertEqual(rates.get_ylabel(), "amounts that are wrong [%]")
        drawn = stairs(rates)["4 cascades of 256²: false shadow"][0]
        assert_array_equal(drawn, 100 * column("mixed", "shadow_amount_rate"))

    def test_draws_the_texels_that_are_read_where_a_slice_reads_several_maps(self):
        widths, _ = cascades.draw(cascades.read([path("containing")])).axes
        median_m, edges_m, _ = stairs(widths)["4 cascades of 256²"]
        assert_array_equal(median_m, column("containing", "texel_m.median"))
        assert_array_equal(edges_m[:-1], column("containing", "lower_m"))

    def test_refuses_other_tables(self):
        for names, reason in (
            (("one_map",), "0 tables of cascades and 1 of one map"),
            (("tight", "mixed"), "2 tables of cascades and 0 of one map"),
        ):
            with self.assertRaisesRegex(gnomon.InputError, reason):
                cascades.read([path(name) for name in names])
        with self.assertRaisesRegex(gnomon.InputError, "no column lower_m|no column shadow_map.layout"):
            cascades.read([figure_inputs.path("lessons/acne")])

    def test_refuses_other_view_depths_and_another_light(self):
        header, first, *rows = path("one_map").read_text().splitlines(keepends=True)
        self.assertIn(",1938,812,", first)
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "other.csv"
            for text in ((header, first, *rows[:-1]), (header, first.replace(",1938,", ",1939,"), *rows)):
                other.write_text("".join(text))
                with self.assertRaisesRegex(gnomon.InputError, "other.csv: other view depths or other truth"):
                    cascades.read([path("tight"), other])

    def test_refuses_slices_that_are_no_list(self):
        with tempfile.TemporaryDirectory() as folder:
            torn = Path(folder) / "torn.csv"
            torn.write_text(path("tight").read_text().replace('"[', '"(['))
            with self.assertRaisesRegex(gnomon.InputError, "torn.csv: slice_edges_m is not a list of numbers"):
                cascades.read([torn])


if __name__ == "__main__":
    unittest.main()
