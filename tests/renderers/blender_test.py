"""engines/blender draws the shadows of EEVEE and of Cycles, reports what it did, and leaves nothing behind."""
import os
import subprocess
import unittest

import numpy

from driven import DrivenEngine, EndsCleanly, Fairness, map_of
from own_picture import OwnPicture
from session import here

COMMAND = ["/usr/bin/python3", "-B", str(here("engines", "blender", "adapter.py"))]
SETTINGS = {"image__width": 320, "image__height": 180, "shadow_map__resolution": 512}


class Eevee(OwnPicture, Fairness, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard", "lamp-room", "fence")
    SETTINGS = SETTINGS
    SHADOWS_OFF = {"use_shadow": False}
    OTHER = {"use_contact_shadow": True, "contact_shadow_distance": 2}
    PICTURED = {"sphere-plane": {}, "yard": {}, "fence": {}}
    UNLIKE = {"use_shadow": False}
    # The passes Shadow and Combined weigh a border's texels a little differently: of 32,932 pixels of sphere-plane 56 differ by more than
    # 2^-8, all of them between light and shadow, and none by more than 0.012.
    APART = 2.0**-6
    FEW = 0.001

    def test_ShadowsLieWhereTheyMustByTheDefaults(self):
        said = self.judged("sphere-plane", {})
        # The shadow's border is some 300 pixels long, and a texel is a third of a pixel: at most a tenth of the border is wrong. The
        # README's page has 0.04 % of false shadow and 0.12 % of false lit in a larger image.
        self.assertGreater(said["pixels"]["blocked"], 5000)
        self.assertLess(said["false_shadow"] + said["false_lit"], 40)
        for scene in ("yard", "lamp-room"):
            said = self.judged(scene, {})
            self.assertLess(said["false_shadow_rate"], 0.02, scene)
            self.assertLess(said["false_lit_rate"], 0.1, scene)  # a misplaced light gives about 1

    def test_RefusesByKeyWhatEeveeDoesNotHave(self):
        self.open("sphere-plane")
        shadow_map = {**map_of(*self.cases["sphere-plane"]), "resolution": 500, "depth_format": "d16"}
        answer = self.session.draw(self.folder / "refused", shadow_map, {"no": 1}, lookup={"filter": "nearest"}, bias={"slope": 0.1})
        self.assertEqual(sorted(answer["error"]), ["bias.slope", "engine.no", "lookup.filter", "shadow_map.depth_format",
                                                   "shadow_map.resolution"])


class Cycles(OwnPicture, DrivenEngine):
    """Rays have hardly an error, so the errors of EEVEE's frames do not come from the adapter's scene."""
    COMMAND = [*COMMAND, "--engine=cycles"]
    SCENES = ("sphere-plane", "yard", "lamp-room")
    SETTINGS = SETTINGS
    PICTURED = {"sphere-plane": {}}
    UNLIKE = {"cast_shadow": False}

    def test_IsNearlyTrueUnderEveryLight(self):
        for scene in self.SCENES:
            said = self.judged(scene, {})
            self.assertGreater(said["pixels"]["blocked"], 1000, scene)
            # Rays in single precision err in a pixel or two on a shadow's border.
            self.assertLess(said["false_shadow"] + said["false_lit"], said["pixels"]["lit"] / 5000, scene)

    def test_DrawsNoShadowsWhereTheyAreOff(self):
        said = self.judged("sphere-plane", {"cast_shadow": False})
        self.assertEqual(said["false_lit"], said["pixels"]["blocked"])
        self.assertEqual(said["false_shadow"], 0)

    def test_LeavesOutWhatDoesNotCastAndWhatIsNotSeen(self):
        self.assertEqual(self.judged("sphere-plane", {}, no_cast=["sphere", "plane"])["false_shadow"], 0)
        said = self.judged("sphere-plane", {}, no_receive=["sphere"])
        self.assertGreater(said["pixels"]["blocked"], 1000)
        self.assertLess(said["false_lit"], said["pixels"]["blocked"] / 100)

    def test_EqualRequestsGiveEqualFrames(self):
        frames = [self.frame("sphere-plane", {})[1] for _ in range(2)]
        self.assertTrue(numpy.array_equal(*(numpy.load(frame / "shadow.npy") for frame in frames)))


class BlendersEnd(EndsCleanly, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "blender"

    def test_OfBlenderIsSaid(self):
        process = self.started()
        started = subprocess.run(["ps", "-o", "pid=,comm=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True)
        blender = [int(line.split()[0]) for line in started.stdout.splitlines() if "blender" in line]
        os.kill(blender[0], 9)
        process.stdin.write('{"id": 2, "hello": 1}\n')
        process.stdin.flush()
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), "^blender: Blender ended")
        self.expect_nothing_left()


if __name__ == "__main__":
    unittest.main()
