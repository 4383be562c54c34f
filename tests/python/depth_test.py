"""Precision of depth formats."""

import json
import subprocess
import unittest

import gnomon
from support import PROGRAM


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
            (lambda: gnomon.depth(format="d16", bits=8), "mutually exclusive"),
            (lambda: gnomon.depth(projection="fisheye"), "must be one of perspective, orthographic"),
            (lambda: gnomon.depth(content="distance", reversed=True), "a positional light"),
            (lambda: gnomon.depth(samples=1), "samples = 1"),
            (lambda: gnomon.depth(tilt_deg=float("nan")), "tilt = nan"),
            (lambda: gnomon.depth(tolerance_m=0), "tolerance = 0"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words):
                call()
