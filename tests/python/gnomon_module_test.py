"""The Python package, as its users call it. Run with the package's folder in PYTHONPATH.

    gnomon_module_test.py PROGRAM [unittest arguments]

GNOMON_FULL_TESTS=1 takes more scenes, methods, calls and repetitions.
"""

import datetime
import html
import inspect
import json
import os
import random
import shlex
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import gnomon
import numpy as np
from gnomon.keys import flat, pairs, toml

PROGRAM = sys.argv.pop(1)
IS_FULL = os.environ.get("GNOMON_FULL_TESTS") == "1"
SMALL = {"image": {"width": 96, "height": 54}, "shadow_map": {"resolution": 256}}
SUN = {"direction": [-0.4, -1, -0.3]}


def program_says(builtin, keys):
    """What the program prints of the same job: the result, or why it refuses."""
    settings = [word for name, value in pairs(keys) for word in ("--set", f"{name}={value}")]
    command = [PROGRAM, "compare", "--builtin", builtin, "--json", *settings]
    done = subprocess.run(command, capture_output=True, text=True)
    return without_times(json.loads(done.stdout)) if done.returncode == 0 else done.stderr


def module_says(builtin, keys):
    try:
        return without_times(gnomon.compare(builtin, **keys).to_dict())
    except gnomon.InputError as error:
        return f"gnomon: {error}\n"


def without_times(result):
    return {key: value for key, value in result.items() if key != "seconds"}


def plate():
    """A ground at y = 0 and a plate at y = 1, x and z from −1 to 1."""
    vertices = [[x, 0, z] for x in (-4, 4) for z in (-4, 4)] + [[x, 1, z] for x in (-1, 1) for z in (-1, 1)]
    triangles = [[0, 1, 3], [0, 3, 2], [4, 5, 7], [4, 7, 6]]
    return gnomon.Scene(np.array(vertices, float), triangles, objects={"ground": 2, "plate": 2})


class SceneTest(unittest.TestCase):
    def test_arrays_become_a_scene_of_float32(self):
        scene = plate()
        self.assertEqual(len(scene), 4)
        self.assertEqual([each.name for each in scene.objects], ["ground", "plate"])
        self.assertEqual(scene.vertices.dtype, np.float32)
        self.assertTrue(np.shares_memory(scene.vertices, scene.vertices))
        with self.assertRaises(ValueError):
            scene.vertices[0, 0] = 1

    def test_arrays_outlive_their_scene(self):
        vertices = plate().vertices
        self.assertEqual(vertices[0].tolist(), [-4, 0, -4])

    def test_any_layout_of_arrays_is_taken(self):
        vertices = np.asfortranarray(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32))
        triangles = np.array([[0, 1, 2, 9]], np.uint8)[:, :3]
        vertices.flags.writeable = False
        self.assertEqual(len(gnomon.Scene(vertices, triangles)), 1)

    def test_a_file_that_has_changed_is_not_taken_for_the_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.obj")
            with open(path, "w") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n")
            scene = gnomon.load(path)
            with open(path, "a") as file:
                file.write("v 1 1 1\nf 1 2 4\n")
            with self.assertRaisesRegex(gnomon.InputError, "changed since it was loaded"):
                gnomon.compare(scene, **SMALL)

    def test_flat_triangles_are_left_out_and_counted(self):
        scene = gnomon.Scene([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 1, 3]])
        self.assertEqual((len(scene), scene.dropped_triangles), (1, 1))
        self.assertEqual(scene.kept_triangles.tolist(), [1])

    def test_a_builtin_takes_its_parameters_and_keys_of_its_scene(self):
        plain = gnomon.builtin("wall")
        self.assertNotEqual(plain.content_hash, gnomon.builtin("wall", thickness_m=0.5).content_hash)
        self.assertEqual(len(gnomon.builtin("sphere-cube", ground=True)), len(gnomon.builtin("sphere-cube")) + 2)
        self.assertIn("columns", gnomon.builtins())


