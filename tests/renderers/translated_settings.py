"""An engine draws with the settings that Gnomon translated for it; its errors must be those that were promised."""
import json
import os
import shlex
import subprocess

from session import GNOMON

SMALL = {"image.width": 320, "image.height": 180}
PLACE = ["light.type", "light.position", "light.target", "light.direction",
         *(f"shadow_map.{name}" for name in ("fit", "half_extent", "fov_deg", "roll_deg", "near", "far"))]
RATES = {"false_shadow_rate": "lit", "false_lit_rate": "blocked"}  # and the class of pixels that each is a share of


def ask(command, scene, job, *options):
    """The JSON output of a command for a built-in scene."""
    arguments = [GNOMON, command, "--builtin", scene, "--json", *options]
    for key, value in {**SMALL, **job}.items():
        arguments += ["--set", f"{key}={json.dumps(value)}"]
    return json.loads(subprocess.run(arguments, check=True, capture_output=True, text=True, env=os.environ).stdout)


class TranslatedSettings:
    """To be mixed into a TestCase with the members that are None here."""
    COMMAND = None
    ENGINE = None  # its name for --engine
    TRANSLATED = None  # scene, keys of the job, and keys of the engine that stand for the job's filter
    OPTIONS = ()  # of `gnomon settings`
    DRAWN = {}  # keys of the engine's job, beside its own
    # Whether the engine fits its map, and its adapter tells where it lies. Then the promise is for that map.
    TELLS_ITS_MAP = False
    COMPARED = tuple(RATES)
    # Halves in a map are cut to eleven bits, which moves a twentieth of the wrong pixels.
    RELATIVE = 1 / 20

    @staticmethod
    def engine_keys(values):
        """The engine's keys, as its adapter has them, for the translated values by name."""
        raise NotImplementedError

    def drawn(self, scene, keys):
        """A comparison of the engine's picture."""
        job = {**self.DRAWN, **{f"engine.{name}": value for name, value in keys.items()}}
        return ask("compare", scene, job, "--renderer-command", shlex.join(self.COMMAND))

    def place(self, scene, keys):
        """The job's keys that place a map where the engine has its own."""
        told = self.drawn(scene, keys)["job"] if self.TELLS_ITS_MAP else {}
        return {key: told[key] for key in PLACE if key in told}

    def test_TranslatedSettingsDrawWhatWasPromised(self):
        for scene, job, filtering in self.TRANSLATED:
            job = {**self.DRAWN, **self.place(scene, filtering), **job}
            promised = ask("settings", scene, job, "--engine", self.ENGINE, *self.OPTIONS)[0]
            values = {setting["name"]: setting["value"] for setting in promised["settings"]}
            drawn = self.drawn(scene, {**self.engine_keys(values), **filtering})
            for rate in self.COMPARED:
                # A pixel at a texel's border reads its neighbour where an engine rounds otherwise: in the tables of the
                # engines' pages up to 4 of 600,000 pixels.
                allowed = 5 / drawn["pixels"][RATES[rate]] + promised[rate] * self.RELATIVE
                self.assertLessEqual(abs(drawn[rate] - promised[rate]), allowed, (scene, job, rate, drawn[rate], promised[rate]))
