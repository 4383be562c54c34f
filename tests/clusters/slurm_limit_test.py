"""Of 20 tasks of Slurm one is killed and one runs over its time limit, whose least is a minute: both are tried again."""
import os
import signal
import unittest

from processes import wait_until
from slurm_sweep_case import SlurmSweepCase


class TimeLimit(SlurmSweepCase):
    def test_of_a_stopped_task_and_a_killed_one_leave_one_machines_sweep(self):
        client = self.start(":--time=1")
        stopped, late = self.a_unit_process(client)
        os.kill(stopped, signal.SIGSTOP)
        running, killed = self.a_unit_process(client, other_than=late)
        os.kill(running, signal.SIGKILL)
        for unit in (killed, late):
            wait_until(lambda unit=unit: self.tried().count(unit) == 2 or client.poll() is not None, f"{unit} is tried again")
        tried = self.tried()
        self.assertEqual((len(tried), len(set(tried))), (22, 20), "two units are tried twice")
        self.assertIn("60 of 60 configurations done", self.end(client, 0))
        self.expect_same("run")


if __name__ == "__main__":
    unittest.main(verbosity=2)
