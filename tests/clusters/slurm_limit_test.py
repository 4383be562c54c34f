"""A task of Slurm that runs over its time limit is tried again. The least limit is a minute."""
import os
import signal
import unittest

from processes import wait_until
from slurm_sweep_case import SlurmSweepCase


class TimeLimit(SlurmSweepCase):
    def test_of_a_stopped_task_leaves_one_machines_sweep(self):
        client = self.start(":--time=1")
        pid, late = self.a_unit_process(client)
        os.kill(pid, signal.SIGSTOP)
        wait_until(lambda: self.tried().count(late) == 2 or client.poll() is not None, "it is tried again")
        self.assertEqual(len(self.tried()), 21)
        self.assertIn("60 of 60 configurations done", self.end(client, 0))
        self.expect_same("run")


if __name__ == "__main__":
    unittest.main(verbosity=2)