class TruthTest(unittest.TestCase):
    def test_of_a_plate_is_known_by_hand(self):
        points = [[0, 0.5, 0.25], [0, 1.5, 0], [3, 0, 3], [1, 0.5, 0.25], [1, 0.5, 1]]
        truth = gnomon.truth(plate(), points, {"direction": [0, -1, 0]})
        names = [gnomon.CLASSES[code] for code in truth.point_class]
        self.assertEqual(names, ["blocked", "lit", "lit", "indeterminate", "indeterminate"])
        self.assertEqual([gnomon.REASONS[code] for code in truth.reason[3:]], ["silhouette", "vertex"])
        self.assertIn(truth.witness[0], (2, 3))
        self.assertEqual(truth.witness[1:].tolist(), [-1] * 4)
        self.assertEqual(truth.share.tolist(), [[0, 0], [1, 1], [1, 1], [0, 1], [0, 1]])
        self.assertEqual((truth.lit.sum(), truth.blocked.sum(), len(truth)), (2, 1, 5))

    def test_of_degenerate_places_is_as_documented(self):
        copied = gnomon.Scene([[-1, 1, -1], [-1, 1, 1], [1, 1, 1], [1, 1, -1]], [[0, 1, 2], [0, 1, 2], [0, 2, 3]])
        on_copy = gnomon.truth(copied, triangles=[0, 1, 2], barycentrics=[[0.2, 0.2]] * 3, light={"direction": [0, -1, 0]})
        self.assertTrue(on_copy.lit.all(), "its copy lies in its plane")
        on_edge = gnomon.truth(copied, triangles=[0, 2], barycentrics=[[0, 0.5], [0.5, 0]], light={"direction": [0, -1, 0]})
        self.assertTrue(on_edge.lit.all(), "the edge that two share")
        at_light = gnomon.truth(copied, [[0, 1, 0]], {"position": [0, 1, 0]})
        self.assertTrue(at_light.lit[0])
        on_triangle = gnomon.truth(copied, triangles=[0], barycentrics=[[0, 0.5]], light={"position": [0, 1, 0]})
        self.assertEqual(gnomon.CLASSES[on_triangle.point_class[0]], "attached")
        far = gnomon.truth(copied, [[-0.5, -1e15, 0.25], [-0.5, 1e15, 0.25]], {"direction": [0, -1, 0]})
        self.assertEqual((far.blocked[0], far.lit[1]), (True, True))

    def test_of_points_on_triangles_is_never_their_own_shadow(self):
        scene = gnomon.builtin("sphere-plane")
        count = 20_000
        rng = np.random.default_rng(1)
        triangles = rng.integers(0, len(scene), count)
        places = rng.random((count, 2))
        outside = places.sum(1) > 1
        places[outside] = 1 - places[outside]
        on_triangles = gnomon.truth(scene, triangles=triangles, barycentrics=places, light=SUN)
        corners = scene.vertices[scene.triangles[triangles]].astype(float)
        edges = corners[:, 1:] - corners[:, :1]
        points = corners[:, 0] + np.einsum("nk,nkj->nj", places, edges)
        in_space = gnomon.truth(scene, points, SUN)
        own = in_space.blocked & ~on_triangles.blocked & (in_space.witness == triangles)
        self.assertGreater(own.sum(), 100, "rounded below their triangles")
        self.assertFalse((on_triangles.witness == triangles).any())
        projected = gnomon.truth(scene, points, SUN, project="nearest")
        self.assertLess(projected.distance_m.max(), 1e-10)
        # Those within rounding of an edge may go to the neighbour.
        self.assertLess((projected.blocked != on_triangles.blocked).mean(), 1e-3)

    def test_of_lights_of_each_type(self):
        scene = plate()
        point = [[0, 0.5, 0]]
        cases = [
            ({"position": [0, 5, 0]}, "blocked"),
            ({"position": [0, 0.75, 0]}, "lit"),
            ({"position": [0, 0.75, 0], "target": [0, 0, 0], "cone_deg": 20}, "lit"),
            ({"position": [3, 0.75, 0], "target": [3, 0, 0], "cone_deg": 20}, "out_of_light"),
        ]
        for light, name in cases:
            self.assertEqual(gnomon.CLASSES[gnomon.truth(scene, point, light).point_class[0]], name, light)

    def test_of_a_light_in_double_keeps_its_doubles(self):
        # At the plate's height the ray is 1e-12 inside its border, x = 1; with float32(0.1) it is outside.
        scene = plate()
        point = [[1 - 0.1 * 0.5 - 1e-12, 0.5, 0.25]]
        kept = gnomon.truth(scene, point, {"direction": [-0.1, -1, 0]}, light_precision="double")
        rounded = gnomon.truth(scene, point, {"direction": [-0.1, -1, 0]})
        self.assertTrue(kept.blocked[0])
        self.assertTrue(rounded.lit[0])

    def test_is_the_same_in_any_order_and_number(self):
        scene = gnomon.builtin("columns")
        points = np.random.default_rng(2).uniform(-8, 8, (3000, 3))
        whole = gnomon.truth(scene, points, SUN)
        turned = gnomon.truth(scene, points[::-1], SUN, threads=1)
        self.assertTrue((turned.point_class[::-1] == whole.point_class).all())
        some = gnomon.truth(scene, points[1234:1240], SUN)
        self.assertTrue((some.point_class == whole.point_class[1234:1240]).all())
        self.assertEqual(len(gnomon.truth(scene, np.zeros((0, 3)), SUN)), 0)

    def test_of_several_threads_is_that_of_each_alone(self):
        scenes = [gnomon.builtin("columns"), gnomon.builtin("yard")]
        points = np.random.default_rng(3).uniform(-5, 5, (20_000, 3))
        alone = [gnomon.truth(scene, points, SUN).point_class for scene in scenes]
        found = [None] * 6

        def ask(number):
            found[number] = gnomon.truth(scenes[number % 2], points, SUN).point_class

        threads = [threading.Thread(target=ask, args=(number,)) for number in range(len(found))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for number, classes in enumerate(found):
            self.assertTrue((classes == alone[number % 2]).all())


class InterruptionTest(unittest.TestCase):
    def test_ctrl_c_ends_a_long_question(self):
        script = """
import gnomon, numpy as np
scene = gnomon.builtin("sphere-field")
points = np.random.default_rng(1).uniform(-5, 5, (8_000_000, 3))
gnomon.truth(scene, points[:10], {"direction": [0, -1, 0]})
print("ready", flush=True)
gnomon.truth(scene, points, {"direction": [-0.4, -1, -0.3]})
print("done")
"""
        command = [sys.executable, "-c", script]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            self.assertEqual(process.stdout.readline(), "ready\n")
            process.send_signal(signal.SIGINT)
            out, error = process.communicate()
        self.assertEqual(out, "")
        self.assertIn("KeyboardInterrupt", error)


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
            with self.assertRaisesRegex(gnomon.InputError, "written as .png"):
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
            (lambda: gnomon.compare("wall", advise=True, views={"camera": 2}), "there is no 'camera'"),
            (lambda: gnomon.compare("wall", advise=True, views=65), r"views\['cameras'\] = 65"),
            (lambda: gnomon.compare("wall", advise=True, views={"all_cases": True}), r"no \[\[case\]\]"),
            (lambda: gnomon.compare("wall", advise=True, methods="vsmm"), "did you mean vsm"),
            (lambda: gnomon.compare("wall", advise=True, max_bytes=9), "give methods, too"),
            (lambda: gnomon.compare("wall", advise=True, method={"name": "shadow_volumes"}), "no map and no bias"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))


