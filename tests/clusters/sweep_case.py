"""A small sweep, and its results on one machine."""
import os
import pathlib
import subprocess
import tempfile
import unittest

GNOMON = os.environ["GNOMON"]
CSV = ("results.csv", "error_vs_z.csv", "bias_curves.csv")
JOB = 'scene.builtin = "sphere-cube"\nimage.width = 64\nimage.height = 36\n'


class SweepCase(unittest.TestCase):
    axes = ["--axis", "shadow_map.resolution=16,20,24,28,32,36", "--axis", "bias.slope=0,1",
            "--axis", "bias.constant=0,0.001,0.02"]
    job = JOB
    environment = None  # of the program

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        (self.folder / "job.toml").write_text(self.job)
        self.write_scenes()
        self.run_gnomon("sweep", "job.toml", "--out", "whole", "--no-keep-pixels", "--quiet", *self.axes)

    def write_scenes(self):
        """The files that the job names."""

    def run_gnomon(self, *arguments, code=0, environment=None):
        done = subprocess.run([GNOMON, *arguments], cwd=self.folder, capture_output=True, text=True, check=False,
                              env=environment or self.environment)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def expect_same(self, run):
        for name in CSV:
            self.assertEqual((self.folder / run / name).read_bytes(), (self.folder / "whole" / name).read_bytes(),
                             name)
