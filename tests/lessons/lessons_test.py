"""Measures each claim of the lessons: its verdict holds, and docs/lessons.md has its number.

To show that the test can fail, every row must fail with its condition negated, and in its control run, which measures
something else. GNOMON_UPDATE_DOCUMENTS=1 updates the document's tables.
"""

import functools
import os
import sys
import unittest

import document
from all_lessons import LESSONS, rows
from measured_job import JOBS, NotMeasured, measure_beforehand, printed

FEWEST_ROWS = 35
LARGEST_COUNT_OFF = 10  # the pixels by which a documented count may differ


class Row(unittest.TestCase):
    """A claim's verdict holds for the measured number."""

    def __init__(self, lesson, claim, negated=False):
        super().__init__("run_row")
        self.lesson, self.claim, self.negated = lesson, claim, negated

    def __str__(self):
        return f"{self.lesson.folder}/{self.claim.job}"

    def measured(self, job):
        try:
            return self.claim.measure(job)
        except NotMeasured as reason:
            self.skipTest(str(reason))

    def run_row(self):
        number = self.measured(self.lesson.job(self.claim))
        limits = f"[{self.claim.low:g}, {self.claim.high:g}]"
        self.assertNotEqual(self.claim.holds(number), self.negated,
                            f"{self}: {self.claim.number}: {number:g}, limits {limits}: {self.claim.claim}")


class ControlRow(Row):
    """A claim's verdict does not hold for something else."""

    def run_row(self):
        number = self.measured(self.lesson.control(self.claim))
        self.assertFalse(self.claim.holds(number),
                         f"{self}: the control's number {number:g} is within the limits as well")


class DocumentedRow(Row):
    """The document has the claim and a number near the measured one."""

    def run_row(self):
        written = document.number_of(self.lesson, self.claim)
        again = "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R lessons updates it"
        self.assertIsNotNone(written, f"docs/lessons.md has no row {self}; {again}")
        number = self.measured(self.lesson.job(self.claim))
        self.assertTrue(self.claim.is_near(float(written), number),
                        f"docs/lessons.md, {self}: {written}, measured {self.claim.in_unit(number):g}; {again}")


class Rows(unittest.TestCase):
    """The rows, the job files and the document agree."""

    def test_there_are_enough_rows(self):
        self.assertGreaterEqual(len(rows()), FEWEST_ROWS)

    def test_each_job_file_is_of_one_row(self):
        named = [f"{lesson.folder}/{claim.job}" for lesson, claim in rows()]
        files = [str(path.relative_to(JOBS).with_suffix("")) for path in JOBS.rglob("*.toml")]
        self.assertEqual(sorted(named), sorted(files))

    def test_each_job_file_is_a_job(self):
        for lesson, claim in rows():
            plan = printed("sweep", str(lesson.job(claim).path), "--dry-run", "--json")
            self.assertEqual(plan["refused"], 0, f"{lesson.folder}/{claim.job}: {plan['first_refusal']}")

    def test_each_job_file_says_how_it_is_run(self):
        for lesson, claim in rows():
            path = lesson.job(claim).path
            self.assertRegex(path.read_text(), r"(?m)^#   gnomon (compare|sweep|depth|methods)", str(path))

    def test_each_documented_number_can_be_wrong(self):
        for lesson, claim in rows():
            written = float(document.number_of(lesson, claim))
            # Spreads are below 1: nothing is near ten times a number, and a half is not near zero.
            wrong = claim.off_by + 1 + written if claim.off_by else 10 * written or 0.5
            name = f"{lesson.folder}/{claim.job}"
            self.assertFalse(claim.is_near(written, wrong / claim.in_unit(1)), f"{name}: {wrong:g} is near {written:g}")
            self.assertLessEqual(claim.off_by, LARGEST_COUNT_OFF, name)
            self.assertTrue(claim.unit == "px" or not claim.off_by, f"{name}: it counts no pixels")

    def test_the_document_counts_the_verdicts(self):
        self.assertEqual(document.block_of("verdicts"), document.verdicts_text())

    def test_the_documents_tables_have_no_other_rows(self):
        for lesson in LESSONS:
            self.assertEqual(len(document.block_of(lesson.folder).splitlines()), 2 + len(lesson.claims), lesson.title)


def update_document():
    numbers = {lesson.folder: {claim.job: claim.printed(claim.measure(lesson.job(claim))) for claim in lesson.claims}
               for lesson in LESSONS}
    document.write(numbers)


def run(tests):
    return unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(unittest.TestSuite(tests))


def check():
    """Whether every row holds and the document has it."""
    measure_beforehand(functools.partial(claim.measure, lesson.job(claim)) for lesson, claim in rows())
    if os.environ.get("GNOMON_UPDATE_DOCUMENTS"):
        update_document()
    rows_agree = unittest.defaultTestLoader.loadTestsFromTestCase(Rows)
    return run([rows_agree, *(Row(*row) for row in rows()), *(DocumentedRow(*row) for row in rows())]).wasSuccessful()


def check_negated():
    """Whether every row fails with its claim negated, and in its control run."""
    measure_beforehand(functools.partial(claim.measure, lesson.control(claim)) for lesson, claim in rows())
    negated = unittest.TestResult()
    unittest.TestSuite(Row(*row, negated=True) for row in rows()).run(negated)
    failed = {str(test) for test, _ in negated.failures}
    excused = {str(test) for test, _ in negated.skipped}
    unmoved = [f"{lesson.folder}/{claim.job}" for lesson, claim in rows()
               if f"{lesson.folder}/{claim.job}" not in failed | excused]
    for name in unmoved:
        print(f"{name}: passes with its claim negated")
    print(f"{len(failed)} of {len(rows())} rows failed with their claim negated; all must")
    return run([ControlRow(*row) for row in rows()]).wasSuccessful() and not unmoved


if __name__ == "__main__":
    sys.exit(0 if all([check(), check_negated()]) else 1)