class TuneTest(unittest.TestCase):
    def test_is_the_program_s_and_its_keys_give_what_it_says(self):
        limits = ["--max-resolution", "256", "--max-false-shadow", "0.5", "--max-false-lit", "0.5"]
        settings = [word for name, value in pairs(SMALL) for word in ("--set", f"{name}={value}")]
        command = [PROGRAM, "tune", "--builtin", "wall", "--json", *limits, *settings]
        said = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
        found = gnomon.tune("wall", max_resolution=256, max_false_shadow=0.5, max_false_lit=0.5, **SMALL)
        self.assertTrue(found.meets_limits)
        self.assertEqual(found.to_dict(), said)
        self.assertIn(found.toml, str(found) + found.toml)
        again = gnomon.compare("wall", **{"image": SMALL["image"], **found.keys})
        for name in ("false_shadow", "false_lit"):
            self.assertEqual(again.metrics[name], said["measured"][name])

    def test_of_several_lights_is_of_each(self):
        lights = {"name": "a", "direction": [-0.4, -1, -0.3]}, {"name": "b", "direction": [0.4, -1, -0.3]}
        with tempfile.TemporaryDirectory() as folder:
            job = os.path.join(folder, "job.toml")
            with open(job, "w") as file:
                file.write('scene.builtin = "wall"\n')
                for light in lights:
                    file.write(f'[[lights]]\nname = "{light["name"]}"\ndirection = {light["direction"]}\n')
            found = gnomon.tune(job, max_resolution=256, time_s=5, **SMALL)
            self.assertEqual([each.light for each in found], ["a", "b"])
            again = gnomon.compare(job, only_light="b", **SMALL, **found[1].keys)
        for name in ("false_shadow", "false_lit"):
            self.assertEqual(again.metrics[name], found[1].to_dict()["measured"][name])

    def test_refuses_limits_that_are_none(self):
        for call, words in [
            (lambda: gnomon.tune("wall", max_false_lit=2), "max_false_lit = 2: must be a share"),
            (lambda: gnomon.tune("wall", max_resolution=0), "max_resolution = 0"),
            (lambda: gnomon.tune("wall", max_resolution=8), "at most 8 texels"),
            (lambda: gnomon.tune("wall", time_s="soon"), "time_s = 'soon': must be a number"),
            (lambda: gnomon.tune("wall", method={"name": "shadow_volumes"}), "no bias curve"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words):
                call()

    def test_ctrl_c_ends_it(self):
        script = """
from pathlib import Path

import gnomon
print("ready", flush=True)
gnomon.tune("columns", time_s=600)
print("done")
"""
        with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            self.assertEqual(process.stdout.readline(), "ready\n")
            time.sleep(2)
            process.send_signal(signal.SIGINT)
            out, error = process.communicate(timeout=60)
        self.assertEqual(out, "")
        self.assertIn("KeyboardInterrupt", error)


class DepthTest(unittest.TestCase):
    def test_is_the_program_s(self):
        for options, keys in [
            (["--bits", "16"], {"bits": 16}),
            (["--format", "d32f", "--reversed", "--near", "0.1"], {"format": "d32f", "reversed": True, "near_m": 0.1}),
            (["--content", "distance", "--tolerance", "0.01"], {"content": "distance", "tolerance_m": 0.01}),
        ]:
            for measures in (False, True):
                command = [PROGRAM, "depth", "--json", "--samples", "64", *options, *([] if measures else ["--theory-only"])]
                said = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
                found = gnomon.depth(samples=64, measure=measures, **keys).to_dict()
                for result in (said, found):
                    result.pop("not_measured_because")
                self.assertEqual(found, said)

    def test_steps_of_a_d16_map_are_those_of_the_formula(self):
        study = gnomon.depth(1, 9, bits=16, samples=8)
        step_at_far = 9 * 9 * (9 - 1) / (1 * 9) / 65535  # dζ/dz = ζ²(f − n)/(nf)
        self.assertAlmostEqual(study.theory["step_at_far_m"], step_at_far, delta=1e-4 * step_at_far)
        self.assertIsNone(study.measured)
        self.assertIn("d16", repr(study))

    def test_refuses_what_is_no_frustum(self):
        for call, words in [
            (lambda: gnomon.depth(5, 4), "near must be below far"),
            (lambda: gnomon.depth("near"), "near_m = 'near': must be a number"),
            (lambda: gnomon.depth(format="d17"), "no such format"),
            (lambda: gnomon.depth(format="d16", bits=8), "exclude each other"),
            (lambda: gnomon.depth(projection="fisheye"), "must be one of perspective, orthographic"),
            (lambda: gnomon.depth(content="distance", reversed=True), "a light at a place"),
            (lambda: gnomon.depth(samples=1), "samples = 1"),
            (lambda: gnomon.depth(tilt_deg=float("nan")), "tilt = nan"),
            (lambda: gnomon.depth(tolerance_m=0), "tolerance = 0"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words):
                call()


class SunTest(unittest.TestCase):
    BERLIN = 52.52, 13.40
    SUN = {"latitude_deg": 52.52, "longitude_deg": 13.40, "time": "2026-06-21T12:00:00Z"}

    def test_of_many_times_is_that_of_each(self):
        times = [f"2026-06-21T{hour:02}:00:00Z" for hour in range(24)]
        azimuths, elevations = gnomon.sun_position(*self.BERLIN, times)
        directions = gnomon.sun_direction(*self.BERLIN, times, north=[1, 0, 0])
        for number, time in enumerate(times):
            self.assertEqual(gnomon.sun_position(*self.BERLIN, time), (azimuths[number], elevations[number]))
            one = gnomon.sun_direction(*self.BERLIN, time, north=[2, 9, 0])
            self.assertTrue(np.array_equal(one, directions[number]))
        self.assertTrue(np.allclose(np.linalg.norm(directions, axis=1), 1))
        self.assertEqual(azimuths[10:13].round().tolist(), sorted(azimuths[10:13].round().tolist()))

    def test_times_are_the_same_in_every_form(self):
        zone = datetime.timezone(datetime.timedelta(hours=2))
        forms = ["2026-06-21T12:00:00Z", "2026-06-21T14:00+02:00", np.datetime64("2026-06-21T12:00")]
        forms.append(datetime.datetime(2026, 6, 21, 14, 0, tzinfo=zone))
        found = {gnomon.sun_position(*self.BERLIN, form) for form in forms}
        self.assertEqual(len(found), 1)

    def test_is_the_sun_of_a_job(self):
        sun = self.SUN
        direction = gnomon.sun_direction(52.52, 13.40, "2026-06-21T12:00:00Z")
        points = np.random.default_rng(3).uniform(-3, 3, (200, 3))
        scene = gnomon.builtin("columns")
        self.assertTrue(
            np.array_equal(
                gnomon.truth(scene, points, {"sun": sun}).point_class,
                gnomon.truth(scene, points, {"direction": direction}).point_class,
            )
        )
        of_sun = gnomon.compare("columns", light={"sun": sun}, **SMALL)
        of_direction = gnomon.compare("columns", light={"direction": direction}, **SMALL)
        self.assertEqual(of_sun.metrics, of_direction.metrics)
        turned = gnomon.compare("columns", light={"sun": sun}, scene={"north": [1, 0, 0]}, **SMALL)
        self.assertNotEqual(turned.metrics, of_sun.metrics)
        as_datetime = {**sun, "time": datetime.datetime(2026, 6, 21, 12, tzinfo=datetime.timezone.utc)}
        self.assertEqual(gnomon.compare("columns", light={"sun": as_datetime}, **SMALL).metrics, of_sun.metrics)

    def test_stands_by_the_north_of_a_scene(self):
        scene = gnomon.builtin("columns", north=[1, 0, 0])
        compared = gnomon.compare(scene, light={"sun": self.SUN}, bias={"constant": 0.003}, **SMALL)
        evaluated = gnomon.evaluate(compared.verdict, scene, {"sun": self.SUN}, compared.positions)
        self.assertLess(evaluated.metrics["error_rate"], 0.2)
        direction = gnomon.sun_direction(*self.BERLIN, self.SUN["time"], north=[1, 0, 0])
        points = np.random.default_rng(5).uniform(-3, 3, (100, 3))
        of_sun = gnomon.truth(scene, points, {"sun": self.SUN})
        of_direction = gnomon.truth(scene, points, {"direction": direction})
        self.assertTrue(np.array_equal(of_sun.point_class, of_direction.point_class))

    def test_takes_the_place_of_a_direction_of_a_dict(self):
        job = {"scene": {"builtin": "columns"}, "light": {"sun": self.SUN}, **SMALL}
        of_direction = gnomon.compare(job, light={"direction": [0, -1, 0]})
        self.assertEqual(of_direction.metrics, gnomon.compare("columns", light={"direction": [0, -1, 0]}, **SMALL).metrics)

    def test_refuses_what_is_no_place_or_time(self):
        for call, words in [
            (lambda: gnomon.sun_position(91, 0, "2026-06-21T12:00Z"), "latitude_deg = 91"),
            (lambda: gnomon.sun_position(0, float("nan"), "2026-06-21T12:00Z"), "longitude_deg = nan"),
            (lambda: gnomon.sun_position(0, 0, "2026-06-21T12:00"), "must be such as"),
            (lambda: gnomon.sun_position(0, 0, datetime.datetime(2026, 6, 21)), "has no time zone"),
            (lambda: gnomon.sun_position(0, 0, ["2026-06-21T12:00Z", "2209-06-21T12:00Z"]), r"time\[1\]: must be of the years"),
            (lambda: gnomon.sun_position(0, 0, np.datetime64("NaT")), "must be a text"),
            (lambda: gnomon.sun_position(0, 0, 5), "time = 5: must be a text"),
            (lambda: gnomon.sun_position(0, 0, datetime.date(2026, 6, 21)), "time = datetime.date"),
            (lambda: gnomon.sun_position(0, 0, np.array([["2026-06-21"]], "datetime64[ms]")), "2 dimensions"),
            (lambda: gnomon.sun_position(10**400, 0, "2026-06-21T12:00Z"), "latitude_deg = 1000"),
            (lambda: gnomon.sun_direction(0, 0, "2026-06-21T12:00Z", north="abc"), "north = 'abc'"),
            (lambda: gnomon.truth(plate(), [[0, 1, 0]], {"sun": {"latitude_deg": 1}}), "latitude_deg, longitude_deg and time"),
            (
                lambda: gnomon.truth(plate(), [[0, 1, 0]], {"sun": {**self.SUN, "time": "2026-06-21T23:00Z"}}),
                "below the horizon",
            ),
            (lambda: gnomon.sun_direction(0, 0, "2026-06-21T12:00Z", north=[0, 1, 0]), "horizontal part"),
            (lambda: gnomon.compare("wall", light={"sun": {"latitude_deg": 1}}), "longitude_deg is missing"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words):
                call()


class ReferenceTest(unittest.TestCase):
    def public_functions(self):
        for name in gnomon.__all__:
            value = getattr(gnomon, name)
            if inspect.isfunction(value):
                yield name, value
            elif inspect.isclass(value) and value.__module__.startswith("gnomon."):
                for member, own in vars(value).items():
                    function = own.fget if isinstance(own, property) else own
                    if inspect.isfunction(function) and not member.startswith("_"):
                        yield f"{name}.{member}", function

    def test_everything_public_has_types_and_a_sentence(self):
        names = [name for name, _ in self.public_functions()]
        self.assertIn("compare", names)
        self.assertIn("Comparison.findings", names)
        for name, function in self.public_functions():
            signature = inspect.signature(function)
            self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
            for parameter in signature.parameters.values():
                if parameter.name != "self":
                    self.assertIsNot(parameter.annotation, inspect.Parameter.empty, f"{name}({parameter.name})")
            self.assertTrue(function.__doc__, name)


class ListsTest(unittest.TestCase):
    def test_methods_are_the_program_s(self):
        said = json.loads(subprocess.run([PROGRAM, "methods", "--json"], capture_output=True, check=True).stdout)
        self.assertEqual(gnomon.methods(), said)


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


class SweepTest(unittest.TestCase):
    def test_is_the_program_s_sweep_and_resumes(self):
        with tempfile.TemporaryDirectory() as folder:
            ours = os.path.join(folder, "ours")
            axes = {"bias": {"constant": [0, 0.001, 0.01]}, "shadow_map.resolution": [128, 256]}
            keys = {"image": SMALL["image"]}
            run = gnomon.sweep("wall", axes, ours, progress=False, **keys)
            self.assertEqual(len(run.results), 6)
            theirs = os.path.join(folder, "theirs")
            with run.connect() as database:
                command = database.execute("SELECT value FROM run WHERE key = 'command'").fetchone()[0]
            words = shlex.split(command)
            self.assertEqual(words[:2], ["gnomon", "sweep"])
            subprocess.run([PROGRAM, *words[1:], "--out", theirs, "--quiet"], check=True, capture_output=True)
            for name in ("results.csv", "bias_curves.csv", "error_vs_z.csv"):
                with open(os.path.join(ours, name)) as own, open(os.path.join(theirs, name)) as other:
                    self.assertEqual(own.read(), other.read(), name)
            again = gnomon.sweep("wall", {**axes, "bias": {"constant": [0, 0.001, 0.01, 0.02]}}, ours, progress=False, **keys)
            self.assertEqual(len(again.results), 8)
            self.assertEqual(len(gnomon.open_run(ours).results), 8)

    def test_ctrl_c_ends_it_and_keeps_what_is_done(self):
        script = """
import gnomon, sys
axes = {"shadow_map.resolution": list(range(128, 1128, 2))}
print("ready", flush=True)
gnomon.sweep("wall", axes, sys.argv[1], progress=False, image={"width": 96, "height": 54})
"""
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-c", script, folder]
            with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
                process.stdout.readline()
                while not os.path.exists(os.path.join(folder, "results.sqlite")):
                    time.sleep(0.05)
                time.sleep(1)
                process.send_signal(signal.SIGINT)
                _, error = process.communicate()
            self.assertIn("KeyboardInterrupt", error)
            with gnomon.open_run(folder).connect() as database:
                done = database.execute("SELECT count(*) FROM configurations WHERE status = 'done'").fetchone()[0]
            self.assertGreater(done, 0)
            self.assertLess(done, 500)

    def test_a_night_fails_by_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            run = gnomon.sweep(
                "columns",
                {"light.sun.time": ["2026-06-21T12:00Z", "2026-06-21T23:00Z"]},
                folder,
                light={"sun": {"latitude_deg": 52, "longitude_deg": 13}},
                lookup={"filter": "pcf3"},
                progress=False,
                **SMALL,
            )
            self.assertEqual(run.results["status"].tolist(), ["done", "failed"])
            self.assertIn("below the horizon", run.results["message"][1])

    def test_refuses_what_is_no_run_and_no_axis(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(gnomon.InputError, "is it a run"):
                gnomon.open_run(folder)
            with self.assertRaisesRegex(gnomon.InputError, "bias.constnt"):
                gnomon.sweep("wall", {"bias.constnt": [1]}, folder)
            with self.assertRaisesRegex(TypeError, "no scene from arrays"):
                gnomon.sweep(plate(), {}, folder)


class EvaluateTest(unittest.TestCase):
    def setUp(self):
        self.result = gnomon.compare("columns", **SMALL)
        self.scene = gnomon.builtin("columns")
        job = self.result.to_dict()["job"]
        self.light = {"direction": job["light.direction"]}
        self.eye = job["camera.eye"]

    def test_judges_a_mask_by_positions(self):
        found = gnomon.evaluate(
            self.result.verdict, self.scene, self.light, self.result.positions, eye=self.eye
        )
        ours = np.isin(found["class"], (5, 6)) & np.isin(self.result["class"], (5, 6))
        self.assertGreater(ours.mean(), 0.8 * np.isin(self.result["class"], (5, 6)).mean())
        self.assertTrue((found["class"][ours] == self.result["class"][ours]).all())

    def test_names_the_mistake_that_a_mask_looks_like(self):
        with self.assertRaisesRegex(gnomon.InputError, "rows|upside|invert|1 − |shadowed"):
            gnomon.evaluate(1 - self.result.verdict, self.scene, self.light, self.result.positions, eye=self.eye)

    def test_a_mask_by_the_camera_alone(self):
        job = self.result.to_dict()["job"]
        camera = {"eye": job["camera.eye"], "target": job["camera.target"], "vertical_fov_deg": job["camera.vertical_fov_deg"]}
        found = gnomon.evaluate(self.result.verdict, self.scene, self.light, camera=camera)
        self.assertLess(abs(found.metrics["error_rate"] - self.result.metrics["error_rate"]), 0.02)


BAD_CALLS = [
    (lambda: gnomon.Scene([[0, 0, 0]], [[0, 0, 1]]), r"triangles\[0, 2\] is 1: there are 1 vertices"),
    (lambda: gnomon.Scene([[0, 0]], [[0, 0, 0]]), r"vertices has the shape \(1, 2\): it must be \(n, 3\)"),
    (lambda: gnomon.Scene([[0, float("nan"), 0]] * 3, [[0, 1, 2]]), r"vertices\[0\]: y is nan"),
    (lambda: gnomon.Scene("mesh", [[0, 1, 2]]), "vertices must be an array of numbers"),
    (lambda: gnomon.Scene(np.eye(3), np.eye(3)), "triangles must be an array of integers"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, -1]]), r"triangles\[0, 2\] is -1"),
    (lambda: gnomon.Scene(np.zeros((0, 3)), np.zeros((0, 3), int)), "none has an area"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, 2]], objects={"a": 2}), "objects hold 2 of 1 triangles"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, 2]], no_cast=["b"]), 'scene has no object of this name; the nearest is "mesh"'),
    (lambda: gnomon.load("nothing.obj"), "nothing.obj"),
    (lambda: gnomon.builtin("colums"), "columns"),
    (lambda: gnomon.builtin("columns", angle=1), "unknown key"),
    (lambda: gnomon.truth(plate(), [[0, 0]], SUN), r"points has the shape \(1, 2\)"),
    (lambda: gnomon.truth(plate(), [0, 0, 0], SUN), r"points has the shape \(3\)"),
    (lambda: gnomon.truth(plate(), [[0, 0, float("inf")]], SUN), r"points\[0\]: z is inf"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"directon": 1}), "light.directon=.*unknown key"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"direction": [0, 0, 0]}), "light.direction"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {}), "light"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"position": [0, 1, float("nan")]}), "light.position"),
    (lambda: gnomon.truth(plate(), triangles=[9], barycentrics=[[0, 0]], light=SUN), r"triangles\[0\] is 9: the scene has 4"),
    (lambda: gnomon.truth(plate(), triangles=[0], barycentrics=[[1, 1]], light=SUN), r"barycentrics\[0\] is \(1, 1\)"),
    (lambda: gnomon.truth(plate(), triangles=[0, 1], barycentrics=[[0, 0]], light=SUN), "2 triangles and 1 barycentrics"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, side="up"), 'side = "up"'),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, side=["x"]), "side = "),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, threads=100_000), "threads = 100000: must be a whole number"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, threads="x"), "threads = 'x'"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"position": [0, 1, 0], "cone_deg": 4}), "light.cone_deg"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"position": [0, 1, 0], "direction": [0, -1, 0], "cone_deg": 4}), "light.cone_deg"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"direction": 5}), "light.direction=5"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], 5), "light must be a dict"),
    (lambda: gnomon.compare("wall", threads=-1), "threads = -1"),
    (lambda: gnomon.compare("wall", device=1.5), "device = 1.5"),
    (lambda: gnomon.compare(plate(), scene={"builtin": "wall"}), "scene.builtin: the job is a scene already"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 4, 3)), eye=[float("nan")] * 3), "eye: x is nan"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 4, 3)), eye=5), "eye = 5"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 4, 3)), image={"width": 7}), "image.width: a mask has"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, 2]], objects={"a": 2**70}), r'objects\["a"\]'),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, project="up"), 'project = "up"'),
    (lambda: gnomon.compare("wall", bias={"constant": "x"}), r"bias.constant=.x.*must be a number"),
    (lambda: gnomon.compare("wall", bias={"constnt": 1}), "unknown key; the nearest is bias.constant"),
    (lambda: gnomon.compare({"bias": {"constant": 1}}), "no scene"),
    (lambda: gnomon.compare("wall", case="night"), "night"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN), "needs the whole camera"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 5, 3))), "positions has 5x4 pixels and the mask 4x4"),
    (lambda: gnomon.evaluate(np.full((4, 4), 2.0), plate(), SUN, np.zeros((4, 4, 3))), r"mask\[0, 0\] is 2"),
    (lambda: gnomon.evaluate(np.ones(4), plate(), SUN, np.zeros((4, 4, 3))), r"mask must have the shape \(height, width\)"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.full((4, 4, 3), np.nan)), "no pixel is to be judged"),
]


