"""Scenes of the Python package."""

import os
import tempfile
import unittest

import gnomon
import numpy as np
from support import SMALL, plate


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
