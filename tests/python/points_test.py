"""Truth of points."""

import random
import signal
import subprocess
import sys
import threading
import unittest

import gnomon
import numpy as np
from support import SUN, plate


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
