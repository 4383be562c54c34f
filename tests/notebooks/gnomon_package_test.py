"""The notebooks' package agrees with the program: tables, layers, other biases, bad input."""

import csv
import json
import os
import random
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "notebooks"))

import gnomon  # noqa: E402

JOB = ("--builtin", "sphere-plane", "--set", "image.width=96", "--set", "image.height=64",
       "--set", "shadow_map.resolution=128")


def setUpModule():
    global folder, run, layers, answer
    folder = Path(tempfile.mkdtemp())
    unittest.addModuleCleanup(shutil.rmtree, folder)
    gnomon.call("compare", *JOB, "--out", folder / "view", "--depth-map", folder / "map.exr")
    run = gnomon.load_run(folder / "view")
    layers = run.layers_of(run.results.iloc[0])
    answer = compare()


def compare(*more):
    """The result of `compare --json`."""
    return json.loads(gnomon.call("compare", *JOB, *more, "--json"))


class Tables(unittest.TestCase):
    def test_hold_the_numbers_of_the_json_bit_by_bit(self):
        row = run.results.iloc[0]
        for name in ("false_shadow", "false_lit", "false_shadow_rate", "error_rate"):
            self.assertEqual(row[name], answer[name], name)
        for name, count in answer["labels"].items():
            self.assertEqual(row[f"labels.{name}"], count, name)
        self.assertEqual(row["bias_curve.acne_free"], answer["bias_curve"]["acne_free"])

    def test_keep_ids_as_texts_and_missing_texts_as_none(self):
        row = run.results.iloc[0]
        with open(folder / "view" / "results.csv", newline="") as file:
            (stored,) = csv.DictReader(file)
        self.assertEqual(row["id"], stored["id"])
        self.assertEqual(row["curve"], stored["curve"])
        self.assertIsNone(row["message"])

    def test_name_the_axes(self):
        gnomon.call("sweep", "--builtin", "wall", "--set", "image.width=32", "--set",
                    "image.height=24", "--axis", "bias.constant=0,0.001", "--axis",
                    "shadow_map.resolution=64,128", "--out", folder / "axes", "--quiet")
        axes = gnomon.load_run(folder / "axes").axes
        self.assertEqual(axes, ["shadow_map.resolution", "bias.constant"])
        self.assertEqual(run.axes, [])


class ImageLayers(unittest.TestCase):
    def test_have_their_shapes_and_types(self):
        self.assertEqual(layers["verdict"].shape, (64, 96))
        self.assertEqual(layers["verdict"].dtype, numpy.float32)
        self.assertEqual(layers["prim"].dtype, numpy.uint32)
        self.assertEqual(layers["P"].shape, (64, 96, 3))
        self.assertEqual(layers.job["shadow_map.resolution"], 128)
        self.assertEqual(layers.attributes["scene"], "sphere-plane")

    def test_count_as_the_json_does(self):
        for value, name in enumerate(gnomon.CLASSES):
            count = numpy.count_nonzero(layers["class"] == value)
            self.assertEqual(count, answer["pixels"][name], name)
        for names, layer, key in ((gnomon.LABELS, "label", "labels"),
                                  (gnomon.CAUSES, "cause", "causes")):
            for value, name in list(enumerate(names))[1:]:
                count = numpy.count_nonzero(layers[layer] == value)
                self.assertEqual(count, answer[key][name], name)

    def test_have_their_first_row_at_the_top(self):
        # The camera looks down at the scene: the background is above it.
        background = layers["class"] == gnomon.CLASSES.index("background")
        self.assertGreater(background[0].sum(), background[-1].sum())

    def test_say_what_gl_shows_with_any_bias(self):
        seed = 20261122
        biases = [0.0, *(10 ** random.Random(seed).uniform(-7, -1) for _ in range(8))]
        for bias in biases:
            with self.subTest(bias=bias):
                said = compare("--set", f"bias.constant={bias!r}")
                self.assertEqual(layers.errors(bias),
                                 {name: said[name] for name in ("false_shadow", "false_lit")})

    def test_agree_with_the_curve_at_each_of_its_biases(self):
        curve = run.curve_of(run.results.iloc[0])
        self.assertGreater(len(curve), 100)
        for _, point in curve.iterrows():
            self.assertEqual(layers.errors(point["bias"]),
                             {name: point[name] for name in ("false_shadow", "false_lit")})

    def test_of_hardware_know_every_bias_too(self):
        path = folder / "hardware.exr"
        gnomon.call("compare", *JOB, "--set", "lookup.filter=hardware", "--aov", path)
        hardware = gnomon.load_layers(path)
        for bias in (0.0, 0.001):
            said = compare("--set", "lookup.filter=hardware", "--set", f"bias.constant={bias}")
            self.assertEqual(hardware.errors(bias)["false_lit"], said["false_lit"])

    def test_say_where_nothing_knows_other_biases(self):
        path = folder / "float.exr"
        gnomon.call("compare", *JOB, "--truth", "float", "--aov", path)
        with self.assertRaisesRegex(gnomon.InputError, "no critical_bias"):
            gnomon.load_layers(path).errors(0.001)


