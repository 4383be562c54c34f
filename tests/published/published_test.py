"""Each measured number is within the limits of its verdict, and docs/methods/published.md has it.

GNOMON_UPDATE_DOCUMENTS=1 updates the document. Only --full measures the rows that take minutes; otherwise only their
text is checked.
"""

import os
import sys
import unittest

import document
from row import NotMeasured, measure_beforehand
from rows import ROWS


class NumberTest(unittest.TestCase):
    """One number of a row."""

    def __init__(self, row, index):
        super().__init__("run_number")
        self.row, self.index = row, index
        self.number = row.numbers[index]

    def __str__(self):
        return f"{self.row.name}: {self.number.name}"

    def measured(self, measure):
        try:
            return measure()
        except NotMeasured as reason:
            self.skipTest(str(reason))

    # The number is within its limits, its control is not, and the document has it.
    def run_number(self):
        number = self.measured(self.number.measure)
        limits = f"[{self.number.low:g}, {self.number.high:g}]"
        self.assertTrue(self.number.holds(number), f"{self}: {number:g}, limits {limits}")
        control = self.measured(self.number.control)
        self.assertFalse(self.number.holds(control), f"{self}: the control's {control:g} is within {limits}, too")
        written = document.numbers_of(self.row)
        again = "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R published updates it"
        self.assertIsNotNone(written, f"docs/methods/published.md differs in {self.row.name}; {again}")
        self.assertTrue(self.number.is_near(float(written[self.index]), number),
                        f"docs/methods/published.md, {self}: {written[self.index]}, measured {number:g}; {again}")


class Document(unittest.TestCase):
    """The rows and the document fit together."""

    def test_the_document_has_each_row(self):
        for row in ROWS:
            self.assertIsNotNone(document.numbers_of(row), row.name)

    def test_the_document_has_the_overview(self):
        self.assertEqual(document.blocks.block_of(document.PATH, "overview"), document.overview())

    def test_each_documented_number_can_be_wrong(self):
        for row in ROWS:
            for number, written in zip(row.numbers, document.numbers_of(row)):
                wrong = 10 * float(written) or 0.5
                self.assertFalse(number.is_near(float(written), wrong), f"{row.name}: {number.name}")


def measured_rows():
    return [row for row in ROWS if "--full" in sys.argv[1:] or not row.slow]


def main():
    rows = measured_rows()
    numbers = [number for row in rows for number in row.numbers]
    measure_beforehand([measure for number in numbers for measure in (number.measure, number.control)])
    if os.environ.get("GNOMON_UPDATE_DOCUMENTS"):
        document.write(rows)
    tests = [unittest.defaultTestLoader.loadTestsFromTestCase(Document)]
    tests += [NumberTest(row, index) for row in rows for index in range(len(row.numbers))]
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(unittest.TestSuite(tests))
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
