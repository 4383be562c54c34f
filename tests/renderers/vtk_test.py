"""engines/vtk draws vtkShadowMapPass's own shadows, reports what it did, and leaves nothing behind."""
import math
import unittest

import numpy

from driven import DrivenEngine, EndsCleanly, Fairness, map_of
from own_picture import OwnPicture
from session import here

COMMAND = ["/usr/bin/python3", "-B", str(here("engines", "vtk", "adapter.py"))]
SETTINGS = {"image__width": 320, "image__height": 180, "shadow_map__resolution": 512}


class Vtk(OwnPicture, Fairness, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard")
    SETTINGS = SETTINGS
    SHADOWS_OFF = {"ShadowMapPass": False}
    OTHER = {"Window": "square"}
    PICTURED = {"sphere-plane": {}, "yard": OTHER}
    UNLIKE = OTHER

    def test_ShadowOfASphereLiesWhereItMustInASquareWindow(self):
        said = self.judged("sphere-plane", {"Window": "square"})
        # The shadow's border is some 300 pixels long. Linearly mixed exponentials cross a half up to a texel, here a third of a
        # pixel, beside it. A shadow that is displaced by a pixel would have some 300 wrong pixels.
        self.assertGreater(said["pixels"]["blocked"], 5000)
        self.assertLess(said["false_shadow"] + said["false_lit"], 100)

    def test_MapIsSqueezedByTheWindowsAspect(self):
        said = self.judged("sphere-plane", {})
        self.assertAlmostEqual(said["false_shadow_rate"], 0.18, delta=0.02)  # as on the README's page, in a larger image
        self.assertAlmostEqual(said["false_lit_rate"], 0.33, delta=0.02)

    def test_ShadowsFadeTowardsWhatCastsThem(self):
        # exp(-11 x) is above a half up to x = ln 2 / 11, 6.3 % of the map's depth range: 2.4 m in the yard.
        said = self.judged("yard", {"Window": "square"})
        self.assertGreater(said["false_lit"], said["pixels"]["blocked"] / 8)
        self.assertLess(said["evaluate"]["false_lit_gap_m"]["median"], 2.4)
        self.assertLess(said["false_shadow"], said["pixels"]["lit"] / 1000)

    def test_AttenuationIsTheShadowsShare(self):
        whole, half = (self.frame("sphere-plane", {"ShadowAttenuation": share})[1] for share in (1, 0.5))
        whole, half = (numpy.load(frame / "shadow.npy") for frame in (whole, half))
        shows = numpy.isfinite(numpy.load(self.frame("sphere-plane", {})[1] / "position.npy")).all(2)
        self.assertLess(abs(half - (whole + 1) / 2)[shows].max(), 1e-6)  # a rounding or two of float32

    def test_TellsNearAndFarOfItsOwnMap(self):
        description, _ = self.cases["sphere-plane"]
        answer, frame = self.frame("sphere-plane", {"Window": "square"})
        table = answer["case"]["shadow_map"]
        axis = numpy.subtract(description["light"]["target"], description["light"]["position"])
        shown = numpy.load(frame / "position.npy").reshape(-1, 3)
        shown = shown[numpy.isfinite(shown).all(1)] - description["light"]["position"]
        ways = shown @ axis / math.sqrt(axis @ axis)
        self.assertLess(table["near"], ways.min())
        self.assertGreater(table["far"], ways.max())

    def test_RefusesByKeyWhatVtkDoesNotHave(self):
        self.open("sphere-plane")
        shadow_map = {**map_of(*self.cases["sphere-plane"]), "reversed": True, "depth_format": "d16"}
        answer = self.session.draw(self.folder / "refused", shadow_map, {"no": 1}, lookup={"filter": "nearest"},
                                   bias={"constant": 0, "slope": 0.1}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.slope", "engine.no", "lookup.filter", "method.name", "shadow_map.depth_format",
                                                   "shadow_map.reversed"])

    def test_RefusesAPointLight(self):
        description = {**self.cases["sphere-plane"][0], "light": {"type": "point", "position": [0, 5, 0]}}
        answer = self.session.open(self.folder / "sphere-plane" / "mesh.glb", description, 320, 180)
        self.assertRegex(answer["error"], "cone angle")


class VtkBySoftpipe(DrivenEngine):
    """Mesa's other rasterizer gives equal errors, so they are VTK's."""
    COMMAND = [*COMMAND, "--rasterizer=softpipe"]
    SCENES = ("sphere-plane",)
    SETTINGS = SETTINGS

    def test_HasTheSameErrors(self):
        said = self.judged("sphere-plane", {})
        self.assertIn("softpipe", self.session.hello["device"])
        self.assertAlmostEqual(said["false_shadow_rate"], 0.18, delta=0.02)
        self.assertAlmostEqual(said["false_lit_rate"], 0.33, delta=0.02)


class VtksEnd(EndsCleanly, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "vtk"


if __name__ == "__main__":
    unittest.main()
