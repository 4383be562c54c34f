"""engines/godot draws Godot's own shadows, reports what it did, and leaves nothing behind."""
import os
import subprocess
import unittest

from driven import DrivenEngine, EndsCleanly, Fairness, map_of
from own_picture import OwnPicture
from session import here
from translated_settings import TranslatedSettings

COMMAND = ["/usr/bin/python3", "-B", str(here("engines", "godot", "adapter.py"))]
SETTINGS = {"image__width": 320, "image__height": 180, "shadow_map__resolution": 512}


class Godot(OwnPicture, Fairness, DrivenEngine):
    COMMAND = COMMAND
    SCENES = ("sphere-plane", "yard", "lamp-room", "fence")
    SETTINGS = SETTINGS
    SHADOWS_OFF = {"shadow_enabled": False}
    OTHER = {"shadow_bias": 0.02}
    PICTURED = {"sphere-plane": {}, "yard": {}, "lamp-room": {}, "fence": {}}  # fence shows the sky
    UNLIKE = OTHER
    APART = 2.0**-7  # both masks are quotients of two half floats, each truncated by up to 2^-10 of itself

    def test_ShadowLiesWhereItMustWithALittleBias(self):
        said = self.judged("sphere-plane", {"shadow_bias": 0.02})
        # 2 cm along the light's axis shrink the shadow by 2 cm in about 1.8 m, some 2.6 % of it.
        self.assertGreater(said["pixels"]["blocked"], 5000)
        self.assertLess(said["false_shadow"], said["pixels"]["lit"] / 1000)
        self.assertLess(said["false_lit_rate"], 0.04)

    def test_BiasShrinksASpotsShadows(self):
        said = self.judged("sphere-plane", {})
        self.assertAlmostEqual(said["false_lit_rate"], 0.171, delta=0.01)  # as on the README's page, in a larger image
        self.assertEqual(said["false_shadow"], 0)

    def test_WithoutABiasWhatIsLitShadowsItself(self):
        said = self.judged("sphere-plane", {"shadow_bias": 0})
        self.assertAlmostEqual(said["false_shadow_rate"], 0.41, delta=0.05)  # as on the README's page, in a larger image

    def test_ShadowsLieWhereTheyMustUnderOtherLights(self):
        for scene in ("yard", "lamp-room"):
            said = self.judged(scene, {"shadow_bias": 0.05})
            self.assertLess(said["false_shadow_rate"], 0.05, scene)
            self.assertLess(said["false_lit_rate"], 0.3, scene)  # a misplaced light gives about 1

    def test_MapsOfADirectionalLightHaveTheSizeThatIsAsked(self):
        coarse, fine = (self.judged_at("yard", resolution) for resolution in (128, 2048))
        self.assertLess(fine["false_lit"] + fine["false_shadow"], (coarse["false_lit"] + coarse["false_shadow"]) / 2)

    def judged_at(self, scene, resolution):
        description, said = self.cases[scene]
        self.cases[scene] = ({**description, "shadow_map": {**description["shadow_map"], "resolution": resolution}}, said)
        try:
            return self.judged(scene, {"directional_shadow_mode": "orthogonal"})
        finally:
            self.cases[scene] = (description, said)

    def test_RefusesByKeyWhatGodotDoesNotHave(self):
        self.open("sphere-plane")
        shadow_map = {**map_of(*self.cases["sphere-plane"]), "resolution": 500, "depth_format": "d16"}
        answer = self.session.draw(self.folder / "refused", shadow_map, {"no": 1}, lookup={"filter": "nearest"}, bias={"slope": 0.1})
        self.assertEqual(sorted(answer["error"]), ["bias.slope", "engine.no", "lookup.filter", "shadow_map.depth_format",
                                                   "shadow_map.resolution"])


class GodotByGles2(DrivenEngine):
    """Godot's other renderer, whose mask has 8 bits."""
    COMMAND = [*COMMAND, "--api=gles2"]
    SCENES = ("sphere-plane",)
    SETTINGS = SETTINGS

    def test_HasTheSameErrors(self):
        said = self.judged("sphere-plane", {})
        self.assertEqual(self.session.hello["name"], "Godot GLES2")
        self.assertAlmostEqual(said["false_lit_rate"], 0.17, delta=0.01)

    def test_ShowsPointsOfTheMesh(self):
        said = self.judged("sphere-plane", {})
        self.assertLess(said["evaluate"]["import_check"]["distance_m"]["p99"], 2e-5)


class GodotsEnd(EndsCleanly, unittest.TestCase):
    COMMAND = COMMAND
    NAME = "godot"

    def test_OfGodotIsSaid(self):
        process = self.started()
        started = subprocess.run(["ps", "-o", "pid=,comm=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True)
        godot = [int(line.split()[0]) for line in started.stdout.splitlines() if "godot" in line]
        os.kill(godot[0], 9)
        process.stdin.write('{"id": 2, "hello": 1}\n')
        process.stdin.flush()
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), "^godot: Godot ended")
        self.expect_nothing_left()


class TranslatedForGodot(TranslatedSettings, unittest.TestCase):
    """Godot fits the sun's map to what the camera sees, and the adapter does not tell where it lies. A bias of many texels hides more
    of the light than the map's texels do, and so its length shows in the pixels that are falsely lit."""
    COMMAND = COMMAND
    ENGINE = "godot3"
    OPTIONS = ("--own",)
    DRAWN = {"shadow_map.resolution": 4096}
    COMPARED = ("false_lit_rate",)
    RELATIVE = 1 / 10
    TRANSLATED = [("columns", {"lookup.filter": "hardware", "shadow_map.cull": "back", "bias.constant_m": bias},
                   {"directional_shadow_mode": "orthogonal", "filter_mode": "disabled", "directional_shadow_max_distance": 25,
                    "directional_shadow_normal_bias": 0})  # the line that the translation adds
                  for bias in (0.3, 0.4)]

    @staticmethod
    def engine_keys(values):
        return {"directional_shadow_bias": values["Light.shadow_bias"]}


if __name__ == "__main__":
    unittest.main()
