"""The league's rules: what passes a check and what does not, which row is trusted, sentences, the table's file."""

import csv
import pathlib
import tempfile
import unittest

from made_rows import row, tuned

import checks
import engines
import page
import rows
import sentences
from measure import Store


def done(lit=1000, blocked=100, **numbers):
    """An outcome without errors, except for the given numbers."""
    result = {"pixels": {"lit": lit, "blocked": blocked}, "false_shadow": 0, "false_lit": 0, "false_shadow_rate": 0.0,
              "false_lit_rate": 0.0, "shadow_amount_rate": 0.0, "light_amount_rate": 0.0, "mean_abs_error": 0.0,
              "evaluate": {"positions": "image", "import_check": {"distance_m": {"p99": 1e-6}, "tolerance_m": 1e-4, "agreement": 1.0}}}
    return {"status": "done", "message": "", "json": {**result, **numbers}}


def word(text):
    return text.partition(":")[0]


REFUSED = {"status": "refused", "message": "it has no such key", "json": None}


class Checks(unittest.TestCase):
    def test_PositionsPassOnTheMeshAlone(self):
        self.assertEqual(word(checks.positions(done())), "passed")
        off = done(evaluate={"positions": "image", "import_check": {"distance_m": {"p99": 1e-3}, "tolerance_m": 1e-4}})
        self.assertEqual(word(checks.positions(off)), "failed")
        given = done(evaluate={"positions": "camera", "import_check": {}})
        self.assertEqual(word(checks.positions(given)), "not done")

    def test_ARowMustShowWhatGlShows(self):
        self.assertEqual(word(checks.same_view(done(lit=1005), done())), "passed")
        self.assertEqual(word(checks.same_view(done(lit=20), done())), "failed")
        self.assertEqual(word(checks.same_view(done(), REFUSED)), "not done")

    def test_ShadowsOffMustLightAll(self):
        self.assertEqual(word(checks.shadows_off(done(false_lit=100, light_amount_rate=1.0))), "passed")
        self.assertEqual(word(checks.shadows_off(done())), "failed")
        self.assertEqual(word(checks.shadows_off(done(false_lit=100, light_amount_rate=1.0, false_shadow=3))), "failed")
        self.assertEqual(word(checks.shadows_off(done(false_lit=100, light_amount_rate=1.0, shadow_amount_rate=0.02))), "failed")
        self.assertEqual(checks.shadows_off(REFUSED), "not done: it has no such key")

    def test_NoCasterMustDarkenNothing(self):
        self.assertEqual(word(checks.no_caster(done(blocked=0))), "passed")
        self.assertEqual(word(checks.no_caster(done(blocked=0, false_shadow=3))), "failed")
        self.assertEqual(word(checks.no_caster(done(blocked=0, shadow_amount_rate=0.02))), "failed")
        self.assertEqual(word(checks.no_caster(done(blocked=5))), "failed")

    def test_KnownShapeMustLandWithTheBestSettings(self):
        def agreeing(agreement, mean):
            evaluate = {"positions": "image", "import_check": {"agreement": agreement}}
            return done(mean_abs_error=mean, evaluate=evaluate)
        self.assertEqual(word(checks.known_shape({"defaults": agreeing(0.1, 0.4), "tuned": agreeing(0.99, 0.01)}, "spot")), "passed")
        self.assertEqual(word(checks.known_shape({"defaults": agreeing(0.1, 0.4), "tuned": agreeing(0.5, 0.3)}, "spot")), "failed")
        self.assertEqual(word(checks.known_shape({"defaults": REFUSED}, "spot")), "not done")

    def test_RasterizersMayDifferByHalfAPointOrAQuarter(self):
        def second(rate):
            return word(checks.second_rasterizer(done(false_shadow_rate=0.5), done(false_shadow_rate=rate), "Other"))
        self.assertEqual(second(0.48), "passed")
        self.assertEqual(second(0.01), "failed")
        self.assertEqual(word(checks.second_rasterizer(done(), done(false_lit_rate=0.004), "Other")), "passed")
        self.assertEqual(word(checks.second_rasterizer(done(), None, "Other")), "not done")
        self.assertEqual(word(checks.second_rasterizer(done(), done(), "")), "not done")

    def test_AnEnginesOwnPictureHasTheRowsErrors(self):
        def pictured(**numbers):
            return word(checks.own_picture(done(false_shadow_rate=0.5), done(**numbers), True))
        self.assertEqual(pictured(false_shadow_rate=0.496), "passed")
        self.assertEqual(pictured(false_shadow_rate=0.48), "failed")
        # A tenth of the pixels is too dark, and may be what was wrong; two thirds show too little.
        self.assertEqual(pictured(false_shadow_rate=0.405, lit=900), "passed")
        self.assertEqual(pictured(false_shadow_rate=0.3, lit=900), "failed")
        self.assertEqual(pictured(false_shadow_rate=0.5, blocked=33), "not done")
        self.assertEqual(word(checks.own_picture(done(), None, True)), "not done")
        self.assertEqual(word(checks.own_picture(done(), REFUSED, True)), "not done")
        self.assertEqual(word(checks.own_picture(done(), done(), False)), "not done")


