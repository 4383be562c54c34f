"""Comparisons and their advice."""

import html
import json
import os
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

import gnomon
import numpy as np
from gnomon.keys import pairs
from support import IS_FULL, PROGRAM, SMALL, SUN, module_says, plate, program_says, without_times


class CompareTest(unittest.TestCase):
    def test_says_what_the_program_says(self):
        scenes = gnomon.builtins() if IS_FULL else ["columns", "lamp-room"]
        methods = ["depth", "pcss", "vsm", "evsm"] if IS_FULL else ["depth", "vsm"]
        for scene in scenes:
            for method in methods:
                keys = {**SMALL, "method": {"name": method}}
                with self.subTest(scene=scene, method=method):
                    self.assertEqual(module_says(scene, keys), program_says(scene, keys))

    def test_layers_are_the_memory_of_the_result(self):
        result = gnomon.compare("wall", **SMALL)
        for name, layer in result.layers.items():
            self.assertEqual(layer.shape[:2], (54, 96), name)
            self.assertFalse(layer.flags.writeable, name)
            self.assertFalse(layer.flags.owndata, name)
            self.assertTrue(np.shares_memory(layer, result.layers[name]), name)
        verdict = result.verdict
        del result
        self.assertEqual(verdict.shape, (54, 96))

    def test_layers_and_metrics_and_curve_agree(self):
        result = gnomon.compare("columns", bias={"constant": 0.001}, **SMALL)
        lit = result["class"] == gnomon.CLASSES.index("lit")
        blocked = result["class"] == gnomon.CLASSES.index("blocked")
        self.assertEqual((lit & (result.verdict == 0)).sum(), result.metrics["false_shadow"])
        self.assertEqual((blocked & (result.verdict == 1)).sum(), result.metrics["false_lit"])
        self.assertEqual(result.curve.false_shadow(0.001), result.metrics["false_shadow"])
        self.assertEqual(result.curve.false_lit(0.001), result.metrics["false_lit"])
        self.assertTrue((result.truth[lit] == 1).all() and (result.truth[blocked] == 0).all())
        self.assertEqual(result.picture().shape[2], 3)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            result.save_picture(path)
            with self.assertRaisesRegex(gnomon.InputError, "must end with .png"):
                result.save_picture(path + ".jpg")
            self.assertTrue(Path(path).read_bytes().startswith(b"\x89PNG"))
        self.assertIn(result.findings[0], repr(result))
        self.assertIn("data:image/png;base64,iVBOR", result._repr_html_())
        self.assertIn(html.escape(result.findings[0]), result._repr_html_())

    def test_takes_a_scene_in_memory_as_it_takes_its_file(self):
        scene = plate()
        keys = {"light": SUN, "camera": {"eye": [0, 6, 8], "target": [0, 0, 0]}, **SMALL}
        in_memory = gnomon.compare(scene, **keys)
        folder = os.environ.get("TMPDIR", "/tmp")
        path = os.path.join(folder, f"gnomon_plate_{os.getpid()}.obj")
        with open(path, "w") as file:
            for name, first, count, _, _ in scene.objects:
                file.write(f"o {name}\n")
                for corner in scene.vertices[scene.triangles[first : first + count]].reshape(-1, 3):
                    file.write("v {} {} {}\n".format(*corner))
                for triangle in range(first, first + count):
                    file.write("f {} {} {}\n".format(*range(3 * triangle + 1, 3 * triangle + 4)))
        try:
            of_file = gnomon.compare(path, **keys)
        finally:
            os.remove(path)
        self.assertEqual(in_memory.metrics, of_file.metrics)
        self.assertGreater(in_memory.metrics["false_shadow"], 0)

    def test_takes_a_loaded_scene_and_a_dict(self):
        scene = gnomon.builtin("wall", thickness_m=0.5)
        of_scene = gnomon.compare(scene, **SMALL)
        of_dict = gnomon.compare({"scene": {"builtin": "wall", "wall": {"thickness_m": 0.5}}, **SMALL})
        self.assertEqual(of_scene.metrics, of_dict.metrics)
        self.assertEqual(of_scene.to_dict()["scene"]["hash"], scene.content_hash)

    def test_two_threads_find_what_each_finds_alone(self):
        jobs = [("wall", {}), ("columns", {"bias.constant": 0.002})] * 2
        alone = [gnomon.compare(job, **{**SMALL, **keys}).metrics for job, keys in jobs[:2]]
        found = [None] * len(jobs)

        def work(number):
            job, keys = jobs[number]
            found[number] = gnomon.compare(job, **{**SMALL, **keys}).metrics

        threads = [threading.Thread(target=work, args=(number,)) for number in range(len(jobs))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, alone * 2)


class SettingsTest(unittest.TestCase):
    def test_are_the_program_s(self):
        job = {**SMALL, "bias": {"constant_m": 0.1}}
        program = program_says("yard", job, "settings", "--engine", "bevy", "--own")[0]
        self.assertEqual(gnomon.settings("yard", "bevy", recommended=False, **job), program)
        depth_bias = next(each for each in program["settings"] if each["key"] == "bias.constant_m")
        self.assertAlmostEqual(depth_bias["value"], 0.1, delta=0.1 * 2**-24)  # biases are float32

    def test_refuse_unknown_engines(self):
        with self.assertRaisesRegex(gnomon.InputError, "engine thre: unknown engine; the nearest is three"):
            gnomon.settings("yard", "thre", **SMALL)


class AdviceTest(unittest.TestCase):
    def test_is_the_program_s(self):
        job = {"bias": {"constant": 0}, **SMALL}
        settings = [word for name, value in pairs(job) for word in ("--set", f"{name}={value}")]
        command = [PROGRAM, "compare", "--builtin", "columns", "--advise", "--views", "1", "--json", *settings]
        said = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
        found = gnomon.compare("columns", advise=True, views=1, **job)
        self.assertEqual(without_times(found.to_dict()), without_times(said))
        self.assertEqual(len(found.to_dict()["views"]), 2)
        self.assertIn(html.escape(found.remedies[0]["toml"]), found._repr_html_())

    def test_takes_other_methods(self):
        found = gnomon.compare("columns", advise=True, methods=["pcss"], **SMALL)
        self.assertIn("pcss", json.dumps([each["keys"] for each in found.remedies]))

    def test_refuses_what_is_nothing_to_advise_from(self):
        for call, words in [
            (lambda: gnomon.compare("wall", views=2), "advise=True"),
            (lambda: gnomon.compare("wall", advise=True, views={"camera": 2}), "unknown 'camera'"),
            (lambda: gnomon.compare("wall", advise=True, views=65), r"views\['cameras'\] = 65"),
            (lambda: gnomon.compare("wall", advise=True, views={"all_cases": True}), r"no \[\[case\]\]"),
            (lambda: gnomon.compare("wall", advise=True, methods="vsmm"), "did you mean vsm"),
            (lambda: gnomon.compare("wall", advise=True, max_bytes=9), "give methods as well"),
            (lambda: gnomon.compare("wall", advise=True, method={"name": "shadow_volumes"}), "no map and no bias"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))


if IS_FULL:  # takes half a minute

    class MemoryTest(unittest.TestCase):
        def test_a_hundred_comparisons_leave_no_memory_behind(self):
            def resident():
                with open("/proc/self/statm") as file:
                    return int(file.read().split()[1])

            for _ in range(150):
                gnomon.compare("columns", **SMALL)
            before = resident()
            for _ in range(100):
                gnomon.compare("columns", **SMALL)
            self.assertLess(resident(), 1.01 * before)
