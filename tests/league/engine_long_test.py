"""An installed engine on the quick scenes: its rows are checked, and a second run measures nothing."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from made_rows import rows

import engines

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Engine(unittest.TestCase):
    def test_IsMeasuredCheckedAndKept(self):
        chosen = engines.chosen(engines.all_engines(), [], True)
        if not chosen:
            self.skipTest("no engine is installed: ./dev engines three")
        with tempfile.TemporaryDirectory() as place:
            command = [sys.executable, "-B", str(ROOT / "league" / "league.py"), "--quick", "--out", place, chosen[0].name]
            said = [subprocess.run(command, capture_output=True, text=True, check=True).stderr for _ in range(2)]
            table = rows.read(pathlib.Path(place) / "league.csv")
            self.assertTrue((pathlib.Path(place) / "league.html").exists())
        self.assertIn(" 0 measured", said[1])
        done = [row for row in table if row["status"] == "done"]
        self.assertGreaterEqual(len(done), 4)
        for row in done:
            self.assertTrue(row["check_shadows_off"].startswith("passed"), row)
            self.assertTrue(row["check_positions"].startswith("passed"), row)
            self.assertFalse(row["trust"].startswith("not trusted"), row)


if __name__ == "__main__":
    unittest.main()