class Trust(unittest.TestCase):
    ALL = dict.fromkeys(checks.CHECKS, "passed: it did")
    SURPRISING = done(false_shadow_rate=0.06)["json"]

    def test_ASurprisingRowNeedsEveryCheck(self):
        self.assertEqual(checks.trust(self.SURPRISING, self.ALL, {}), "checked")
        lacking = {**self.ALL, "second_rasterizer": "not done: there is one"}
        self.assertEqual(checks.trust(self.SURPRISING, lacking, {}), "unchecked: second_rasterizer: there is one")
        self.assertEqual(checks.trust(done()["json"], lacking, {}), "checked")

    def test_SurprisingIsWhatExceedsOneOfThreeLimits(self):
        for name, limit in (("false_shadow_rate", 0.05), ("false_lit_rate", 0.3), ("mean_abs_error", 0.1)):
            self.assertFalse(checks.is_surprising(done(**{name: limit})["json"]), name)
            self.assertTrue(checks.is_surprising(done(**{name: limit + 0.001})["json"]), name)

    def test_AFailedCheckMarksTheRowWhateverItsNumbers(self):
        for name in ("positions", "same_view", "shadows_off", "no_caster", "known_shape", "own_picture"):
            failed = {**self.ALL, name: "failed: it did not"}
            self.assertEqual(checks.trust(done()["json"], failed, {}), f"not trusted: {name}: it did not")
            self.assertEqual(checks.trust(done()["json"], failed, {name: "as its manual says"}), "explained: as its manual says")

    def test_RasterizersThatDisagreeMakeItTheDrivers(self):
        failed = {**self.ALL, "second_rasterizer": "failed: Other has 0 %"}
        self.assertEqual(checks.trust(self.SURPRISING, failed, {}), "driver: Other has 0 %")


class Trusted(unittest.TestCase):
    def test_NoSentenceIsMadeOfARowThatIsNotTrusted(self):
        self.assertTrue(rows.is_trusted(row("one")))
        self.assertFalse(rows.is_trusted(row("two", trust="not trusted: known_shape: elsewhere")))


