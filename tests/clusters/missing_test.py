"""Where a cluster's programs are not installed, its driver says in one line what to install."""
import json
import subprocess
import sys
import unittest

from processes import ROOT


class WithoutACluster(unittest.TestCase):
    def said(self, driver, cluster):
        # -S: without Debian's Python packages; PATH: without its programs
        done = subprocess.run(
            [sys.executable, "-B", "-S", str(ROOT / "clusters" / driver), cluster, "plan", "folder", "gnomon"],
            input="\n", capture_output=True, text=True, check=False, env={"PATH": "/nonexistent"})
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_dask_is_named(self):
        self.assertEqual(self.said("dask_driver.py", "local:2"),
                         [{"error": "Dask is not installed: apt-get install python3-distributed"}])

    def test_slurm_is_named(self):
        self.assertEqual(self.said("slurm_driver.py", "slurm"),
                         [{"error": "Slurm is not installed (sbatch is missing): apt-get install slurm-wlm"}])


if __name__ == "__main__":
    unittest.main(verbosity=2)
