"""engines/qtquick3d draws Qt Quick 3D's own shadows, follows its settings, and leaves nothing behind."""
import unittest

import numpy

from driven import DrivenEngine, EndsWithItsDisplay, map_of
from fairness import FairEngine
from own_picture import OwnPicture
from session import here
from translated_settings import TranslatedSettings

COMMAND = [str(here("engines", "qtquick3d", "build", "gnomon_qtquick3d"))]
# The map ends behind the scene, and shadows are hard. By default nothing is darker than a half.
HARD = {"shadowFactor": 80, "shadowMapFar": 2000, "shadowFilter": 0, "shadowBias": 0.002}


class QtQuick3D(OwnPicture, FairEngine, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard", "lamp-room")  # a spot, the sun, a point light
    SETTINGS = {"image__width": 320, "image__height": 180, "shadow_map__resolution": 512}
    WITHOUT_SHADOWS = {"castsShadow": False}
    GOOD = {scene: HARD for scene in SCENES}
    OTHERS = ({}, HARD)
    PICTURED = {"sphere-plane": HARD, "yard": HARD}
    UNLIKE = {**HARD, "shadowFilter": 50}

    def visible(self, scene, engine):
        """V of the pixels that show a surface."""
        folder = self.frame(scene, engine)[1]
        seen = numpy.isfinite(numpy.load(folder / "position.npy")).all(-1)
        return numpy.load(folder / "shadow.npy")[seen].astype(float)

    def test_ItsOwnFactorAndFarLeaveShadowsLighterThanAHalf(self):
        # V is e^(-5 d / 5000) at d units, of 1 cm, behind the blocker: a half is 693 of them.
        said = self.judged("sphere-plane", {})
        self.assertEqual(said["false_lit"], said["pixels"]["blocked"])
        self.assertGreater(said["light_amount"], said["pixels"]["blocked"] / 2)
        self.assertLess(said["light_amount"], said["pixels"]["blocked"])

    def test_ShadowsFallOffByEToTheFactor(self):
        for scene in self.SCENES:
            once, twice = (self.visible(scene, {"shadowFactor": factor}) for factor in (5, 10))
            # Both are e to at most 10. Their float32 arguments, and so their logarithms, err by 5e-7.
            self.assertLess(abs(once**2 - twice).max(), 1e-5, scene)
            self.assertLess(twice.min(), 0.9, scene)

    def test_MapsOfSpotsBeginAtOneUnit(self):
        near, cut = (self.judged("sphere-plane", {**HARD, "shadowMapFar": 20 / unit_m, "unit_m": unit_m}) for unit_m in (0.1, 10))
        self.assertLess(near["false_lit"], near["pixels"]["blocked"] * 0.15)
        self.assertEqual(cut["false_lit"], cut["pixels"]["blocked"])

    def test_RefusesByKeyWhatQtQuick3DDoesNotHave(self):
        self.open("yard")
        answer = self.session.draw(self.folder / "refused", {**map_of(*self.cases["yard"]), "resolution": 500, "reversed": True, "cull": "none"},
                                   {}, lookup={"filter": "pcf9", "outside": "lit"}, bias={"constant": 0.1, "slope": 0}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.constant", "lookup.filter", "lookup.outside", "method.name", "shadow_map.cull",
                                                   "shadow_map.resolution", "shadow_map.reversed"])


class QtQuick3DUnderTheSun(DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane",)
    SETTINGS = {**QtQuick3D.SETTINGS, "light__type": "directional"}

    def test_ItsMapBeginsAndEndsWhereItIsTold(self):
        # Where the map is empty its depth is 1, and light falls off with the receiver's depth alone.
        answer, folder = self.frame("sphere-plane", {"shadowFilter": 0, "shadowBias": -1}, no_cast=["plane"])
        description, said = self.cases["sphere-plane"]
        position, visible = (numpy.load(folder / f"{name}.npy").astype(float) for name in ("position", "shadow"))
        seen = numpy.isfinite(position).all(-1)
        camera, told = map_of(description, said)["light_camera"], answer["case"]["shadow_map"]
        depth = ((position[seen] - camera["position"]) @ camera["forward"] - told["near"]) / (told["far"] - told["near"])
        apart = abs(depth + numpy.log(visible[seen]) / 5)
        # The sphere covers little of the map. V is e to a float32 below 10.
        self.assertLess(numpy.percentile(apart, 75), 1e-5)


class QtQuick3DBySoftpipe(FairEngine, DrivenEngine):
    """Mesa's other rasterizer gives the same shadows. Under the sun, which has one map: blurring each of six takes seconds."""
    COMMAND = [*COMMAND, "--rasterizer=softpipe"]
    SCENES = ("sphere-plane",)
    SETTINGS = {**QtQuick3D.SETTINGS, "image__width": 160, "image__height": 90, "light__type": "directional"}
    WITHOUT_SHADOWS = QtQuick3D.WITHOUT_SHADOWS
    GOOD = QtQuick3D.GOOD
    OTHERS = QtQuick3D.OTHERS
    SOME = 25


class QtQuick3DsEnd(EndsWithItsDisplay, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "qtquick3d"


class TranslatedForQtQuick3D(TranslatedSettings, unittest.TestCase):
    """Hard shadows. The adapter tells where the sun's map begins and ends, but not its sides: Gnomon's own differ by a tenth."""
    COMMAND = COMMAND
    ENGINE = "qt"
    OPTIONS = ("--own",)
    DRAWN = {"shadow_map.resolution": 512}
    TELLS_ITS_MAP = True
    RELATIVE = 1 / 10
    TRANSLATED = [("columns", {"method.name": "esm", "method.exponent": 80, "method.kernel_width": 1, "shadow_map.cull": "back",
                               "bias.constant": bias}, {"shadowFilter": 0}) for bias in (0.0005, 0.002)]

    @staticmethod
    def engine_keys(values):
        return {"shadowBias": values["Light.shadowBias"], "shadowFactor": values["Light.shadowFactor"]}


if __name__ == "__main__":
    unittest.main()
