"""engines/babylon draws Babylon.js's own shadows, follows its settings, and leaves nothing behind."""
import unittest

from chromium import EndsWithChromium
from driven import DrivenEngine, map_of
from fairness import FairEngine
from own_picture import OwnPicture
from session import here
from translated_settings import TranslatedSettings

COMMAND = ["node", str(here("engines", "babylon", "adapter.mjs"))]
BIASED = {"bias": 0.003}  # relative to near + far: some 3 cm, more than half floats and slopes need


class Babylon(OwnPicture, FairEngine, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard", "lamp-room")
    SETTINGS = {"image__width": 320, "image__height": 180}
    WITHOUT_SHADOWS = {"shadowEnabled": False}
    GOOD = {scene: BIASED for scene in SCENES}
    OTHERS = ({"filter": "PCF"}, {"filter": "BLURCLOSEEXPONENTIALSHADOWMAP"})
    PICTURED = {"sphere-plane": {}, "yard": {"filter": "PCF"}, "lamp-room": BIASED}
    UNLIKE = BIASED

    def test_BiasIsAgainstAcneWherePositive(self):
        wrong = [self.judged("sphere-plane", {"bias": bias})["false_shadow"] for bias in (0, 0.0005, 0.003)]
        self.assertEqual(wrong, sorted(wrong, reverse=True))
        self.assertLess(wrong[2], wrong[0] / 10)

    def test_NormalBiasMovesCastersIn(self):
        plain, moved = (self.judged("sphere-plane", {**BIASED, "normalBias": bias}) for bias in (0, 0.2))
        # The sphere in the map is smaller, and so is its shadow.
        self.assertGreater(moved["false_lit"], 2 * plain["false_lit"])

    def test_ExponentialMapsShadowWhatCastsAsTheirFormulaHasIt(self):
        # 1 - clamp(e^(k r) e^(-k d)) is 0 where r = d: casters are dark, and a plane that does not cast is not. A k of 10 keeps
        # e^(-k d) above 6e-8, the smallest half float, below which everything is lit.
        engine = {"filter": "EXPONENTIALSHADOWMAP", "depthScale": 10}
        both = self.judged("sphere-plane", engine)
        self.assertGreater(both["false_shadow"], both["pixels"]["lit"] * 0.9)
        sphere = self.judged("sphere-plane", engine, no_cast=["plane"])
        on_plane = next(row for row in sphere["by_object"] if row["object"] == "plane")
        self.assertLess(on_plane["false_shadow"], on_plane["lit"] * 0.1)

    def test_RefusesByKeyWhatBabylonDoesNotHave(self):
        self.open("lamp-room")
        answer = self.session.draw(self.folder / "refused", {**map_of(*self.cases["lamp-room"]), "reversed": True, "cull": "none"}, {"filter": "PCSS"},
                                   lookup={"filter": "pcf9", "outside": "lit"}, bias={"constant": 0.1, "slope": 0}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.constant", "engine.filter", "lookup.filter", "method.name", "shadow_map.cull",
                                                   "shadow_map.reversed"])


class BabylonInSwiftShader(FairEngine, DrivenEngine):
    """Another rasterizer, with full-precision samplers, gives the same shadows."""
    COMMAND = [*COMMAND, "--rasterizer=swiftshader", "--samplers=highp"]
    SCENES = ("sphere-plane",)
    SETTINGS = Babylon.SETTINGS
    WITHOUT_SHADOWS = Babylon.WITHOUT_SHADOWS
    GOOD = Babylon.GOOD
    OTHERS = Babylon.OTHERS


class BabylonsEnd(EndsWithChromium, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "babylon"


class TranslatedForBabylon(TranslatedSettings, unittest.TestCase):
    COMMAND = COMMAND
    ENGINE = "babylon"
    TRANSLATED = [("yard", {"lookup.filter": name, "shadow_map.cull": "back", "shadow_map.depth_format": stored}, keys)
                  for name, stored, keys in (("nearest", "r16f", {"filter": "NONE"}),
                                             ("hardware", "d32f", {"filter": "PCF", "filteringQuality": "LOW"}),
                                             ("bilinear3", "d32f", {"filter": "PCF", "filteringQuality": "MEDIUM"}),
                                             ("bilinear5", "d32f", {"filter": "PCF", "filteringQuality": "HIGH"}))]

    @staticmethod
    def engine_keys(values):
        return {"bias": values["shadowGenerator.bias"], "normalBias": values["shadowGenerator.normalBias"]}


if __name__ == "__main__":
    unittest.main()
