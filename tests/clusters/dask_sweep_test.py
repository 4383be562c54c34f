"""`gnomon sweep --on local:N` leaves the bytes of a sweep on one machine, whatever dies meanwhile."""
import contextlib
import os
import pathlib
import shlex
import signal
import sqlite3
import subprocess
import time
import unittest

from dask_cluster import Cluster
from processes import PATIENCE_S, children_of, unit_processes_of, wait_until
from sweep_case import GNOMON, SweepCase
from tent_case import TentCase


class SweepOnWorkers(SweepCase):
    def sweep_on(self, run):
        return ["sweep", "job.toml", "--out", run, "--on", "local:2", "--units", "6", *self.axes]

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

        wait_until(lambda: unit_processes_of(client.pid) or client.poll() is not None, "a unit has begun")
        for pid in unit_processes_of(client.pid):
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

    def test_retry_failed_computes_units_with_failures_again(self):
        self.run_gnomon(*self.sweep_on("run"))
        with contextlib.closing(sqlite3.connect(self.folder / "run" / "results.sqlite")) as database, database:
            database.execute("UPDATE configurations SET status = 'failed', may_pass = 1, message = 'no memory' WHERE number = 5")
        kept = self.run_gnomon(*self.sweep_on("run"), code=5)
        self.assertIn("35 of 36 configurations done, 1 failed", kept.stdout)
        self.assertIn("--retry failed tries again", kept.stderr)
        advice = self.run_gnomon("status", "run", code=5).stdout
        program, *words = shlex.split(advice.splitlines()[-1])
        self.assertEqual((program, words[-2:]), ("gnomon", ["--retry", "failed"]))
        self.assertIn("local:2", words)
        self.assertIn("36 of 36", self.run_gnomon(*words).stdout)
        self.expect_same("run")

    def test_refuses_what_it_has_no_part_in(self):
        for options, words in ((["--on", "local:0"], "must be local:N"), (["--on", "farm"], "must be local:N"),
                               (["--on", "slurmy"], "must be local:N"),
                               (["--on", "local:2", "--shard", "1/2"], "--shard does not work with --on"),
                               (["--on", "local:2", "--renderer", "three"], "--renderer does not work with --on"),
                               (["--on", "local:2", "--verify"], "--verify does not work with --on")):
            done = self.run_gnomon("sweep", "job.toml", "--out", "none", *options, code=2)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)


class SweepOfAFileElsewhere(TentCase):
    def test_needs_the_file_here_alone(self):
        cluster = Cluster(self.folder, 2)
        self.addCleanup(cluster.stop)
        client = subprocess.Popen(
            [GNOMON, "sweep", "job.toml", "--out", "run", "--on", cluster.address, "--units", "3", "--quiet"],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_until(lambda: (self.folder / "run" / "units" / "plan.jsonl").exists() or client.poll() is not None,
                   "the sweep is planned")
        for name in ("tent.obj", "tent.mtl"):
            (self.folder / name).unlink()
        _, words = client.communicate(timeout=PATIENCE_S)
        self.assertEqual(client.returncode, 0, words)
        self.expect_same("run")
        self.assertEqual(len(list(self.folder.glob("gnomon-*/scenes-*/*.scene"))), 1)
        self.assertFalse((self.folder / "run" / "scenes").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
