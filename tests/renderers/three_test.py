"""engines/three draws three.js's own shadows, tells what it did, and leaves nothing behind."""
import json
import math
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

import numpy
import OpenImageIO

from session import Session, export_case, here, judge

COMMAND = ["node", str(here("engines", "three", "adapter.mjs"))]
WIDTH, HEIGHT = 320, 180
SETTINGS = {"image__width": WIDTH, "image__height": HEIGHT, "lookup__filter": "nearest"}
SCENES = ("sphere-plane", "yard", "columns", "lamp-room")


def length(v):
    return math.sqrt(sum(x * x for x in v))


def map_of(description, said):
    """The map as a draw is told of it; its camera is taken from the rows of Gnomon's matrix, z of which grows along it."""
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


def pixels_of(file):
    """The channels of an EXR file by name."""
    image = OpenImageIO.ImageBuf(str(file))
    pixels = {name: image.get_pixels(OpenImageIO.FLOAT)[..., i] for i, name in enumerate(image.spec().channelnames)}
    native = image.nativespec()
    if native.channelformat(native.channelnames.index("id.geom")).basetype == OpenImageIO.UINT:
        pixels["id.geom"] = numpy.rint(pixels["id.geom"] * 2.0**32)  # OpenImageIO takes whole numbers for shares of the largest
    return pixels


class Three(unittest.TestCase):
    """A started three.js, and what it draws of built-in scenes."""
    OPTIONS = ()

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name)
        cls.cases = {name: export_case(cls.folder / name, name, **SETTINGS) for name in SCENES}
        cls.session = Session([*COMMAND, *cls.OPTIONS])
        cls.addClassCleanup(cls.session.__exit__, None)

    def frame(self, scene, engine, **objects):
        """What is answered, and the frame's folder."""
        description, said = self.cases[scene]
        opened = self.session.open(self.folder / scene / "mesh.glb", description, WIDTH, HEIGHT, **objects)
        self.assertEqual(opened, {"ok": True})
        frame = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        return self.session.draw(frame, map_of(description, said), engine), frame

    def judged(self, scene, engine, **objects):
        answer, frame = self.frame(scene, engine, **objects)
        self.assertTrue(answer.get("ok"), answer)
        description = self.cases[scene][0]
        # What the map covers is the exported case's own: rebuilt from a float32 matrix it is off by roundings.
        own = {k: v for k, v in description["shadow_map"].items() if k in ("fit", "half_extent", "fov_deg", "roll_deg", "near", "far")}
        table = {k: v for k, v in answer["case"]["shadow_map"].items() if k not in ("fit", "half_extent", "fov_deg", "roll_deg")}
        answer["case"]["shadow_map"] = {**table, **own}
        described = {"camera": description["camera"], "light": description["light"]}
        return judge(frame, self.folder / scene / "mesh.glb", described, answer, **objects)


