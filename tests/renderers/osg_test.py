"""engines/osg draws osgShadow's own shadows, follows its settings, and leaves nothing behind."""
import subprocess
import unittest

from driven import DrivenEngine, EndsCleanly, map_of
from fairness import FairEngine
from own_picture import OwnPicture
from session import here
from translated_settings import TranslatedSettings

COMMAND = [str(here("engines", "osg", "build", "gnomon_osg"))]
NO_OFFSET = {"polygonOffsetFactor": 0, "polygonOffsetUnits": 0}


class Osg(OwnPicture, FairEngine, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard")
    SETTINGS = {"image__width": 320, "image__height": 180, "shadow_map__resolution": 512}
    WITHOUT_SHADOWS = {"shadows": False}
    GOOD = {scene: NO_OFFSET for scene in SCENES}
    OTHERS = ({}, {"technique": "SoftShadowMap"})
    PICTURED = {"sphere-plane": {}, "yard": {"technique": "SoftShadowMap"}}
    UNLIKE = {"technique": "SoftShadowMap", "softnessWidth": 0.05}
    CASTERS = ("sphere",)  # if nothing casts, OpenSceneGraph does not clear the map, and the adapter refuses

    def test_ItsOwnPolygonOffsetDarkens(self):
        # Casters are drawn with the negative offset, nearer to the light: 0.32 % of the lit pixels are dark, and 0.09 % without
        # it, at 1280 x 720. A quarter as many columns and rows give these shares to some pixels.
        own, without = (self.judged("sphere-plane", engine) for engine in ({}, NO_OFFSET))
        self.assertGreater(own["false_shadow"], without["false_shadow"] * 1.5)
        self.assertLess(own["false_shadow"], own["pixels"]["lit"] * 0.006)
        self.assertLess(own["false_lit"], own["pixels"]["blocked"] * 0.006)

    def test_SoftShadowsAreSofterAndAsRight(self):
        hard, soft = (self.judged("sphere-plane", {**NO_OFFSET, "technique": technique}) for technique in ("ShadowMap", "SoftShadowMap"))
        self.assertGreater(soft["partial"], 2 * hard["partial"])
        # The disk of samples reaches 0.005 of the map, 2.6 texels, to each side of a border.
        self.assertLess(soft["false_shadow"] + soft["false_lit"], (soft["pixels"]["lit"] + soft["pixels"]["blocked"]) * 0.03)

    def test_RefusesByKeyWhatOpenSceneGraphDoesNotHave(self):
        self.open("yard")
        answer = self.session.draw(self.folder / "refused", {**map_of(*self.cases["yard"]), "reversed": True, "cull": "none"}, {},
                                   lookup={"filter": "pcf9", "outside": "lit"}, bias={"constant": 0.1, "slope": 0}, method={"name": "esm"})
        self.assertEqual(sorted(answer["error"]), ["bias.constant", "lookup.filter", "method.name", "shadow_map.cull", "shadow_map.reversed"])

    def test_RefusesToDrawWhereNothingCasts(self):
        answer, _ = self.frame("sphere-plane", {}, no_cast=["sphere", "plane"])
        self.assertIn("let an object cast", answer["error"])


class OsgUnderAPointLight(DrivenEngine):
    """One map looks at the middle of the casters. A light outside their bounding sphere sees them all."""
    COMMAND = COMMAND
    SCENES = ("sphere-plane",)
    SETTINGS = {**Osg.SETTINGS, "light__type": "point"}

    def test_ShadowsLandWhereTheMapReaches(self):
        said = self.judged("sphere-plane", NO_OFFSET)
        self.assertLess(said["false_shadow"], said["pixels"]["lit"] * 0.03)
        self.assertLess(said["false_lit"], said["pixels"]["blocked"] * 0.3)


class OsgOfManyTriangles(DrivenEngine):
    """131,072 triangles in one object are more than OpenSceneGraph draws as one geometry."""
    COMMAND = COMMAND
    SCENES = ("terrain",)
    SETTINGS = {**Osg.SETTINGS, "image__width": 160, "image__height": 90}

    def test_AreAllDrawn(self):
        said = self.judged("terrain", NO_OFFSET)
        self.assertLess(said["false_shadow"], said["pixels"]["lit"] * 0.1)
        self.assertLess(said["false_lit"], said["pixels"]["blocked"] * 0.3)


class OsgBySoftpipe(FairEngine, DrivenEngine):
    """Mesa's other rasterizer gives the same shadows."""
    COMMAND = [*COMMAND, "--rasterizer=softpipe"]
    SCENES = ("sphere-plane",)
    SETTINGS = {**Osg.SETTINGS, "image__width": 160, "image__height": 90}
    WITHOUT_SHADOWS = Osg.WITHOUT_SHADOWS
    GOOD = Osg.GOOD
    OTHERS = ({}, {"polygonOffsetFactor": -100})
    CASTERS = Osg.CASTERS
    SOME = 25


class OsgsEnd(EndsCleanly, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "osg"
    STARTS_PROCESSES = False

    def test_WithAnUnknownOptionSaysWhatIsKnown(self):
        ended = subprocess.run([*COMMAND, "--rasterizer=other"], capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 1)
        self.assertRegex(ended.stderr, "^osg: unknown option --rasterizer=other; .*softpipe")


class TranslatedForOsg(TranslatedSettings, unittest.TestCase):
    """Both draw a polygon offset with the same GL."""
    COMMAND = COMMAND
    ENGINE = "osg"
    OPTIONS = ("--own",)
    DRAWN = {"shadow_map.resolution": 512}
    TELLS_ITS_MAP = True
    TRANSLATED = [(scene, {"lookup.filter": "hardware", "shadow_map.cull": "front", "shadow_map.depth_format": "d24", "bias.constant": 0,
                           "bias.polygon_offset_factor": factor, "bias.polygon_offset_units": units}, {})
                  for scene in ("sphere-plane", "columns", "terrain") for factor, units in ((-1, -1), (2, 4))]

    @staticmethod
    def engine_keys(values):
        return {"polygonOffsetFactor": values["ShadowMap::setPolygonOffset, x"],
                "polygonOffsetUnits": values["ShadowMap::setPolygonOffset, y"]}


if __name__ == "__main__":
    unittest.main()
