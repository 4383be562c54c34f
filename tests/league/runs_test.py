"""Whole runs of the league with a renderer that draws the truth, or makes mistakes on purpose."""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from made_rows import rows

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FAKE = [sys.executable, "-B", str(HERE / "fake_renderer.py")]


JOB = """# A wall in the sun.
[scene]
builtin = "wall"
wall.height_m = 0.5

[image]
width = 48
height = 28

[[case]]
name = "no-caster"
scene.no_cast = ["wall", "ground"]
"""


def quoted(words):
    return "[" + ", ".join(f'"{word}"' for word in words) + "]"


class League(unittest.TestCase):
    """Folders of engines, scenes and results."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        self.jobs("wall")

    def jobs(self, *names):
        """Writes a wall in the sun under each name."""
        (self.folder / "jobs").mkdir(exist_ok=True)
        (self.folder / "jobs" / "scenes.toml").write_text("".join(
            f'[{name}]\nlight = "directional"\nknown_shape = {str(name == "wall").lower()}\n' for name in names))
        for name in names:
            (self.folder / "jobs" / f"{name}.toml").write_text(JOB)

    def engine(self, name, *mistakes, more="", lights=("directional",), budget=3):
        folder = self.folder / "engines" / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "league.toml").write_text(
            f'title = "{name.title()}"\nlights = {quoted(lights)}\ncommand = {quoted([*FAKE, *mistakes])}\n'
            f'shadows_off = {{ shadows = false }}\nsearch = ["soft"]\nbudget = {budget}\n{more}\n[limits]\nmask = "made of the truth"\n')
        return folder

    def command(self, *options):
        return [sys.executable, "-B", str(ROOT / "league" / "league.py"), "--engines", str(self.folder / "engines"), "--jobs",
                str(self.folder / "jobs"), "--out", str(self.folder / "out"), *options]

    def run_league(self, *options, status=0):
        """The output, and the rows by engine, scene and setting."""
        done = subprocess.run(self.command(*options), capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stderr)
        path = self.folder / "out" / "league.csv"
        table = rows.read(path) if path.exists() else []
        return done.stderr, {(row["engine"], row["scene"], row["setting"]): row for row in table}

    def counts(self, said):
        """The numbers of measured and of stored results."""
        return tuple(map(int, re.search(r"(\d+) measured, (\d+) taken", said).groups()))


class Runs(League):
    def test_MeasureOnceAndThenOnlyWhatChanged(self):
        folder = self.engine("good", more='[documented]\nsource = "its page"\nengine = {soft = 0.125}', budget=20)
        said, table = self.run_league()
        self.assertEqual(self.counts(said), (7, 0))
        errors = [table["good", "wall", setting]["mean_abs_error"] for setting in ("defaults", "documented", "tuned")]
        lit, blocked = (table["good", "wall", "defaults"][key] for key in ("lit", "blocked"))
        # A quarter of the light is missing where it is lit, and an eighth; two pixels may lie at the shadow's border.
        self.assertAlmostEqual(errors[0], 0.25 * lit / (lit + blocked), delta=2 / (lit + blocked))
        self.assertAlmostEqual(errors[1], errors[0] / 2, delta=2 / (lit + blocked))
        self.assertLess(errors[2], errors[1])
        self.assertEqual(table["good", "wall", "tuned"]["single_key"], "soft")
        self.assertIn("--set engine.soft=0.125", table["good", "wall", "documented"]["command"])
        self.assertEqual(self.counts(self.run_league()[0]), (0, 7))
        text = (folder / "league.toml").read_text()
        (folder / "league.toml").write_text(text.replace("0.125", "0.5"))  # one setting's values
        self.assertEqual(self.counts(self.run_league()[0]), (1, 6))
        (folder / "adapter.py").write_text("# another adapter\n")
        self.assertEqual(self.counts(self.run_league()[0]), (6, 1))  # what GL shows is the same
        (folder / "README.md").write_text("What it is.\n")
        self.assertEqual(self.counts(self.run_league()[0]), (0, 7))

    def test_MeasureTheSettingsThatAreNamed(self):
        self.engine("good")
        said, table = self.run_league("--settings", "defaults")
        self.assertEqual(self.counts(said), (4, 0))  # and what GL shows, and two trials
        self.assertEqual(list(table), [("good", "wall", "defaults")])
        said, table = self.run_league("--settings", "tuned,defaults")
        self.assertEqual(self.counts(said), (2, 4))
        self.assertEqual(list(table), [("good", "wall", "defaults"), ("good", "wall", "tuned")])
        refused = subprocess.run(self.command("--settings", "best"), capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("unknown setting best; known are defaults, documented, tuned", refused.stderr)

    def test_AgainSaysThatAllIsTheSame(self):
        self.engine("good")
        self.assertIsNone(self.run_league()[1]["good", "wall", "defaults"]["again"])
        said, table = self.run_league("--again")
        self.assertEqual(self.counts(said), (6, 0))
        self.assertEqual({row["again"] for row in table.values()}, {"same"})
        store = self.folder / "out" / "store"
        path = next(store.glob("good.wall.defaults.*"))
        path.write_text(re.sub('"false_lit": [0-9]+', '"false_lit": 700', path.read_text()))
        table = self.run_league("--again")[1]
        self.assertRegex(table["good", "wall", "defaults"]["again"], "^false_lit: 700, now [0-9]+$")

    def test_StoppedGoOnWhereTheyWere(self):
        self.engine("good")
        process = subprocess.Popen(self.command(), stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.assertIn("gnomon.wall", process.stderr.readline())  # what GL shows is the first that is kept
        os.killpg(process.pid, signal.SIGINT)
        said = process.communicate(timeout=30)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("the same command resumes", said)
        measured, kept = self.counts(self.run_league()[0])
        self.assertEqual(measured + kept, 6)
        self.assertGreaterEqual(kept, 1)

    def test_KilledLoseNothingThatWasMeasured(self):
        self.engine("good")
        process = subprocess.Popen(self.command(), stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.assertIn("gnomon.wall", process.stderr.readline())  # what GL shows is the first that is kept
        process.kill()
        process.communicate(timeout=30)
        time.sleep(0.1)
        self.assertGreaterEqual(self.counts(self.run_league()[0])[1], 1)

    def test_NameWhoIsAbsentAndGoOn(self):
        self.engine("good")
        absent = self.engine("absent")
        (absent / "engine.sh").write_text('missing_of_engine() { echo "there is no abacus"; }\n')
        dead = self.engine("dead")
        (dead / "league.toml").write_text((dead / "league.toml").read_text().replace("fake_renderer.py", "no_such_file.py"))
        said, table = self.run_league()
        self.assertEqual(table["absent", None, None]["message"], "not installed: there is no abacus")
        self.assertRegex(table["dead", None, None]["message"], "^does not start: ")
        self.assertEqual(table["good", "wall", "defaults"]["status"], "done")
        self.assertIn("absent: not installed: there is no abacus", said)

    def test_RefuseWhatIsNotThere(self):
        self.engine("good")
        self.assertIn("unknown engine nobody; known are good", self.run_league("nobody", status=2)[0])


class Mistakes(League):
    """Each renderer makes one mistake, which exactly the check for it must find."""

    def trust(self, *mistakes, more="", lights=("directional",), setting="defaults"):
        self.engine("bad", *mistakes, more=more, lights=lights)
        return self.run_league("bad")[1]["bad", "wall", setting]

    def test_NoneIsMadeByTheOneWithout(self):
        row = self.trust()
        self.assertEqual(row["trust"], "unchecked: second_rasterizer: there is no second rasterizer for it here; "
                         "own_picture: the adapter makes no mask of pictures")
        self.assertTrue(all(row[f"check_{name}"].startswith("passed") for name in ("positions", "same_view", "shadows_off", "no_caster", "known_shape")))

    def test_ShadowsThatAreNotOffMarkTheRow(self):
        self.assertRegex(self.trust("--always")["trust"], "^not trusted: shadows_off: ")

    def test_AnotherViewMarksTheRow(self):
        self.assertRegex(self.trust("--turned")["trust"], "^not trusted: same_view: ")

    def test_ShadowsElsewhereMarkTheRow(self):
        self.assertRegex(self.trust("--aside")["trust"], "^not trusted: known_shape: ")

    def test_ShadowsThatASettingMovesAreTheEngines(self):
        row = self.trust("--aside", more="known_shape = { other = 3 }")
        self.assertRegex(row["check_known_shape"], "^passed: ")
        self.assertRegex(row["trust"], "^unchecked: ")
        self.assertIn('"other": 0', row["engine_settings"])

    def test_AnotherRasterizersNumbersMakeItTheDrivers(self):
        same = f'own_picture = {quoted(FAKE)}\n'
        more = f'{same}[second]\nname = "Dark"\ncommand = {quoted([*FAKE, "--dark"])}'
        row = self.trust(more=more)
        self.assertRegex(row["trust"], "^driver: Dark has 100.00 %")
        self.assertEqual(row["second_false_shadow_rate"], 1.0)
        more = f'{same}[second]\nname = "Same"\ncommand = {quoted(FAKE)}'
        self.assertEqual(self.trust(more=more)["trust"], "checked")

    def test_AnotherRasterizerMayDrawSomeLightsAlone(self):
        row = self.trust(more=f'[second]\nname = "Dark"\ncommand = {quoted([*FAKE, "--dark"])}\nlights = ["point"]')
        self.assertNotEqual(row["light"], "point")
        self.assertEqual(row["check_second_rasterizer"], "not done: there is no second rasterizer for it here")
        self.assertIsNone(row["second_false_shadow_rate"])

    def test_AMaskThatTheOwnPictureDoesNotShowMarksTheRow(self):
        row = self.trust(more=f'own_picture = {quoted([*FAKE, "--dark"])}')
        self.assertRegex(row["trust"], "^not trusted: own_picture: the picture has 100.00 %")
        self.assertRegex(self.trust(more=f"own_picture = {quoted(FAKE)}")["check_own_picture"], "^passed: ")

    def test_FramesThatAreNotEqualAreNoRow(self):
        self.engine("bad", "--unequal")
        said, table = self.run_league()
        self.assertRegex(table["bad", None, None]["message"], "two equal requests gave frames that are not equal: the mask differs at")

    def test_WhatIsRefusedIsANamedRow(self):
        self.engine("bad", more='[documented]\nsource = "its page"\nengine = {soft = 7}')
        table = self.run_league()[1]
        self.assertEqual(table["bad", "wall", "documented"]["status"], "refused")
        self.assertIn("engine.soft", table["bad", "wall", "documented"]["message"])
        self.assertEqual(table["bad", "wall", "defaults"]["status"], "done")


if __name__ == "__main__":
    unittest.main()
