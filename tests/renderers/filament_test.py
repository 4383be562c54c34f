"""engines/filament draws Filament's own shadows, follows its settings, and leaves nothing behind."""
import unittest

from chromium import EndsWithChromium
from driven import DrivenEngine, map_of
from fairness import FairEngine
from own_picture import OwnPicture
from session import here

COMMAND = ["node", str(here("engines", "filament", "adapter.mjs"))]


class Filament(OwnPicture, FairEngine, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard")
    SETTINGS = {"image__width": 320, "image__height": 180}
    WITHOUT_SHADOWS = {"castShadows": False}
    GOOD = {scene: {} for scene in SCENES}
    OTHERS = ({}, {"castShadows": False})
    PICTURED = {"sphere-plane": {}, "yard": {}}
    UNLIKE = {"castShadows": False}
    APART = 2.0**-7  # llvmpipe computes `mediump` in half floats, each truncated by up to 2^-10 of itself

    def test_DoesNotShowWhatDoesNotReceive(self):
        # Filament cannot do this, and the adapter refuses it.
        self.assertRegex(self.open("sphere-plane", no_receive=["sphere"])["error"], "scene.no_receive")

    def test_TheDefaultsAreWhatTheyWereByHand(self):
        # An image of 1280 x 720 had 0, 0.61 and 0.26 %. In a smaller one two pixels in a thousand may differ.
        said = self.judged("sphere-plane", {})
        self.assertEqual(said["false_shadow"], 0)
        self.assertAlmostEqual(said["false_lit_rate"], 0.0061, delta=0.002)
        self.assertAlmostEqual(said["mean_abs_error"], 0.0026, delta=0.001)

    def test_RefusesWhatFilamentDoesNotHave(self):
        self.open("sphere-plane")
        answer = self.session.draw(self.folder / "refused", {**map_of(*self.cases["sphere-plane"]), "reversed": True},
                                   lookup={"filter": "pcf9", "outside": "lit"}, bias={"constant": 0.1, "slope": 0}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.constant", "lookup.filter", "method.name", "shadow_map.reversed"])
        described = {**self.cases["sphere-plane"][0], "light": {"type": "point", "position": [2, 4, 3]}}
        answer = self.session.open(self.folder / "sphere-plane" / "mesh.glb", described, 32, 32)
        self.assertRegex(answer["error"], "point lights")


class FilamentUnderTheSun(DrivenEngine):
    """If nothing casts under the sun, its shaders look no map up."""
    COMMAND = Filament.COMMAND
    SCENES = ("sphere-plane",)
    SETTINGS = {**Filament.SETTINGS, "light__type": "directional"}

    def test_DrawsNoShadowOfWhatDoesNotCast(self):
        said = self.judged("sphere-plane", {}, no_cast=["sphere", "plane"])
        self.assertEqual((said["pixels"]["blocked"], said["false_shadow"]), (0, 0))
        self.assertGreater(said["pixels"]["lit"], 0)


class FilamentInSwiftShader(FairEngine, DrivenEngine):
    """Another rasterizer gives the same shadows."""
    COMMAND = [*COMMAND, "--rasterizer=swiftshader"]
    SCENES = ("sphere-plane",)
    SETTINGS = Filament.SETTINGS
    WITHOUT_SHADOWS = Filament.WITHOUT_SHADOWS
    GOOD = Filament.GOOD
    OTHERS = Filament.OTHERS
    test_DoesNotShowWhatDoesNotReceive = Filament.test_DoesNotShowWhatDoesNotReceive


class FilamentEnds(EndsWithChromium, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "filament"


if __name__ == "__main__":
    unittest.main()
