"""engines/ogre draws OGRE's own texture shadows, follows its settings, and leaves nothing behind."""
import unittest

import numpy

from driven import DrivenEngine, EndsWithItsDisplay, map_of
from fairness import FairEngine
from own_picture import OwnPicture
from session import export_case, here

COMMAND = [str(here("engines", "ogre", "build", "gnomon_ogre"))]


class Ogre(OwnPicture, FairEngine, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard")
    SETTINGS = {"image__width": 320, "image__height": 180, "shadow_map__resolution": 512}
    WITHOUT_SHADOWS = {"castShadows": False}
    GOOD = {scene: {} for scene in SCENES}  # back faces cast, and need no bias
    OTHERS = ({}, {"shadowCasterRenderBackFaces": False})
    PICTURED = {"sphere-plane": {}, "yard": {"filtering": "none", "shadowCasterRenderBackFaces": False}}
    UNLIKE = {"shadowCasterRenderBackFaces": False, "depthBiasSlopeScale": 4}

    def test_FrontFacesNeedABiasAgainstAcneThatIsNegative(self):
        # Front faces are lit. Without a bias the four taps darken a slope, at most by half.
        wrong = [self.judged("sphere-plane", {"shadowCasterRenderBackFaces": False, "depthBiasSlopeScale": slope})["shadow_amount"]
                 for slope in (0, -4, 4)]
        self.assertLess(wrong[1], wrong[0] / 2)
        self.assertGreater(wrong[2], wrong[0])

    def test_FilteringIsOfEachTap(self):
        smooth, hard = (self.frame("sphere-plane", {"filtering": name})[1] for name in ("bilinear", "none"))
        values = [set(numpy.load(folder / "shadow.npy").ravel().tolist()) for folder in (smooth, hard)]
        self.assertGreater(len(values[0]), 100)
        self.assertEqual(values[1] - {0, 0.25, 0.5, 0.75, 1}, set())

    def test_RefusesByKeyWhatOgreDoesNotHave(self):
        self.open("yard")
        answer = self.session.draw(self.folder / "refused", {**map_of(*self.cases["yard"]), "reversed": True, "cull": "none"}, {},
                                   lookup={"filter": "pcf9", "outside": "lit"}, bias={"constant": 0.1, "slope": 0}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.constant", "lookup.filter", "method.name", "shadow_map.cull", "shadow_map.reversed"])

    def test_RefusesPointLights(self):
        description, _ = export_case(self.folder / "lamp-room", "lamp-room", **self.SETTINGS)
        answer = self.session.open(self.folder / "lamp-room" / "mesh.glb", description, 320, 180)
        self.assertIn("point lights are not driven", answer["error"])


class OgreBySoftpipe(FairEngine, DrivenEngine):
    """Mesa's other rasterizer gives the same shadows."""
    COMMAND = [*COMMAND, "--rasterizer=softpipe"]
    SCENES = ("sphere-plane",)
    SETTINGS = {**Ogre.SETTINGS, "image__width": 160, "image__height": 90}
    WITHOUT_SHADOWS = Ogre.WITHOUT_SHADOWS
    GOOD = Ogre.GOOD
    OTHERS = Ogre.OTHERS
    SOME = 25


class OgresEnd(EndsWithItsDisplay, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "ogre"


if __name__ == "__main__":
    unittest.main()
