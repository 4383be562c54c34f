"""engines/three draws three.js's own shadows, reports what it did, and leaves nothing behind."""
import unittest

import numpy
import OpenImageIO

from chromium import EndsWithChromium, EndsWithItsDevice
from driven import DrivenEngine, map_of
from own_picture import OwnPicture
from session import here
from translated_settings import TranslatedSettings

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
        pixels["id.geom"] = numpy.rint(pixels["id.geom"] * 2.0**32)  # OpenImageIO maps integers to [0, 1]
    return pixels


class Three(DrivenEngine):
    """three.js by one of its renderers."""
    COMMAND = COMMAND
    SCENES = SCENES
    SETTINGS = SETTINGS


class ThreeByWebGl(EndsWithItsDevice, OwnPicture, Three):
    PICTURED = {"sphere-plane": {}, "columns": {"type": "vsm"}, "lamp-room": {}}
    UNLIKE = {"type": "basic", "bias": -0.01}

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

    def test_ReachesEveryCauseForBasicAndPcf(self):
        for engine in ({"type": "basic"}, {"type": "pcf", "radius": 0}, {"type": "basic", "normalBias": 0.02}, {"type": "pcf"},
                       {"type": "pcf", "radius": 2.5, "normalBias": 0.02}):
            said = self.judged("sphere-plane", {"side": "double", "bias": -0.001, **engine})
            self.assertEqual(said["evaluate"]["cannot_know"], [], engine)
            self.assertEqual(sum(said["causes"].values()), said["false_shadow"] + said["false_lit"])
            self.assertIn(said["evaluate"]["contradicted_pixels"], (0, None), engine)
            self.assertIsNotNone(said["bias_curve"], engine)

    def test_NormalBiasLetsLightInByTheBias(self):
        said = self.judged("sphere-plane", {"type": "basic", "side": "double", "bias": -0.001, "normalBias": 0.1})
        self.assertGreater(said["causes"]["bias"], 0)

    def test_SidesCastAsThreeHasIt(self):
        # Front faces cast by their back faces, which need no bias. With both sides, lit faces shadow themselves.
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


def slope_of(channel, objects):
    """The largest change of a channel to a neighbour that shows the same object, ignoring NaN."""
    most = numpy.zeros(channel.shape)
    for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):
        change = numpy.abs(numpy.roll(channel, step, axis) - channel)
        change[numpy.roll(objects, step, axis) != objects] = 0
        most = numpy.fmax(most, change)
    return most


class BasicByWebGl(Three):
    """Basic shadows equal Gnomon's with the same near, far, bias and culling, pixel by pixel."""
    SCENES = ("sphere-plane", "yard", "columns")
    SETTINGS = {"image__width": 1280, "image__height": 720, "lookup__filter": "nearest"}

    # Vertices are snapped to 1/16 of a pixel at the coarsest, and to 1/256 in Gnomon's image: a surface moves by half of each
    # along either axis. Slopes between pixels are doubled for curved surfaces.
    SNAPPED = 2 * 2 * (1 / 32 + 1 / 512)
    ROUNDED = 2.0**-20  # of depths: some roundings of a clip position and a division

    def compared(self, scene, factor=1):
        """The bias, both images' channels, where they show the same object, and where their masks differ there.

        factor: scales three.js's bias.
        """
        bias = float.fromhex(self.cases[scene][1]["exact_inputs"]["bias_constant"])
        answer, frame = self.frame(scene, {"type": "basic", "side": "double", "bias": -bias * factor})
        self.assertTrue(answer.get("ok"), answer)
        ours, theirs = (pixels_of(file) for file in (self.folder / scene / "aov.exr", frame / "frame.exr"))
        same = (ours["valid"] > 0) & (ours["id.geom"] == theirs["id.geom"]) & numpy.isfinite(theirs["P.X"])
        return bias, ours, theirs, same, same & (ours["shadow.V"] != theirs["shadow.V"])

    def unexplained(self, bias, ours, theirs, differ):
        """The number of pixels that lie neither near a texel's border nor near the depth that changes the verdict."""
        objects = ours["id.geom"]
        texel_slope = slope_of(ours["texel.X"], objects) + slope_of(ours["texel.Y"], objects)
        depth_slope = slope_of(ours["z.light"], objects)
        other_texel = sum(numpy.floor(ours[c]) != numpy.floor(theirs[c]) for c in ("texel.X", "texel.Y")) > 0
        apart = sum(numpy.abs(ours[c] - theirs[c]) for c in ("texel.X", "texel.Y"))
        near_border = other_texel & (apart <= self.SNAPPED * texel_slope + 2.0**-12)
        margin = numpy.abs(ours["z.light"] - bias - ours["z.map"])
        near_turn = ~other_texel & (margin <= self.SNAPPED * depth_slope + self.ROUNDED)
        return int((differ & ~near_border & ~near_turn).sum())

    def test_IsTheSameOrItsRoundingSaysWhyNot(self):
        for scene in self.SCENES:
            bias, ours, theirs, same, differ = self.compared(scene)
            self.assertGreater(same.sum(), 1280 * 720 / 3, scene)
            self.assertGreater((same & (ours["shadow.V"] == 0)).sum(), 1000, scene)
            self.assertLessEqual(differ.sum(), same.sum() // 1000, scene)
            self.assertEqual(self.unexplained(bias, ours, theirs, differ), 0, scene)

    def test_IsNotExplainedByRoundingWithAnotherBias(self):
        bias, ours, theirs, _, differ = self.compared("sphere-plane", factor=0.5)
        self.assertGreater(self.unexplained(bias, ours, theirs, differ), 100)


class ThreeByWebGpu(OwnPicture, Three):
    """The other renderer, which gives the mask alone."""
    COMMAND = [*COMMAND, "--api=webgpu"]
    PICTURED = {"sphere-plane": {}}
    UNLIKE = {"type": "basic", "bias": -0.01}

    def test_DrawsNoShadowsWhereTheyAreOff(self):
        for scene in SCENES:
            said = self.judged(scene, {"castShadow": False})
            self.assertEqual(said["false_lit"], said["pixels"]["blocked"], scene)
            self.assertEqual(said["false_shadow"], 0, scene)

    def test_BasicIsNearlyTrueUnderEveryLight(self):
        for scene in SCENES:
            said = self.judged(scene, {"type": "basic", "bias": -0.001})
            self.assertLess(said["false_shadow"], said["pixels"]["lit"] / 50, scene)
            self.assertLess(said["false_lit"], said["pixels"]["blocked"] / 10, scene)  # a misplaced light gives about 1


class ThreesEnd(EndsWithChromium, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "three"


class TranslatedForThree(TranslatedSettings, unittest.TestCase):
    COMMAND = COMMAND
    ENGINE = "three"
    TRANSLATED = [(scene, {"lookup.filter": "hardware", "shadow_map.cull": "none"}, {"side": "double", "radius": 0})
                  for scene in ("sphere-plane", "yard", "columns", "terrain")]

    @staticmethod
    def engine_keys(values):
        return {"bias": values["light.shadow.bias"], "normalBias": values["light.shadow.normalBias"]}


if __name__ == "__main__":
    unittest.main()
