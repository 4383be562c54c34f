"""docs/scaling.md agrees with docs/scaling_model.csv and docs/scaling_checks.csv.

GNOMON_UPDATE_DOCUMENTS=1 updates the document's blocks.
"""

import os
import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "scaling"))

import document  # noqa: E402


class Document(unittest.TestCase):
    def test_is_what_the_model_says(self):
        if os.environ.get("GNOMON_UPDATE_DOCUMENTS"):
            document.write()
        for name, text in document.block_texts().items():
            self.assertEqual(document.blocks.block_of(document.PATH, name), text,
                             f"docs/scaling.md, block {name}: GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R scaling_document updates it")

    def test_changes_with_the_model(self):
        model = document.model_of(document.read(document.MODEL))
        before = document.example_text(model)
        model["curve_s"]["once"] *= 2
        self.assertNotEqual(document.example_text(model), before)


class Amount(unittest.TestCase):
    def test_has_three_digits_and_a_prefix(self):
        self.assertEqual(document.amount(1.2345e-7, "s"), "123 ns")
        self.assertEqual(document.amount(0.0123, "s"), "12.3 ms")
        self.assertEqual(document.amount(262, "B"), "262 B")
        self.assertEqual(document.amount(3 * 2**20, "B"), "3.00 MiB")


if __name__ == "__main__":
    unittest.main(verbosity=2)
