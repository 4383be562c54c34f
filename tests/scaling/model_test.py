"""model_test.py SCALING_FIT: fits the model of docs/scaling.md to its measurements, and reports outliers."""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

FIT = sys.argv.pop()
DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
HEAD = ["series", "is_check", "triangles", "pixels", "texels", "biases", "curves", "quantity", "value"]


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Model(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def fit(self, rows):
        with open(self.folder / "measured.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, HEAD, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        return subprocess.run([FIT, *(self.folder / name for name in ("measured.csv", "model.csv", "checks.csv"))],
                              capture_output=True, text=True, check=False)

    def coefficient(self, quantity, term):
        return {(row["quantity"], row["term"]): float(row["coefficient"]) for row in read(self.folder / "model.csv")}[quantity, term]

    def test_of_the_document_is_that_of_its_measurements(self):
        done = self.fit(read(DOCS / "scaling_measurements.csv"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for name, keys in (("model", ("quantity", "term")), ("checks", ("quantity", "series", "size"))):
            found, recorded = read(self.folder / f"{name}.csv"), read(DOCS / f"scaling_{name}.csv")
            self.assertEqual([[row[key] for key in keys] for row in found], [[row[key] for key in keys] for row in recorded])
            value = "coefficient" if name == "model" else "predicted"
            for one, other in zip(found, recorded):
                # Least squares in double with a few terms; versions of Eigen order their sums differently.
                self.assertAlmostEqual(float(one[value]) / float(other[value]), 1, delta=1e-9)

    def test_finds_the_terms_that_costs_were_made_of(self):
        rows = read(DOCS / "scaling_measurements.csv")
        for row in rows:
            if row["quantity"] == "receivers_s":
                row["value"] = repr(0.01 + 3e-8 * float(row["pixels"]) + 2e-7 * float(row["triangles"]))
        self.fit(rows)
        self.assertAlmostEqual(self.coefficient("receivers_s", "pixels") / 3e-8, 1, delta=1e-9)
        self.assertAlmostEqual(self.coefficient("receivers_s", "triangles") / 2e-7, 1, delta=1e-9)

    def test_that_is_far_from_the_fourth_size_is_told(self):
        rows = read(DOCS / "scaling_measurements.csv")
        for row in rows:
            if row["quantity"] == "truth_s" and row["is_check"] == "1":
                row["value"] = repr(1.5 * float(row["value"]))
        done = self.fit(rows)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"truth_s .* too far")

    def test_needs_measurements(self):
        done = self.fit([])
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, "scaling_fit: start_s: 0 measurements for 1 terms\n")


if __name__ == "__main__":
    unittest.main(verbosity=2)
