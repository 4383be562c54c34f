"""`gnomon sweep --on local:N` leaves the bytes of a sweep on one machine, whatever dies meanwhile."""
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

from cluster import PATIENCE_S, children_of, wait_until

GNOMON = os.environ["GNOMON"]
CSV = ("results.csv", "error_vs_z.csv", "bias_curves.csv")
JOB = 'scene.builtin = "sphere-cube"\nimage.width = 64\nimage.height = 36\n'
AXES = ["--axis", "shadow_map.resolution=16,20,24,28,32,36", "--axis", "bias.slope=0,1",
        "--axis", "bias.constant=0,0.001,0.02"]


class SweepOnWorkers(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        (self.folder / "job.toml").write_text(JOB)
        self.run_gnomon("sweep", "job.toml", "--out", "whole", "--no-keep-pixels", "--quiet", *AXES)

    def run_gnomon(self, *arguments, code=0):
        done = subprocess.run([GNOMON, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def sweep_on(self, run):
        return ["sweep", "job.toml", "--out", run, "--on", "local:2", "--units", "6", *AXES]

    def expect_same(self, run):
        for name in CSV:
            self.assertEqual((self.folder / run / name).read_bytes(), (self.folder / "whole" / name).read_bytes(),
                             name)

    def test_is_one_machines_sweep(self):
        done = self.run_gnomon(*self.sweep_on("run"))
        self.assertIn("36 of 36 configurations done", done.stdout)
        self.expect_same("run")
        self.assertFalse((self.folder / "run" / "units").exists())
        self.run_gnomon("status", "run")
        again = self.run_gnomon(*self.sweep_on("run"))
        self.assertIn("36 of 36 configurations done", again.stdout)
        self.expect_same("run")

    def test_goes_on_after_workers_and_client_were_killed(self):
        client = subprocess.Popen([GNOMON, *self.sweep_on("run"), "--quiet"], cwd=self.folder)
        units = self.folder / "run" / "units"

        def unit_processes():
            found = []
            for pid in children_of(client.pid):
                try:
                    words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
                except OSError:
                    continue
                if b"run-unit" in words and b"python" not in words[0]:
                    found.append(pid)
            return found

        wait_until(lambda: unit_processes() or client.poll() is not None, "a unit has begun")
        for pid in unit_processes():
            os.kill(pid, signal.SIGKILL)
        time.sleep(1)
        family = children_of(client.pid)
        client.kill()
        client.wait()
        wait_until(lambda: not any(pathlib.Path(f"/proc/{pid}").exists() for pid in family),
                   "nothing of it is left")
        self.run_gnomon(*self.sweep_on("run"))
        self.expect_same("run")
        self.assertFalse(units.exists())

    def test_stops_at_ctrl_c_and_resumes(self):
        client = subprocess.Popen([GNOMON, *self.sweep_on("run"), "--quiet"], cwd=self.folder,
                                  stderr=subprocess.PIPE, text=True)
        wait_until(lambda: (self.folder / "run" / "units" / "plan.jsonl").exists(), "the sweep has begun")
        client.send_signal(signal.SIGINT)
        _, words = client.communicate(timeout=PATIENCE_S)
        self.assertEqual(client.returncode, 130, words)
        self.assertIn("the same command goes on where this stopped", words)
        self.run_gnomon("status", "run", code=5)
        self.run_gnomon(*self.sweep_on("run"))
        self.expect_same("run")

    def test_refuses_what_it_has_no_part_in(self):
        for options, words in ((["--on", "local:0"], "must be local:N"), (["--on", "farm"], "must be local:N"),
                               (["--on", "local:2", "--shard", "1/2"], "--shard: not with --on"),
                               (["--on", "local:2", "--verify"], "--verify: not with --on")):
            done = self.run_gnomon("sweep", "job.toml", "--out", "none", *options, code=2)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