class Crops(unittest.TestCase):
    def test_hold_the_pixels_of_their_box_bit_by_bit(self):
        crop = layers.crop(["class", "critical_bias"], (30, 20, 7, 5), ["shadow_map.resolution"])
        self.assertEqual(list(crop), ["x_px", "y_px", "class", "critical_bias",
                                      "shadow_map.resolution"])
        self.assertEqual(len(crop), 35)
        path = folder / "crop.csv"
        crop.to_csv(path, index=False)
        for row in gnomon.read_table(path).itertuples(index=False):
            x, y, pixel_class, critical, resolution = row
            self.assertEqual(pixel_class, layers["class"][y, x])
            # NaN where the pixel is not scored.
            numpy.testing.assert_equal(numpy.float32(critical), layers["critical_bias"][y, x])
            self.assertEqual(resolution, 128)

    def test_are_of_the_whole_image_by_default(self):
        crop = layers.crop(["verdict"])
        numpy.testing.assert_array_equal(crop["verdict"].to_numpy().reshape(64, 96),
                                         layers["verdict"])

    def test_refuse_what_the_image_has_not(self):
        for names, box, keys, message in (
            (["colour"], None, (), "no colour"),
            (["class"], None, ("scene.colour",), "no scene.colour"),
            (["class"], (90, 0, 7, 1), (), "96 x 64 pixels"),
            (["class"], (-1, 0, 7, 1), (), "96 x 64 pixels"),
            (["class"], (0, 0, 0, 1), (), "96 x 64 pixels"),
        ):
            with self.subTest(message=message), self.assertRaisesRegex(gnomon.InputError, message):
                layers.crop(names, box, keys)


class DepthMap(unittest.TestCase):
    def test_has_what_lookups_read(self):
        depth_map = gnomon.load_depth_map(folder / "map.exr")
        self.assertEqual(depth_map["depth"].shape, (128, 128))
        stored = layers["map_depth"][layers.is_lit | layers.is_blocked]
        self.assertTrue(numpy.isin(stored[~numpy.isnan(stored)], depth_map["depth"]).all())
        distance = depth_map["light_distance_m"]
        numpy.testing.assert_array_equal(numpy.isnan(distance), depth_map["depth"] == 1)
        near, far = (depth_map.job[f"shadow_map.{end}"] for end in ("near", "far"))
        self.assertTrue(near <= numpy.nanmin(distance) <= numpy.nanmax(distance) <= far)

    def test_is_no_image_of_pixels(self):
        with self.assertRaisesRegex(gnomon.InputError, "was not written by gnomon compare"):
            gnomon.load_layers(folder / "map.exr")


class BadInput(unittest.TestCase):
    def refuse(self, load, path, message):
        with self.assertRaises(gnomon.InputError) as caught:
            load(path)
        self.assertIn(message, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def altered_run(self, alter):
        copy = Path(tempfile.mkdtemp(dir=folder))
        for name in ("results.csv", "error_vs_z.csv", "bias_curves.csv"):
            text = (folder / "view" / name).read_text()
            (copy / name).write_text(alter(text) if name == "results.csv" else text)
        return copy

    def test_in_runs_is_one_line(self):
        self.refuse(gnomon.load_run, folder / "absent", "results.csv: no such file")
        self.refuse(gnomon.load_run, self.altered_run(lambda text: ""), "cannot be read as CSV")
        self.refuse(gnomon.load_run, self.altered_run(lambda text: text.replace("schema,", "s,", 1)),
                    "no column schema")
        self.refuse(gnomon.load_run, self.altered_run(lambda text: text.replace("\n2,", "\n9,", 1)),
                    "schema 9, this package reads 1 and 2")

    def test_rows_of_all_lights_together_stand_apart(self):
        def with_lights(text):
            header, row = text.splitlines()[:2]
            at = header.split(",").index("case") + 1
            lines = []
            for cell in ("light", "", "sun", "lamp"):
                cells = (header if cell == "light" else row).split(",")
                lines.append(",".join([*cells[:at], cell, *cells[at:]]))
            return "\n".join(lines) + "\n"

        run = gnomon.load_run(self.altered_run(with_lights))
        self.assertEqual(list(run.results["light"]), ["sun", "lamp"])
        self.assertEqual(len(run.totals), 1)
        self.assertIsNone(run.totals["light"].iloc[0])
        self.assertEqual(run.axes, ["light"])
        self.assertEqual(len(gnomon.load_run(folder / "view").totals), 0)

    def test_in_images_is_one_line(self):
        (image,) = (folder / "view" / "pixels").glob("*.exr")
        whole = image.read_bytes()
        for name, content, message in (("absent", None, "no such file"),
                                       ("text", b"not an image", "cannot be read"),
                                       ("cut", whole[: len(whole) // 2], "read")):
            path = folder / f"{name}.exr"
            if content is not None:
                path.write_bytes(content)
            with self.subTest(name=name):
                self.refuse(gnomon.load_layers, path, message)

    def test_of_a_run_without_pixels_says_how_to_keep_them(self):
        bare = gnomon.load_run(self.altered_run(lambda text: text))
        self.refuse(bare.layers_of, bare.results.iloc[0], "--keep-pixels")

    def test_of_the_program_is_its_own_line(self):
        with self.assertRaisesRegex(gnomon.InputError, "gnomon compare: exit 2: .*no-such-scene"):
            gnomon.call("compare", "--builtin", "no-such-scene")

    def test_says_that_the_program_is_missing(self):
        with mock.patch.dict(os.environ, GNOMON=str(folder / "absent")):
            with self.assertRaisesRegex(gnomon.InputError, "absent: No such file.*dev build"):
                gnomon.call("doctor")


if __name__ == "__main__":
    unittest.main()
