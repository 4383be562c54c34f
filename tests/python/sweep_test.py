"""Sweeps and runs."""

import os
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import gnomon
from support import PROGRAM, SMALL, plate


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
            with self.assertRaisesRegex(TypeError, "a scene from arrays"):
                gnomon.sweep(plate(), {}, folder)
