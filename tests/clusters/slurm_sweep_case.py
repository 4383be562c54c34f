"""A small sweep by the tasks of a Slurm of one node."""
import pathlib
import subprocess
import tempfile

from processes import PATIENCE_S, wait_until, words_of
from slurm_cluster import Slurm
from sweep_case import GNOMON, SweepCase


class SlurmSweepCase(SweepCase):
    # 20 bias curves, which are 20 units at most
    axes = ["--axis", "shadow_map.resolution=16,18,20,22,24,26,28,30,32,36", "--axis", "bias.slope=0,1",
            "--axis", "bias.constant=0,0.001,0.02"]

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.place.cleanup)
        cls.slurm = Slurm(cls.place.name, processors=2, kill_wait_s=2)
        cls.addClassCleanup(cls.slurm.stop)
        cls.environment = cls.slurm.environment

    def setUp(self):
        super().setUp()
        self.addCleanup(self.slurm.cancel_all)

    def sweep_on(self, options=""):
        return ["sweep", "job.toml", "--out", "run", "--on", "slurm" + options, "--units", "20", *self.axes]

    def start(self, *options):
        client = subprocess.Popen([GNOMON, *self.sweep_on(*options), "--quiet"], cwd=self.folder,
                                  env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(client.kill)
        return client

    def end(self, client, code):
        said, words = client.communicate(timeout=PATIENCE_S)
        self.assertEqual(client.returncode, code, words)
        return said + words

    def unit_processes(self):
        """The processes that compute units of this run."""
        mine = str(self.folder.resolve())
        found = {}
        for entry in pathlib.Path("/proc").iterdir():
            words = words_of(entry.name) if entry.name.isdigit() else []
            if words[1:2] == ["run-unit"] and words[2].startswith(mine):
                found[int(entry.name)] = words[3]
        return found

    def a_unit_process(self, client, other_than=None):
        """The process and the name of a running unit."""
        found = {}

        def has_begun():
            found.update((pid, unit) for pid, unit in self.unit_processes().items() if unit != other_than)
            return found or client.poll() is not None

        wait_until(has_begun, "a unit has begun")
        self.assertTrue(found, "the sweep ended before a unit was seen")
        return next(iter(found.items()))

    def tried(self):
        """The units of all submitted arrays."""
        return [unit for path in (self.folder / "run" / "units" / "slurm").glob("*.units")
                for unit in path.read_text().split()]
