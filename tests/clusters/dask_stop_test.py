"""A Dask worker that is stopped (SIGSTOP) loses its unit to another, and the sweep has the bytes of one machine."""
import os
import pathlib
import signal
import subprocess
import unittest

from dask_cluster import Cluster
from processes import PATIENCE_S, children_of, unit_processes_of, wait_until
from sweep_case import GNOMON, SweepCase

# As with `--on local:N`. A worker is also silent while it reports its GL, for seconds on a busy machine.
SILENCE = "30 s"


class StoppedWorker(SweepCase):
    # A unit takes one or two seconds, so it is still running when its worker is stopped.
    axes = ["--axis", "shadow_map.roll_deg={from=0, to=80, count=60}", "--axis", "bias.slope=0,1",
            "--axis", "bias.constant=0,0.001,0.02"]

    def setUp(self):
        super().setUp()
        os.environ["DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL"] = SILENCE
        self.addCleanup(os.environ.pop, "DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL")
        self.cluster = Cluster(self.folder, 2)
        self.addCleanup(self.cluster.stop)

    def stop_a_worker(self):
        """Stops a worker that computes a unit, and its program; returns the worker."""
        found = []

        def is_at_work():
            found[:] = [worker for worker in self.cluster.workers if unit_processes_of(worker.pid)]
            return bool(found)

        wait_until(is_at_work, "a unit has begun")
        family = children_of(found[0].pid)
        for pid in family:
            os.kill(pid, signal.SIGSTOP)
        self.addCleanup(self.kill, family)
        return found[0]

    def kill(self, family):
        for pid in family[1:]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def state_of(self, pid):
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]

    def test_loses_its_unit_to_another_and_the_sweep_has_the_same_bytes(self):
        command = [GNOMON, "sweep", "job.toml", "--out", "run", "--quiet", "--on", self.cluster.address, "--units", "6", *self.axes]
        client = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        stopped = self.stop_a_worker()
        said, words = client.communicate(timeout=2 * PATIENCE_S)
        self.assertEqual(client.returncode, 0, words)
        self.assertIn("360 of 360 configurations done", said)
        self.assertEqual(self.state_of(stopped.pid), "T", "it was stopped all the while")
        self.expect_same("run")


if __name__ == "__main__":
    unittest.main(verbosity=2)