class Sentences(unittest.TestCase):
    def rules(self, table):
        return {one.rule: one for one in sentences.sentences_of(table, "one")}

    def test_SayWhichKeyMendsByHowMuchAndOfWhichRows(self):
        said = self.rules([row(false_shadow=0.4, mean=0.3), tuned(single=20.0)])
        self.assertIn("most wrong on **columns**: 40 % false shadow", said["defaults"].text)
        self.assertIn("**`bias` mends it.**", said["mends"].text)
        self.assertIn("`bias = -0.001` alone takes away 80 % of the error", said["mends"].text)
        self.assertIn("mean |error| 0.1 % in place of 30 %", said["mends"].text)
        self.assertEqual(said["mends"].rows, (("columns", "defaults"), ("columns", "tuned")))

    def test_NameNoSingleKeyWhereItMendsLessThanHalf(self):
        said = self.rules([row(mean=0.3), tuned(single=80.0)])
        self.assertIn("Several keys together", said["mends"].text)
        self.assertNotIn("alone", said["mends"].text)

    def test_AreSilentWhereNothingIsToBeSaid(self):
        self.assertEqual(list(self.rules([row(mean=0.001), tuned(mean=0.001)])), ["defaults"])

    def test_TellSoftErrorsFromCounts(self):
        self.assertIn("soft", self.rules([row(mean=0.1, false_shadow=0.001)]))
        self.assertNotIn("soft", self.rules([row(mean=0.1, false_shadow=0.1)]))

    def test_TellWhereNoShadowIsDrawn(self):
        self.assertIn("no_shadow", self.rules([row(false_lit=1.0, mean=0.1)]))

    def test_NameBothNumbersOfTheDrivers(self):
        said = self.rules([row(mean=0.3, false_shadow=0.46, trust="driver: Other has less", second_rasterizer="Other",
                               second_false_shadow_rate=0.005, second_false_lit_rate=0.0, second_mean_abs_error=0.03)])
        self.assertIn("46 % false shadow", said["driver"].text)
        self.assertIn("by Other 0.5 %, 0 % and 3 %", said["driver"].text)

    def test_CompareWhatIsDocumentedWithTheDefaults(self):
        said = self.rules([row(mean=0.3), row(setting="documented", mean=0.1, settings_said='{"bias": 1}')])
        self.assertIn("better than the defaults on 1 and worse on 0 of 1 scenes, by mean |error|: columns 30 % → 10 %",
                      said["documented"].text)

    def test_RestOnNoRowThatIsNotTrusted(self):
        said = self.rules([row(mean=0.3, trust="not trusted: known_shape: elsewhere"), tuned(single=20.0)])
        self.assertEqual(sorted(said), ["not_trusted"])

    def test_TellWhatIsRefused(self):
        said = self.rules([row(), row(scene="lamp-room", status="refused", message="it has no cubes")])
        self.assertEqual(said["not_drawn"].text, "Refused: it has no cubes.")


