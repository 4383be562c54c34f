"""Searches for settings."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import gnomon
from gnomon.keys import pairs
from support import PROGRAM, SMALL


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
            (lambda: gnomon.tune("wall", max_resolution=8), "as small as 8 texels"),
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
