"""How engines in a headless Chromium end, beyond what holds for all engines."""
import json
import os
import pathlib
import subprocess
import tempfile

from driven import EndsCleanly, map_of
from session import Session


def descendants(pid):
    """A process and its descendants."""
    parents = {}
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
        except OSError:
            continue
        parents.setdefault(parent, []).append(int(entry.name))
    found = [pid]
    for process in found:
        found += parents.get(process, [])
    return found


class EndsWithItsDevice:
    """A mixin of DrivenEngine: a crash of the graphics process between two frames is no refusal."""

    def test_OfALostDeviceIsTheEnginesEnd(self):
        scene = self.SCENES[0]
        description, said = self.cases[scene]
        session = Session(self.COMMAND)
        self.addCleanup(session.process.stdout.close)
        self.addCleanup(session.process.stdin.close)
        self.addCleanup(session.process.wait)
        self.addCleanup(session.process.kill)
        size = self.SETTINGS["image__width"], self.SETTINGS["image__height"]
        self.assertTrue(session.open(self.folder / scene / "mesh.glb", description, *size).get("ok"))
        frame = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        self.assertTrue(session.draw(frame, map_of(description, said)).get("ok"))
        graphics = [pid for pid in descendants(session.process.pid)
                    if b"--type=gpu-process" in pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()]
        self.assertEqual(len(graphics), 1)
        os.kill(graphics[0], 9)
        with self.assertRaises(json.JSONDecodeError):  # the end of its output
            session.draw(frame, map_of(description, said))
        self.assertEqual(session.process.wait(timeout=15), 1)


class EndsWithChromium(EndsCleanly):
    """A mixin of TestCase."""

    def test_OfChromiumIsSaid(self):
        process = self.started()
        started = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True)
        os.kill(int(started.stdout.split()[0]), 9)
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), f"^{self.NAME}: Chromium")
        self.expect_nothing_left()

    def test_WithoutChromiumNamesTheRemedy(self):
        process = self.start(CHROMIUM="/nonexistent/chromium")
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertIn("apt-get install chromium", process.stderr.read())

    def test_OfAnUnknownOptionNamesTheKnownOnes(self):
        result = subprocess.run([*self.COMMAND, "--rasterizer=none"], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=10, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("--rasterizer=system|swiftshader", result.stderr)