class Table(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def test_IsReadAsItWasWritten(self):
        table = [row(false_shadow=0.1, mean=1 / 3, message="a, \"b\"\nc"), row(surprising=True, peter_panning_gap_m=None)]
        rows.write(self.folder / "t.csv", table)
        self.assertEqual(rows.read(self.folder / "t.csv"), table)

    def test_OfBeforeThereWasACheckIsReadWithoutIt(self):
        rows.write(self.folder / "t.csv", [row(surprising=True)])
        with (self.folder / "t.csv").open() as whole, (self.folder / "old.csv").open("w") as file:
            writer = csv.DictWriter(file, [name for name in rows.COLUMNS if name != "check_own_picture"], extrasaction="ignore")
            writer.writeheader()
            writer.writerows(csv.DictReader(whole))
        read = rows.read(self.folder / "old.csv")
        self.assertEqual(read, [row(surprising=True, check_own_picture=None)])
        self.assertIn("own_picture: not done: not measured", page.checks_cell(read[0]))
        rows.write(self.folder / "new.csv", read)
        self.assertEqual(rows.read(self.folder / "new.csv"), read)

    def test_KeepsEnginesThatWereNotMeasuredNow(self):
        gone = {**row("one"), "status": "absent", "scene": None}
        self.assertEqual([r["status"] for r in rows.merged([row("one"), row("two")], [gone, row("two", mean=0.5)])], ["done", "done"])
        self.assertEqual(rows.merged([row("two")], [row("two", mean=0.5)])[0]["mean_abs_error"], 0.5)
        self.assertEqual(rows.merged([], [gone]), [gone])
        both = rows.merged([row("one", mean=0.1), row("one", "fence", mean=0.1)], [row("one", mean=0.5)])
        self.assertEqual([(r["scene"], r["mean_abs_error"]) for r in both], [("columns", 0.5), ("fence", 0.1)])
        tuned = {**row("one", mean=0.2), "setting": "tuned"}
        both = rows.merged([row("one", mean=0.1), tuned], [row("one", mean=0.5)])
        self.assertEqual([(r["setting"], r["mean_abs_error"]) for r in both], [("defaults", 0.5), ("tuned", 0.2)])

    def test_StoreGivesBackWhatDependsOnTheSame(self):
        store = Store(self.folder)
        store.write("a", {"x": 1}, {"status": "done"})
        self.assertEqual(store.read("a", {"x": 1}), {"status": "done"})
        self.assertIsNone(store.read("a", {"x": 2}))
        next(self.folder.glob("a.*")).write_text("{")  # cut off
        self.assertIsNone(store.read("a", {"x": 1}))


class Descriptions(unittest.TestCase):
    GOOD = 'title = "A"\nlights = ["spot"]\nshadows_off = {s = false}\n[limits]\nmask = "its own"\n'

    def described(self, text):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place) / "a"
            folder.mkdir()
            (folder / "league.toml").write_text(text)
            return engines.read_engine(folder)

    def test_OfTheCheckoutAreGood(self):
        self.assertIn("three", engines.all_engines())

    def test_ThatAreWrongAreRefusedByName(self):
        self.assertEqual(self.described(self.GOOD).title, "A")
        wrong = {"unknown key colour": 'colour = 1\n' + self.GOOD, "title is missing": self.GOOD.replace('title = "A"', ""),
                 "unknown light sun": self.GOOD.replace("spot", "sun"), "unknown light moon": self.GOOD + '[second]\nlights = ["moon"]\n',
                 "unknown check shape": self.GOOD + "[explained]\nshape = 'a'\n",
                 "unknown check view": self.GOOD + "[explained.point]\nview = 'a'\n", "unknown key bits": self.GOOD + "bits = 8\n",
                 "source is missing": self.GOOD + "[documented]\nengine = {bias = 1}\n", "league.toml": "title ="}
        for what, text in wrong.items():
            with self.assertRaisesRegex(engines.DescriptionError, what):
                self.described(text)

    def test_DocumentedValuesMayBelongToALight(self):
        engine = self.described(self.GOOD + "[documented]\nsource = 's'\nengine = {bias = 1}\npoint = {bias = 2}\n")
        self.assertEqual([engine.documented_for(light) for light in ("spot", "point")], [{"bias": 1}, {"bias": 2}])
        self.assertIsNone(self.described(self.GOOD).documented_for("spot"))

    def test_WhatIsExplainedMayBelongToALight(self):
        engine = self.described(self.GOOD + "[explained]\npositions = 'a'\npoint = {known_shape = 'b'}\n")
        self.assertEqual([engine.explained_for(light) for light in ("spot", "point")],
                         [{"positions": "a"}, {"positions": "a", "known_shape": "b"}])

    def test_ASecondRasterizerHasAllLightsOrThoseThatAreNamed(self):
        second = self.GOOD.replace('["spot"]', '["spot", "point"]') + '[second]\nname = "Other"\n'
        names = [[self.described(text).second_for(light).get("name") for light in ("spot", "point")]
                 for text in (second, second + 'lights = ["point"]\n', self.GOOD)]
        self.assertEqual(names, [["Other", "Other"], [None, "Other"], [None, None]])

    def test_AnUnknownEngineIsRefused(self):
        with self.assertRaisesRegex(engines.DescriptionError, "unknown engine nobody; known are"):
            engines.chosen(engines.all_engines(), ["nobody"], False)


if __name__ == "__main__":
    unittest.main()
