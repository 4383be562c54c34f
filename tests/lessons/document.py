"""docs/lessons.md: its tables are the rows of the lessons, with the numbers that were measured."""

import re
from collections import Counter

from all_lessons import LESSONS, rows
from claim import Verdict
from measured_job import ROOT

PATH = ROOT / "docs" / "lessons.md"
NUMBER = "\0"  # stands where a row has its number


def row_text(lesson, claim, number=NUMBER):
    """A claim's row of its table."""
    unit = {"": "", "%": " %"}.get(claim.unit, f" {claim.unit}")
    job = f"[{claim.job}](../examples/lessons/{lesson.folder}/{claim.job}.toml)"
    return f"| {claim.claim} | {job} | {number}{unit} | {claim.number} | {claim.verdict.value} | {claim.why} |"


def verdicts_text():
    """How many rows each verdict has, by lesson."""
    counts = {lesson.title: Counter(claim.verdict for claim in lesson.claims) for lesson in LESSONS}
    counts["all"] = Counter(claim.verdict for _, claim in rows())
    lines = [f"| | claims | {' | '.join(verdict.value for verdict in Verdict)} |", "|---|---|---|---|---|"]
    for title, count in counts.items():
        lines.append(f"| {title} | {count.total()} | {' | '.join(str(count[v]) for v in Verdict)} |")
    return "\n".join(lines)


def lesson_text(lesson, numbers):
    """A lesson's table; numbers: printed ones by claim."""
    lines = ["| it claims | job | number | of | verdict | why |", "|---|---|---|---|---|---|"]
    lines += [row_text(lesson, claim, numbers[claim.job]) for claim in lesson.claims]
    return "\n".join(lines)


def _block(name):
    return re.compile(rf"(<!-- {name}: generated -->\n\n)(.*?)(\n\n<!-- end -->)", re.DOTALL)


def block_of(name):
    """What stands between the markers of a name.

    Raises AssertionError where there are none.
    """
    found = _block(name).search(PATH.read_text())
    assert found, f"docs/lessons.md has no block <!-- {name}: generated -->"
    return found[2]


def number_of(lesson, claim):
    """The number that the document gives for a claim, as it stands there; None if it has no such row."""
    pattern = re.escape(row_text(lesson, claim)).replace(re.escape(NUMBER), r"([-0-9.e]+)")
    found = re.search(f"^{pattern}$", block_of(lesson.folder), re.MULTILINE)
    return found[1] if found else None


def write(numbers):
    """Puts the tables into the document; numbers: printed ones, by lesson's folder and claim's job."""
    text = PATH.read_text()
    blocks = {lesson.folder: lesson_text(lesson, numbers[lesson.folder]) for lesson in LESSONS}
    blocks["verdicts"] = verdicts_text()
    for name, table in blocks.items():
        text = _block(name).sub(lambda found, table=table: found[1] + table + found[3], text)
    PATH.write_text(text)