class BadInputTest(unittest.TestCase):
    def test_is_an_exception_that_names_argument_and_index(self):
        for number, (call, words) in enumerate(BAD_CALLS):
            with self.subTest(number=number, words=words):
                with self.assertRaisesRegex(gnomon.InputError, words) as caught:
                    call()
                self.assertNotIn("\n", str(caught.exception))

    def test_random_arguments_never_crash(self):
        seed = 7
        rng = random.Random(seed)
        numbers = [0, 1, -1, 2, 3, 1e300, float("nan"), float("inf"), -0.0, 1e-320, 2**32, 2**63 - 1]

        def array():
            shape = rng.choice([(0,), (3,), (1, 3), (5, 3), (2, 2), (0, 3), (2, 3, 3), ()])
            dtype = rng.choice([np.float64, np.float32, np.int64, np.int8, np.uint32, object, "U3"])
            with np.errstate(all="ignore"):
                try:
                    given = np.array([rng.choice(numbers) for _ in range(int(np.prod(shape)))], float)
                    return given.reshape(shape).astype(dtype)
                except (OverflowError, ValueError):
                    return None

        scene = plate()
        calls = 0
        for _ in range(20_000 if IS_FULL else 1_500):
            arguments = [array() for _ in range(3)]
            light = {rng.choice(["direction", "position", "target"]): [rng.choice(numbers) for _ in range(3)] for _ in range(2)}
            try:
                with np.errstate(all="ignore"):
                    kind = rng.randrange(4)
                    if kind == 0:
                        gnomon.Scene(arguments[0], arguments[1])
                    elif kind == 1:
                        gnomon.truth(scene, arguments[0], light)
                    elif kind == 2:
                        gnomon.truth(scene, triangles=arguments[0], barycentrics=arguments[1], light=light)
                    else:
                        gnomon.evaluate(arguments[0], scene, light, arguments[1])
            except (ValueError, TypeError, OverflowError):
                pass
            calls += 1
        self.assertGreater(calls, 1000, f"seed {seed}")


