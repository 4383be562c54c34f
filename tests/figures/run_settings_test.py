"""The axes of a run's table, and the texts of values."""

import unittest

import numpy
import pandas
from numpy.testing import assert_array_equal

import figure_inputs  # noqa: F401  finds the module below
import run_settings  # noqa: E402


class TextOfAValue(unittest.TestCase):
    def test_is_short_and_keeps_whole_numbers(self):
        for value, text in ((16384, "16384"), (2048.0, "2048"), (0, "0"), (-0.0, "0"), (0.1, "0.1"),
                            (4e-6, "4e-6"), (1.23456e-5, "1.235e-5"), (2e9, "2e9"), (True, "true"),
                            (None, "auto"), (float("nan"), "auto"), (float("inf"), "inf"),
                            ("pcf3", "pcf3"), ("a\tb\u202e", "a\ufffdb\ufffd"),
                            (50 * "x", 27 * "x" + "…")):
            self.assertEqual(run_settings.text_of(value), text)


class Axes(unittest.TestCase):
    def axes(self, **columns):
        class Run:
            light_keys = []
            job_keys = list(columns)
        table = pandas.DataFrame({"case": [None] * len(next(iter(columns.values()))), **columns})
        return run_settings.axes_of(Run, table)

    def test_name_the_light_that_an_axis_is_of(self):
        for key, name in (("light", "light"),
                          ("lights.sun.shadow_map.resolution", "sun: map resolution [texels]"),
                          ("lights.sun.position", "sun: light position [m]"),
                          ("lights.sun.cone_deg", "sun: cone [°]")):
            self.assertEqual(run_settings.name_of(key), name)

    def test_leave_out_what_follows_from_another(self):
        (axis,) = self.axes(near=[1, 2, 1, 2], far=[10, 20, 10, 20], same=[3, 3, 3, 3])
        self.assertEqual((axis.key, axis.values), ("near", [1, 2]))
        self.assertEqual([axis.key for axis in self.axes(near=[1, 2, 1], far=[10, 20, 30])],
                         ["near", "far"])

    def test_tell_numbers_from_texts(self):
        texts, mixed = self.axes(filter=["b", "a", "b", "a"], near=["auto", "auto", "1", "2"])
        self.assertEqual((texts.values, texts.is_numeric), (["b", "a"], False))
        self.assertEqual((mixed.values, mixed.is_numeric), (["auto", "1", "2"], False))

    def test_spread_values_by_their_range(self):
        for values, scale in (([1, 2, 3], "linear"), ([256, 512, 1024], "log"), ([0, 1], "linear"),
                              ([1, 5, 100], "log"), ([0, 1, 100], "symlog")):
            (axis,) = self.axes(key=values)
            self.assertEqual(axis.scale["value"], scale, values)

    def test_unite_many_values_into_classes_of_equal_numbers(self):
        values = numpy.random.default_rng(1).permutation(10000) / 7
        (axis,) = self.axes(key=values)
        self.assertEqual(len(axis.values), 100)
        self.assertEqual(set(numpy.bincount(axis.codes)), {100})
        # Each class holds its own median.
        order = numpy.argsort(values)
        assert_array_equal(axis.values, numpy.median(values[order].reshape(100, 100), axis=1))


if __name__ == "__main__":
    unittest.main()
