"""An engine draws with the settings that Gnomon translated for it; its errors must be those that were promised."""
import json
import os
import shlex
import subprocess

from session import GNOMON

SMALL = {"image.width": 320, "image.height": 180}


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

    @staticmethod
    def engine_keys(values):
        """The engine's keys, as its adapter has them, for the translated values by name."""
        raise NotImplementedError

    def test_TranslatedSettingsDrawWhatWasPromised(self):
        for scene, job, filtering in self.TRANSLATED:
            promised = ask("settings", scene, job, "--engine", self.ENGINE)[0]
            values = {setting["name"]: setting["value"] for setting in promised["settings"]}
            keys = {f"engine.{name}": value for name, value in {**self.engine_keys(values), **filtering}.items()}
            drawn = ask("compare", scene, keys, "--renderer-command", shlex.join(self.COMMAND))
            for rate, pixels in (("false_shadow_rate", drawn["pixels"]["lit"]), ("false_lit_rate", drawn["pixels"]["blocked"])):
                # A pixel at a texel's border reads its neighbour where an engine rounds otherwise: in the tables of the
                # engines' pages up to 4 of 600,000 pixels. Halves in a map are cut to eleven bits, which moves a
                # twentieth of the wrong pixels.
                allowed = 5 / pixels + promised[rate] / 20
                self.assertLessEqual(abs(drawn[rate] - promised[rate]), allowed, (scene, job, rate, drawn[rate], promised[rate]))