class WithoutGlTest(unittest.TestCase):
    def test_truth_and_evaluate_work_and_compare_says_what_is_missing(self):
        script = """
import gnomon, numpy as np
scene = gnomon.builtin("wall")
assert len(gnomon.truth(scene, [[0, 1, 5]], {"direction": [0, -1, 0]})) == 1
try:
    gnomon.compare("wall")
except gnomon.EnvironmentError as error:
    print(error)
"""
        environment = {**os.environ, "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "^[^\n]*(EGL|GL driver)[^\n]*\n$")


class KeysTest(unittest.TestCase):
    def test_values_are_written_as_toml(self):
        cases = [(True, "true"), (3, "3"), (0.1, "0.1"), (np.float32(0.5), "0.5"), (float("inf"), "inf")]
        cases += [('a"b', '"a\\"b"'), ([1, "x"], '[1, "x"]'), (np.array([1.5, 2]), "[1.5, 2.0]")]
        for value, text in cases:
            self.assertEqual(toml(value), text)
        with self.assertRaises(gnomon.InputError):
            toml(object())

    def test_tables_are_flattened(self):
        given = {"bias": {"constant": 1, "slope": None}, "image.width": 2}
        self.assertEqual(list(flat(given)), [("bias.constant", 1), ("image.width", 2)])


class ProgramTest(unittest.TestCase):
    def test_the_module_is_the_program(self):
        environment = {**os.environ, "PATH": os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]}
        command = [sys.executable, "-m", "gnomon", "--version"]
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        self.assertIn(gnomon.__version__, done.stdout)


if __name__ == "__main__":
    unittest.main()
