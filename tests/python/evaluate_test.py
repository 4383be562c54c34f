"""Other renderers' masks."""

import unittest

import gnomon
import numpy as np
from support import SMALL


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
