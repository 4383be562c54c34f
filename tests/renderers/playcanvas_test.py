"""engines/playcanvas draws PlayCanvas's own shadows, follows its settings, and leaves nothing behind."""
import unittest

from chromium import EndsWithChromium
from driven import DrivenEngine, map_of
from fairness import FairEngine
from own_picture import OwnPicture
from session import here
from translated_settings import TranslatedSettings

COMMAND = ["node", str(here("engines", "playcanvas", "adapter.mjs"))]
BIASED = {"shadowType": "PCF1_32F", "shadowBias": 0.2}  # glPolygonOffset(2, 2): twice the slope of a depth


class PlayCanvas(OwnPicture, FairEngine, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard", "lamp-room")
    SETTINGS = {"image__width": 320, "image__height": 180}
    WITHOUT_SHADOWS = {"castShadows": False}
    GOOD = {scene: BIASED for scene in SCENES}
    OTHERS = ({"shadowType": "PCF5_32F"}, {"shadowType": "VSM_16F", "clusteredLightingEnabled": False})
    PICTURED = {"sphere-plane": {}, "yard": {}, "lamp-room": {"clusteredLightingEnabled": False}}
    UNLIKE = BIASED

    def test_BiasIsAgainstAcneWherePositive(self):
        for clustered in (False, True):
            wrong = [self.judged("sphere-plane", {"shadowType": "PCF1_32F", "shadowBias": bias, "clusteredLightingEnabled": clustered})["false_shadow"]
                     for bias in (0, 0.02, 0.2)]
            self.assertEqual(wrong, sorted(wrong, reverse=True))
            self.assertLess(wrong[2], wrong[0] / 10)

    def test_TheDefaultTakesAQuarterOfTheLightFromLitGround(self):
        # Half of the depth's slope suits half a texel, but 3 x 3 taps reach farther.
        said = self.judged("sphere-plane", {})
        self.assertAlmostEqual(said["mean_abs_error"], 0.2, delta=0.03)
        self.assertLess(said["false_shadow_rate"], 0.02)

    def test_PcssHasNoBiasButAlongTheNormal(self):
        keys = {"shadowType": "PCSS_32F", "clusteredLightingEnabled": False}
        frames = [(self.frame("sphere-plane", {**keys, "shadowBias": bias})[1] / "frame.exr").read_bytes() for bias in (0, 1)]
        self.assertEqual(frames[0], frames[1])
        plain, moved = (self.judged("sphere-plane", {**keys, "normalOffsetBias": bias})["false_shadow"] for bias in (0, 0.05))
        self.assertLess(moved, plain / 10)

    def test_BeyondTheShadowsDistanceAllIsLit(self):
        said = self.judged("yard", {**BIASED, "shadowDistance": 1})
        self.assertEqual(said["false_lit"], said["pixels"]["blocked"])

    def test_RefusesByKeyWhatPlayCanvasDoesNotHave(self):
        self.open("lamp-room")
        answer = self.session.draw(self.folder / "refused", {**map_of(*self.cases["lamp-room"]), "reversed": True, "cull": "none"}, {"shadowType": "VSM_32F"},
                                   lookup={"filter": "pcf9", "outside": "lit"}, bias={"constant": 0.1, "slope": 0}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.constant", "engine.shadowType", "lookup.filter", "method.name", "shadow_map.cull",
                                                   "shadow_map.reversed"])


class PlayCanvasInSwiftShader(FairEngine, DrivenEngine):
    """Another rasterizer gives the same shadows."""
    COMMAND = [*COMMAND, "--rasterizer=swiftshader"]
    SCENES = ("sphere-plane",)
    SETTINGS = PlayCanvas.SETTINGS
    WITHOUT_SHADOWS = PlayCanvas.WITHOUT_SHADOWS
    GOOD = PlayCanvas.GOOD
    OTHERS = PlayCanvas.OTHERS


class PlayCanvasEnds(EndsWithChromium, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "playcanvas"


class TranslatedForPlayCanvas(TranslatedSettings, unittest.TestCase):
    """Both draw a polygon offset, under a spot, which is the light that the translation is for. Where an offset is too small, rounding
    decides which pixels shadow themselves, and so these are large enough."""
    COMMAND = COMMAND
    ENGINE = "playcanvas"
    OPTIONS = ("--own",)
    DRAWN = {"shadow_map.resolution": 512}
    TELLS_ITS_MAP = True
    TRANSLATED = [("sphere-plane", {"lookup.filter": name, "shadow_map.cull": "back", "shadow_map.depth_format": "d32f", "bias.constant": 0,
                                    "bias.polygon_offset_factor": offset, "bias.polygon_offset_units": offset, **job},
                   {"shadowType": kind, "clusteredLightingEnabled": False})
                  for name, kind in (("hardware", "PCF1_32F"), ("bilinear3", "PCF3_32F"), ("bilinear5", "PCF5_32F"))
                  for offset, job in ((2, {}), (0, {"bias.normal_m": 0.05}))]

    @staticmethod
    def engine_keys(values):
        return {"shadowBias": values["light.shadowBias"], "normalOffsetBias": values["light.normalOffsetBias"]}


if __name__ == "__main__":
    unittest.main()
