"""docs/league.md is what docs/league.csv says, and the page has every row with its checks and command.

GNOMON_UPDATE_DOCUMENTS=1 writes the document's blocks anew.
"""

import os
import pathlib
import re
import tempfile
import unittest

from made_rows import row, tuned

import document
from engines import all_engines
import page
import rows
from scenes import JOBS, all_scenes

TABLE = [row("one", mean=0.2, false_shadow=0.2, surprising=True), tuned(), row("one", "fence", mean=0.01),
         row("two", mean=0.3, false_shadow=0.4, surprising=True, trust="not trusted: known_shape: elsewhere",
             check_known_shape="failed: elsewhere"),
         row("two", "fence", status="refused", message="it <has> none", frame_seconds=None),
         {**row("three"), "status": "absent", "message": "not installed: there is no node"}]


class Document(unittest.TestCase):
    def test_IsWhatTheTableSays(self):
        if os.environ.get("GNOMON_UPDATE_DOCUMENTS"):
            document.write(rows.read(document.CSV))
        for name, text in document.block_texts(rows.read(document.CSV)).items():
            self.assertEqual(document.blocks.block_of(document.PATH, name), text,
                             f"docs/league.md, block {name}: GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R league_document writes it anew")

    def test_NamesEveryColumnOfTheTable(self):
        text = document.PATH.read_text().partition("## The table")[2]
        named = re.findall(r"`([a-z_*]+)`", text)
        for column in rows.COLUMNS:
            self.assertTrue(any(re.fullmatch(name.replace("*", ".*"), column) for name in named), column)

    def test_ChangesWithTheTable(self):
        before = document.block_texts(TABLE)
        after = document.block_texts([{**TABLE[0], "false_shadow_rate": 0.123}, *TABLE[1:]])
        self.assertNotEqual(before["rows"], after["rows"])
        self.assertIn("12.3 / 0 / 20", after["rows"])

    def test_MarksWhatIsNotTrustedAndNamesWhoIsAbsent(self):
        texts = document.block_texts(TABLE)
        self.assertIn("40 / 0 / 30 (not trusted)", texts["rows"])
        self.assertIn("| fence | directional | refused | – | – | – |", texts["rows"])
        self.assertIn("| Three | not installed: there is no node |", texts["engines"])

    def test_SaysFirstWhatDefaultsMeansAndRanksNobody(self):
        known = all_engines()
        first = document.PATH.read_text().partition("## What was measured")[0]
        self.assertIn("**in Gnomon's frustum**", first)
        for engine in known.values():
            self.assertIn(engine.title, first)
            self.assertEqual(f"{engine.title} ({engine.frustum})" in first, bool(engine.frustum), engine.title)
        self.assertNotIn("ranks", document.block_texts(TABLE))
        with tempfile.TemporaryDirectory() as place:
            text = page.whole(TABLE, pathlib.Path(place), list(all_scenes().values()))
        self.assertIn("in Gnomon&#x27;s frustum", text.partition("<section>")[0])
        self.assertNotIn("<h2>Ranks</h2>", text)

    def test_PutsANoteBesideTheRowsThatItIsOf(self):
        babylon = [{**row("babylon", mean=0.2), "title": "Babylon.js"}]
        self.assertIn("With its own planes the errors are of the other kind", document.block_texts(babylon)["rows"])
        self.assertNotIn("With its own planes", document.block_texts(TABLE)["rows"])

    def test_SaysWhetherMeasuringAnewGaveTheSame(self):
        twice = [{**TABLE[0], "again": "same"}, {**TABLE[1], "again": "false_lit: 3, now 4"}]
        self.assertEqual(document.again_text(twice), "1 of 2 rows the same; columns tuned: false_lit: 3, now 4")
        self.assertEqual(document.again_text(TABLE), "not yet")


class Jobs(unittest.TestCase):
    def test_AreAtLeastSixScenesUnderEachKindOfLight(self):
        found = all_scenes().values()
        self.assertGreaterEqual(len(found), 6)
        self.assertEqual({scene.light for scene in found}, {"spot", "directional", "point"})
        self.assertEqual({scene.light for scene in found if scene.known_shape}, {"spot", "directional", "point"})
        quick = [scene for scene in found if scene.quick]
        self.assertEqual(len(quick), 2)
        self.assertEqual({scene.light for scene in quick}, {scene.light for scene in quick if scene.known_shape})  # all checks can be done
        self.assertEqual({path.stem for path in JOBS.glob("*.toml")} - {"scenes"}, {scene.name for scene in found})
        self.assertEqual({tuple(scene.image().values()) for scene in found}, {(640, 360)})


class Page(unittest.TestCase):
    def test_HasEveryRowWithItsChecksAndItsCommand(self):
        with tempfile.TemporaryDirectory() as place:
            text = page.whole(TABLE, pathlib.Path(place), list(all_scenes().values()))
        self.assertEqual(text.count("<summary>command</summary>"), sum(one["status"] == "done" for one in TABLE))
        self.assertIn("<li>known_shape: failed: elsewhere</li>", text)
        self.assertIn("gnomon compare league/jobs/fence.toml --renderer one", text)
        self.assertIn("it &lt;has&gt; none", text)

    def test_NeedsNothingBesideIt(self):
        with tempfile.TemporaryDirectory() as place:
            text = page.whole(TABLE, pathlib.Path(place), list(all_scenes().values()))
        self.assertEqual(re.findall(r"(?:src|href)=\"(?!data:)", text), [])
        self.assertNotIn("url(", text)

    def test_ShowsRowsThatAreNotTrustedHollow(self):
        with tempfile.TemporaryDirectory() as place:
            pages = [page.whole([{**TABLE[0], "trust": trust}], pathlib.Path(place), list(all_scenes().values()))
                     for trust in ("checked", "not trusted: known_shape: elsewhere")]
        hollow = [text.count('fill="none"') for text in pages]
        self.assertEqual(hollow[1], hollow[0] + 1)


if __name__ == "__main__":
    unittest.main()
