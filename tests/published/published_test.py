"""Each published number beside ours: measured, within what its verdict needs, and as docs/methods/published.md has it.

GNOMON_UPDATE_DOCUMENTS=1 writes the document's rows anew. Without --full rows that take minutes are left out; what the
document says of them is held to their text alone.
"""

import contextlib
import os
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor

import document
from row import NotMeasured
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

    # It is within its limits, something else is not, and the document has it.
    def run_number(self):
        number = self.measured(self.number.measure)
        limits = f"[{self.number.low:g}, {self.number.high:g}]"
        self.assertTrue(self.number.holds(number), f"{self}: {number:g}, limits {limits}")
        control = self.measured(self.number.control)
        self.assertFalse(self.number.holds(control), f"{self}: the control's {control:g} is within {limits}, too")
        written = document.numbers_of(self.row)
        again = "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R published writes it anew"
        self.assertIsNotNone(written, f"docs/methods/published.md says something else of {self.row.name}; {again}")
        self.assertTrue(self.number.is_near(float(written[self.index]), number),
                        f"docs/methods/published.md, {self}: {written[self.index]}, measured {number:g}; {again}")


class House(unittest.TestCase):
    """The rows and the document fit together."""

    def test_the_document_has_each_row(self):
        for row in ROWS:
            self.assertIsNotNone(document.numbers_of(row), row.name)

    def test_the_document_has_the_overview(self):
        self.assertEqual(document.block_of("overview"), document.overview())

    def test_each_documented_number_can_be_wrong(self):
        for row in ROWS:
            for number, written in zip(row.numbers, document.numbers_of(row)):
                wrong = 10 * float(written) or 0.5
                self.assertFalse(number.is_near(float(written), wrong), f"{row.name}: {number.name}")


def measured_rows():
    return [row for row in ROWS if "--full" in sys.argv[1:] or not row.slow]


def measure_beforehand(rows):
    """Runs the program for all of them, as many at a time as there are processors."""
    def measure(number):
        # The number's own test measures again, and tells what fails.
        with contextlib.suppress(Exception):
            number.measure()
            number.control()

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(measure, [number for row in rows for number in row.numbers]))


def main():
    rows = measured_rows()
    measure_beforehand(rows)
    if os.environ.get("GNOMON_UPDATE_DOCUMENTS"):
        document.write(rows)
    tests = [unittest.defaultTestLoader.loadTestsFromTestCase(House)]
    tests += [NumberTest(row, index) for row in rows for index in range(len(row.numbers))]
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(unittest.TestSuite(tests))
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
