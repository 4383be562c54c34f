"""Base classes of the tests of driven engines: a started engine with built-in scenes, and how an engine must end."""
import json
import math
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

from session import Session, export_case, judge


def length(v):
    return math.sqrt(sum(x * x for x in v))


def map_of(description, said):
    """The `shadow_map` table of a draw request. Its camera follows from the rows of Gnomon's matrix."""
    exact = said["exact_inputs"]
    near, far = (float.fromhex(exact[name]) for name in ("near", "far"))
    table = {"resolution": description["shadow_map"]["resolution"], "near": near, "far": far}
    if description["light"]["type"] == "point":
        return table
    m = [float.fromhex(x) for x in exact["light_clip_from_world"]]
    rows = [m[i:i + 4] for i in (0, 4, 8, 12)]
    sizes = [length(row[:3]) for row in rows]
    right, up, forward = ([x / sizes[i] for x in rows[i][:3]] for i in range(3))
    half = [1 / sizes[0], 1 / sizes[1]]
    if description["light"]["type"] == "spot":
        half = [h * sizes[3] for h in half]
        forward = [x / sizes[3] for x in rows[3][:3]]
        position = description["light"]["position"]
        table["vertical_fov_deg"] = 2 * math.degrees(math.atan(half[1]))
    else:
        along = ((-2 * near) / (far - near) - 1 - rows[2][3]) / sizes[2]
        ways = zip((right, up, forward), (-rows[0][3] / sizes[0], -rows[1][3] / sizes[1], along))
        position = [sum(p) for p in zip(*([x * k for x in way] for way, k in ways))]
        table["half_extent"] = max(half)
    table["light_clip_from_world"] = m
    table["light_camera"] = {"projection": "perspective" if description["light"]["type"] == "spot" else "orthographic",
                             "position": position, "forward": forward, "up": up,
                             "left": -half[0], "right": half[0], "bottom": -half[1], "top": half[1]}
    return table


class DrivenEngine(unittest.TestCase):
    """A started engine that draws built-in scenes. A subclass sets what is None here."""
    COMMAND = None
    SCENES = None
    SETTINGS = None  # of the cases, for `export_case`; they include the image's size

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        cls.cases = {name: export_case(cls.folder / name, name, **cls.SETTINGS) for name in cls.SCENES}
        cls.session = Session(cls.COMMAND)
        cls.addClassCleanup(cls.session.__exit__, None)

    def open(self, scene, **objects):
        """The answer to opening a built-in scene."""
        size = self.SETTINGS["image__width"], self.SETTINGS["image__height"]
        return self.session.open(self.folder / scene / "mesh.glb", self.cases[scene][0], *size, **objects)

    def frame(self, scene, engine, **objects):
        """The answer to a draw request, and the frame's folder."""
        opened = self.open(scene, **objects)
        self.assertTrue(opened.get("ok"), opened)
        frame = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        return self.session.draw(frame, map_of(*self.cases[scene]), engine), frame

    def judged(self, scene, engine, **objects):
        """Gnomon's evaluation of a frame."""
        answer, frame = self.frame(scene, engine, **objects)
        self.assertTrue(answer.get("ok"), answer)
        description = self.cases[scene][0]
        # The exported case says what the map covers; the float32 matrix would give it with rounding errors.
        own = {k: v for k, v in description["shadow_map"].items() if k in ("fit", "half_extent", "fov_deg", "roll_deg", "near", "far")}
        table = {k: v for k, v in answer["case"]["shadow_map"].items() if k not in ("fit", "half_extent", "fov_deg", "roll_deg")}
        answer["case"]["shadow_map"] = {**table, **own}
        described = {"camera": description["camera"], "light": description["light"]}
        return judge(frame, self.folder / scene / "mesh.glb", described, answer, **objects)


