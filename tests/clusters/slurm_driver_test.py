"""clusters/slurm_driver.py submits units, tries again, follows what runs, and cancels it. A fake program computes them."""
import os
import tempfile
import unittest

from driver_case import DriverCase
from processes import PATIENCE_S, wait_until
from slurm_cluster import Slurm

# Refuses arrays of more than two tasks, like a cluster with a limit for each user.
FUSSY_SBATCH = """#!/bin/sh
for word; do
    case $word in
        --array=1-[12]) exec /usr/bin/sbatch "$@" ;;
    esac
done
echo "sbatch: error: AssocMaxSubmitJobLimit" >&2
exit 1
"""


class SlurmDriver(DriverCase):
    script = "slurm_driver.py"

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        cls.slurm = Slurm(cls.place.name, processors=1, most_tasks=4, kill_wait_s=2)
        cls.addClassCleanup(cls.slurm.stop)

    def setUp(self):
        super().setUp()
        self.addCleanup(self.slurm.cancel_all)

    def start_slurm(self, units, *options, cluster="slurm", **variables):
        environment = dict(self.slurm.environment, FAKE_LOG=str(self.folder / "log"), **variables)
        return self.start(cluster, units, *options, environment=environment)

    def done(self, events):
        return sorted(event["unit"] for event in events if "unit" in event)

    def arrays(self):
        return [path.read_text().split() for path in (self.units / "slurm").glob("*.units")]

    def test_computes_each_unit_once_the_longest_first_in_arrays_as_long_as_they_may_be(self):
        units = {f"u{i}": i for i in range(5)}
        driver = self.start_slurm(units)
        events = self.events(driver)
        self.assertEqual(driver.returncode, 0, events)
        self.assertEqual(self.computed(), ["u4", "u3", "u2", "u1", "u0"])
        self.assertEqual(sorted(self.arrays()), [["u1", "u0"], ["u4", "u3", "u2"]])  # MaxArraySize is 4
        self.assertEqual(self.done(events), sorted(units))
        self.assertRegex(events[0]["worker"], r"^Slurm's \S+$")
        for name in units:
            self.assertEqual((self.units / f"{name}.unit").read_text(), f"bytes of {name}")
        self.assertEqual(list((self.units / "slurm").glob("*.log")), [])

    def test_tries_again_what_was_killed_and_says_what_fails_three_times(self):
        driver = self.start_slurm({"dies-a": 3, "bad-b": 2, "c": 1})
        events = self.events(driver)
        self.assertEqual(driver.returncode, 0, events)
        self.assertEqual(self.done(events), ["c", "dies-a"])
        failed = [event for event in events if "failed" in event]
        self.assertEqual([event["failed"] for event in failed], ["bad-b"])
        self.assertRegex(failed[0]["message"], r"tried 3 times.*ended as FAILED on .*this unit is bad")
        self.assertEqual(sorted(self.computed()), ["bad-b"] * 3 + ["c"] + ["dies-a"] * 2)

    def test_cancels_its_tasks_when_its_input_ends(self):
        driver = self.start_slurm({"slow-3000": 2, "slow-3001": 1})
        wait_until(self.computed, "a unit has begun")
        driver.stdin.close()
        self.assertEqual(driver.wait(PATIENCE_S), 0)
        self.assertEqual(self.slurm.tasks(), [])
        self.assertEqual(list(self.units.glob("*.unit")), [])

    def test_follows_what_a_killed_one_submitted_and_outlives_the_controller(self):
        units = {"slow-60": 2, "slow-1": 1}
        driver = self.start_slurm(units)
        wait_until(self.computed, "a unit has begun")
        driver.kill()
        driver.wait()
        again = self.start_slurm(units)
        self.slurm.restart_controller()
        events = self.events(again)
        self.assertEqual(again.returncode, 0, events)
        self.assertEqual(self.done(events), sorted(units))
        self.assertEqual(sorted(self.computed()), sorted(units))
        self.assertEqual(len(self.arrays()), 1)

    def test_takes_what_came_while_it_was_away_and_cancels_what_was_of_another_plan(self):
        driver = self.start_slurm({"slow-3000": 1})
        wait_until(self.computed, "a unit has begun")
        driver.kill()
        driver.wait()
        place = self.units / "slurm"
        (list_file,) = place.glob("*.units")
        list_file.unlink()
        (place / "00000000.units").write_text("early\n")
        (place / "early.unit").write_text("bytes of early")
        events = self.events(self.start_slurm({"early": 2, "late": 1}))
        self.assertEqual(self.done(events), ["early", "late"])
        self.assertEqual(sorted(self.computed()), ["late", "slow-3000"])
        self.assertEqual((self.units / "early.unit").read_text(), "bytes of early")

    def test_does_not_submit_again_what_somebody_cancelled(self):
        driver = self.start_slurm({"slow-3000": 1})
        wait_until(self.computed, "the unit has begun")
        self.slurm.cancel_all()
        events = self.events(driver)
        self.assertEqual([event["failed"] for event in events], ["slow-3000"])
        self.assertIn("its task was cancelled", events[0]["message"])
        self.assertEqual(self.computed(), ["slow-3000"])

    def test_submits_fewer_at_a_time_where_a_user_may_have_fewer(self):
        programs = self.folder / "bin"
        programs.mkdir()
        (programs / "sbatch").write_text(FUSSY_SBATCH)
        (programs / "sbatch").chmod(0o755)
        driver = self.start_slurm({"a": 3, "b": 2, "c": 1}, PATH=f"{programs}:{os.environ['PATH']}")
        events = self.events(driver)
        self.assertEqual(self.done(events), ["a", "b", "c"], events)
        self.assertEqual(sorted(map(len, self.arrays())), [1, 1, 1])

    def test_gives_sbatch_its_options_and_says_what_it_refuses(self):
        driver = self.start_slurm({"a": 1}, cluster="slurm:--partition=none")
        events = self.events(driver)
        self.assertEqual(driver.returncode, 1)
        self.assertRegex(events[0]["error"], r"^sbatch: .*[Ii]nvalid partition")
        self.assertEqual(self.arrays(), [])
        allowed = self.start_slurm({"a": 1}, cluster="slurm:--partition=main --nice=5")
        self.assertEqual(self.done(self.events(allowed)), ["a"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
