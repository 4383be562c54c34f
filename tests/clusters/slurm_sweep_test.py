"""`gnomon sweep --on slurm` leaves the bytes of a sweep on one machine, whatever dies meanwhile."""
import json
import os
import signal
import sqlite3
import subprocess
import unittest

from processes import children_of, wait_until, words_of
from slurm_sweep_case import SlurmSweepCase
from sweep_case import GNOMON


class SweepOnSlurm(SlurmSweepCase):
    def test_is_one_machines_sweep_though_a_task_was_killed(self):
        client = self.start()
        pid, killed = self.a_unit_process(client)
        self.assertEqual(len(self.tried()), 20)
        os.kill(pid, signal.SIGKILL)
        wait_until(lambda: self.tried().count(killed) == 2 or client.poll() is not None, "it is tried again")
        tried = self.tried()
        self.assertIn("60 of 60 configurations done", self.end(client, 0))
        self.assertEqual((len(tried), len(set(tried))), (21, 20), "one unit is tried twice")
        self.expect_same("run")
        self.assertFalse((self.folder / "run" / "units").exists())

    def test_goes_on_after_its_client_was_killed_and_after_ctrl_c(self):
        client = self.start()
        self.a_unit_process(client)
        client.kill()
        client.communicate()
        again = self.start()
        wait_until(lambda: any("slurm_driver.py" in " ".join(words_of(pid)) for pid in children_of(again.pid)),
                   "its driver has started")
        again.send_signal(signal.SIGINT)
        self.assertIn("the same command goes on where this stopped", self.end(again, 130))
        self.assertEqual(self.slurm.tasks(), [])
        self.assertEqual(len(self.tried()), 20, "nothing was submitted twice")
        self.run_gnomon("status", "run", code=5)
        done = self.run_gnomon(*self.sweep_on())
        self.assertIn("60 of 60 configurations done", done.stdout)
        self.expect_same("run")

    def renderer(self, **variables):
        done = subprocess.run([GNOMON, "doctor", "--json"], capture_output=True, text=True, check=True,
                              env=dict(os.environ, **variables))
        return json.loads(done.stdout)["gl"]["renderer"]

    def has_results(self):
        file = self.folder / "run" / "results.sqlite"
        if not file.exists():
            return False
        try:
            with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
                (count,) = database.execute("SELECT count(*) FROM configurations").fetchone()
        except sqlite3.OperationalError:
            return False  # its tables are not there yet
        return count > 0

    def test_stops_where_nodes_differ_and_leaves_no_task(self):
        width = {"LP_NATIVE_VECTOR_WIDTH": "128"}  # llvmpipe names its width
        if self.renderer() == self.renderer(**width):
            self.skipTest("the driver is not llvmpipe, or of 128 bits")
        client = self.start(":--export=ALL,LP_NATIVE_VECTOR_WIDTH=128")
        wait_until(self.has_results, "a unit is in the run")
        client.send_signal(signal.SIGINT)
        self.end(client, 130)
        refused = self.run_gnomon(*self.sweep_on(), code=2).stderr
        self.assertIn("was computed in another environment", refused)
        self.assertIn("--allow-mixed", refused)
        self.assertEqual(self.slurm.tasks(), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