class ThreeByWebGl(Three):
    def test_DrawsNoShadowsWhereTheyAreOff(self):
        for scene in SCENES:
            said = self.judged(scene, {"castShadow": False})
            self.assertGreater(said["pixels"]["blocked"], 1000, scene)
            self.assertEqual(said["false_lit"], said["pixels"]["blocked"], scene)
            self.assertEqual(said["false_shadow"], 0, scene)

    def test_DrawsNoShadowOfWhatDoesNotCast(self):
        for kind in ("basic", "pcf"):
            said = self.judged("sphere-plane", {"type": kind, "bias": -0.02}, no_cast=["sphere", "plane"])
            self.assertEqual(said["pixels"]["blocked"], 0)
            self.assertEqual(said["false_shadow"], 0)
        answer, _ = self.frame("sphere-plane", {"type": "vsm"}, no_cast=["sphere", "plane"])
        self.assertEqual(list(answer["error"]), ["engine.type"])

    def test_BasicIsGlsOwnShadowMapWhereBothShowTheSame(self):
        for scene in SCENES:
            bias = float.fromhex(self.cases[scene][1]["exact_inputs"]["bias_constant"])
            answer, frame = self.frame(scene, {"type": "basic", "side": "double", "bias": -bias})
            self.assertTrue(answer.get("ok"), answer)
            ours, theirs = (pixels_of(file) for file in (self.folder / scene / "aov.exr", frame / "frame.exr"))
            same = (ours["valid"] > 0) & (ours["id.geom"] == theirs["id.geom"]) & numpy.isfinite(theirs["P.X"])
            self.assertGreater(same.sum(), WIDTH * HEIGHT / 3, scene)
            differ = same & (ours["shadow.V"] != theirs["shadow.V"])
            # Both drivers snap to a sub-pixel of their own, 4 bits of one in ANGLE at the least: P moves by up to 1/16 of a
            # pixel, and the verdict may turn where a texel's border, or the edge of what a texel holds, is that near.
            self.assertLessEqual(differ.sum(), same.sum() // 1000, scene)
            shadowed = same & (ours["shadow.V"] == 0)
            self.assertGreater(shadowed.sum(), 100, scene)

    def test_ReachesEveryCauseForBasicAndForPcfWithoutARadius(self):
        for engine in ({"type": "basic"}, {"type": "pcf", "radius": 0}, {"type": "basic", "normalBias": 0.02}):
            said = self.judged("sphere-plane", {"side": "double", "bias": -0.001, **engine})
            self.assertEqual(said["evaluate"]["cannot_know"], [], engine)
            self.assertEqual(sum(said["causes"].values()), said["false_shadow"] + said["false_lit"])
            self.assertIn(said["evaluate"]["contradicted_pixels"], (0, None), engine)

    def test_NormalBiasLetsLightInByTheBias(self):
        said = self.judged("sphere-plane", {"type": "basic", "side": "double", "bias": -0.001, "normalBias": 0.1})
        self.assertGreater(said["causes"]["bias"], 0)

    def test_SidesCastAsThreeHasIt(self):
        # Of front faces the map holds the back ones, which need no bias; with both, what is lit shadows itself.
        front = self.judged("sphere-plane", {"type": "pcf", "side": "front"})
        double = self.judged("sphere-plane", {"type": "pcf", "side": "double"})
        self.assertLess(front["false_shadow"], front["pixels"]["lit"] / 100)
        self.assertGreater(double["false_shadow"], double["pixels"]["lit"] / 4)

    def test_RefusesByKeyWhatThreeDoesNotHave(self):
        description, said = self.cases["lamp-room"]
        self.session.open(self.folder / "lamp-room" / "mesh.glb", description, WIDTH, HEIGHT)
        answer = self.session.draw(self.folder / "refused", {**map_of(description, said), "reversed": True}, {"type": "vsm"},
                                   lookup={"filter": "pcf9", "wrong": 1}, bias={"slope": 0.1}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.slope", "engine.type", "lookup.filter", "lookup.wrong", "method.name",
                                                   "shadow_map.reversed"])

    def test_EqualRequestsGiveEqualFramesWhateverCameBetween(self):
        frames = []
        for engine in ({"type": "pcf"}, {"type": "vsm", "blurSamples": 25}, {"type": "basic", "side": "back"}, {"type": "pcf"}):
            frames.append((self.frame("sphere-plane", engine)[1] / "frame.exr").read_bytes())
        self.assertEqual(frames[0], frames[3])
        self.assertNotEqual(frames[0], frames[1])


class ThreeByWebGpu(Three):
    """The same scenes by the other renderer, of which the mask is known alone."""
    OPTIONS = ("--api=webgpu",)

    def test_DrawsNoShadowsWhereTheyAreOff(self):
        for scene in SCENES:
            said = self.judged(scene, {"castShadow": False})
            self.assertEqual(said["false_lit"], said["pixels"]["blocked"], scene)
            self.assertEqual(said["false_shadow"], 0, scene)

    def test_BasicIsNearlyTrueUnderEveryLight(self):
        for scene in SCENES:
            said = self.judged(scene, {"type": "basic", "bias": -0.001})
            self.assertLess(said["false_shadow"], said["pixels"]["lit"] / 50, scene)
            self.assertLess(said["false_lit"], said["pixels"]["blocked"] / 10, scene)  # a light elsewhere: about all


class ThreesEnd(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def start(self, **environment):
        process = subprocess.Popen(COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
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
        self.assertNotEqual(self.browsers(), [])
        return process

    def browsers(self):
        """The processes whose arguments name the folder."""
        found = []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if str(self.folder).encode() in (entry / "cmdline").read_bytes():
                    found.append(int(entry.name))
            except OSError:
                continue
        return sorted(found)

    def expect_nothing_left(self):
        for _ in range(100):
            if not self.browsers() and not list(self.folder.iterdir()):
                return
            time.sleep(0.05)
        self.fail(f"left: processes {self.browsers()}, files {list(self.folder.iterdir())}")

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

    def test_OfChromiumIsSaid(self):
        process = self.started()
        started = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True)
        os.kill(int(started.stdout.split()[0]), 9)
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), r"^three: Chromium")
        self.expect_nothing_left()

    def test_OfARequestThatIsNoJsonIsSaid(self):
        process = self.started()
        process.stdin.write("draw!\n")
        process.stdin.flush()
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), r"^three: .*JSON")
        self.expect_nothing_left()

    def test_WithoutChromiumNamesTheRemedy(self):
        process = self.start(CHROMIUM="/nonexistent/chromium")
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertIn("apt-get install chromium", process.stderr.read())


if __name__ == "__main__":
    unittest.main()