class Fairness:
    """A mixin of DrivenEngine: what must hold of an adapter before errors count as its engine's."""
    SHADOWS_OFF = None
    OTHER = None  # settings that give another frame than the defaults

    def test_DrawsNoShadowsWhereTheyAreOff(self):
        for scene in self.SCENES:
            said = self.judged(scene, self.SHADOWS_OFF)
            self.assertGreater(said["pixels"]["blocked"], 1000, scene)
            self.assertEqual(said["false_lit"], said["pixels"]["blocked"], scene)
            self.assertEqual(said["false_shadow"], 0, scene)

    def test_DrawsNoShadowOfWhatDoesNotCast(self):
        said = self.judged("sphere-plane", {}, no_cast=["sphere", "plane"])
        self.assertEqual(said["pixels"]["blocked"], 0)
        self.assertEqual(said["false_shadow"], 0)

    def test_LeavesOutWhatIsNotSeenAndCastsItsShadow(self):
        said = self.judged("sphere-plane", {}, no_receive=["sphere"])
        self.assertEqual([one["object"] for one in said["by_object"] if one["lit"] + one["blocked"] > 0], ["plane"])
        self.assertGreater(said["pixels"]["blocked"], 1000)
        self.assertLess(said["false_lit"], said["pixels"]["blocked"] / 2)

    def test_ShowsPointsOfTheMesh(self):
        for scene in self.SCENES:
            distance = self.judged(scene, {})["evaluate"]["import_check"]["distance_m"]
            # At 40 m, the end of the scenes, float32 has steps of 4e-6 m. Interpolation errs by a few of them.
            self.assertLess(distance["p99"], 2e-5, scene)

    def test_EqualRequestsGiveEqualFramesWhateverCameBetween(self):
        frames = []
        for scene, engine in (("sphere-plane", {}), ("yard", {}), ("sphere-plane", self.OTHER), ("sphere-plane", {})):
            answer, frame = self.frame(scene, engine)
            frames.append([(frame / file).read_bytes() for file in answer["files"].values()])
        self.assertEqual(frames[0], frames[3])
        self.assertNotEqual(frames[0], frames[2])


class EndsCleanly:
    """A mixin of TestCase: how an engine ends, in a folder that must be empty afterwards."""
    COMMAND = None
    NAME = None  # its messages begin with it
    STARTS_PROCESSES = True  # further ones

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def start(self, **environment):
        process = subprocess.Popen(self.COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "TMPDIR": str(self.folder), **environment})
        self.addCleanup(lambda: [stream.close() for stream in (process.stdin, process.stdout, process.stderr)])
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def started(self):
        process = self.start()
        process.stdin.write('{"id": 1, "hello": 1}\n')
        process.stdin.flush()
        self.assertEqual(json.loads(process.stdout.readline())["id"], 1)
        self.assertEqual(self.processes() != [process.pid], self.STARTS_PROCESSES)
        return process

    def processes(self):
        """The processes whose arguments or environment name the folder."""
        found = []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if str(self.folder).encode() in (entry / "cmdline").read_bytes() + (entry / "environ").read_bytes():
                    found.append(int(entry.name))
            except OSError:
                continue
        return sorted(found)

    def expect_nothing_left(self):
        for _ in range(100):
            if not self.processes() and not list(self.folder.iterdir()):
                return
            time.sleep(0.05)
        self.fail(f"left: processes {self.processes()}, files {list(self.folder.iterdir())}")

    def test_WithItsInputLeavesNothing(self):
        process = self.started()
        process.stdin.close()
        self.assertEqual(process.wait(timeout=10), 0)
        self.expect_nothing_left()

    def test_BySignalLeavesNothing(self):
        process = self.started()
        process.terminate()
        self.assertEqual(process.wait(timeout=10), 1)
        self.expect_nothing_left()

    def test_OfARequestThatIsNoJsonIsSaid(self):
        process = self.started()
        process.stdin.write("draw!\n")
        process.stdin.flush()
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), f"(?m)^{self.NAME}: .*JSON")
        self.expect_nothing_left()


class EndsWithItsDisplay(EndsCleanly):
    """For adapters that start an X server."""

    def test_OfItsDisplayLeavesNothing(self):
        process = self.started()
        process.kill()
        process.wait()
        self.expect_nothing_left()

    def test_WithoutXvfbNamesTheRemedy(self):
        ended = subprocess.run(self.COMMAND, capture_output=True, text=True, check=False, env={**os.environ, "PATH": "/nonexistent"})
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stderr, f"^{self.NAME}: Xvfb does not start; is it installed")
