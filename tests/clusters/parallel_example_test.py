"""examples/clusters/parallel.sh makes one machine's sweep, though a unit was killed, and says what is missing."""
import os
import subprocess
import unittest

from processes import ROOT
from sweep_case import GNOMON, JOB, SweepCase

AXES = '[sweep]\nshadow_map.resolution = [16, 24, 32]\nbias.constant = [0, 0.001, 0.02]\n'
# Is killed at the second unit, the first time or always.
WRAPPER = """#!/bin/sh
echo "$@" >>"{folder}/log"
if [ "$1 $3" = "run-unit 2" ] && {{ [ -n "$ALWAYS" ] || [ "$(grep -c ' 2 --out' "{folder}/log")" = 1 ]; }}; then
    kill -9 $$
fi
exec "{program}" "$@"
"""


class Parallel(SweepCase):
    axes = []
    job = JOB + AXES

    def setUp(self):
        super().setUp()
        self.wrapper = self.folder / "a program"
        self.wrapper.write_text(WRAPPER.format(folder=self.folder, program=GNOMON))
        self.wrapper.chmod(0o755)

    def run_example(self, **variables):
        return subprocess.run(
            [ROOT / "examples/clusters/parallel.sh", "job.toml", "a run", "--jobs", "2"], cwd=self.folder, text=True,
            capture_output=True, check=False, env=dict(os.environ, GNOMON=str(self.wrapper), UNITS="3", **variables))

    def test_tries_again_what_was_killed(self):
        done = self.run_example()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_same("a run")

    def test_says_what_is_missing_and_goes_on(self):
        done = self.run_example(ALWAYS="1")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("1 of 3 units are missing", done.stderr)
        again = self.run_example()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.expect_same("a run")


if __name__ == "__main__":
    unittest.main(verbosity=2)
