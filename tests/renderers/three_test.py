"""engines/three draws three.js's own shadows, tells what it did, and leaves nothing behind."""
import os
import subprocess
import unittest

import numpy
import OpenImageIO

from driven import DrivenEngine, EndsCleanly, map_of
from session import here

COMMAND = ["node", str(here("engines", "three", "adapter.mjs"))]
WIDTH, HEIGHT = 320, 180
SETTINGS = {"image__width": WIDTH, "image__height": HEIGHT, "lookup__filter": "nearest"}
SCENES = ("sphere-plane", "yard", "columns", "lamp-room")


def pixels_of(file):
    """The channels of an EXR file by name."""
    image = OpenImageIO.ImageBuf(str(file))
    pixels = {name: image.get_pixels(OpenImageIO.FLOAT)[..., i] for i, name in enumerate(image.spec().channelnames)}
    native = image.nativespec()
    if native.channelformat(native.channelnames.index("id.geom")).basetype == OpenImageIO.UINT:
        pixels["id.geom"] = numpy.rint(pixels["id.geom"] * 2.0**32)  # OpenImageIO takes whole numbers for shares of the largest
    return pixels


class Three(DrivenEngine):
    """three.js by one of its renderers."""
    COMMAND = COMMAND
    SCENES = SCENES
    SETTINGS = SETTINGS


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
    COMMAND = [*COMMAND, "--api=webgpu"]

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


class ThreesEnd(EndsCleanly, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "three"

    def test_OfChromiumIsSaid(self):
        process = self.started()
        started = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True)
        os.kill(int(started.stdout.split()[0]), 9)
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), r"^three: Chromium")
        self.expect_nothing_left()

    def test_WithoutChromiumNamesTheRemedy(self):
        process = self.start(CHROMIUM="/nonexistent/chromium")
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertIn("apt-get install chromium", process.stderr.read())


if __name__ == "__main__":
    unittest.main()
